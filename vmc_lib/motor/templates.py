"""Past experience: reaches that ended where they should, remembered as muscle excitations u_i(t).

Every reach starts at rest in the same posture and lasts a second. What ships is the spline knots
of the excitations.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from vmc_lib.arm.simulate import UNPERTURBED, simulate
from vmc_lib.data import arrays, read_only
from vmc_lib.motor.inverse_dynamics import spline, static_activation

START = np.radians([-20.0, 95.0])  # every reach begins here: elbow bent, the hand over the table
SPACINGS = (0.04, 0.06, 0.08)  # m: how densely past experience covers the plane …
SPACING = 0.06  # … unless another is asked for
REACH = 0.525  # m from the shoulder: a nearly straight arm


def reach(excitations, perturbation=UNPERTURBED):
    """The `Motion` that excitations (…, T, 6) give the arm from rest in `START`."""
    return simulate(excitations, START, _rest(), perturbation=perturbation)


@dataclass(frozen=True, eq=False)
class TemplateSet:
    """N remembered reaches from one resting posture, of our arm or of another.

    Another arm brings its own commands (N, T, m), their limits, and a `reach` that moves it.
    """

    points: np.ndarray  # (N, 2): where in the arm's plane each reach ended, m
    excitations: np.ndarray  # (N, T, 6), in [0, 1], 1 kHz
    limits: tuple = (0.0, 1.0)  # of a command: no nerve can do otherwise
    reach: Callable = reach  # commands (…, T, m), perturbation -> a motion with `endpoint` (…, 2)


@cache
def load(spacing=SPACING):
    """The shipped `TemplateSet` whose reached points lie `spacing` metres apart."""
    if spacing not in SPACINGS:
        raise ValueError(f"no templates lie {spacing} m apart; choose one of {SPACINGS}")
    excitations = spline() @ arrays("templates")[key(spacing)].astype(float)
    return TemplateSet(read_only(reach(excitations).endpoint), read_only(excitations))


@cache
def _rest():
    return static_activation(START)


def key(spacing):
    """The name under which the knots of such a set are stored."""
    return f"knots_{1000 * spacing:.0f}mm"
