"""Past experience: reaches that ended where they should, remembered as muscle excitations u_i(t).

Every reach starts at rest in the same posture. Its command lasts a second; then comes the hold, for
which the last command is kept on. What ships is the spline knots of the excitations, and the
activation at rest.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import STEP
from vmc_lib.arm.simulate import UNPERTURBED, Motion, Perturbation, simulate
from vmc_lib.checks import as_numbers, cached, is_within
from vmc_lib.data import arrays, read_only
from vmc_lib.motor.inverse_dynamics import spline
from vmc_lib.short_repr import short, short_repr

START = np.radians([-20.0, 95.0])  # every reach begins here: elbow bent, the hand over the table …
HOME = hand(START)[:2]  # m: … where it rests
SPACINGS = (0.04, 0.06, 0.07, 0.08)  # m: how densely past experience covers the plane …
SPACING = 0.06  # … unless another is asked for
REACH = 0.525  # m from the shoulder: a nearly straight arm
HOLD = 0.5  # s: how long the last command is kept on, by every arm …
EVERY = 10  # ms: … and how often the hand is looked at meanwhile


@dataclass(frozen=True, eq=False)
class HeldMotion(Motion):
    """A reach, and the hold after it."""

    held: int  # steps

    __repr__ = short_repr

    @property
    def wrist(self) -> np.ndarray:
        """The wrist's path from the command's end on, (…, n, 3) in the shoulder frame, m."""
        return hand(self.q[..., -1 - self.held :: EVERY, :])

    @property
    def hold(self) -> np.ndarray:
        """The same in the arm's plane, (…, n, 2), m."""
        return self.wrist[..., :2]

    @property
    def endpoint(self) -> np.ndarray:
        """Where the wrist is on average over the hold, (…, 2), m."""
        return self.hold.mean(axis=-2)

    @property
    def speed(self) -> np.ndarray:
        """How fast the wrist still moves over the hold, on average, (…), m/s."""
        return mean_speed(self.hold, self.held * STEP)


def mean_speed(hold: np.ndarray, seconds: float = HOLD) -> np.ndarray:
    """The mean speed (…), m/s, of what takes the path (…, n, D), m, over a hold of so many seconds.

    ValueError where there is no hold.
    """
    if not seconds:
        raise ValueError("no speed over a hold of 0 s: give a longer hold, as load(hold=0.5)")
    return np.linalg.norm(np.diff(hold, axis=-2), axis=-1).sum(axis=-1) / seconds


def mean_distance(hold: np.ndarray, target: ArrayLike) -> np.ndarray:
    """The mean distance (…) of paths over the hold (…, n, D) from targets (…, D), in their unit."""
    return np.linalg.norm(offsets(hold, target), axis=-1).mean(axis=-1)


def offsets(points: np.ndarray, target: ArrayLike) -> np.ndarray:
    """From targets (…, D) to points (…, N, D) in their unit; ValueError for another D."""
    target, points = as_numbers("target", target), as_numbers("points", points)
    if not target.shape[-1:] == np.shape(points)[-1:]:
        raise ValueError(f"target {target} is of another dimension than points {np.shape(points)}")
    return points - target[..., None, :]


def reach(
    excitations: np.ndarray, perturbation: Perturbation = UNPERTURBED, hold: float = HOLD
) -> HeldMotion:
    """The `HeldMotion` from rest in `START`: excitations (…, T, 6), then `hold` s of the last."""
    rest = arrays("rest")["activation"]  # that holds the arm in START
    motion = simulate(keep_last(excitations, hold), START, rest, perturbation=perturbation)
    return HeldMotion(**vars(motion), held=round(hold / STEP))


def keep_last(excitations: np.ndarray, hold: float = HOLD) -> np.ndarray:
    """Excitations (…, T, 6), and then `hold` s of the last of them."""
    excitations = as_numbers("excitations", excitations)
    if excitations.ndim < 2:
        raise ValueError(f"excitations {excitations.shape}: give (…, T, 6), one set a step")
    _check_hold(hold)
    last = np.repeat(excitations[..., -1:, :], round(hold / STEP), axis=-2)
    return np.concatenate([excitations, last], axis=-2)


def _check_hold(hold):
    if not is_within(hold, 0, np.inf):
        raise ValueError(f"a hold of {short(hold)} s: give seconds, 0 or more")


@dataclass(frozen=True, eq=False)
class TemplateSet:
    """N remembered reaches from one resting posture, of our arm or of another.

    Another arm brings its own commands (N, T, m), their limits, and a `reach` that moves it.
    """

    points: np.ndarray  # (N, 2): where in the arm's plane each reach ended, m
    excitations: np.ndarray  # (N, T, 6), in [0, 1], 1 kHz
    limits: tuple = (0.0, 1.0)  # of a command: no nerve can do otherwise
    reach: Callable = reach  # commands (…, T, m), perturbation -> a motion with `hold` (…, n, 2) …
    seconds: float = HOLD  # … of so many seconds

    __repr__ = short_repr


@cached
def load(spacing: float = SPACING, hold: float = HOLD) -> TemplateSet:
    """The shipped `TemplateSet` whose reached points lie `spacing` metres apart.

    A movement ends with a `hold` of so many seconds, over which its end point is the mean. With 0
    it ends with the command, as we read the paper.
    """
    if spacing not in SPACINGS:
        raise ValueError(f"no templates lie {spacing} m apart; choose one of {SPACINGS}")
    _check_hold(hold)
    return simulate_templates(spline() @ arrays("templates")[key(spacing)].astype(float), hold)


def simulate_templates(excitations: np.ndarray, hold: float = HOLD) -> TemplateSet:
    """The `TemplateSet` of our arm's reaches by excitations (N, T, 6), each with a `hold` (s)."""
    move = partial(reach, hold=hold)
    points = read_only(move(excitations).endpoint)
    return TemplateSet(points, read_only(excitations), reach=move, seconds=hold)


def key(spacing: float) -> str:
    """The name under which the knots of such a set are stored."""
    return f"knots_{1000 * spacing:.0f}mm"
