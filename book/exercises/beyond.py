"""Exercises of the chapter beyond the paper."""

from itertools import product

import numpy as np

from vmc_lib.grading import Exercise


def honest(first, again):
    best = first.argmin(axis=0)
    return again[best, np.arange(len(best))]


HONEST = Exercise(
    honest,
    lambda rng: (rng.random((4, 5)).round(2), rng.random((4, 5)).round(2)),
    {
        "That is the error of the lucky trial itself. Choose by `first`, and report what `again` "
        "says.": lambda first, again: first.min(axis=0),
        "You chose by `again`, and the luck is back. Choose by other errors than you report.": (
            lambda first, again: again.min(axis=0)
        ),
        "You kept one trial for all targets. Each target has its own best.": (
            lambda first, again: again[first.mean(axis=1).argmin()]
        ),
        "You took the mean of all trials. Only the one that was kept is repeated.": (
            lambda first, again: again.mean(axis=0)
        ),
    },
)

CORNERS = np.array(list(product([0, 1], repeat=3)))


def cube_weights(place, corners):
    shares = np.where(corners == 1, place, 1 - place)
    return shares.prod(axis=1)


CUBE_WEIGHTS = Exercise(
    cube_weights,
    lambda rng: (rng.random(3).round(2), rng.permutation(CORNERS)),
    {
        "The farthest corner has the most weight: along an axis, a corner at 1 gets the share "
        "`place`, one at 0 gets the rest.": lambda place, corners: cube_weights(1 - place, corners),
        "You added the three shares, and divided to make the sum one. The mixture then misses the "
        "place: multiply the shares.": lambda place, corners: (
            np.where(corners == 1, place, 1 - place).sum(axis=1) / 12
        ),
        "Weights by nearness (Eq. 5) do not give the place back. Multiply the three shares.": (
            lambda place, corners: _nearness(np.linalg.norm(corners - place, axis=1))
        ),
        "You gave all the weight to the nearest corner. Let each have its share.": (
            lambda place, corners: 1.0 * (corners == place.round()).all(axis=1)
        ),
    },
)


def _nearness(d):
    return (1 / d) / (1 / d).sum()
