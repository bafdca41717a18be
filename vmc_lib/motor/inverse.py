"""Asking backwards: from a path the joints should take to the excitations that make them.

A minimum-jerk path (Flash and Hogan, 1985) gives torques by inverse dynamics; torques are shared
among the six muscles, smoothly and with least effort; Eq. 9 solved backwards gives excitations.
The brain's habitual planning never does this. It is how its past experience was made.
"""

from functools import cache

import numpy as np
from scipy.interpolate import BSpline
from scipy.optimize import lsq_linear

from ..arm import closed_form
from ..arm.model import F0, STEP
from ..arm.muscle import excitation_for, force
from ..arm.simulate import fibres

MOVE, STEPS = 700, 1000  # ms: a movement; the movement and the hold that follows
KNOTS = 28  # spline coefficients of each muscle's excitation
EFFORT, ROUGHNESS = 0.02, 0.5  # what activation, and its bending, cost beside a missed N m


def minimum_jerk(start, goal):
    """The smoothest joint path (STEPS + 1, 2) from start to goal in `MOVE` ms, then still."""
    s = np.minimum(np.arange(STEPS + 1) / MOVE, 1)[:, None]
    return start + (goal - start) * (10 * s**3 - 15 * s**4 + 6 * s**5)


@cache
def spline(knots=KNOTS):
    """Cubic B-splines (STEPS, knots); each row sums to 1, so knots in [0, 1] stay in [0, 1]."""
    edges = np.concatenate([[0] * 3, np.linspace(0, 1, knots - 2), [1] * 3])
    return BSpline.design_matrix(np.linspace(0, 1, STEPS), edges, 3).toarray()


def demand(path):
    """What a joint path (T + 1, 2) asks of the muscles: torque (T, 2) and gain (T, 2, 6).

    Whatever activation (T, 6) satisfies torque = gain @ activation at every step keeps to it.
    """
    velocity = np.diff(path, axis=0, prepend=path[:1]) / STEP
    acceleration = np.diff(velocity, axis=0) / STEP
    q, velocity = path[:-1], velocity[:-1]
    lengths, arms = closed_form.paths(q)
    slack, full = (force(a, *fibres(lengths, arms, velocity), F0)[:, None] for a in (0, 1))
    torque = closed_form.torque_for(q, velocity, acceleration) - (arms * slack).sum(axis=-1)
    return torque, arms * (full - slack)


def hold(q):
    """The least activations (6,) that hold the posture q (2,) against gravity."""
    torque, gain = demand(np.tile(q, (2, 1)))
    return least(np.vstack([gain[0], 0.01 * np.eye(6)]), np.append(torque[0], np.zeros(6)))


def excitation_knots(path):
    """Spline knots (KNOTS, 6) of excitations that keep the arm near a joint path from rest."""
    torque, gain = demand(path)
    rows = slice(0, STEPS, 5)
    asked = np.einsum("tjm,tk->tjkm", gain[rows], spline()[rows]).reshape(-1, KNOTS * 6)
    bending = np.kron(np.diff(np.eye(KNOTS), 2, axis=0), np.eye(6))
    matrix = np.vstack([asked, EFFORT * np.eye(KNOTS * 6), ROUGHNESS * bending])
    wanted = np.append(torque[rows].ravel(), np.zeros(len(matrix) - len(asked)))
    activation = spline() @ least(matrix, wanted).reshape(KNOTS, 6)
    excitation = excitation_for(activation, np.gradient(activation, STEP, axis=0))
    knots = np.stack([least(spline(), muscle) for muscle in excitation.T], axis=-1)
    knots[:2] = hold(path[0])
    return knots


def least(matrix, wanted):
    """The x (n,) in [0, 1] whose matrix @ x comes nearest to what is wanted, in least squares."""
    return lsq_linear(matrix, wanted, (0, 1), method="bvls").x
