"""Inverse dynamics: the muscle activations that a joint path, or a posture, requires.

Habitual planning never does this. It is how the templates were made, as smooth excitations that a
few spline coefficients keep.
"""

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.dynamics import check_posture, check_radians, interpolated_paths, torque_for
from vmc_lib.arm.engines import fibres
from vmc_lib.arm.model import F0, STEP
from vmc_lib.arm.muscle import PAPER
from vmc_lib.checks import as_numbers, cached, check_count, is_positive
from vmc_lib.data import read_only
from vmc_lib.short_repr import short

MOVING, SAMPLES = 700, 1000  # ms: a movement; the movement and the hold that follows
KNOTS = 28  # spline coefficients of each muscle's excitation


@cached
def spline(knots: int = KNOTS, samples: int = SAMPLES) -> np.ndarray:
    """Cubic B-splines (samples, knots); a row sums to 1, so knots in [0, 1] stay in [0, 1].

    By the recursion of Cox and de Boor: SciPy's are the same, but cannot run in the page.
    """
    check_count("knots", knots, least=4)
    check_count("samples", samples, least=2)
    edges = np.concatenate([[0] * 3, np.linspace(0, 1, knots - 2), [1] * 3])
    x = np.linspace(0, 1, samples)[:, None]
    last = edges[:-1] == edges[knots - 1]  # the interval that holds its upper end, too
    basis = (edges[:-1] <= x) & ((x < edges[1:]) | (last & (x == 1)))
    for degree in (1, 2, 3):
        span = edges[degree:] - edges[:-degree]
        rise = (x - edges[:-degree]) / np.where(span, span, 1)
        basis = rise[:, :-1] * basis[:, :-1] + (1 - rise[:, 1:]) * basis[:, 1:]
    return read_only(basis)


def minimum_jerk_profile(share: ArrayLike) -> np.ndarray:
    """Minimum jerk (Flash & Hogan 1985): the share of a way done at each share of its time."""
    s = np.clip(as_numbers("share", share), 0, 1)
    return s**3 * (10 - 15 * s + 6 * s**2)


def minimum_jerk(
    start: ArrayLike, goal: ArrayLike, samples: int = SAMPLES, moving: int = MOVING
) -> np.ndarray:
    """Minimum-jerk paths (…, samples + 1, n) from start to goal (…, n), there after `moving`.

    Then they stay there. ValueError where start and goal are no joint angles, or places, of one
    length, or are angles in degrees (places: in m); where there is no sample, or no time to move.
    """
    start, goal = as_numbers("start", start), as_numbers("goal", goal)
    if start.ndim == 0 or start.shape[-1:] != goal.shape[-1:]:
        raise ValueError(f"from start {start} to goal {goal}: give both of one length, (…, n)")
    check_radians("start", start)
    check_radians("goal", goal)
    check_count("samples", samples, least=1)
    if not is_positive(moving):
        raise ValueError(f"moving = {short(moving)}: give a number of samples above 0")
    done = minimum_jerk_profile(np.arange(samples + 1) / moving)[:, None]
    return start[..., None, :] + (goal - start)[..., None, :] * done


def muscle_gain(q: np.ndarray, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Muscle torque as a linear function of activation: slack torque (…, 2), gain (…, 2, 6), N m.

    An activation (…, 6) adds gain @ activation to the torque of the slack muscles. ValueError for
    another shape of the posture (…, 2), or of its velocity.
    """
    q, velocity = as_numbers("posture", q), as_numbers("velocity", velocity)
    if q.shape != velocity.shape:
        raise ValueError(f"posture {q.shape} and velocity {velocity.shape}: give both as (…, 2)")
    lengths, arms = interpolated_paths(q)
    normal = fibres(lengths, arms, velocity)
    slack, full = (PAPER.force(a, *normal, F0)[..., None, :] for a in (0.0, 1.0))
    return (arms * slack).sum(axis=-1), arms * (full - slack)


def required_torque(path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inverse dynamics: the muscle torque that a joint path requires, and the torque of activation.

    Any activation (T, 6) with torque = gain @ activation at every step keeps to the path.

    Parameters
    ----------
    path : array (T + 1, 2)
        Joint angles, rad, a millisecond apart; two or more.

    Returns
    -------
    torque : array (T, 2)
        Beyond the torque of slack muscles, N m.
    gain : array (T, 2, 6)
        Torque per unit activation, N m.

    Raises
    ------
    ValueError
        Where the path is of another shape.

    Examples
    --------
    >>> torque, gain = required_torque(np.zeros((11, 2)))
    >>> torque.shape, gain.shape
    ((10, 2), (10, 2, 6))
    """
    path = as_numbers("path", path)
    if path.ndim != 2 or path.shape[1] != 2 or len(path) < 2:
        raise ValueError(
            f"path {path.shape}: give joint angles (T + 1, 2) in rad, two rows or more"
        )
    if not np.isfinite(path).all():
        raise ValueError("a path needs finite joint angles: one is NaN or infinite")
    velocity = np.diff(path, axis=0, prepend=path[:1]) / STEP
    acceleration = np.diff(velocity, axis=0) / STEP
    q, velocity = path[:-1], velocity[:-1]
    slack, gain = muscle_gain(q, velocity)
    return torque_for(q, velocity, acceleration) - slack, gain


def static_activation(q: ArrayLike) -> np.ndarray:
    """The activations (6,) that hold the posture q (2,), small ones preferred (a ridge).

    ValueError for a posture far beyond the joints' limits.
    """
    check_posture(q := as_numbers("posture", q))
    if q.ndim != 1:
        raise ValueError(f"postures {q.shape}: give one, (2,), in rad")
    torque, gain = required_torque(np.tile(q, (2, 1)))
    return bounded_least_squares(
        np.vstack([gain[0], 0.01 * np.eye(6)]), np.append(torque[0], np.zeros(6))
    )


def bounded_least_squares(matrix: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """The x (n,) in [0, 1] for which matrix @ x is nearest to `wanted`, in least squares.

    By active sets (Stark & Parker 1995): SciPy's `bvls` is the same, but cannot run in the page.
    """
    x = np.linalg.lstsq(matrix, wanted)[0]
    free, x = (x > 0) & (x < 1), np.clip(x, 0, 1)
    least = 1e-12 * np.abs(matrix.T @ wanted).max()
    for _ in range(10 * len(x)):
        while free.any():  # to the optimum of those that are free, or until one meets its bound
            step = np.linalg.lstsq(matrix[:, free], wanted - matrix @ x)[0]
            room = np.where(step > 0, 1 - x[free], x[free]) / np.maximum(np.abs(step), 1e-300)
            x[free] = np.clip(x[free] + min(1, room.min()) * step, 0, 1)
            if room.min() >= 1:
                break
            met = np.flatnonzero(free)[room.argmin()]
            x[met], free[met] = round(x[met]), False
        slope = matrix.T @ (wanted - matrix @ x)
        gain = np.where(free, 0, np.where(x > 0, -slope, slope))
        if gain.max() <= least:
            break
        free[gain.argmax()] = True
    return x
