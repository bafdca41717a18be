"""The arm's closed forms as arrays, asked of its MuJoCo model: see `vmc_lib.arm.dynamics`."""

from itertools import product

import numpy as np

from vmc_lib.arm.arm26 import dynamics_at, forward, muscle_paths
from vmc_lib.arm.dynamics import DIFFERENCES, HIGH, LOW, ROWS, UNIT, trig_basis
from vmc_lib.motor.inverse_dynamics import static_activation
from vmc_lib.motor.templates import START

HEAVY = 10.0  # kg: inertia, gravity and throw grow in proportion to a load at the wrist


def make():
    """The arrays of `arm26.npz`: "dynamics" (2, 11, 10), "paths" (2, 12, ROWS)."""
    bare, loaded = coefficients(0), coefficients(HEAVY)
    paths = np.rint(path_table() / UNIT).astype(int)
    none = np.zeros((2, 12, DIFFERENCES), int)  # before the first row
    return {
        "dynamics": np.array([bare, (loaded - bare) / HEAVY]),  # with no load, and per kg
        "paths": np.diff(paths, DIFFERENCES, prepend=none),
    }


def coefficients(load):
    """Of the basis in the dynamics and in the hand's position, with a `load` in kg: (11, 10)."""
    angles = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    snapshots = np.array(list(product(angles, angles)))
    basis = np.array(trig_basis(*snapshots.T)).T
    return np.linalg.lstsq(basis, dynamics_at(snapshots, load))[0]


def path_table():
    """Lengths and moment arms over the angle of either joint, in m: (2, 12, ROWS)."""
    data = forward((0, 0))
    straight = muscle_paths(data)[0].copy()
    turned = np.empty((2, 12, ROWS))
    for joint, posture in enumerate(np.eye(2)):
        angles = np.linspace(LOW[joint], HIGH[joint], ROWS)
        for column, angle in zip(turned[joint].T, angles, strict=True):
            column[:6], arms = muscle_paths(forward(angle * posture, data=data))
            column[6:] = arms[joint]
    turned[1, :6] -= straight[:, None]
    return turned


def make_rest():
    """The array of `rest.npz`: "activation" (6,), which holds the arm where every reach begins."""
    return {"activation": static_activation(START)}
