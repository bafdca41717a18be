"""Inverse kinematics: from where the hand should be to the joint angles and the trunk's turn.

The trunk turns about a vertical axis beside the shoulder (positive to the left) until the arm's
plane meets the target. What remains is planar: p = (x, y) of the wrist in the turned shoulder
frame. Its z follows from the posture, for the joints' axes are not quite parallel to z.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib import NoReach
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import LIMITS
from vmc_lib.checks import as_numbers

TRUNK = np.array([0.017545, -0.17])  # x and z of the axis about which the trunk turns, m
ON_AXIS = np.insert(TRUNK, 1, 0)
TRUNK_RANGE = np.radians([-60.0, 90.0])
BENT = np.array([LIMITS[0], [0.1, LIMITS[1, 1]]])  # a straighter elbow adds no reach, only doubt


def inverse_kinematics(p: ArrayLike) -> np.ndarray:
    """Inverse kinematics: joint angles that put the wrist at a position in the arm's plane.

    Parameters
    ----------
    p : array (…, 2)
        Forward and up of the shoulder, m.

    Returns
    -------
    array (…, 2)
        Shoulder and elbow angle, rad.

    Raises
    ------
    vmc_lib.NoReach
        Where a position is out of the arm's reach.

    Examples
    --------
    >>> q = inverse_kinematics([0.15, -0.4])
    >>> hand(q)[:2].round(6).tolist()
    [0.15, -0.4]
    """
    p = _positions(p, 2)
    return _solve(lambda q: hand(q)[..., :2], p, p, p)


def turn_towards(target: ArrayLike) -> tuple[Any, np.ndarray]:
    """Turn the trunk until a target in the room lies in the arm's plane.

    Parameters
    ----------
    target : array (…, 3)
        In the shoulder frame of the trunk straight ahead, m.

    Returns
    -------
    psi : array (…)
        The trunk's turn, rad, positive to the left.
    p : array (…, 2)
        The target's position in the plane, m.

    Raises
    ------
    vmc_lib.NoReach
        Where no turn within `TRUNK_RANGE` brings the target within reach.

    Examples
    --------
    >>> psi, p = turn_towards([0.25, -0.4, 0.1])
    >>> to_world(hand(inverse_kinematics(p)), psi).round(6).tolist()
    [0.25, -0.4, 0.1]
    """
    target = _positions(target, 3)
    x, z = np.moveaxis(target[..., [0, 2]] - TRUNK, -1, 0)
    distance, height = np.hypot(x, z), target[..., 1]  # from the trunk's axis
    wanted = np.stack([distance, height], axis=-1)
    aside = 0.06 - TRUNK[1]  # about, of the hand from the axis; ahead is what is left
    ahead = np.sqrt(np.maximum(distance**2 - aside**2, 0))
    guess = np.stack([TRUNK[0] + ahead, height], axis=-1)
    q = _solve(
        lambda q: np.stack([np.hypot(*_aside(q)), hand(q)[..., 1]], -1), wanted, guess, target
    )
    turn = np.arctan2(*_aside(q)[::-1]) - np.arctan2(z, x)
    far = (turn < TRUNK_RANGE[0]) | (turn > TRUNK_RANGE[1])
    if np.any(far):
        first, needed = target[far][0], np.degrees(np.asarray(turn)[far][0])
        raise NoReach(f"{first} m needs a turn of {needed:.0f}°; move the target")
    return turn, hand(q)[..., :2]


def to_world(points: np.ndarray, psi: ArrayLike) -> np.ndarray:
    """Points (…, 3) of the turned shoulder frame, in the frame of the trunk straight ahead.

    One turn `psi` in rad for all of them, or one for each, (…).
    """
    return rotate_by_turn(_positions(points, 3) - ON_AXIS, psi) + ON_AXIS


def rotate_by_turn(vectors: np.ndarray, psi: ArrayLike) -> np.ndarray:
    """Rotate vectors (…, 3) by a turn of the trunk, as `to_world` does points: lengths stay."""
    vectors, psi = _positions(vectors, 3).copy(), as_numbers("turn", psi)
    x, z = np.moveaxis(vectors[..., [0, 2]], -1, 0)
    c, s = np.cos(psi), np.sin(psi)
    vectors[..., [0, 2]] = np.stack([c * x + s * z, c * z - s * x], axis=-1)
    return vectors


def _positions(points, axes):
    points = as_numbers("position", points)
    if points.shape[-1:] != (axes,) or not np.all(np.isfinite(points)):
        raise ValueError(f"position {points} must be finite, of shape (…, {axes}), in m")
    return points


def _solve(measure, wanted, guess, target):
    """Postures q with measure(q) = wanted, by Newton's method from near plane position `guess`.

    `target` (…, 2 or 3) is what the caller asked for; an error names it.

    For the guess the joints' axes count as parallel: then the wrist's distance from the shoulder
    depends on the elbow alone, and the shoulder turns the wrist to its bearing.
    """
    elbow = np.linspace(*BENT[1], 100)[::-1]
    distance = np.linalg.norm(hand(np.stack([0 * elbow, elbow], -1))[:, :2], axis=-1)
    bend = np.interp(np.linalg.norm(guess, axis=-1), distance, elbow)
    q = np.stack([0 * bend, bend], axis=-1)
    q[..., 0] = _bearing(np.asarray(guess)) - _bearing(hand(q))
    for _ in range(12):
        slope = (measure(q[..., None, :] + 1e-6 * np.eye(2)) - measure(q)[..., None, :]) / 1e-6
        step = np.linalg.pinv(np.swapaxes(slope, -1, -2)) @ (wanted - measure(q))[..., None]
        q = np.clip(q + np.clip(step[..., 0], -0.2, 0.2), *BENT.T)
    missed = np.abs(measure(q) - wanted).max(axis=-1) > 1e-9
    if np.any(missed):
        far = np.round(target[missed][0], 3)
        raise NoReach(
            f"position {far} m lies beyond the arm's reach of "
            f"{distance[0]:.2f} to {distance[-1]:.2f} m; move the target"
        )
    return q


def _aside(q):
    return np.moveaxis(hand(q)[..., [0, 2]] - TRUNK, -1, 0)


def _bearing(point):
    return np.arctan2(point[..., 0], -point[..., 1])
