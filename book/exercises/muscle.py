"""Exercises of the chapter on a muscle."""

import numpy as np

from vmc_lib.arm.muscle import force_length as f1
from vmc_lib.arm.muscle import force_velocity as f2
from vmc_lib.arm.muscle import passive_force as f3
from vmc_lib.grading import Exercise


def activation_rates(u, a, rise, fall):
    up = (u - a) * (u / rise + (1 - u) / fall)
    down = (u - a) / fall
    return np.where(u >= a, up, down)


ACTIVATION_RATES = Exercise(
    activation_rates,
    lambda rng: (*rng.random((2, 6)).round(2), *rng.choice([[0.01, 0.04], [0.015, 0.05]])),
    {
        "Too slow on the way up: while $u \\ge a$, both time constants count, mixed by $u$.": (
            lambda u, a, rise, fall: (u - a) / fall
        ),
        "Too quick on the way down: there $u$ mixes nothing, and $\\tau_{deact}$ counts alone.": (
            lambda u, a, rise, fall: (u - a) * (u / rise + (1 - u) / fall)
        ),
        "On the way up you took $\\tau_{act}$ alone. Eq. 9 mixes both time constants by $u$.": (
            lambda u, a, rise, fall: np.where(u >= a, (u - a) / rise, (u - a) / fall)
        ),
        "The two cases are exchanged: the bracket belongs to $u \\ge a$.": (
            lambda u, a, rise, fall: np.where(
                u < a, (u - a) * (u / rise + (1 - u) / fall), (u - a) / fall
            )
        ),
        "`rise` and `fall` are exchanged.": lambda u, a, rise, fall: activation_rates(
            u, a, fall, rise
        ),
    },
)


def activation_to_hold(mass, length, strongest):
    share = 9.81 * mass / strongest
    active = (share - f3(length)) / (f1(length) * f2(0))
    return np.clip(active, 0, 1)


ACTIVATION_TO_HOLD = Exercise(
    activation_to_hold,
    lambda rng: (
        rng.uniform(2, 120, 5).round(),
        rng.uniform(0.7, 1.6, 5).round(2),
        rng.choice([987.0, 550.0]),
    ),
    {
        "Weight is a force: multiply the mass by 9.81 m/s².": lambda mass, length, strongest: (
            activation_to_hold(mass / 9.81, length, strongest)
        ),
        "Nearly: 9.8 m/s² is not enough here. Take 9.81.": lambda mass, length, strongest: (
            activation_to_hold(mass * 9.8 / 9.81, length, strongest)
        ),
        "A stretched muscle resists by itself. Take $f_3$ away before you ask for activation.": (
            lambda mass, length, strongest: np.clip(
                9.81 * mass / strongest / (f1(length) * f2(0)), 0, 1
            )
        ),
        "Activation lies between 0 and 1: what asks for more cannot be held, what asks for less "
        "than nothing needs none.": lambda mass, length, strongest: (
            (9.81 * mass / strongest - f3(length)) / (f1(length) * f2(0))
        ),
        "Your muscle pulls the same at every length: divide by $f_1$.": (
            lambda mass, length, strongest: np.clip(
                (9.81 * mass / strongest - f3(length)) / f2(0), 0, 1
            )
        ),
        "Nearly. At rest $f_2$ is not exactly 1 in the paper's formula: divide by $f_2(0)$, too.": (
            lambda mass, length, strongest: np.clip(
                (9.81 * mass / strongest - f3(length)) / f1(length), 0, 1
            )
        ),
    },
)
