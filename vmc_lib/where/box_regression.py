"""Box regression and IoU prediction: how to correct a box, and how well it fits in the end.

Both are ridge regressions on a few radial basis functions, learnt from true boxes that were
jittered on purpose. The numbers were chosen on 120 validation photos a level, of which 20 ship.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.distance import cdist
from sklearn.linear_model import Ridge

from vmc_lib.boxes import corrected, corrections, iou

DIRECTIONS = 100  # of the features, in which likeness to a centre is measured
PENALTY = 0.1  # of the ridge regression
REGRESSION_CENTRES, PREDICTION_CENTRES = 1000, 2000  # jittered boxes that are kept as centres

UNFIT, FIT = 0.5, 0.9  # IoU up to which a box is worth 0, and from which it is worth 1
BACKGROUND = 0.3  # IoU under which a box shows no object
JITTERS = (0.03, 0.08, 0.15)  # in sides: how far the predictor's boxes are jittered
HARD_NEGATIVES, EASY_NEGATIVES = 25, 10  # further candidates a photo: mined ones, any ones
MINED = 51_200  # candidates of all photos among which the hard ones are sought


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
        likeness = np.exp(-self.gamma * cdist(x @ self.axes, self.centres, "sqeuclidean"))
        return np.hstack([x, likeness])

    def predict(self, x):
        """The numbers (n,) or (n, m) for features x (n, d)."""
        return self.basis(x) @ self.weights + self.bias


def fit_box_regression(images, recipe, rng):
    """One `RBFRidge` a round, of the correction (4,) that a box needs by what it shows.

    Box regression (Girshick et al. 2014) on training images; the later the round, the nearer it
    expects the box to be.
    """
    times, rounds = recipe.boxes // sum(len(image.truth) for image in images) + 1, []
    for spread in recipe.regressions:
        x, goal = [], []
        for image in images:
            truth, boxes = image.jittered(times, spread, rng)
            x.append(recipe.describe(image.pixels, boxes))
            goal.append(corrections(boxes, truth))
        x, goal = np.concatenate(x), np.concatenate(goal)
        rounds.append(RBFRidge.fit(x, goal, REGRESSION_CENTRES, rng))
    return tuple(rounds)


def regress(recipe, regressions, pixels, boxes):
    """The boxes (n, 4), each corrected by what it shows, once for every one of `regressions`."""
    for regression in regressions:
        boxes = corrected(boxes, regression.predict(recipe.describe(pixels, boxes)))
    return boxes


def fit_iou_predictor(images, recipe, svm, regressions, rng):
    """An `RBFRidge` of how well a box fits its object: 0 up to IoU UNFIT, rising to 1 at FIT.

    It learns from true boxes, jittered, so that IoUs of 0.5 to 0.8, which the `svm` never learnt
    from, are among them; from candidates; and from hard negatives: candidates that show no object
    and yet pass the `svm`, as the regressions then correct them.
    """
    total = sum(len(image.truth) for image in images)
    times, x, y = 2 * recipe.boxes // total // len(JITTERS) + 1, [], []
    for image in images:
        near = [image.jittered(times, spread, rng)[1] for spread in JITTERS]
        some = rng.permutation(image.candidates)[: MINED // len(images)]
        off = some[iou(some, image.truth).max(1, initial=0) < BACKGROUND]
        passed = svm.score(recipe.describe(image.pixels, off)) > recipe.gate
        led = regress(recipe, regressions, image.pixels, off[passed][:HARD_NEGATIVES])
        boxes = np.vstack([*near, led, some[:EASY_NEGATIVES]])
        x.append(recipe.describe(image.pixels, boxes))
        y.append(np.interp(iou(boxes, image.truth).max(1, initial=0), (UNFIT, FIT), (0, 1)))
    return RBFRidge.fit(np.concatenate(x), np.concatenate(y), PREDICTION_CENTRES, rng)
