"""The paper's experiments on movement, whole: plan, calibrate off-line, learn, test on new targets.

Tables IV to VI are `planned`, `offline` and a row of `in_sample`; Fig. 12 is the mean of each row.
The paper reports movements that were practised; `held_out` is what was learned for others.

`python -m vmc_lib.cerebellum.experiment` repeats them all with other seeds and writes
`data/movements.json`. The seeds are shared out by joblib: inside
`joblib.parallel_config("dask")` a whole cluster takes them.
"""

import json
from functools import partial
from typing import NamedTuple

import numpy as np
from joblib import Parallel, delayed

from ..arm.simulate import World
from ..data import FOLDER
from ..motor.planning import draw_targets, plan, surrounded, turned
from ..motor.templates import Library, load
from .adaptation import CORRECTIONS, Adaptation
from .offline import calibrate, published
from .online import Aim, Linear

FILE = FOLDER / "movements.json"
SEEDS = range(6)
SCENARIOS = ("changing neighbours", "four fixed templates")
PRISM = np.radians(6.0)
WORLDS = {  # what may change, as `Plan.under` takes it
    "a load of 0.5 kg": {"world": World(load=0.5)},
    "a viscous field": {"world": World(field=((-1.0, 0.0), (0.0, -1.0)))},
    "a prism": {"prism": PRISM},
}

# Algorithm 1 with every fifth n: a quarter of the reaches, and hardly a difference
quick = partial(published, gains=range(0, 21, 5))


class Errors(NamedTuple):
    """How far from the target the hand ends, in m; row k is after k experiments."""

    planned: np.ndarray  # (movements,): the first experiment's, by habit (Table IV) …
    offline: np.ndarray  # (movements,): … and after their off-line calibration (Table V)
    in_sample: np.ndarray  # (experiments + 1, movements): online, for movements just practised
    held_out: np.ndarray  # (experiments + 1, held_out): online, for movements never practised
    held_out_planned: np.ndarray  # (held_out,): those by habit


def run(learner, library, rng, movements=25, held_out=200, experiments=10, fresh=False, **lesson):
    """`Errors` of a learner (`Linear`, `Aim`) that practises `movements` in every experiment.

    They are the same movements each time, as we read Fig. 12, or new ones where `fresh`. What
    `lesson` names is passed to the learner's `practise`: `rule=quick` saves Algorithm 1's time.
    """
    unseen = plan(draw_targets(library, held_out, rng), library)
    first = practised = plan(draw_targets(library, movements, rng), library)
    in_sample, others = [_errors(learner.correct(first))], [_errors(learner.correct(unseen))]
    for experiment in range(experiments):
        if fresh and experiment:
            practised = plan(draw_targets(library, movements, rng), library)
        learner.practise(practised, **lesson)
        in_sample.append(_errors(learner.correct(practised)))
        others.append(_errors(learner.correct(unseen)))
    offline = lesson.get("rule", published)(first).error.min(axis=0)
    return Errors(_errors(first), offline, np.array(in_sample), np.array(others), _errors(unseen))


def around(library, place):
    """The four templates around a place (2,) as a `Library`: the scenario of four fixed ones."""
    four = plan(place, library).chosen
    return Library(library.points[four], library.excitations[four])


class Curve(NamedTuple):
    """An adaptation, block by block; every movement is made before it is learned from."""

    target: np.ndarray  # (blocks, movements, 2), m, as seen
    reached: np.ndarray  # (blocks, movements, 2), m, as seen

    @property
    def error(self):
        """Mean distance from the target in each block, (blocks,), m."""
        return np.linalg.norm(self.reached - self.target, axis=-1).mean(axis=-1)


def adapt(learner, library, rng, world, blocks=(2, 8, 6), movements=8):
    """The `Curve` of an `Adaptation` in a world (of `WORLDS`) that comes and goes.

    `blocks` counts those before, in and after the changed world. All targets are new, and lie
    where the arm has experience with the prism and without it.
    """
    before, during, _ = blocks
    targets = draw_targets(library, 4 * sum(blocks) * movements, rng)
    inside = targets[surrounded(turned(targets, -PRISM), library.points)]
    targets = inside[: sum(blocks) * movements].reshape(-1, movements, 2)
    reached = [
        learner.practise(plan(t, library).under(**(world if before <= b < before + during else {})))
        for b, t in enumerate(targets)
    ]
    return Curve(targets, np.array(reached))


def skilled(library, rng, movements=150):
    """An `Aim` that has practised."""
    return Aim(library).practise(plan(draw_targets(library, movements, rng), library))


def tables(seed, scenario=SCENARIOS[0]):
    """Tables IV to VI and the own rules for one seed and scenario: ratios of errors, by name."""
    rng, library = np.random.default_rng(seed), load()
    if scenario != SCENARIOS[0]:
        library = around(library, draw_targets(library, 1, rng)[0])
    paper = run(Linear(), library, rng)
    own = run(Aim(library), library, rng, fresh=True, experiments=10)
    many = plan(draw_targets(library, 200, rng), library)
    tried, practised = calibrate(many, 4).error.mean(axis=1), paper.in_sample.mean(axis=1)
    others, aimed = (e.held_out.mean(axis=1) / e.held_out_planned.mean() for e in (paper, own))
    return {
        "planned / reach": tried[0] / np.linalg.norm(many.target, axis=-1).mean(),
        "off-line, published": paper.offline.mean() / paper.planned.mean(),
        "online, 1 experiment, in-sample": practised[1] / paper.planned.mean(),
        "online, 1 experiment, held-out": others[1],
        "online, 10 experiments, in-sample": practised[10] / paper.planned.mean(),
        "online, 10 experiments, held-out": others[10],
        **{f"own off-line, {k} trials": tried[k] / tried[0] for k in (1, 2, 4)},
        **{f"own online, {25 * k} movements, held-out": aimed[k] for k in (0, 1, 6, 10)},
    }


def worlds(seed):
    """Mean error in mm of each block, by world and by what is corrected, for one seed."""
    library = load()
    return {
        f"{name}, {corrects}": 1000 * _adapted(seed, library, world, corrects).error
        for name, world in WORLDS.items()
        for corrects in CORRECTIONS
    }


def _adapted(seed, library, world, corrects):
    rng = np.random.default_rng(seed)
    return adapt(Adaptation(skilled(library, rng), library, corrects), library, rng, world)


def repeat(experiment, seeds=SEEDS, jobs=-1):
    """An experiment (seed -> dictionary of numbers) with every seed: name -> (seeds, …)."""
    results = Parallel(n_jobs=jobs)(delayed(experiment)(seed) for seed in seeds)
    return {name: np.array([r[name] for r in results]) for name in results[0]}


def measured():
    """What shipped: by scenario and "worlds", name -> one entry for each of `SEEDS`."""
    shipped = json.loads(FILE.read_text())
    return {part: {k: np.array(v) for k, v in rows.items()} for part, rows in shipped.items()}


def _errors(plan):
    return np.linalg.norm(plan.reached() - plan.target, axis=-1)


if __name__ == "__main__":
    parts = {s: repeat(partial(tables, scenario=s)) for s in SCENARIOS} | {"worlds": repeat(worlds)}
    rounded = {
        part: {name: np.round(values, 4).tolist() for name, values in rows.items()}
        for part, rows in parts.items()
    }
    FILE.write_text(json.dumps(rounded, indent=1) + "\n")
