"""To look again: what a box shows says how to correct it, and how well it fits in the end.

Both are estimates, learnt from true boxes that were scattered on purpose. The numbers were chosen
on 120 validation photos a level (20 ship; CONTRIBUTING.md says how to render more).
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.distance import cdist
from sklearn.linear_model import Ridge

from .boxes import corrected, corrections, iou

SCATTERED = 12_800  # boxes, strewn about the true ones, that a look learns from
DIRECTIONS = 100  # of the features, in which likeness is measured
PENALTY = 0.1  # of the ridge regression
REMEMBERED_LOOKING, REMEMBERED_JUDGING = 1000, 2000  # boxes

JUDGED = 25_600  # scattered boxes that the judge learns from
UNFIT, FIT = 0.5, 0.9  # IoU up to which a box is worth 0, and from which it is worth 1
ASTRAY = 0.3  # IoU under which a box shows no object
NEAR = (0.03, 0.08, 0.15)  # how far, in sides, the scattered boxes stray that are judged
FOOLED, PLAIN = 25, 10  # further candidates a lesson: fooled ones after the looks, any as found
SIFTED = 51_200  # candidates of all lessons among which these are sought


@dataclass(frozen=True)
class Estimate:
    """Numbers read off what a box shows: a linear part, and one for likeness to boxes remembered.

    estimate(x) = weights · (x - mean, exp(-gamma ‖axesᵀ (x - mean) - remembered‖²)) + bias: a
    network of radial basis functions (Broomhead & Lowe 1988) beside a linear map.
    """

    mean: np.ndarray  # (d,)
    axes: np.ndarray  # (d, k) the main directions of the features
    remembered: np.ndarray  # (r, k)
    gamma: float
    weights: np.ndarray = 0  # (d + r,), or (d + r, m) for m numbers
    bias: np.ndarray = 0

    @classmethod
    def fit(cls, x, y, memories, rng):
        """Learn from features x (n, d) and their numbers y (n,) or (n, m), by ridge regression.

        So many of the examples, drawn at random, are remembered.
        """
        mean = x.mean(0)
        axes = np.linalg.eigh(np.cov(x.T))[1][:, -DIRECTIONS:]
        places = (x - mean) @ axes
        some = places[rng.permutation(len(x))[:memories]]
        blank = cls(mean, axes, some, 1 / places.var(0).sum())
        ridge = Ridge(PENALTY).fit(blank.terms(x), y)
        return replace(blank, weights=ridge.coef_.T, bias=ridge.intercept_)

    def terms(self, x):
        """What the weights weigh, for features x (n, d): (n, d + r)."""
        x = x - self.mean
        likeness = np.exp(-self.gamma * cdist(x @ self.axes, self.remembered, "sqeuclidean"))
        return np.hstack([x, likeness])

    def __call__(self, x):
        """The estimates (n,) or (n, m) for features x (n, d)."""
        return self.terms(x) @ self.weights + self.bias


def learn_to_look(lessons, recipe, rng):
    """One Estimate a look, of the correction (4,) that a box needs by what it shows.

    Box regression (Girshick et al. 2014); the later a look, the nearer it expects the box to be.
    """
    times, looks = SCATTERED // sum(len(lesson.truth) for lesson in lessons) + 1, []
    for spread in recipe.looks:
        x, goal = [], []
        for lesson in lessons:
            truth, boxes = lesson.scattered(times, spread, rng)
            x.append(recipe.describe(lesson.image, boxes))
            goal.append(corrections(boxes, truth))
        x, goal = np.concatenate(x), np.concatenate(goal)
        looks.append(Estimate.fit(x, goal, REMEMBERED_LOOKING, rng))
    return tuple(looks)


def look_again(recipe, looks, image, boxes):
    """The boxes (n, 4), each corrected by what it shows, once for every one of the `looks`."""
    for look in looks:
        boxes = corrected(boxes, look(recipe.describe(image, boxes)))
    return boxes


def learn_to_judge(lessons, recipe, machine, looks, rng):
    """An Estimate of how well a box fits its object: 0 up to IoU UNFIT, rising to 1 at FIT.

    It learns from true boxes, scattered, the classifier's blind zone (0.5 to 0.8) included; from
    candidates; and from those that show no object and yet fool the `machine`, wherever the looks
    then lead them.
    """
    total = sum(len(lesson.truth) for lesson in lessons)
    times, x, y = JUDGED // total // len(NEAR) + 1, [], []
    for lesson in lessons:
        near = [lesson.scattered(times, spread, rng)[1] for spread in NEAR]
        some = rng.permutation(lesson.boxes)[: SIFTED // len(lessons)]
        off = some[iou(some, lesson.truth).max(1, initial=0) < ASTRAY]
        fooled = machine.score(recipe.describe(lesson.image, off)) > recipe.gate
        led = look_again(recipe, looks, lesson.image, off[fooled][:FOOLED])
        boxes = np.vstack([*near, led, some[:PLAIN]])
        x.append(recipe.describe(lesson.image, boxes))
        y.append(np.interp(iou(boxes, lesson.truth).max(1, initial=0), (UNFIT, FIT), (0, 1)))
    return Estimate.fit(np.concatenate(x), np.concatenate(y), REMEMBERED_JUDGING, rng)
