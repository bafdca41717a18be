"""An arm that wavers: noise that lasts, and what calibration and learning make of it.

The motor units of a muscle, its pool, are driven together, and what unsteadies a pull most is a
slow waver of that common drive (Dideriksen et al. 2012). So every pool has one smooth curve of
noise, and its command is multiplied by it: the stronger the command, the noisier (Harris & Wolpert
1998). How strong the noise is, is told by where the hand ends: by the standard deviation of a reach
that is repeated.
"""

from functools import cache, partial

import numpy as np
from scipy.optimize import brentq

from reproduce.experiments import calibration
from reproduce.experiments.calibration import SEEDS
from reproduce.peers import adaptive_controllers
from reproduce.peers.adaptive_controllers import MOVEMENTS
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.cerebellum.online import AimCorrection, GranuleCells, WeightCorrection
from vmc_lib.motor.inverse_dynamics import spline
from vmc_lib.motor.planning import draw_targets, exact_weights, plan
from vmc_lib.motor.templates import load, reach

KNOTS = 12  # spline coefficients of a pool's noise: it wavers about as slowly as commands change
LEVELS = (0, 2, 5, 10)  # mm: the hand's standard deviation
LEARNERS = {
    "Algorithm 2": (lambda past, cells: WeightCorrection(), GranuleCells),
    "granule cells": (AimCorrection, GranuleCells),
    "a larger ridge": (AimCorrection, partial(GranuleCells, ridge=adaptive_controllers.RIDGE)),
    **{
        f"delta rule, rate {rate}": (
            AimCorrection,
            partial(adaptive_controllers.LocalCells, rate=rate),
        )
        for rate in (0.02, 0.1, 0.4)
    },
}


@cache
def waves():
    """The smooth curves (T, KNOTS) of which noise is made: random sums of them vary by one."""
    return spline(KNOTS) / np.linalg.norm(spline(KNOTS), axis=1, keepdims=True)


def waver(shape, share, rng):
    """By what noise multiplies commands of a shape (…, T, 6): 1 + share · (a smooth curve)."""
    random = rng.standard_normal((*shape[:-2], KNOTS, 6))
    return 1 + share * waves() @ random


def wavering(excitations, share, rng):
    """Excitations (…, T, 6), each pool's times its `waver`, held to [0, 1]."""
    return np.clip(excitations * waver(np.shape(excitations), share, rng), 0, 1)


def deviation(ends):
    """The standard deviation in m of ends (repeats, n, 2) about their means, over both axes."""
    return np.sqrt(ends.var(axis=0, ddof=1).mean())


@cache
def share_for(mm):
    """The share of `wavering` with which repeated reaches end with a standard deviation of `mm`.

    ValueError when no share up to one gives so much.
    """
    targets = draw_targets(load(), 200, np.random.default_rng(100))
    told = plan(targets, load(), exact_weights).excitations

    @cache  # the ends of the search are asked for twice
    def missing(share):
        if not share:
            return -mm
        rng = np.random.default_rng(101)  # one repeat at a time: less memory
        ends = [reach(wavering(told, share, rng)).reached for _ in range(10)]
        return 1000 * deviation(np.array(ends)) - mm

    if not (mm == 0 or (mm > 0 and missing(1.0) > 0)):
        raise ValueError(f"no noise makes reaches end with {mm} mm; choose 0 to 20")
    return brentq(missing, 0, 1, xtol=1e-3, rtol=1e-3)


def learned(mm, seed, learners=LEARNERS, sizes=MOVEMENTS, held_out=200):
    """One draw on an arm that wavers by `mm`: shares of habit's miss that are left, by name.

    In-sample and held-out after so many movements (`adaptive_controllers.practise`), and after
    off-line calibration: of the best trial, and of the same command given again. "Nothing but
    noise" is how far reaches end from their own mean, "habit" the miss in mm that all are shares
    of.
    """
    noise = partial(wavering, share=share_for(mm))
    left = {}
    for name, learner in learners.items():
        shares = adaptive_controllers.practise(*learner, seed, sizes, held_out, noise)[-1]
        left |= {f"{name}, in-sample": shares[:, 0], f"{name}, held-out": shares[:, 1]}
    return left | calibrated(noise, seed, held_out // 4)


def calibrated(noise, seed, count):
    """The off-line part of `learned`, for so many targets."""
    rng = np.random.default_rng((seed, 3))
    habit = plan(draw_targets(load(), count, rng), adaptive_controllers.arm(noise, (seed, 4)))
    many = habit.with_weights(np.tile(habit.weights, (20, 1, 1))).reached()
    miss = _norm(many - habit.target).mean()
    left = {
        "habit": 1000 * miss,
        "nothing but noise": _norm(many - many.mean(axis=0)).mean() / miss,
    }
    for name, rule in {"Algorithm 1": algorithm_1, "Broyden": broyden_calibration}.items():
        trials = rule(habit)
        again = habit.with_weights(np.tile(trials.best, (20, 1, 1))).reached()
        left[f"{name}, best trial"] = trials.error.min(axis=0).mean() / miss
        left[f"{name}, again"] = _norm(again - habit.target).mean() / miss
    return left


def make(levels=LEVELS, seeds=SEEDS, **size):
    """What `results/unsteady.json` holds: `learned` for every level, with every seed."""
    experiments = {f"{mm} mm": partial(learned, mm, **size) for mm in levels}
    return calibration.make(experiments, seeds)


measured = partial(calibration.measured, "unsteady")
_norm = partial(np.linalg.norm, axis=-1)
