"""Calibration and learning on an arm with signal-dependent noise (`motor_noise`)."""

from functools import cache, partial

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import SEEDS
from reproduce.experiments.controller_comparison import (
    MOVEMENTS,
    templates_with_noise,
    train_controller,
)
from reproduce.experiments.planning_ablation import repeat, repeat_best_trials
from reproduce.peers.adaptive_controllers import RIDGE, DeltaRuleCells
from reproduce.peers.motor_noise import noise_floor, noise_share_for, with_noise
from vmc_lib.cerebellum.online import AimCorrection, GranuleCells, WeightCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load

LEVELS = (0, 2, 5, 10)  # mm: the hand's standard deviation
LEARNERS = {
    "Algorithm 2": (lambda past, cells: WeightCorrection(), GranuleCells),
    "granule cells": (AimCorrection, GranuleCells),
    "a larger ridge": (AimCorrection, partial(GranuleCells, ridge=RIDGE)),
    **{
        f"delta rule, rate {rate}": (AimCorrection, partial(DeltaRuleCells, rate=rate))
        for rate in (0.02, 0.1, 0.4)
    },
}


def compare_learners(mm, seed, learners=LEARNERS, sizes=MOVEMENTS, held_out=200):
    """One draw on an arm that wavers by `mm`: shares of habit's miss that are left, by name.

    In-sample and held-out after so many movements (`train_controller`), and after off-line
    calibration: of the best trial, and of the same command given again. "Nothing but noise" is
    `noise_floor`, "habit" the miss in mm that all are shares of; "noise" the coefficient of
    variation of a command.
    """
    share = noise_share_for(mm)
    noise, left = partial(with_noise, share=share), {"noise": share}
    for name, learner in learners.items():
        shares = train_controller(*learner, seed, sizes, held_out, noise)[-1]
        left |= {f"{name}, in-sample": shares[:, 0], f"{name}, held-out": shares[:, 1]}
    return left | compare_calibration(noise, seed, held_out // 4)


def compare_calibration(noise, seed, count):
    """The off-line part of `compare_learners`, for so many targets."""
    rng = np.random.default_rng((seed, 3))
    habit = plan(draw_targets(load(), count, rng), templates_with_noise(noise, (seed, 4)))
    many = execute(repeat(habit, 20))
    miss = many.error.mean()
    left = {"habit": 1000 * miss, "nothing but noise": noise_floor(many.hold) / miss}
    for name, (best, again) in repeat_best_trials(habit, 20, cache(execute)).items():
        left[f"{name}, best trial"] = best.mean() / miss
        left[f"{name}, again"] = again.mean() / miss
    return left


def make(levels=LEVELS, seeds=SEEDS, **size):
    """What `results/unsteady.json` holds: `compare_learners` for every level, with every seed."""
    experiments = {f"{mm} mm": partial(compare_learners, mm, **size) for mm in levels}
    return calibration.make(experiments, seeds)


load_results = partial(calibration.load_results, "unsteady")
