"""Forward and inverse dynamics, hand position and muscle paths in closed form, for many postures.

Inertia, gravity and the hand's position are trigonometric polynomials in the two angles, sums of
eleven basis functions: a few dozen snapshots of the MuJoCo model determine their coefficients
exactly. And no muscle wraps over both joints at once, so every musculotendon length is a function
of the shoulder angle plus a function of the elbow angle. They are tables, interpolated linearly:
MuJoCo's wrapping takes ten times as long as all the rest of a step. Both ship as arrays, made by
`reproduce.training.arm_tables`: the arm moves where there is no MuJoCo.
"""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.model import DAMPING, LIMITS, STEP, check_load
from vmc_lib.arm.muscle import Numbers
from vmc_lib.checks import as_numbers, cached, shape_of
from vmc_lib.data import arrays
from vmc_lib.short_repr import short

ROWS = 10_001  # of the muscle tables: steps of half a milliradian
MARGIN = 0.4  # rad: the tables reach a little beyond the joints' stops
LOW, HIGH = LIMITS[:, 0] - MARGIN, LIMITS[:, 1] + MARGIN
FARTHEST = 2 * np.pi  # rad: no joint turns so far, unless the movement blows up
ROWS_PER_RADIAN = (ROWS - 1) / (HIGH - LOW)
UNIT = 1e-11  # m: the muscle tables ship in whole numbers of it …
DIFFERENCES = 3  # … of which each row's third differences are small, and compress
SHOULDER, ELBOW = DAMPING.tolist()


def trig_basis(shoulder: np.ndarray, elbow: np.ndarray) -> tuple[Any, ...]:
    """Basis functions: cosines and sines of the two angles, their sum, their products; eleven."""
    c1, s1, c2, s2 = np.cos(shoulder), np.sin(shoulder), np.cos(elbow), np.sin(elbow)
    c12, s12 = c1 * c2 - s1 * s2, s1 * c2 + c1 * s2
    return c1 * 0 + 1, c1, s1, c2, s2, c12, s12, c2 * c1, c2 * s1, c2 * c2, c2 * s2


def trig_basis_gradient(shoulder: np.ndarray, elbow: np.ndarray) -> tuple[tuple, tuple]:
    """Derivatives of the `trig_basis` by the shoulder angle, and by the elbow angle: 2 × 11."""
    _, c1, s1, c2, s2, c12, s12, cc, cs, cc2, cs2 = trig_basis(shoulder, elbow)
    o = c1 * 0
    return (
        (o, -s1, c1, o, o, -s12, c12, -cs, cc, o, o),
        (o, o, o, -s2, c2, -s12, c12, -s2 * c1, -s2 * s1, -2 * cs2, cc2 - s2 * s2),
    )


def _trig_basis_of(q):
    """`trig_basis` of postures (…, 2), as an array (…, 11); ValueError for other shapes."""
    return np.array(trig_basis(*_per_joint("posture", q, "rad").T)).T


@cached
def coefficients(load: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Of the basis in the dynamics (11, 7), as `_dynamics` unpacks it, and in the hand (11, 3).

    With a `load` in kg at the wrist.
    """
    check_load(load)
    unloaded, per_kg = arrays("arm26")["dynamics"]
    solved = unloaded + load * per_kg
    return solved[:, :7].copy(), solved[:, 7:].copy()


def hand(q: ArrayLike) -> np.ndarray:
    """Forward kinematics: the wrist's position in the shoulder frame.

    Parameters
    ----------
    q : array (…, 2)
        Shoulder and elbow angle, rad; zeros hang straight down.

    Returns
    -------
    array (…, 3)
        Metres; x forward, y up, z to the right.

    Examples
    --------
    >>> hand(np.radians([0, 90])).round(3).tolist()
    [0.249, -0.293, 0.061]
    """
    return _trig_basis_of(_posture(q)) @ coefficients()[1]


def torque_for(
    q: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, load: float = 0.0
) -> np.ndarray:
    """Inverse dynamics: torques (…, 2) in N m that give these accelerations over one step.

    With a `load` in kg at the wrist.
    """
    velocity = _per_joint("velocity", velocity, "rad/s")
    acceleration = _per_joint("acceleration", acceleration, "rad/s²")
    now = terms(_posture(q), load)
    return np.array(equation_12_torques(now, *velocity.T, *acceleration.T, STEP)).T


def forward_dynamics(q: ArrayLike, velocity: ArrayLike, torque: ArrayLike) -> np.ndarray:
    """Forward dynamics, Eq. 12: the accelerations (…, 2) that joint torques cause."""
    velocity = _per_joint("velocity", velocity, "rad/s")
    return joint_acceleration(_posture(q), velocity, _per_joint("torque", torque, "N m"))


def joint_acceleration(q: np.ndarray, velocity: np.ndarray, torque: np.ndarray) -> np.ndarray:
    """`forward_dynamics` for loops: the angles may be as wild as a forward model predicts them."""
    return np.transpose(equation_12(terms(q), *np.transpose(velocity), *torque.T, STEP))


def check_posture(q: ArrayLike, name: str = "posture") -> None:
    """ValueError where a posture (…, 2) lies beyond the joints' limits by more than MARGIN."""
    if shape_of(name, q)[-1:] != (2,):
        raise ValueError(f"{name} {q} must be (shoulder, elbow), (…, 2), in rad")
    q = as_numbers(name, q)
    far = ~np.all((q >= LOW) & (q <= HIGH), axis=-1)
    if np.any(far):
        raise ValueError(
            f"{name} {q[far][0]} rad is beyond the joints' limits, {LIMITS.round(2).tolist()} rad; "
            "give radians: np.radians(degrees)"
        )


def check_radians(name: str, q: np.ndarray) -> None:
    """ValueError where an angle is so large that it can be in degrees alone."""
    far = np.abs(q) >= FARTHEST
    if np.any(far):
        raise ValueError(
            f"{name} {short(q)}: {q[far][0]:g} rad is a turn or more; "
            "give radians: np.radians(degrees)"
        )


def _posture(q):
    """A posture as an array (…, 2); ValueError for another shape, or in degrees."""
    q = _per_joint("posture", q, "rad")
    check_radians("posture", q)
    return q


def _per_joint(name, values, unit):
    """Values as an array (…, 2); ValueError for other shapes."""
    if shape_of(name, values)[-1:] != (2,):
        raise ValueError(
            f"{name} {short(values)}: give one for each joint, (shoulder, elbow), (…, 2), in {unit}"
        )
    return as_numbers(name, values)


def terms(q: ArrayLike, load: float = 0.0) -> np.ndarray:
    """The terms of Eq. 12 (7, …) in postures (…, 2): inertia, motion, gravity.

    For loops: the angles may be as wild as a forward model predicts them.
    """
    return (_trig_basis_of(q) @ coefficients(load)[0]).T


def equation_12(
    terms: np.ndarray, w1: Numbers, w2: Numbers, t1: Numbers, t2: Numbers, step: float
) -> tuple[Any, Any]:
    """Eq. 12 of one arm, or of many: both accelerations from velocities and torques of the joints.

    `terms` are the seven that `coefficients` makes of the basis.
    """
    m11, m12, m22, b1, b2 = _dynamics(terms, w1, w2, step)
    t1, t2 = t1 - b1, t2 - b2
    determinant = m11 * m22 - m12 * m12
    return (m22 * t1 - m12 * t2) / determinant, (m11 * t2 - m12 * t1) / determinant


def equation_12_torques(
    terms: np.ndarray, w1: Numbers, w2: Numbers, a1: Numbers, a2: Numbers, step: float
) -> tuple[Any, Any]:
    """Eq. 12 solved for the torques of the joints: from their velocities and accelerations."""
    m11, m12, m22, b1, b2 = _dynamics(terms, w1, w2, step)
    return m11 * a1 + m12 * a2 + b1, m12 * a1 + m22 * a2 + b2


def _dynamics(terms, w1, w2, step):
    """The mass matrix's entries, and the torques of motion, gravity and damping."""
    m11, m12, m22, swing, bend, gravity1, gravity2 = terms
    thrown = swing * w1
    b1 = (bend * w2 - 2 * thrown) * w2 + gravity1 + SHOULDER * w1
    b2 = thrown * w1 + gravity2 + ELBOW * w2
    # Damping acts on the velocity at the end of the step, as MuJoCo's integrator has it: stable.
    return m11 + step * SHOULDER, m12, m22 + step * ELBOW, b1, b2


def paths(q: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Musculotendon lengths (…, 6) and moment arms (…, 2, 6) in m; angles held to the tables.

    ValueError where a posture is no (…, 2), or in degrees.
    """
    return interpolated_paths(_posture(q))


def interpolated_paths(q: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """`paths` for loops: the angles may be as wild as a forward model predicts them."""
    row, share = table_row(_per_joint("posture", q, "rad"), slice(2))
    entry = tables()[np.arange(2), row]
    value = entry[..., :12] + share[..., None] * entry[..., 12:]
    return value[..., 0, :6] + value[..., 1, :6], value[..., 6:]


def table_row(angle: Numbers, joint: int | slice) -> tuple[Any, Any]:
    """The row of the `tables` for a joint at this angle, and the share of the way to the next."""
    low = LOW[joint]
    # fmin, fmax: an angle that is not a number has a row, too, and a share that is none either
    place = (np.fmin(np.fmax(angle, low), HIGH[joint]) - low) * ROWS_PER_RADIAN[joint]
    row = np.int64(place)
    return row, place - row + 0 * angle


@cache
def tables() -> np.ndarray:
    """Lengths and moment arms over the angle of either joint, and their slopes (2, ROWS, 24)."""
    table = arrays("arm26")["paths"]
    for _ in range(DIFFERENCES):
        table = np.cumsum(table, axis=-1)
    turned = UNIT * np.swapaxes(table, 1, 2)
    slopes = np.diff(turned, axis=1, append=turned[:, -1:])
    return np.concatenate([turned, slopes], axis=-1)
