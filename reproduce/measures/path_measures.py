"""What is measured of a hand's path in the arm's plane: misses, swings, tremor, detours."""

import numpy as np

from vmc_lib.arm.model import STEP
from vmc_lib.motor.inverse_dynamics import MOVING
from vmc_lib.motor.planning import norm
from vmc_lib.motor.templates import HOLD, mean_distance, mean_speed

SWING, TREMOR = (0.5, 3.0), (3.0, 8.0)  # Hz
LAST = round(HOLD / STEP)  # samples at the end, over which a hand's distance is averaged


def push_error(path, reference, at):
    """How far paths (T + 1, 2) are apart after a push at `at` s: at most, and in the end, mm."""
    return 1000 * norm(path - reference)[round(at / STEP) :].max(), end_error(path, reference[-1])


def end_error(path, target):
    """How far paths (…, T + 1, 2) are from targets (…, 2) in the last half second, (…,), mm.

    The mean distance: a hand that swings round its target is not on it.
    """
    return 1000 * mean_distance(path[..., -LAST:, :], target)


def end_speed(path):
    """How fast hands (…, T + 1, 2) move in the last half second, on average, (…,), mm/s."""
    return 1000 * mean_speed(path[..., -LAST:, :], (LAST - 1) * STEP)


def end_swing(path):
    """How far a hand (T + 1, 2) swings in the last half second, mm."""
    return 1000 * np.ptp(path[-LAST:], axis=0).max()


def tremor(path, since=1.0, band=TREMOR):
    """Power in mm² in a band (low, high) in Hz, and the strongest frequency in Hz, of hand paths.

    `path` is (B, T + 1, 2) in m; what comes before `since` s is left out. Both answers are (B,).
    """
    late = 1000 * path[:, round(since / STEP) :]
    window = np.hanning(late.shape[1])[:, None]
    waves = np.fft.rfft((late - late.mean(axis=1, keepdims=True)) * window, axis=1)
    power = 2 * (np.abs(waves) ** 2).sum(axis=-1) / ((window**2).sum() * late.shape[1])
    frequency = np.fft.rfftfreq(late.shape[1], STEP)
    low, high = band
    within = (frequency >= low) & (frequency < high)
    return power[:, within].sum(axis=1), frequency[1:][power[:, 1:].argmax(axis=1)]


def overshoot(path, target):
    """How far hands (B, T + 1, 2) go beyond their targets (B, 2), along the way there, (B,), m."""
    way = target - path[:, 0]
    along = ((path - target[:, None]) * (way / norm(way)[:, None])[:, None]).sum(axis=-1)
    return along.max(axis=1).clip(0)


def path_length_ratio(path):
    """The length of each path in its first second, over the distance between its ends, (B,)."""
    first = path[:, : round(1 / STEP) + 1]
    length = norm(np.diff(first, axis=1)).sum(axis=1)
    return length / norm(first[:, -1] - first[:, 0])


def path_deviation(path, meant):
    """Where paths (B, T + 1, 2) are farthest from the meant ones across their way, (B,), m.

    Across the straight line from the first meant place to the last, while the hand should move;
    positive to the left.
    """
    way = meant[:, -1] - meant[:, 0]
    left = np.stack([-way[:, 1], way[:, 0]], axis=-1) / norm(way)[:, None]
    aside = ((path - meant)[:, :MOVING] * left[:, None]).sum(axis=-1)
    farthest = np.abs(aside).argmax(axis=1)[:, None]
    return np.take_along_axis(aside, farthest, axis=1)[:, 0]
