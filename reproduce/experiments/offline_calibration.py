"""Off-line calibration as its chapter shows it: round upon round, with a load, and over the hold.

`calibration` has the six draws.
"""

from functools import partial

import numpy as np

from vmc_lib.arm.model import STEP
from vmc_lib.arm.simulate import Perturbation
from vmc_lib.cerebellum.offline import GAINS, algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.feedback import REFLEX, reference_trajectory, simulate_feedback
from vmc_lib.motor.inverse_dynamics import SAMPLES
from vmc_lib.motor.planning import norm
from vmc_lib.motor.templates import mean_distance

FIFTH = range(0, 21, 5)  # every fifth n
LOADS = {"empty": 0, "0.5 kg": 0.5}  # in the hand, kg
GRIDS = {"n = 0 only": (0,), "every fifth n": FIFTH, "every n": GAINS}


def repeat_algorithm_1(plan, keep, rounds=4):
    """Hands over the hold (rounds + 1, n, T, 2) by Algorithm 1 upon Algorithm 1, by `GRIDS`.

    With `keep` the weights before a round are among its tries. Each round's best weights move the
    arm once more: where it wavers, a lucky try does not count.
    """
    first, everyone = 0 if keep else 1, np.arange(len(plan.target))
    holds = {}
    for name, gains in GRIDS.items():
        weights = [plan.weights]
        for _ in range(rounds):
            trials = algorithm_1(plan.with_weights(weights[-1]), gains)
            winner = first + trials.error[first:].argmin(axis=0), everyone
            weights.append(trials.weights[winner])
        holds[name] = execute(plan.with_weights(np.array(weights))).hold
    return holds


def reaches_until(mm, plan, rules):
    """Extra reaches by each rule until its mean error is below so many mm; infinite if never.

    `rules` maps a name to hands over the hold (trials, n, T, 2), and the reaches of a trial.
    """
    errors = {name: 1000 * mean_distance(hold, plan.target) for name, (hold, _) in rules.items()}
    return {
        name: rules[name][1] * min(np.flatnonzero(error.mean(axis=-1) < mm), default=np.inf)
        for name, error in errors.items()
    }


def move_with_load(load):
    """`execute` with a load in kg in the hand."""
    return partial(execute, perturbation=Perturbation(load))


def trials_with_load(plan, load):
    """`Trials` of Broyden calibration with a load in kg, eight after the first: guarded -> them."""
    move = move_with_load(load)
    return {
        guarded: broyden_calibration(plan, 8, guarded=guarded, execute=move)
        for guarded in (True, False)
    }


def errors_with_load(plan, load):
    """Their errors in mm, (9, n): guarded -> errors."""
    return {k: 1000 * trials.error for k, trials in trials_with_load(plan, load).items()}


def hold_distances(plans, seconds=1.5):
    """How far the hand is from each target after the command, (n, T), mm, every 10 ms."""
    paths = templates.reach(plans.excitations, hold=seconds).hold
    return 1000 * norm(paths - plans.target[:, None])


def reflex_distances(plans, seconds=1.5):
    """The same with the stretch reflex of chapter 12, which is told where the joints should be."""
    reference = reference_trajectory(plans, SAMPLES * STEP + seconds)
    paths = simulate_feedback(reference, REFLEX).hand[:, SAMPLES :: templates.EVERY, :2]
    return 1000 * norm(paths - plans.target[:, None])


def hold_measures(hold, target):
    """Means over reaches of hands' paths (n, T, 2) over the hold, for targets (n, 2), m.

    The miss where the command ends; the distance from the target over the hold, and how far the
    mean place is from it, the bias (all in mm); the speed (mm/s).
    """
    away = hold - target[:, None]
    misses = away[:, 0], away, away.mean(axis=1)
    speed = templates.mean_speed(hold).mean()
    return [1000 * x for x in (*(norm(miss).mean() for miss in misses), speed)]
