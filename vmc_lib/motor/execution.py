"""Execution of a plan: what the arm does with it, in a world that the plan does not know."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from vmc_lib.arm.simulate import UNPERTURBED, Perturbation
from vmc_lib.motor.planning import Plan

BATCH = 512  # movements simulated at once
EYE = np.array([0.10, 0.25])  # above and a little in front of the shoulder


def execute(plan, perturbation=UNPERTURBED, prism=0.0):
    """Let the arm move as planned.

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
        With `.motion`, `.endpoint` and `.error`, each simulated when it is first read.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> movement = execute(plan([0.15, -0.4], load()))
    >>> movement.endpoint.shape, bool(movement.error < 0.02)
    ((2,), True)
    """
    return Movement(plan, perturbation, prism)


@dataclass(frozen=True, eq=False)
class Movement:
    """What the arm did, made once."""

    plan: Plan
    perturbation: Perturbation = UNPERTURBED
    prism: float = 0.0

    @cached_property
    def motion(self):
        """The trajectories, a `Motion`."""
        return self.plan.template_set.reach(self.plan.excitations, self.perturbation)

    @cached_property
    def endpoint(self):
        """Where the hand is seen to end, (…, 2), m; in space (…, 3), where there is no prism."""
        end = self._endpoint
        return rotate_about_eye(end, self.prism) if self.prism else end

    @property
    def error(self):
        """How far from the target the hand is seen to end, (…), m."""
        return np.linalg.norm(self.endpoint - self.plan.target, axis=-1)

    @property
    def _endpoint(self):
        weights, rows = (x.reshape(-1, x.shape[-1]) for x in (self.plan.weights, self.plan.rows))
        if len(weights) <= BATCH:
            return self.motion.endpoint
        parts = [  # of a larger batch the trajectories are not kept, to spare memory
            replace(self, plan=replace(self.plan, rows=rows[part], weights=weights[part])).motion
            for part in (slice(i, i + BATCH) for i in range(0, len(weights), BATCH))
        ]
        return np.concatenate([part.endpoint for part in parts]).reshape(
            *self.plan.weights.shape[:-1], -1
        )


def rotate_about_eye(points, angle):
    """Plane positions (…, 2) rotated about the eye by `angle`, upwards where it is positive."""
    c, s = np.cos(angle), np.sin(angle)
    return (points - EYE) @ np.array([[c, s], [-s, c]]) + EYE
