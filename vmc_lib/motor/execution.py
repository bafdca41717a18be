"""Execution of a plan: what the arm does with it, in a world that the plan does not know."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from vmc_lib.arm.simulate import UNPERTURBED, Perturbation
from vmc_lib.checks import as_numbers, check_kind, is_within
from vmc_lib.motor.planning import Plan, check_plan, norm
from vmc_lib.motor.templates import HeldMotion, mean_distance, mean_speed
from vmc_lib.short_repr import short, short_repr

BATCH = 512  # movements simulated at once
QUARTER_TURN = np.pi / 2
EYE = np.array([0.10, 0.25])  # above and a little in front of the shoulder


def execute(plan: Plan, perturbation: Perturbation = UNPERTURBED, prism: float = 0.0) -> "Movement":
    """Let the arm move as planned, and hold.

    Parameters
    ----------
    plan : Plan
        Of one reach or a batch.
    perturbation : Perturbation
        What the arm meets: a load, a force field.
    prism : float
        How far glass before the eyes turns what they see, rad, upwards where it is positive.

    Returns
    -------
    Movement
        With `.motion`, `.endpoint`, `.error`, `.bias`, `.speed` and `.stray`, simulated when first
        read.

    Raises
    ------
    ValueError
        For what is no plan; for a prism from a quarter turn on.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> movement = execute(plan([0.15, -0.4], load()))
    >>> movement.endpoint.shape, bool(movement.error < 0.02)
    ((2,), True)
    """
    check_plan(plan)
    check_kind("perturbation", perturbation, Perturbation, "Perturbation(load=1.0), in kg")
    if not is_within(prism, -QUARTER_TURN, QUARTER_TURN):
        raise ValueError(f"a prism of {short(prism)} rad: give radians, within a quarter turn")
    return Movement(plan, perturbation, prism)


@dataclass(frozen=True, eq=False)
class Movement:
    """What the arm did, made once."""

    plan: Plan
    perturbation: Perturbation = UNPERTURBED
    prism: float = 0.0

    __repr__ = short_repr

    @cached_property
    def motion(self) -> HeldMotion:
        """The trajectories, a `Motion` with its `hold`."""
        return self.plan.template_set.reach(self.plan.excitations, self.perturbation)

    @cached_property
    def hold(self) -> np.ndarray:
        """The hand's path over the hold as it is seen, (…, n, 2), m; in space (…, n, 3)."""
        return rotate_about_eye(self._hold, self.prism) if self.prism else self._hold

    @property
    def endpoint(self) -> np.ndarray:
        """Where the hand is seen on average over the hold, (…, 2), m; in space (…, 3)."""
        return self.hold.mean(axis=-2)

    @property
    def error(self) -> np.ndarray:
        """How far from the target the hand is seen over the hold, on average, (…), m.

        A hand that swings round its target is not on it. Without a hold it is the distance where
        the command ends.
        """
        return mean_distance(self.hold, self.plan.target)

    @property
    def bias(self) -> np.ndarray:
        """How far from the target the hand's mean place over the hold is, (…), m."""
        return norm(self.endpoint - self.plan.target)

    @property
    def speed(self) -> np.ndarray:
        """How fast the hand still moves over the hold, on average, (…), m/s."""
        return mean_speed(self.hold, self.plan.template_set.seconds)

    @property
    def stray(self) -> np.ndarray:
        """How far the hand strays from its mean place over the hold, at most, (…), m."""
        away = self.hold - self.hold.mean(axis=-2, keepdims=True)
        return norm(away).max(axis=-1)

    @property
    def _hold(self):
        weights, rows = (x.reshape(-1, x.shape[-1]) for x in (self.plan.weights, self.plan.rows))
        if len(weights) <= BATCH:
            return self.motion.hold
        parts = [  # of a larger batch the trajectories are not kept, to spare memory
            replace(self, plan=replace(self.plan, rows=rows[part], weights=weights[part])).motion
            for part in (slice(i, i + BATCH) for i in range(0, len(weights), BATCH))
        ]
        hold = np.concatenate([part.hold for part in parts])
        return hold.reshape(*self.plan.weights.shape[:-1], *hold.shape[1:])


def rotate_about_eye(points: np.ndarray, angle: float) -> np.ndarray:
    """Plane positions (…, 2) rotated about the eye by `angle`, upwards where it is positive."""
    return rotate(points, angle, EYE)


def rotate(points: np.ndarray, angle: float, centre: np.ndarray) -> np.ndarray:
    """Plane positions (…, 2) rotated about a `centre` (2,) by `angle`, rad, anticlockwise."""
    points, angle = as_numbers("points", points), as_numbers("angle", angle)
    if points.shape[-1:] != (2,) or angle.ndim:
        raise ValueError(f"points {points.shape} by {angle}: give (…, 2) in the plane, and radians")
    c, s = np.cos(angle), np.sin(angle)
    return (points - centre) @ np.array([[c, s], [-s, c]]) + centre


Execute = Callable[[Plan], Movement]  # whatever lets the arm move
