"""Exercises of the chapter on one CRBM."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from vmc_lib.grading import Exercise


def energy_of(v, h, W, b, a):
    windows = sliding_window_view(v, W.shape)
    fit = (windows * W).sum(axis=(2, 3))  # W is not turned
    return -(h * (fit + b)).sum() - a * v.sum() + (v**2).sum() / 2


def _picture_and_explanation(rng):
    """Of the units, none to all are on."""
    m, w = rng.integers(2, 4, 2)
    h = (rng.random((m, m)) < rng.random()) * 1.0
    return rng.normal(size=[m + w - 1] * 2), h, rng.normal(size=(w, w)), *rng.normal(size=2)


ENERGY_OF = Exercise(
    energy_of,
    _picture_and_explanation,
    {
        "Your filter is turned once too often: a unit compares $W$ itself with its window.": (
            lambda v, h, W, b, a: energy_of(v, h, W[::-1, ::-1], b, a)
        ),
        "A unit that is on and fits must *lower* the energy: mind the sign of the first sum.": (
            lambda v, h, W, b, a: energy_of(v, h, -W, b, a)
        ),
        "The unit's own bias is missing: $-b \\sum h$.": lambda v, h, W, b, a: energy_of(
            v, h, W, 0, a
        ),
        "Every unit counted, on or off. Multiply each fit by its $h$.": lambda v, h, W, b, a: (
            energy_of(v, np.ones_like(h), W, b, a)
        ),
        "The last term is *half* the sum of squares.": lambda v, h, W, b, a: (
            energy_of(v, h, W, b, a) + (v**2).sum() / 2
        ),
    },
)


def unit_on(drives, die):
    chances = np.exp(drives) / (1 + np.exp(drives).sum())
    return np.searchsorted(chances.cumsum(), die)


UNIT_ON = Exercise(
    unit_on,
    lambda rng: (rng.normal(size=rng.integers(2, 5)).round(1), round(rng.random(), 3)),
    {
        "In yours one unit is always on. All of them off is a state too: the 1 below the line.": (
            lambda drives, die: np.searchsorted(
                (np.exp(drives) / np.exp(drives).sum()).cumsum(), die
            )
        ),
        "That is the most likely unit. A draw gives the others their chance too: use the die.": (
            lambda drives, die: drives.argmax()
        ),
        "You gave each unit the chance that it would have alone. Units of a block compete: all "
        "drives stand below the line.": lambda drives, die: np.searchsorted(
            (1 / (1 + np.exp(-drives))).cumsum(), die
        ),
        "You took the first unit whose own chance is above the die. Add up the chances on the "
        "way: the units share the numbers from 0 to 1 among them.": lambda drives, die: np.argmax(
            [*(np.exp(drives) / (1 + np.exp(drives).sum()) > die), True]
        ),
    },
)


def cd_step(v, h, dream_v, dream_h):
    def together(v, h):
        return (sliding_window_view(v, h.shape) * h).sum(axis=(2, 3))

    return together(v, h) - together(dream_v, dream_h)


def _data_and_dream(rng):
    m, w = rng.integers(2, 4, 2)
    n = m + w - 1
    return tuple(x for _ in range(2) for x in (rng.normal(size=(n, n)), rng.random((m, m))))


CD_STEP = Exercise(
    cd_step,
    _data_and_dream,
    {
        "The wrong way round: what goes together in the *data* must become more likely.": (
            lambda v, h, dream_v, dream_h: -cd_step(v, h, dream_v, dream_h)
        ),
        "That is what the data say alone. The filter would grow for ever: take away what goes "
        "together in the dream.": lambda v, h, dream_v, dream_h: cd_step(v, h, v, 0 * h),
        "Your change is turned by 180°: slide $h$ over $v$ as it is.": (
            lambda v, h, dream_v, dream_h: cd_step(v, h[::-1, ::-1], dream_v, dream_h[::-1, ::-1])
        ),
        "The dream has an explanation of its own: use `dream_h` with it.": (
            lambda v, h, dream_v, dream_h: cd_step(v, h, dream_v, h)
        ),
    },
)
