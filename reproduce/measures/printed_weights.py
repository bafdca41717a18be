"""Least-squares fit of fixed templates to printed weights: can a few reaches share them?

Taken exactly, Eq. 5 makes each column of weights a statement about ratios of distances. Five
columns that sum to one are fifteen numbers; four points in the plane have only eight.
"""

import numpy as np
from scipy.optimize import least_squares

from reproduce import paper
from vmc_lib.motor.planning import habitual_weights


def best_points(targets, weights, rng, starts=20):
    """Points (4, 2) whose weights by Eq. 5 come nearest to weights (4, n) for targets (n, 2).

    Returns the points and their root mean square misfit: the best of many random starts.
    """

    def off(points):
        return (habitual_weights(targets, points.reshape(4, 2)).T - weights).ravel()

    spread = rng.choice([0.03, 0.1, 0.3], (starts, 1, 1))
    around = targets.mean(axis=0) + spread * rng.normal(size=(starts, 4, 2))
    fits = [least_squares(off, start.ravel()) for start in around]
    best = min(fits, key=lambda fit: fit.cost)
    return best.x.reshape(4, 2), np.sqrt((best.fun**2).mean())


def least_misfits(*choices):
    """The least misfit (m) that four points can have, for columns of Table IV: by their count."""
    weights = paper.TABLE_4_WEIGHTS / paper.TABLE_4_WEIGHTS.sum(axis=0)
    chosen = {len(k): (paper.TARGETS[k], weights[:, k]) for k in map(list, choices)}
    return {n: best_points(*one, np.random.default_rng(0))[1] for n, one in chosen.items()}
