"""One more draw of the ledger's numbers, where that takes seconds: `DRAWS`, by row.

Each takes a seed and returns numbers by the names that their row gives them; the ledger's own are
means over such draws.
"""

import numpy as np

from vmc_lib.cerebellum.offline import broyden_calibration, gauss_newton_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, exact_weights, habitual_weights, nearest, plan

WHOLE_HOLD = "own off-line, 8 trials over the whole hold"
COUNT, MANY = 25, 200  # movements of a draw, as in the paper; and where they are new ones
HOLDS = {"": 0.0, ", over the hold": templates.HOLD}  # how long the hold is, s


def template_rows(targets, points, number):
    """Rows (n, number) of the nearest templates, for `plan`; of four None: one in each quadrant."""
    return None if number == 4 else nearest(targets, points, number)


def planned_error_ratio(seed, past=None, rule=habitual_weights, number=4, count=COUNT):
    """The mean miss over the mean reach; of templates `past` the plan mixes a `number`.

    Which, `template_rows` says; our reading of the paper by default.
    """
    past = past or templates.load(hold=0.0)
    targets = draw_targets(past, count, np.random.default_rng(seed))
    plans = plan(targets, past, rule, template_rows(targets, past.points, number))
    return execute(plans).error.mean() / np.linalg.norm(targets, axis=-1).mean()


def _planned(seed):
    sets = {reading: templates.load(hold=hold) for reading, hold in HOLDS.items()}
    return {
        f"planned error over reach{reading}": planned_error_ratio(seed, past, count=MANY)
        for reading, past in sets.items()
    }


def worst_example(seed, rule=habitual_weights):
    """The largest miss over its reach, of as many targets as Table IV prints."""
    past = templates.load(hold=0.0)
    targets = draw_targets(past, 5, np.random.default_rng(seed))
    return (execute(plan(targets, past, rule)).error / np.linalg.norm(targets, axis=-1)).max()


def _worst_example(seed):
    return {"near: miss over reach, worst of five examples": worst_example(seed)}


def _few_templates(seed):
    few, some, many = (
        planned_error_ratio(seed, templates.load(apart, 0.0)) for apart in (0.08, 0.06, 0.04)
    )
    most, least = (planned_error_ratio(seed, number=number) for number in (12, 3))
    return {
        "planned error, templates 6 cm apart over 8": some / few,
        "planned error, templates 4 cm apart over 6": many / some,
        "planned error, 12 templates combined over 3": most / least,
    }


def _non_linear(seed):
    numbers = {}
    for reading, hold in HOLDS.items():
        past, count = templates.load(hold=hold), MANY if hold else COUNT
        left = planned_error_ratio(seed, past, exact_weights, count=count)
        numbers |= {"miss over reach with exact weights, above rounding": left} if not hold else {}
        share = 1 - left / planned_error_ratio(seed, past, count=count)
        numbers[f"share of the miss that exact weights remove{reading}"] = share
    return numbers


def _exact(seed):
    left = planned_error_ratio(seed, rule=exact_weights) / planned_error_ratio(seed)
    return {"error with exact weights over that with Eq. 5, in the plane": left}


def error_ratio(trials):
    """Mean error of the best trials of each reach, over the planned one."""
    return trials.error.min(axis=0).mean() / trials.error[0].mean()


def mean_best_so_far(errors):
    """Mean over the targets of the least error up to each trial, (trials,), for (trials, n)."""
    return np.minimum.accumulate(errors).mean(axis=1)


def offline_ratios(tried, held):
    """Mean errors over the planned one: after 1, 2 and 4 trials, and over the whole hold, by name.

    Of the `Trials` by Broyden's rule, and by least squares.
    """
    left = mean_best_so_far(tried.error) / tried.error[0].mean()
    ratios = {f"own off-line, {k} trials": left[k] for k in (1, 2, 4)}
    return ratios | {WHOLE_HOLD: error_ratio(held)}


def _own_offline(seed):
    past = templates.load()
    habit = plan(draw_targets(past, MANY, np.random.default_rng(seed)), past)
    ratios = offline_ratios(broyden_calibration(habit, 4), gauss_newton_calibration(habit))
    return {f"error over planned, {name}": ratio for name, ratio in ratios.items()}


DRAWS = {
    "Table IV": _planned,
    "Fig. 9": _worst_example,
    "IV C, templates": _few_templates,
    "III, Block 3": _non_linear,
    "Ours, Eq. 5": _exact,
    "Ours, Table V": _own_offline,
}
