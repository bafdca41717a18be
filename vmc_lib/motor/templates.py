"""Past experience: reaches that ended where they should, remembered as muscle excitations u_i(t).

Every reach starts at rest in the same posture and lasts a second. What ships is the spline knots
of the excitations; `python -m vmc_lib.motor.templates` remakes them.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ..arm.posture import posture
from ..arm.simulate import EMPTY, simulate
from ..data import FOLDER, arrays
from .inverse import excitation_knots, hold, minimum_jerk, spline

START = np.radians([-20.0, 95.0])  # every reach begins here: elbow bent, the hand over the table
SPACINGS = (0.04, 0.06, 0.08)  # m: how densely past experience covers the plane …
SPACING = 0.06  # … unless another is asked for
CORNER = np.array([0.24, -0.37])  # every grid is laid out from this point
ZONE = np.array([[-0.01, -0.50], [0.25, -0.28]])  # lowest and highest (x, y): in front, table high
REACH = 0.525  # m from the shoulder: a nearly straight arm


@dataclass(frozen=True)
class Library:
    """N remembered reaches from one resting posture."""

    points: np.ndarray  # (N, 2): where in the arm's plane each reach ended, m
    excitations: np.ndarray  # (N, T, 6), in [0, 1], 1 kHz


@cache
def load(spacing=SPACING):
    """The shipped `Library` whose reached points lie `spacing` metres apart."""
    if spacing not in SPACINGS:
        raise ValueError(f"no library has its points {spacing} m apart; choose one of {SPACINGS}")
    excitations = spline() @ arrays("templates")[_name(spacing)].astype(float)
    return Library(reach(excitations).reached, excitations)


def reach(excitations, world=EMPTY):
    """The `Motion` that excitations (…, T, 6) give the arm from rest in `START`."""
    return simulate(excitations, START, _rest(), world=world)


def grid(spacing):
    """Plane positions (N, 2) of a square grid: those within `ZONE` that the arm can reach."""
    steps = spacing * np.arange(-12, 13)
    points = CORNER + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    within = points[np.all((ZONE[0] <= points) & (points <= ZONE[1]), axis=-1)]
    return within[np.linalg.norm(within, axis=-1) < REACH]


def make(goal):
    """Spline knots (KNOTS, 6) of a reach that comes to rest at the plane position `goal` (2,)."""
    knots = excitation_knots(minimum_jerk(START, posture(goal)))
    for _ in range(3):
        knots = _settle(knots, goal)
    return knots


def _settle(knots, goal):
    """One Gauss–Newton step: nudge every knot, see where each reach ends, correct all of them."""
    nudge = 1e-4
    nudged = knots + nudge * np.eye(knots.size).reshape(-1, *knots.shape)
    motion = reach(np.clip(spline() @ np.concatenate([knots[None], nudged]), 0, 1))
    ends = np.concatenate([motion.q[:, -1], 0.05 * motion.velocity[:, -1]], axis=-1)
    slope = (ends[1:] - ends[0]).T / nudge
    room = knots * (1 - knots)  # knots at 0 or 1 stay there …
    room[:2] = 0  # … and so does the resting start
    correction = np.linalg.pinv(slope * room.ravel()) @ (np.append(posture(goal), [0, 0]) - ends[0])
    return np.clip(knots + room * correction.reshape(knots.shape), 0, 1)


@cache
def _rest():
    return hold(START)


def _name(spacing):
    return f"knots_{1000 * spacing:.0f}mm"


if __name__ == "__main__":
    libraries = {_name(s): np.array([make(p) for p in grid(s)], np.float32) for s in SPACINGS}
    np.savez_compressed(FOLDER / "templates.npz", **libraries)
