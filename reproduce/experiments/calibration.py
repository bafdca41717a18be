"""The paper's motor experiments: planning, off-line and online calibration, held-out targets.

Tables IV to VI are `planned`, `offline` and a row of `in_sample`; Fig. 12 is the mean of each row.
The paper reports movements that were practised; `held_out` is what was learned for others.

`make` repeats them all with other seeds. The seeds are shared out by joblib: inside
`joblib.parallel_config("dask")` a whole cluster takes them.
"""

from copy import deepcopy
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from joblib import Parallel, delayed

from reproduce import results
from reproduce.experiments.offline_calibration import FIFTH, hold_distances
from reproduce.measures.changed_worlds import block_errors
from reproduce.one_draw import WHOLE_HOLD, offline_ratios
from vmc_lib.cerebellum.offline import (
    algorithm_1,
    broyden_calibration,
    calibrate,
    gauss_newton_calibration,
)
from vmc_lib.cerebellum.online import (
    AimCorrection,
    GranuleCells,
    WeightCorrection,
    mossy_fibres,
    smooth_weights,
)
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import HOLD, load

SEEDS, MANY = range(6), range(20)  # the latter where draws differ so much that six do not tell
NOISE = 0.2  # of every excitation's size, fresh in every step
SCENARIOS = ("changing neighbours", "four fixed templates")

# Algorithm 1 with every fifth n: a quarter of the reaches, and hardly a difference
coarse_algorithm_1 = partial(algorithm_1, gains=FIFTH)
no_calibration = partial(broyden_calibration, n_trials=0)  # no trial at all: a movement as it is


class Errors(NamedTuple):
    """How far from the target the hand ends, in m; row k is after k experiments."""

    planned: np.ndarray  # (movements,): the first experiment's, by habit (Table IV) …
    offline: np.ndarray  # (movements,): … and after their off-line calibration (Table V)
    in_sample: np.ndarray  # (experiments + 1, movements): online, for movements just practised
    held_out: np.ndarray  # (experiments + 1, held_out): online, for movements never practised
    held_out_planned: np.ndarray  # (held_out,): those by habit


def run_experiments(
    learner, template_set, rng, movements=25, held_out=200, experiments=10, fresh=False, **lesson
):
    """`Errors` of a learner that practises so many `movements` in every experiment.

    They are the same movements each time, as we read Fig. 12, or new ones where `fresh`. What
    `lesson` names is passed to the learner's `update`: `rule=coarse_algorithm_1` saves time.
    """
    unseen = plan(draw_targets(template_set, held_out, rng), template_set)
    first = practised = plan(draw_targets(template_set, movements, rng), template_set)

    def error(plans):
        return execute(learner.correct(plans)).error

    in_sample, others = [error(first)], [error(unseen)]
    for experiment in range(experiments):
        if fresh and experiment:
            practised = plan(draw_targets(template_set, movements, rng), template_set)
        learner.update(practised, **lesson)
        in_sample.append(error(practised))
        others.append(error(unseen))
    offline = calibrate(first, lesson.get("rule", "published")).error.min(axis=0)
    planned, held_out_planned = execute(first).error, execute(unseen).error
    return Errors(planned, offline, np.array(in_sample), np.array(others), held_out_planned)


def nearest_templates(template_set, place):
    """The four templates around a place (2,), as a `TemplateSet`."""
    four = plan(place, template_set).rows
    points, excitations = template_set.points[four], template_set.excitations[four]
    return replace(template_set, points=points, excitations=excitations)


def _granule_cell_rule():
    return WeightCorrection(weigh=smooth_weights, g=GranuleCells(), inputs=mossy_fibres)


ABLATION = {  # from Algorithm 2 to our rule, one thing more at each: a learner, how it practises
    "+ exact weights": (partial(WeightCorrection, weigh=smooth_weights), {}),
    "+ granule cells": (_granule_cell_rule, {}),
    "+ no off-line trials": (_granule_cell_rule, {"rule": no_calibration}),
}


def error_ratios(
    seed, scenario=SCENARIOS[0], hold=HOLD, movements=25, held_out=200, experiments=10, past=None
):
    """Tables IV to VI and the own rules for one seed and scenario: ratios of errors, by name.

    "online" is Algorithm 2 as printed. The other reading of it, and `ABLATION` from it to our rule,
    practise the same movements and are tested on the same others. Movements end with a `hold` of so
    many seconds; without one only what the paper has is measured. `past` are other templates than
    those that ship, of an arm with such a hold.
    """
    rng, template_set = np.random.default_rng(seed), past or load(hold=hold)
    if scenario != SCENARIOS[0]:
        template_set = nearest_templates(template_set, draw_targets(template_set, 1, rng)[0])
    size, same = (movements, held_out, experiments), partial(deepcopy, rng)
    other, paper = WeightCorrection(hindsight=False), WeightCorrection()
    runs = {
        "online, the other reading": run_experiments(other, template_set, same(), *size),
        "online": (published := run_experiments(paper, template_set, same(), *size)),
    }
    if hold:
        runs |= {
            f"online, {step}": run_experiments(
                learner(), template_set, same(), movements, held_out, 1, **lesson
            )
            for step, (learner, lesson) in ABLATION.items()
        }
    unseen = draw_targets(template_set, held_out, same())
    return {
        "planned / reach": published.held_out_planned.mean()
        / np.linalg.norm(unseen, axis=-1).mean(),
        "off-line, published": published.offline.mean() / published.planned.mean(),
        **{f"{name}, {k}": x for name, e in runs.items() for k, x in _ratios(e).items()},
        **(_own_ratios(template_set, rng, *size) if hold else {}),
    }


def _own_ratios(template_set, rng, movements, held_out, experiments):
    """What our rules leave of the planned error, and how still the hand is then, by name.

    The miss over the hold and the bias in it, what the hand strays there, and how far from the
    target it is at 2.5 s, on average and at worst, in mm; speed over the hold in mm/s.
    """
    many = plan(draw_targets(template_set, held_out, rng), template_set)
    tried, held = broyden_calibration(many, 4), gauss_newton_calibration(many)
    rows, learner = offline_ratios(tried, held), AimCorrection(template_set)
    own = run_experiments(learner, template_set, rng, movements, held_out, experiments, fresh=True)
    aimed = own.held_out.mean(axis=1) / own.held_out_planned.mean()
    rows |= {
        f"own online, {movements * k} movements, held-out": aimed[k]
        for k in (0, 1, 6, 10)
        if k <= experiments
    }
    best = {"own off-line, 4 trials": tried, WHOLE_HOLD: held, "Algorithm 1": algorithm_1(many)}
    plans = {"planned": many, "own online": learner.correct(many)}
    plans |= {name: many.with_weights(trials.best_weights) for name, trials in best.items()}
    for name, corrected in plans.items():
        movement, late = execute(corrected), hold_distances(corrected)[:, -1]
        rows[f"{name}, mm"] = 1000 * movement.error.mean()
        rows[f"{name}, bias"] = 1000 * movement.bias.mean()
        rows[f"{name}, speed"] = 1000 * movement.speed.mean()
        rows[f"{name}, stray"] = 1000 * movement.stray.mean()
        rows[f"{name}, at 2.5 s"], rows[f"{name}, worst at 2.5 s"] = late.mean(), late.max()
    return rows


def ratio_name(experiments, measured_on):
    """The key of what is left after so many experiments, "in-sample" or "held-out"."""
    return f"{experiments} experiment{'s' * (experiments > 1)}, {measured_on}"


def _ratios(errors):
    """Of the planned error after the first experiment and the last, in-sample and held-out."""
    practised, others = errors.in_sample.mean(axis=1), errors.held_out.mean(axis=1)
    left = {
        "in-sample": practised / errors.planned.mean(),
        "held-out": others / errors.held_out_planned.mean(),
    }
    return {
        ratio_name(k, measured_on): share[k]
        for k in sorted({1, len(practised) - 1})
        for measured_on, share in left.items()
    }


AS_PRINTED = "the hand where the command ends"  # our reading of the paper: where a movement ends
TABLES = {
    **{s: partial(error_ratios, scenario=s) for s in SCENARIOS},
    **{f"{s}, {AS_PRINTED}": partial(error_ratios, scenario=s, hold=0.0) for s in SCENARIOS},
}
EXPERIMENTS = TABLES | {"perturbations": block_errors}


def make(experiments=EXPERIMENTS, seeds=None):
    """What `results/movements.json` holds: every experiment with every seed, to four digits."""
    return round_results(
        {
            name: repeat_over_seeds(experiment, seeds or (MANY if name in TABLES else SEEDS))
            for name, experiment in experiments.items()
        }
    )


def round_results(parts):
    """Results as their file holds them, part -> name -> numbers in lists, to four digits."""
    return {
        part: {name: np.round(values, 4).tolist() for name, values in rows.items()}
        for part, rows in parts.items()
    }


def repeat_over_seeds(experiment, seeds=SEEDS):
    """An experiment (seed -> dictionary of numbers) with every seed: name -> (seeds, …)."""
    results = Parallel()(delayed(experiment)(seed) for seed in seeds)
    return {name: np.array([r[name] for r in results]) for name in results[0]}


def load_results(name="movements"):
    """What `make` made and shipped by that name: experiment -> name -> an entry for each seed."""
    shipped = results.records(name)
    return {part: {k: np.array(v) for k, v in rows.items()} for part, rows in shipped.items()}
