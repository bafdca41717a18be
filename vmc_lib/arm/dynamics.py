"""The arm's dynamics as trigonometric polynomials, for many postures at once.

The inertia, the pull of gravity and the hand's position are trigonometric polynomials in the two
angles, sums of eleven waves: a few dozen snapshots of the MuJoCo model determine their
coefficients exactly. And no muscle wraps over both joints at once, so every musculotendon length
is a function of the shoulder angle plus a function of the elbow angle: two tables.
"""

from functools import cache
from itertools import product

import mujoco
import numpy as np

from vmc_lib.arm.model import DAMPING, LIMITS, STEP, forward, loaded, mass_matrix, muscle_paths

ROWS = 10_001  # of the muscle tables: steps of half a milliradian
MARGIN = 0.4  # rad: the tables reach a little beyond the joints' stops
LOW, HIGH = LIMITS[:, 0] - MARGIN, LIMITS[:, 1] + MARGIN
ROWS_PER_RADIAN = (ROWS - 1) / (HIGH - LOW)
SHOULDER, ELBOW = DAMPING.tolist()


def waves(shoulder, elbow):
    """Cosines and sines of the two angles, their sum, and their products: eleven."""
    c1, s1, c2, s2 = np.cos(shoulder), np.sin(shoulder), np.cos(elbow), np.sin(elbow)
    c12, s12 = c1 * c2 - s1 * s2, s1 * c2 + c1 * s2
    return c1 * 0 + 1, c1, s1, c2, s2, c12, s12, c2 * c1, c2 * s1, c2 * c2, c2 * s2


def turns(shoulder, elbow):
    """How fast each of the `waves` changes as the shoulder turns, and as the elbow does."""
    _, c1, s1, c2, s2, c12, s12, cc, cs, cc2, cs2 = waves(shoulder, elbow)
    o = c1 * 0
    return (
        (o, -s1, c1, o, o, -s12, c12, -cs, cc, o, o),
        (o, o, o, -s2, c2, -s12, c12, -s2 * c1, -s2 * s1, -2 * cs2, cc2 - s2 * s2),
    )


def _each_wave(q):
    """`waves` of postures (…, 2), as an array (…, 11)."""
    return np.array(waves(*np.transpose(q))).T


@cache
def coefficients(load=0.0):
    """Of the waves in the dynamics (11, 7), as `_dynamics` unpacks it, and the hand (11, 3)."""
    angles = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    snapshots = np.array(list(product(angles, angles)))
    data = mujoco.MjData(loaded(load))
    seen = np.array([_snapshot(q, data) for q in snapshots])
    solved = np.linalg.lstsq(_each_wave(snapshots), seen)[0]
    return solved[:, :7].copy(), solved[:, 7:].copy()


def _snapshot(q, data):
    gravity = forward(q, data=data).qfrc_bias.copy()
    inertia = mass_matrix(data)
    # A turning shoulder throws the forearm outwards, and a bending elbow the upper arm.
    swing = forward(q, (1, 0), data).qfrc_bias[1] - gravity[1]
    bend = forward(q, (0, 1), data).qfrc_bias[0] - gravity[0]
    terms = [inertia[0, 0], inertia[0, 1], inertia[1, 1], swing, bend, *gravity]
    return [*terms, *data.site("hand").xpos]


def hand(q):
    """Position of the wrist (…, 3) in the shoulder frame for postures q (…, 2)."""
    return _each_wave(q) @ coefficients()[1]


def torque_for(q, velocity, acceleration):
    """Inverse dynamics: torques (…, 2) in N m that give these accelerations over one step."""
    m11, m12, m22, b1, b2 = _dynamics(_terms(q), *velocity.T, STEP)
    a1, a2 = acceleration.T
    return np.array([m11 * a1 + m12 * a2 + b1, m12 * a1 + m22 * a2 + b2]).T


def acceleration_from(q, velocity, torque):
    """Forward dynamics, Eq. 12: the accelerations (…, 2) that joint torques cause."""
    return np.array(accelerations(_terms(q), *velocity.T, *torque.T, STEP)).T


def _terms(q):
    return (_each_wave(q) @ coefficients()[0]).T


def accelerations(terms, w1, w2, t1, t2, step):
    """Eq. 12 of one arm, or of many: both accelerations from velocities and torques of the joints.

    `terms` are the seven that `coefficients` makes of the waves.
    """
    m11, m12, m22, b1, b2 = _dynamics(terms, w1, w2, step)
    t1, t2 = t1 - b1, t2 - b2
    determinant = m11 * m22 - m12 * m12
    return (m22 * t1 - m12 * t2) / determinant, (m11 * t2 - m12 * t1) / determinant


def _dynamics(terms, w1, w2, step):
    """The mass matrix's entries, and the torques of motion, gravity and damping."""
    m11, m12, m22, swing, bend, gravity1, gravity2 = terms
    thrown = swing * w1
    b1 = (bend * w2 - 2 * thrown) * w2 + gravity1 + SHOULDER * w1
    b2 = thrown * w1 + gravity2 + ELBOW * w2
    # Damping acts on the velocity at the end of the step, as MuJoCo's integrator has it: stable.
    return m11 + step * SHOULDER, m12, m22 + step * ELBOW, b1, b2


def paths(q):
    """Musculotendon lengths (…, 6) and moment arms (…, 2, 6) in m; angles held to the tables."""
    row, share = row_of(q, slice(2))
    entry = tables()[np.arange(2), row]
    value = entry[..., :12] + share[..., None] * entry[..., 12:]
    return value[..., 0, :6] + value[..., 1, :6], value[..., 6:]


def row_of(angle, joint):
    """The row of the `tables` for a joint at this angle, and how far on the way to the next."""
    low = LOW[joint]
    # fmin, fmax: an angle that is not a number has a row, too; its movement is not a number either
    place = (np.fmin(np.fmax(angle, low), HIGH[joint]) - low) * ROWS_PER_RADIAN[joint]
    row = np.int64(place)
    return row, place - row


@cache
def tables():
    """Lengths and moment arms as the shoulder or the elbow turns, and slopes (2, ROWS, 24)."""
    data = forward((0, 0))
    straight = muscle_paths(data)[0].copy()
    turned = np.empty((2, ROWS, 12))
    for joint, posture in enumerate(np.eye(2)):
        angles = np.linspace(LOW[joint], HIGH[joint], ROWS)
        for row, angle in zip(turned[joint], angles, strict=True):
            row[:6], arms = muscle_paths(forward(angle * posture, data=data))
            row[6:] = arms[joint]
    turned[1, :, :6] -= straight
    slopes = np.diff(turned, axis=1, append=turned[:, -1:])
    return np.concatenate([turned, slopes], axis=-1)
