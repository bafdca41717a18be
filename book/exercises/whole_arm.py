"""Exercises of the chapter on the whole arm."""

import numpy as np

from vmc_lib.grading import Exercise


def one_joint(torque, gain):
    helps = np.maximum(np.sign(torque) * gain, 0)
    return abs(torque) * helps / (helps @ helps)


def _muscles(rng):
    bend, straighten = (rng.uniform(4, 20, count).round(1) for count in rng.integers(2, 4, 2))
    torque = rng.choice([-1, 1]) * rng.uniform(2, 10)
    return torque.round(1), rng.permutation(np.append(bend, -straighten))


def _share_torque(torque, gain, shares):
    """The activations in proportion to `shares` that give the torque."""
    return torque * shares / (gain @ shares)


ONE_JOINT = Exercise(
    one_joint,
    _muscles,
    {
        "Some of your muscles push. Leave out those that turn the joint the other way.": (
            lambda torque, gain: _share_torque(torque, gain, gain)
        ),
        "You cut off what pushes at the end, and the torque is no longer right. Leave those "
        "muscles out first, then share.": (
            lambda torque, gain: np.maximum(_share_torque(torque, gain, gain), 0)
        ),
        "All that help are equally active. The squares sum to less when a muscle that turns more "
        "is more active.": (
            lambda torque, gain: _share_torque(torque, gain, 1.0 * (torque * gain > 0))
        ),
        "One muscle does it all. The squares add up to less when all that help share.": (
            lambda torque, gain: _share_torque(
                torque, gain, np.eye(len(gain))[(torque * gain).argmax()]
            )
        ),
    },
)


def self_motion(turning, jacobian):
    finger = jacobian @ turning
    least = np.linalg.pinv(jacobian) @ finger
    return turning - least


SELF_MOTION = Exercise(
    self_motion,
    lambda rng: (rng.uniform(-1, 1, 7).round(2), rng.uniform(-0.5, 0.5, (3, 7)).round(2)),
    {
        "That is the part that *does* move the finger. Take it away from `turning`.": (
            lambda turning, jacobian: turning - self_motion(turning, jacobian)
        ),
        "You added the part that moves the finger: now it moves twice as quickly. Take it away.": (
            lambda turning, jacobian: 2 * turning - self_motion(turning, jacobian)
        ),
        "The transpose turns the right joints, but not by the right amount: the finger still "
        "moves. Take the pseudo-inverse.": (
            lambda turning, jacobian: turning - jacobian.T @ (jacobian @ turning)
        ),
    },
)
