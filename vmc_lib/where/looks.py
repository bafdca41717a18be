"""To look again: what a box shows says how to correct it, and how well it fits in the end.

Both are learnt from true boxes that were scattered on purpose. The numbers were chosen on the
validation photos.
"""

from dataclasses import dataclass

import numpy as np
from sklearn.linear_model import Ridge

from .boxes import corrected, corrections, iou
from .machine import Machine

SCATTERED = 12_800  # boxes, strewn about the true ones, that a look learns from
PENALTY = 30  # of a look's ridge regression

FIT, ASTRAY = 0.75, 0.3  # IoU from which a box fits, and under which it shows no object
NEAR = (0.03, 0.08, 0.15)  # how far, in sides, the judge's scattered boxes stray
FOOLED, PLAIN = 25, 10  # candidates a photo that the judge sees: led astray by looks, and as found
JUDGED, DIRECTIONS, COST = 8000, 60, 10  # of the judge: boxes, directions of features, SVM's C


def learn_to_look(lessons, recipe, rng):
    """One linear map (d + 1, 4) a look, from what a box shows to its correction.

    Box regression (Girshick et al. 2014); the later a look, the nearer it expects the box to be.
    """
    times, maps = SCATTERED // sum(len(lesson.truth) for lesson in lessons) + 1, []
    for spread in recipe.looks:
        x, goal = [], []
        for lesson in lessons:
            truth, boxes = lesson.scattered(times, spread, rng)
            x.append(recipe.describe(lesson.image, boxes))
            goal.append(corrections(boxes, truth))
        ridge = Ridge(PENALTY).fit(np.concatenate(x), np.concatenate(goal))
        maps.append(np.vstack([ridge.coef_.T, ridge.intercept_]))
    return tuple(maps)


def look_again(recipe, maps, image, boxes):
    """The boxes (n, 4), each corrected by what it shows, once for every map."""
    for weights in maps:
        shown = recipe.describe(image, boxes)
        boxes = corrected(boxes, shown @ weights[:-1] + weights[-1])
    return boxes


@dataclass(frozen=True)
class Judge:
    """Scores how well a box fits its object, from the features' main directions."""

    axes: np.ndarray  # (d, k)
    machine: Machine  # of RBF kernel

    @classmethod
    def fit(cls, lessons, recipe, gate, maps, rng):
        """Learn to tell fits from misfits, the classifier's blind zone (0.5 to 0.8) included.

        Fits and near misses are true boxes, scattered; other misfits are candidates, and above all
        those that pass the `gate` (a Machine) and are led by the looks to what is no object.
        """
        total = sum(len(lesson.truth) for lesson in lessons)
        times, x, y = SCATTERED // total // len(NEAR) + 1, [], []
        for lesson in lessons:
            near = [lesson.scattered(times, spread, rng)[1] for spread in NEAR]
            some = rng.permutation(lesson.boxes)[: 2 * SCATTERED // len(lessons)]
            off = some[iou(some, lesson.truth).max(1, initial=0) < ASTRAY]
            fooled = gate.score(recipe.describe(lesson.image, off)) > recipe.gate
            led = look_again(recipe, maps, lesson.image, off[fooled][:FOOLED])
            boxes = np.vstack([*near, led, some[:PLAIN]])
            x.append(recipe.describe(lesson.image, boxes))
            y.append(iou(boxes, lesson.truth).max(1, initial=0) >= FIT)
        x, y = np.concatenate(x), np.concatenate(y)
        some = rng.permutation(len(x))[:JUDGED]
        x, y = x[some], y[some]
        axes = np.linalg.eigh(np.cov(x.T))[1][:, -DIRECTIONS:]
        return cls(axes, Machine.fit(x @ axes, y, "rbf", COST))

    def score(self, x):
        """How well boxes with features x (n, d) fit, in margins: (n,)."""
        return self.machine.score(x @ self.axes)
