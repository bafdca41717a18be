"""Of the arm, what is measured of people: scatter by direction, and the shape of speed."""

import numpy as np

from reproduce.measures.changed_worlds import turn_between
from reproduce.peers.motor_noise import noisy_reach, with_noise
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import STEP


def direction_scatter(plans, start, share, repeats, rng):
    """The standard deviation of the directions in which reaches end, (n,), degrees.

    `plans` to n targets are made so many times, with signal-dependent noise of that `share` in
    every command (`with_noise`); directions are seen from the `start` (2,).
    """
    turned = turn_between(_noisy_ends(plans, share, repeats, rng), plans.target, start)
    return np.degrees(turned.std(axis=0, ddof=1))


def _noisy_ends(plans, share, repeats, rng):
    """Where the plans end each time, (repeats, n, 2), m."""
    commands = plans.excitations
    ends = [
        noisy_reach(lambda x: with_noise(x, share, rng), commands).endpoint for _ in range(repeats)
    ]
    return np.array(ends)


def speed_shape(q, still=0.05):
    """Of joint paths (n, T + 1, 2): the share of the movement before its peak, and peak over mean.

    Both (n,). The movement is the first second's part in which the hand is faster than `still` of
    its peak speed, about the peak.
    """
    path = hand(q[:, : round(1 / STEP) + 1])[..., :2]
    speed = np.linalg.norm(np.diff(path, axis=1), axis=-1)
    return tuple(np.transpose([_one_shape(one, still) for one in speed]))


def _one_shape(speed, still):
    peak = speed.argmax()
    slow = np.flatnonzero(speed < still * speed[peak])
    first = slow[slow < peak].max(initial=-1) + 1
    last = slow[slow > peak].min(initial=len(speed))
    return (peak - first) / (last - first), speed[peak] / speed[first:last].mean()
