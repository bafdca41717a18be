"""Box regression and IoU prediction by ridge regression on radial basis functions.

Both learn from true boxes that were jittered on purpose. The numbers were chosen on 120 validation
photos a level, of which 20 ship.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from vmc_lib.boxes import decode_deltas
from vmc_lib.checks import check_count, check_features, check_rng
from vmc_lib.where.kernels import rbf
from vmc_lib.where.recipes import Recipe

DIRECTIONS = 100  # principal directions of the features that the basis functions are in
PENALTY = 0.1  # of the ridge regression


@dataclass(frozen=True, eq=False)
class RBFRidge:
    """Ridge regression on the features and on radial basis functions of them.

    predict(x) = weights · (x - mean, exp(-gamma ‖axesᵀ (x - mean) - centres‖²)) + bias: a network
    of radial basis functions (Broomhead & Lowe 1988) beside a linear map.
    """

    mean: np.ndarray  # (d,)
    axes: np.ndarray  # (d, k) the principal directions of the features
    centres: np.ndarray  # (r, k)
    gamma: float
    weights: np.ndarray | float = 0  # (d + r,), or (d + r, m) for m numbers
    bias: np.ndarray | float = 0

    @classmethod
    def fit(cls, x: np.ndarray, y: np.ndarray, count: int, rng: np.random.Generator) -> Self:
        """Fit to features x (n, d), targets y (n,) or (n, m); `count` random rows are centres."""
        from sklearn.linear_model import Ridge

        check_count("count", count, least=1)
        check_rng(rng)
        mean = x.mean(0)
        axes = np.linalg.eigh(np.cov(x.T))[1][:, -DIRECTIONS:]
        places = (x - mean) @ axes
        centres = places[rng.permutation(len(x))[:count]]
        untrained = cls(mean, axes, centres, 1 / places.var(0).sum())
        ridge = Ridge(PENALTY).fit(untrained.basis(x), y)
        return replace(untrained, weights=ridge.coef_.T, bias=ridge.intercept_)

    def basis(self, x: np.ndarray) -> np.ndarray:
        """Design matrix: centred features x (n, d) and RBF activations, (n, d + r)."""
        check_features(x, len(self.mean))
        x = x - self.mean
        z = x @ self.axes
        return np.hstack([x, rbf(z, self.centres, self.gamma)])

    def predict(self, x: np.ndarray) -> np.ndarray:
        """Predicted targets (n,) or (n, m) of features x (n, d)."""
        return self.basis(x) @ self.weights + self.bias


def regress(
    recipe: Recipe, regressions: Sequence[RBFRidge], image: np.ndarray, boxes: np.ndarray
) -> np.ndarray:
    """Refine boxes (n, 4) of an image by predicted deltas, once for each of `regressions`."""
    for regression in regressions:
        boxes = decode_deltas(boxes, regression.predict(recipe.describe(image, boxes)))
    return boxes
