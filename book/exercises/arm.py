"""Exercises of the chapter on the arm."""

import numpy as np

from vmc_lib.grading import Exercise


def moment_arms(length, q, turn):
    arms = []
    for joint in np.eye(2):
        longer = length(q + turn * joint) - length(q - turn * joint)
        arms.append(-longer / (2 * turn))
    return np.array(arms)


def _muscle_and_posture(rng):
    near, far = rng.uniform(0.02, 0.05, 2)
    q = rng.uniform(0, 1.5, 2).round(2)
    return (
        lambda q: 0.3 + near * np.cos(q[0]) - far * np.sin(q[1] / 2) + 0.01 * q[0] * q[1],
        q,
        0.01,
    )


MOMENT_ARMS = Exercise(
    moment_arms,
    _muscle_and_posture,
    {
        "The sign: a muscle that gets *shorter* turns the joint forward. $R = -dL/dq$.": (
            lambda length, q, turn: -moment_arms(length, q, turn)
        ),
        "You turned both joints at once. Each joint has a moment arm of its own: turn one, and "
        "leave the other.": lambda length, q, turn: np.repeat(
            moment_arms(length, q, turn).sum(), 2
        ),
        "Twice too large: from `q - turn` to `q + turn` a joint turns by twice `turn`.": (
            lambda length, q, turn: 2 * moment_arms(length, q, turn)
        ),
        "Half as large as it should be: divide by the angle by which the joint was turned.": (
            lambda length, q, turn: moment_arms(length, q, turn) / 2
        ),
        "You turned the joint to one side only. From both sides the slope is that of the middle: "
        "turn forward, and from `q` back.": lambda length, q, turn: np.array(
            [-(length(q + turn * joint) - length(q)) / turn for joint in np.eye(2)]
        ),
    },
)


def posture(hand, upper, fore):
    square = hand @ hand - upper**2 - fore**2
    elbow = np.arccos(square / (2 * upper * fore))
    bearing = np.arctan2(hand[0], -hand[1])  # 0: straight down
    inward = np.arctan2(fore * np.sin(elbow), upper + fore * np.cos(elbow))
    return np.array([bearing - inward, elbow])


def _draw_reachable(rng):
    """Also above the shoulder."""
    bearing, far = rng.uniform(0.2, 2.4), rng.uniform(0.25, 0.5)
    upper, fore = rng.uniform([0.27, 0.24], [0.33, 0.3]).round(2)
    return far * np.array([np.sin(bearing), -np.cos(bearing)]), upper, fore


def _swing_shoulder(hand, upper, fore, share):
    """The right elbow, the shoulder turned by a share of the angle that it takes."""
    shoulder, elbow = posture(hand, upper, fore)
    bearing = np.arctan2(hand[0], -hand[1])
    return np.array([bearing - share * (bearing - shoulder), elbow])


POSTURE = Exercise(
    posture,
    _draw_reachable,
    {
        "Your upper arm points at the hand. A bent elbow carries the hand forward, so that the "
        "upper arm must stay behind.": (
            lambda hand, upper, fore: _swing_shoulder(hand, upper, fore, 0)
        ),
        "That elbow bends backwards: take the angle at the shoulder away, do not add it.": (
            lambda hand, upper, fore: _swing_shoulder(hand, upper, fore, -1)
        ),
        "Your elbow is the angle *inside* the joint, π when the arm is straight. Here a straight "
        "arm has 0.": lambda hand, upper, fore: posture(hand, upper, fore) * [1, -1] + [0, np.pi],
        "`arctan` takes a hand above the shoulder for one below it. `arctan2(x, -y)` tells both.": (
            lambda hand, upper, fore: posture(hand, upper, fore) - [np.pi * (hand[1] > 0), 0]
        ),
        "Your shoulder is measured from straight ahead. Here 0 is straight down: "
        "`arctan2(x, -y)`.": lambda hand, upper, fore: posture(hand, upper, fore) - [np.pi / 2, 0],
    },
)
