"""Muscle models beside the paper's: OpenSim's (Thelen 2003) and MuJoCo's.

Both take what `muscle.activation_rate` and `muscle.force` take, so each can stand in for the
paper's wherever a `Muscle` is asked for. Constants are those of OpenSim's arm26, and MuJoCo's own
defaults. As in our reading of the paper, tendons are rigid and pennation is left out.
"""

import numpy as np

from vmc_lib.arm import muscle
from vmc_lib.arm.muscle import PAPER, Muscle


def lag(wanted, activation):
    """Both muscles' lag in s: the more active, the slower to rise and the faster to fall."""
    pace, rises = 0.5 + 1.5 * activation, wanted > activation
    up, down = muscle.TAU_ACTIVATION * pace, muscle.TAU_DEACTIVATION / pace
    return down + rises * (up - down)


def activation_rate(excitation, activation):
    """How fast an activation follows its excitation, per second."""
    return (excitation - activation) / lag(excitation, activation)


def thelen_force(activation, length, velocity, maximum):
    """Thelen (2003), J. Biomech. Eng. 125:70, Eq. 3, 6 and 7, the latter solved for the force.

    A muscle that is half active is also slower: its greatest speed follows its activation.
    """
    fastest = 2.5 + 7.5 * activation  # fibre lengths a second
    rate = velocity * muscle.MAX_VELOCITY / fastest
    shrinking = np.minimum(np.maximum(rate, -1), 0)
    growing = np.maximum(rate, 0) * (2 + 2 / 0.3) / 0.8
    speed = (1 + shrinking) / (1 - shrinking / 0.3) + 0.8 * growing / (1 + growing)
    passive = np.expm1(4 * np.maximum(length - 1, 0) / 0.6) / np.expm1(4)
    return maximum * (np.exp(-((length - 1) ** 2) / 0.5) * speed * activation + passive)


def mujoco_force(activation, length, velocity, maximum):
    """MuJoCo's `mju_muscleGain` and `mju_muscleBias`: parabolas, joined."""
    slope = np.clip(np.where(length < 1, (length - 0.5) / 0.5, (1.6 - length) / 0.6), 0, 1)
    active = np.where(slope < 0.5, 2 * slope**2, 1 - 2 * (1 - slope) ** 2)
    rate = np.clip(velocity * muscle.MAX_VELOCITY / 1.5, -1, 0.2)
    speed = np.where(rate < 0, (1 + rate) ** 2, 1.2 - (0.2 - rate) ** 2 / 0.2)
    taut = np.maximum(length - 1, 0) / 0.3
    passive = 1.3 * np.where(taut < 1, taut**2 / 2, taut - 0.5)
    return maximum * (active * speed * activation + passive)


LAWS = {
    "the paper (Eq. 9–11)": PAPER,
    "Thelen 2003": Muscle(activation_rate, thelen_force),
    "MuJoCo": Muscle(activation_rate, mujoco_force),
}
