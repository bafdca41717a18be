"""Exercises of the chapter beyond the paper."""

from itertools import product

import numpy as np

from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.grading import Exercise
from vmc_lib.motor import templates
from vmc_lib.motor.planning import plan


def tenfold(sizes, errors):
    powers = np.log10(sizes[-1] / sizes[0])
    return (errors[0] / errors[-1]) ** (1 / powers)


def _sweep(rng):
    """The last error is not above the first; those between are in no order."""
    sizes = np.cumprod(rng.integers(2, 9, rng.integers(3, 6))) * 1.0
    errors = rng.uniform(0.5, 9, len(sizes)).round(1)
    return sizes, errors if errors[0] > errors[-1] else errors[::-1]


TENFOLD = Exercise(
    tenfold,
    _sweep,
    {
        "That is by how much the whole sweep divides the error. A tenfold is only a part of it, "
        "or more than it.": lambda sizes, errors: errors[0] / errors[-1],
        "You divided by the number of tenfolds. Factors multiply: take a root.": (
            lambda sizes, errors: errors[0] / errors[-1] / np.log10(sizes[-1] / sizes[0])
        ),
        "You took the natural logarithm. A tenfold is 1 in the logarithm to base ten.": (
            lambda sizes, errors: (errors[0] / errors[-1]) ** (1 / np.log(sizes[-1] / sizes[0]))
        ),
        "You turned it round: the error after, over the error before.": (
            lambda sizes, errors: 1 / tenfold(sizes, errors)
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


def median_biases(targets, n_trials=8):
    """Median bias (1 + n_trials,), m, by trial of Broyden calibration; templates 8 cm apart."""
    tried = broyden_calibration(plan(targets, templates.load(0.08)), n_trials).movements
    return np.median([movement.bias for movement in tried], axis=1)


def trials_needed(biases, within=1e-4):
    """The first trial whose bias (1 + n_trials,), m, is below `within`; ValueError if none is."""
    below = np.flatnonzero(biases < within)
    if not below.size:
        raise ValueError(f"no bias of {biases!r} is below {within!r} m: try more often")
    return int(below[0])
