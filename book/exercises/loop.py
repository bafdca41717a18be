"""Exercises of the chapter on the loop."""

import numpy as np

from vmc_lib.grading import Exercise


def chosen_box(scores, chances):
    named = chances > 0.5
    if not named.any():
        return -1
    return np.where(named, scores, -np.inf).argmax()


def _scored_boxes(rng):
    """Distinct scores; a chance of 0.5 exactly among others, and sometimes none above it."""
    n, most = rng.integers(3, 7), 10 if rng.random() < 0.8 else 6
    return rng.permutation(np.linspace(-1, 2, n)), rng.integers(2, most, n) / 10


CHOSEN_BOX = Exercise(
    chosen_box,
    _scored_boxes,
    {
        "You took the most likely box. All that are above 0.5 have the right name: of these the "
        "best score counts.": lambda scores, chances: (
            chances.argmax() if max(chances) > 0.5 else -1
        ),
        "You took the best score of all, and it may be the cup's: ask for the chance first.": (
            lambda scores, chances: scores.argmax()
        ),
        "You took the first box that is likely enough. These boxes are in no order: compare their "
        "scores.": lambda scores, chances: (
            np.flatnonzero(chances > 0.5)[0] if max(chances) > 0.5 else -1
        ),
        "Right, as long as there is a shuttlecock. Where no chance is above 0.5, return −1.": (
            lambda scores, chances: np.where(chances > 0.5, scores, -np.inf).argmax()
        ),
    },
)


def mixed(distances, commands):
    nearness = 1 / distances
    weights = nearness / nearness.sum()
    return sum(w * u for w, u in zip(weights, commands, strict=True))


MIXED = Exercise(
    mixed,
    lambda rng: (rng.uniform(0.01, 0.08, 4), rng.random((4, rng.integers(1, 4), 6))),
    {
        "The farthest template has the largest weight now. Take one over the distance.": (
            lambda d, u: np.tensordot(d / d.sum(), u, axes=1)
        ),
        "The weights do not sum to one: divide each by the sum of all.": (
            lambda d, u: np.tensordot(1 / d, u, axes=1)
        ),
        "That is the plain mean: every template has a quarter. Weigh the nearer ones more.": (
            lambda d, u: u.mean(axis=0)
        ),
        "Eq. 5 has one over the distance; yours is over its square.": (
            lambda d, u: np.tensordot(d**-2 / (d**-2).sum(), u, axes=1)
        ),
    },
)
