"""Online calibration: correct the plan before moving, from what past movements taught.

`WeightCorrection` is the paper's g (Eq. 8, Algorithm 2): a linear regression of Δw on the target,
the weights and the templates' positions. `AimCorrection` is ours: it learns where to aim instead.
Granule cells, each excited by its own small region of targets, feed a few Purkinje weights (Marr,
1969; Albus, 1971), and every movement teaches by hindsight: wherever the hand went, the aim taken
was the right one for going there.

Both have `correct(plan)`, the plan with what was learned, and `practise(plan)`, more lessons; what
is practised is a batch of plans.
"""

from functools import partial

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.linear_model import LinearRegression
from sklearn.utils.validation import check_is_fitted, validate_data

from vmc_lib.cerebellum.offline import algorithm_1
from vmc_lib.motor.planning import Plan, exact_weights, surrounded, surrounding
from vmc_lib.motor.templates import TemplateSet

# With Eq. 5's power of 1 the weights have a kink at every template; chosen on validation targets
smooth_weights = partial(exact_weights, power=1.25)


class WeightCorrection:
    """Eq. 8 with the paper's linear g, updated by Algorithm 2."""

    def __init__(self):
        self.inputs, self.changes = [], []

    def correct(self, plan: Plan):
        """The plan with the learned Δw added; as it was before the first lesson."""
        if not self.inputs:
            return plan
        g = LinearRegression().fit(np.concatenate(self.inputs), np.concatenate(self.changes))
        return plan.with_weights(plan.weights + g.predict(_inputs(plan)))

    def practise(self, plan: Plan, rule=algorithm_1):
        """Algorithm 2 for a batch: correct online, calibrate that off-line, learn the sum."""
        calibrated = rule(self.correct(plan)).best
        self.inputs.append(_inputs(plan))
        self.changes.append(calibrated - plan.weights)
        return self


def _inputs(plan):
    points = plan.points.reshape(*plan.points.shape[:-2], -1)
    return np.concatenate([plan.target, plan.weights, points], axis=-1)


class AimCorrection:
    """Learn how far beyond a target to aim for the hand to end on it, then satisfy Eq. 4 there.

    It begins with what is known without moving: aiming at a template needs no correction.
    """

    def __init__(self, template_set: TemplateSet, cells=None):
        self.cells = cells or GranuleCells()
        edges = template_set.points.min(axis=0), template_set.points.max(axis=0)
        spots = np.stack(np.meshgrid(*np.linspace(*edges, 40).T), axis=-1).reshape(-1, 2)
        spots = spots[surrounded(spots, template_set.points)]
        four = template_set.points[np.unique(surrounding(spots, template_set.points), axis=0)]
        self.cells.fit(*_lessons(_place(four, four[:, None]), np.zeros_like(four)))

    def correct(self, plan: Plan):
        """The plan aimed where it should be for the hand to end on the target."""
        return self._at(plan, self.aim(plan))

    def aim(self, plan: Plan):
        """Where to aim, (…, 2), for the hand to end on the plan's target."""
        place = _place(plan.target, plan.points)
        return plan.target + self.cells.predict(place.reshape(-1, 4)).reshape(plan.target.shape)

    def practise(self, plan: Plan, together=5):
        """Move, and learn from where the hand went: a lesson for each movement of the batch.

        So many are made `together`; the next are aimed with what those taught.
        """
        for first in range(0, len(plan.target), together):
            some = plan[first : first + together]
            aim = self.aim(some)
            reached = self._at(some, aim).reached()
            self.cells.partial_fit(*_lessons(_place(reached, some.points), aim - reached))
        return self

    def _at(self, plan, aim):
        return plan.with_weights(smooth_weights(aim, plan.points))


def _place(position, points):
    """Position, and position among the templates' points: what the granule cells sense, (…, 4)."""
    return np.concatenate([position, position - points.mean(axis=-2)], axis=-1)


def _lessons(places, corrections):
    return places.reshape(-1, 4), corrections.reshape(-1, 2)


class GranuleCells(RegressorMixin, BaseEstimator):
    """Ridge regression on a random radial-basis expansion, learnt lesson by lesson.

    `cells` granule cells with receptive fields of the given `width` (in the units of X) lie at
    random about the first lessons; `ridge` is how reluctantly Purkinje weights move from zero.
    """

    def __init__(self, width=0.05, cells=600, ridge=3e-4, random_state=0):
        self.width, self.cells, self.ridge, self.random_state = width, cells, ridge, random_state

    def fit(self, X, y):
        """Forget everything, place the cells about X (n, d), learn y (n,) or (n, k)."""
        X, y = validate_data(self, X, y, multi_output=True)
        rng = np.random.default_rng(self.random_state)
        low, high = X.min(axis=0) - self.width, X.max(axis=0) + self.width
        self.centres_ = rng.uniform(low, high, (self.cells, X.shape[1]))
        self.gram_ = np.zeros((self.cells, self.cells))
        self.climbing_ = np.zeros((self.cells, *y.shape[1:]))
        return self.partial_fit(X, y)

    def partial_fit(self, X, y):
        """Learn these lessons as well; in which order they come does not matter."""
        if not hasattr(self, "centres_"):
            return self.fit(X, y)
        X, y = validate_data(self, X, y, multi_output=True, reset=False)
        active = self.excite(X)
        self.gram_ += active.T @ active
        self.climbing_ += active.T @ y
        reluctant = self.gram_ + self.ridge * np.eye(self.cells)
        self.purkinje_ = np.linalg.solve(reluctant, self.climbing_)
        return self

    def predict(self, X):
        """The correction (n,) or (n, k) for each X (n, d)."""
        check_is_fitted(self)
        return self.excite(validate_data(self, X, reset=False)) @ self.purkinje_

    def excite(self, X):
        """How active each granule cell is, (n, cells) in [0, 1], for each X (n, d)."""
        square = ((X[:, None] - self.centres_) ** 2).sum(axis=-1)
        return np.exp(-square / (2 * self.width**2))
