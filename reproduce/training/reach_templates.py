"""Reach templates: excitations for a grid of places, refined by Gauss–Newton steps.

A minimum-jerk path (Flash and Hogan, 1985) gives torques by inverse dynamics; torques are shared
among the six muscles, smoothly and with the least squares of activation; Eq. 9 solved backwards
gives excitations.
"""

import numpy as np

from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import excitation_for
from vmc_lib.motor.inverse_dynamics import (
    KNOTS,
    SAMPLES,
    bounded_least_squares,
    minimum_jerk,
    required_torque,
    spline,
    static_activation,
)
from vmc_lib.motor.templates import REACH, START, reach

CORNER = np.array([0.24, -0.37])  # every grid is laid out from this point
ZONE = np.array([[-0.01, -0.50], [0.25, -0.28]])  # lowest and highest (x, y): in front, table high
PINNED = slice(0, 2), slice(-5, None)  # knots: a reach begins and ends with what holds the posture
EFFORT, ROUGHNESS = 0.02, 0.5  # what activation, and its bending, cost beside a missed N m


def excitation_knots(path):
    """Spline knots (KNOTS, 6) of excitations that keep the arm near a joint path from rest."""
    torque, gain = required_torque(path)
    rows = slice(0, SAMPLES, 5)
    design = np.einsum("tjm,tk->tjkm", gain[rows], spline()[rows]).reshape(-1, KNOTS * 6)
    bending = np.kron(np.diff(np.eye(KNOTS), 2, axis=0), np.eye(6))
    matrix = np.vstack([design, EFFORT * np.eye(KNOTS * 6), ROUGHNESS * bending])
    wanted = np.append(torque[rows].ravel(), np.zeros(len(matrix) - len(design)))
    activation = spline() @ bounded_least_squares(matrix, wanted).reshape(KNOTS, 6)
    excitation = excitation_for(activation, np.gradient(activation, STEP, axis=0))
    knots = np.stack([bounded_least_squares(spline(), muscle) for muscle in excitation.T], axis=-1)
    for pinned, posture in zip(PINNED, path[[0, -1]], strict=True):
        knots[pinned] = static_activation(posture)
    return knots


def reachable_grid(spacing):
    """Plane positions (N, 2) of a square grid: those within `ZONE` that the arm can reach."""
    steps = spacing * np.arange(-12, 13)
    points = CORNER + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    within = points[np.all((ZONE[0] <= points) & (points <= ZONE[1]), axis=-1)]
    return within[np.linalg.norm(within, axis=-1) < REACH]


def find_reach(goal):
    """Spline knots (KNOTS, 6) of a reach that comes to rest at a place (2,), and is held there."""
    knots = excitation_knots(minimum_jerk(START, inverse_kinematics(goal)))
    for _ in range(4):
        knots = _gauss_newton_step(knots, goal)
    return knots


def _gauss_newton_step(knots, goal):
    """One Gauss–Newton step: nudge every knot, see where each reach ends, correct all of them."""
    nudge = 1e-4
    nudged = knots + nudge * np.eye(knots.size).reshape(-1, *knots.shape)
    motion = reach(np.clip(spline() @ np.concatenate([knots[None], nudged]), 0, 1))
    ends = np.concatenate([x[:, SAMPLES] for x in (motion.q, 0.05 * motion.velocity)], axis=-1)
    slope = (ends[1:] - ends[0]).T / nudge
    room = knots * (1 - knots)  # knots at 0 or 1 stay there …
    for pinned in PINNED:
        room[pinned] = 0  # … and so do those that hold a posture
    correction = np.linalg.pinv(slope * room.ravel()) @ (
        np.append(inverse_kinematics(goal), [0, 0]) - ends[0]
    )
    return np.clip(knots + room * correction.reshape(knots.shape), 0, 1)
