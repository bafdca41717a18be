"""Exercises of the chapter on habitual planning."""

import numpy as np

from vmc_lib.grading import Exercise


def near_weights(target, points):
    d = np.linalg.norm(points - target, axis=1)
    if d.min() == 0:
        return (d == 0) / (d == 0).sum()
    return (1 / d) / (1 / d).sum()


def _target_and_points(rng):
    points, target = np.split(rng.normal(size=(rng.integers(3, 6), 2)) / 10, [-1])
    return points[0] if rng.random() < 0.4 else target[0], rng.permutation(points)


def _normalise(nearness):
    return nearness / nearness.sum()


def _distance(target, points):
    return np.linalg.norm(points - target, axis=1)


NEAR_WEIGHTS = Exercise(
    near_weights,
    _target_and_points,
    {
        "Right, but for a target that lies on a template: there you divide by zero. That "
        "template has it all: weight 1.": lambda target, points: _normalise(
            1 / _distance(target, points)
        ),
        "A small number added to each distance avoids zero, and spoils all other weights a "
        "little. Treat a distance of zero by itself.": lambda target, points: _normalise(
            1 / (_distance(target, points) + 1e-3)
        ),
        "Where the target lies on a template, you gave the others a share as well. That template "
        "alone goes there: weight 1, the others 0.": lambda target, points: (
            near_weights(target, points)
            if _distance(target, points).min()
            else np.full(len(points), 1 / len(points))
        ),
        "The farther templates weigh more in yours: take one over the distance.": (
            lambda target, points: _normalise(_distance(target, points))
        ),
    },
)


def two_arrows(target, weights, points, reached):
    mixed = weights @ points
    return np.array([target - mixed, mixed - reached])


def _draw_plan(rng):
    points = rng.normal(size=(n := rng.integers(2, 5), 2)) / 10
    return rng.normal(size=2) / 10, _normalise(rng.random(n)), points, rng.normal(size=2) / 10


TWO_ARROWS = Exercise(
    two_arrows,
    _draw_plan,
    {
        "Your arrows point the other way: the first goes *to* the target.": (
            lambda target, w, points, reached: -two_arrows(target, w, points, reached)
        ),
        "The two arrows are exchanged: arithmetic first, then the arm.": (
            lambda target, w, points, reached: two_arrows(target, w, points, reached)[::-1]
        ),
        "Your second arrow is the whole miss. The arm's part begins where the mixture of points "
        "lies.": lambda target, w, points, reached: np.array(
            [target - w @ points, target - reached]
        ),
        "You took the mean of the points. Eq. 4 weighs them.": lambda target, w, points, reached: (
            two_arrows(target, _normalise(np.ones(len(w))), points, reached)
        ),
    },
)
