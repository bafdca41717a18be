"""Box regression and IoU prediction: how to correct a box, and how well it fits in the end.

Both are ridge regressions on a few radial basis functions, learnt from true boxes that were
jittered on purpose. The numbers were chosen on 120 validation photos a level, of which 20 ship.
"""

from dataclasses import dataclass, replace

import numpy as np
from sklearn.linear_model import Ridge

from vmc_lib.boxes import corrected

DIRECTIONS = 100  # of the features, in which likeness to a centre is measured
PENALTY = 0.1  # of the ridge regression


@dataclass(frozen=True, eq=False)
class RBFRidge:
    """Ridge regression on the features and on radial basis functions of them.

    predict(x) = weights · (x - mean, exp(-gamma ‖axesᵀ (x - mean) - centres‖²)) + bias: a network
    of radial basis functions (Broomhead & Lowe 1988) beside a linear map.
    """

    mean: np.ndarray  # (d,)
    axes: np.ndarray  # (d, k) the main directions of the features
    centres: np.ndarray  # (r, k)
    gamma: float
    weights: np.ndarray = 0  # (d + r,), or (d + r, m) for m numbers
    bias: np.ndarray = 0

    @classmethod
    def fit(cls, x, y, count, rng):
        """Learn from features x (n, d) and their numbers y (n,) or (n, m).

        So many of the examples, drawn at random, become the centres.
        """
        mean = x.mean(0)
        axes = np.linalg.eigh(np.cov(x.T))[1][:, -DIRECTIONS:]
        places = (x - mean) @ axes
        centres = places[rng.permutation(len(x))[:count]]
        blank = cls(mean, axes, centres, 1 / places.var(0).sum())
        ridge = Ridge(PENALTY).fit(blank.basis(x), y)
        return replace(blank, weights=ridge.coef_.T, bias=ridge.intercept_)

    def basis(self, x):
        """What the weights weigh, for features x (n, d): (n, d + r)."""
        x = x - self.mean
        place = x @ self.axes
        apart = (place**2).sum(1)[:, None] + (self.centres**2).sum(1) - 2 * place @ self.centres.T
        likeness = np.exp(-self.gamma * apart)
        return np.hstack([x, likeness])

    def predict(self, x):
        """The numbers (n,) or (n, m) for features x (n, d)."""
        return self.basis(x) @ self.weights + self.bias


def regress(recipe, regressions, pixels, boxes):
    """The boxes (n, 4), each corrected by what it shows, once for every one of `regressions`."""
    for regression in regressions:
        boxes = corrected(boxes, regression.predict(recipe.describe(pixels, boxes)))
    return boxes
