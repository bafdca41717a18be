"""Ablation of the reach: its templates, weights and correction, swapped one at a time.

Errors are distances of the hand from its targets where a movement ends, in mm.
"""

from dataclasses import replace
from functools import cache, partial

import numpy as np

from reproduce.experiments.controller_comparison import templates_with_noise
from vmc_lib.arm import muscle
from vmc_lib.arm.engines import activations
from vmc_lib.cerebellum.offline import (
    algorithm_1,
    broyden_calibration,
    gauss_newton_calibration,
)
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import exact_weights, habitual_weights, norm, plan
from vmc_lib.motor.templates import load

WEIGHTS = {"nearness (Eq. 5)": habitual_weights, "exact (Eq. 4)": exact_weights}
SPACINGS = 8, 6, 4  # cm between templates
RULES = {
    "Algorithm 1": algorithm_1,
    "Broyden": broyden_calibration,
    "least squares": gauss_newton_calibration,
}
CALIBRATIONS = {
    "none": lambda habit: execute(habit).error,
    "Algorithm 1": lambda habit: algorithm_1(habit).error.min(axis=0),
    "Broyden, 1 trial": lambda habit: broyden_calibration(habit, n_trials=1).error.min(axis=0),
    "Broyden, 2 trials": lambda habit: broyden_calibration(habit, n_trials=2).error.min(axis=0),
    "least squares, 8 trials": lambda habit: gauss_newton_calibration(habit).error.min(axis=0),
}


def reach_errors(targets, weights, correction, spacing):
    """Errors (n,) of reaches for targets (n, 2), of the best trial; the spacing is in cm."""
    return 1000 * CALIBRATIONS[correction](plan(targets, load(spacing / 100), WEIGHTS[weights]))


def repeated_errors(habit, repeats=4):
    """Errors (n,) of a noisy plan: as planned, of each rule's best trial, and of that trial again.

    The last is a mean over repeats.
    """
    once = cache(execute)
    errors = {"planned": 1000 * once(habit).error}
    for name, (best, again) in repeat_best_trials(habit, repeats, once).items():
        errors[f"{name}, best trial"] = 1000 * best
        errors[f"{name}, again"] = 1000 * again.mean(axis=0)
    return errors


def repeat_best_trials(habit, repeats, once):
    """By rule: the errors, m, of its best trial (n,), and of the same commands again (repeats, n).

    A plan meets its noise `once`: to give its commands again, make it again.
    """
    found = {}
    for name, rule in RULES.items():
        trials = rule(habit, execute=once)
        again = execute(repeat(habit.with_weights(trials.best_weights), repeats))
        found[name] = trials.error.min(axis=0), again.error
    return found


def repeat(habit, count):
    """A batch of plans, (n,), so many times: (count, n)."""
    return habit.with_weights(np.tile(habit.weights, (count, 1, 1)))


def on_noisy_arm(plans, percent):
    """The same plans on an arm whose commands vary by so many percent, during the hold too."""
    noise = partial(muscle.noisy, share=percent / 100)
    return replace(plans, template_set=templates_with_noise(noise, 1))


def muscle_scatter(plans, percent):
    """How unsteady muscle noise makes an activation, and the ends of a plan repeated.

    A share; the ends' standard deviations forward and up, and how far their mean moves, in mm.
    """
    hold, draws = np.full((1, 20_000, 1), 0.1), np.random.default_rng(1)
    u = muscle.noisy(hold, percent / 100, draws)
    a = activations(u, u[:, 0])[0, 500:]
    ends = execute(on_noisy_arm(plans, percent)).endpoint
    shift = norm(ends.mean(axis=0) - execute(plans).endpoint[0])
    return a.std() / a.mean(), *1000 * ends.std(axis=0, ddof=1), 1000 * shift
