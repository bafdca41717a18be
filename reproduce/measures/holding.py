"""Static equilibrium: the torques that hold the arm's postures, and those its muscles can give.

Torques are in N m, at the shoulder and the elbow; q (…, 2) in rad.
"""

import numpy as np

from vmc_lib.arm import dynamics
from vmc_lib.motor.inverse_dynamics import muscle_gain

POSTURES = np.radians(np.stack(np.mgrid[-90:91:3, 0:131:5], axis=-1))
_ANGLES = np.linspace(0, 2 * np.pi, 180, endpoint=False)
DIRECTIONS = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)])  # (2, 180), of torques


def muscle_torques(q):
    """What each muscle, fully active, adds to the torques of a still arm (…, 2, 6)."""
    return muscle_gain(q, 0 * q)[1]


def required_torques(q, load=0.0):
    """What gravity, a load in kg at the wrist, and slack muscles leave to hold (…, 2)."""
    slack, _ = muscle_gain(q, 0 * q)
    return dynamics.torque_for(q, 0 * q, 0 * q, load) - slack


def busiest(q, load=0.0):
    """The busiest muscle's least activation (…) that holds q, above 1 where none does.

    The largest ratio, over all directions of torque, of the torque required to what all muscles
    that help give together (by the duality of linear programming).
    """
    most = np.maximum(np.swapaxes(muscle_torques(q), -1, -2) @ DIRECTIONS, 0).sum(axis=-2)
    return (required_torques(q, load) @ DIRECTIONS / np.maximum(most, 1e-9)).max(axis=-1)
