"""Obstacle avoidance: two mixed reaches in one, the first of them to a via-point.

The obstacle is a ball that only the hand must not touch. Positions are in the arm's plane, in m.
"""

from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np

from reproduce.experiments.feedback_control import NOISE, exact_plans, fit_forward_model
from vmc_lib.arm.dynamics import hand
from vmc_lib.motor.feedback import (
    OPEN_LOOP,
    REFLEX,
    SIGHT,
    TICK,
    ReferenceTrajectory,
    reference_trajectory,
    simulate_feedback,
    switch,
)
from vmc_lib.motor.planning import draw_targets, is_surrounded

RADIUS, APART = 0.02, 0.03  # of the ball; how near to its middle a way may be meant
LONG = 0.12  # the straight way, at least: on a short one there is no room for a ball
TURN = 0.3  # s: when the second reach begins to take the first one's place
GRID = 0.02  # between the places that may become via-points


class Detours(NamedTuple):
    """Reaches past obstacles, simulated: places (n, 2), and the hand's paths by (route, senses)."""

    targets: np.ndarray
    balls: np.ndarray
    vias: np.ndarray
    paths: dict  # each (n, ticks, 2)

    def touches(self, route, senses):
        """Which hands touch their ball, (n,)."""
        return clearance(self.paths[route, senses], self.balls) < RADIUS

    def miss(self, route, senses):
        """How far hands end from their targets, (n,)."""
        return np.linalg.norm(self.paths[route, senses][:, -1] - self.targets, axis=-1)


def simulate_detours(template_set, rng, count=60):
    """`Detours`: straight and by a via-point; by the plan alone, a reflex, a forward model, too.

    All six meet the same noise.
    """
    model = fit_forward_model(template_set, rng)
    targets, balls = obstacles(template_set, count, rng)
    plans = [plan_around(*pair, template_set) for pair in zip(targets, balls, strict=True)]
    vias, references = zip(*plans, strict=True)
    routes = {
        "straight": reference_trajectory(exact_plans(targets, template_set)),
        "by a via-point": ReferenceTrajectory(*map(np.concatenate, zip(*references, strict=True))),
    }
    senses = {
        "the plan alone": (OPEN_LOOP, None),
        "reflex alone": (REFLEX, None),
        "forward model": (SIGHT, model),
    }
    paths = {}
    for route, sense in product(routes, senses):
        noise = {"noise": NOISE, "rng": np.random.default_rng(1)}
        motion = simulate_feedback(routes[route], *senses[sense], **noise)
        paths[route, sense] = motion.hand[:, ::TICK, :2]
    return Detours(targets, balls, np.array(vias), paths)


def obstacles(template_set, count, rng):
    """Targets (count, 2), and balls (count, 2), each in the middle of the meant way there."""
    targets = draw_targets(template_set, 20 * count, rng)
    parts = np.array_split(targets, 20)  # one after the other: less memory
    ways = np.concatenate(
        [reference_paths(reference_trajectory(exact_plans(part, template_set))) for part in parts]
    )
    start, end = ways[:, 0], ways[:, -1]
    long = np.linalg.norm(end - start, axis=-1) > LONG
    middle = (start + end)[:, None] / 2
    nearest = np.linalg.norm(ways - middle, axis=-1).argmin(axis=1)
    return targets[long][:count], ways[np.arange(len(ways)), nearest][long][:count]


def plan_around(target, ball, template_set):
    """The via-point (2,) to a target (2,) round a ball (2,), and the reference (a batch of one).

    Of all via-points whose meant way keeps `APART` of the ball, that of the shortest. ValueError
    when there is none.
    """
    spots, first = _via_points(template_set)
    second = reference_trajectory(exact_plans(target[None], template_set))
    both = switch(first, second, TURN)
    ways = reference_paths(both)
    length = np.linalg.norm(np.diff(ways, axis=1), axis=-1).sum(axis=1)
    free = clearance(ways, ball[None]) > APART
    if not free.any():
        raise ValueError(f"no way to {target} m keeps {APART} m from {ball} m; move the ball")
    best = np.where(free, length, np.inf).argmin()
    return spots[best], ReferenceTrajectory(both.q[[best]], both.excitations[[best]])


@cache
def _via_points(template_set):
    """All places (n, 2) that may become via-points, and the `ReferenceTrajectory` to reach each."""
    low, high = template_set.points.min(axis=0), template_set.points.max(axis=0)
    spots = np.stack(np.meshgrid(*(np.arange(a, b, GRID) for a, b in zip(low, high, strict=True))))
    spots = spots.reshape(2, -1).T
    spots = spots[is_surrounded(spots, template_set.points)]
    return spots, reference_trajectory(exact_plans(spots, template_set))


def reference_paths(reference):
    """The hand's paths (B, ticks, 2) along a `ReferenceTrajectory`."""
    return hand(reference.q[:, ::TICK])[..., :2]


def clearance(ways, balls):
    """How near ways (B, T, 2) come to the middle of their balls (B, 2), (B,)."""
    return np.linalg.norm(ways - balls[:, None], axis=-1).min(axis=1)
