"""Adaptive controllers beside the granule cells: regressions, delta rule, other teachers.

Every one of them plans with the same exact weights and senses the same `mossy_fibres`. Who keeps
lessons keeps the templates' too; the delta rule starts from weights of zero, which say the same.
Those of `BY_HINDSIGHT` hold the aim for right at the place where the hand ended, as ours does. Two
learn from the error at the target instead, by the delta rule: feedback-error learning takes it as
it is (Kawato & Gomi 1992), a distal teacher through a model of what an aim leads to (Jordan &
Rumelhart 1992).

Hyperparameters were chosen on the calm arm with the seeds 100 to 102, among 2 to 12
neighbours, 10 or 30 hidden units with a penalty of 1e-4 to 1, and for the delta rule widths of .02
to .08 m and rates of .02 to .4 (.03 and .05 m for the two that learn at the target). The larger
ridge was chosen with these seeds too, among 3e-4 to .3, on the noisy arm.
"""

import warnings
from dataclasses import replace
from functools import partial

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin, clone
from sklearn.compose import TransformedTargetRegressor
from sklearn.exceptions import ConvergenceWarning
from sklearn.linear_model import LinearRegression
from sklearn.neighbors import KNeighborsRegressor
from sklearn.neural_network import MLPRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

from vmc_lib.cerebellum.online import AimCorrection, GranuleCells, mossy_fibres

RIDGE = 0.1  # L2 penalty where training pairs are noisy, instead of 3e-4
SMALL = 0.001  # m: step of the forward model's finite differences


class RefitRegressor(RegressorMixin, BaseEstimator):
    """A regression that is refitted to all training pairs so far (memory-based)."""

    def __init__(self, regression):
        self.regression = regression

    def fit(self, X, y):
        """Forget everything, learn y (n, k) at X (n, d)."""
        self.lessons_ = []
        return self.partial_fit(X, y)

    def partial_fit(self, X, y):
        """Learn these lessons as well."""
        self.lessons_.append((X, y))
        every_x, every_y = map(np.concatenate, zip(*self.lessons_, strict=True))
        with warnings.catch_warnings():  # a perceptron is stopped after so many rounds, and says so
            warnings.simplefilter("ignore", ConvergenceWarning)
            self.fitted_ = clone(self.regression).fit(every_x, every_y)
        return self

    def predict(self, X):
        """The answers (n, k) at X (n, d)."""
        return self.fitted_.predict(X)


class DeltaRuleCells(GranuleCells):
    """The same granule cells with Purkinje weights learnt by the delta rule (LMS).

    A Purkinje weight changes by its own line's activity times the error, a `rate` of it, and needs
    to know nothing of other weights: no matrix is inverted (Albus 1971).
    """

    def __init__(self, width=0.03, cells=600, rate=0.2, random_state=0):
        super().__init__(width, cells, random_state=random_state)
        self.rate = rate

    def fit(self, X, y):
        """Forget everything, place the cells about X (n, d), learn y (n, k)."""
        self.purkinje_ = np.zeros((self.cells, y.shape[1]))
        super().fit(X, y)
        del self.gram_, self.climbing_  # what it has no use for
        return self

    def partial_fit(self, X, y):
        """Learn these lessons as well, one after the other."""
        for active, answer in zip(self.excite(X), y, strict=True):
            error = answer - active @ self.purkinje_
            self.purkinje_ = self.purkinje_ + self.rate * np.outer(active, error)
        return self


class FeedbackError(AimCorrection):
    """Feedback-error learning: shift the aim by the error, at the target that was missed."""

    def training_pairs(self, plan, aim, endpoint):
        """At the target, the aim's shift and the error: aim + (target − reached) − target."""
        return mossy_fibres(plan), aim - endpoint


class DistalTeacher(AimCorrection):
    """Distal teacher: learn a forward model of the aim, and descend the error through it."""

    def __init__(self, template_set, cells):
        super().__init__(template_set, cells)
        self.model = GranuleCells()

    def training_pairs(self, plan, aim, endpoint):
        """The error, sent back through the model's slopes (its transposed Jacobian)."""
        self.model.partial_fit(mossy_fibres(replace(plan, target=aim)), endpoint - aim)
        ends = self._predicted(plan, aim)
        slopes = [(self._predicted(plan, aim + step) - ends) / SMALL for step in SMALL * np.eye(2)]
        error = plan.target - endpoint
        change = np.stack([(slope * error).sum(axis=-1) for slope in slopes], axis=-1)
        return mossy_fibres(plan), aim + change - plan.target

    def _predicted(self, plan, aim):
        return aim + self.model.predict(mossy_fibres(replace(plan, target=aim)))


def perceptron(hidden, penalty):
    """A small multi-layer perceptron, trained to the end on all lessons so far."""
    network = MLPRegressor(
        hidden_layer_sizes=(hidden,),
        activation="tanh",
        solver="lbfgs",
        alpha=penalty,
        max_iter=400,
        random_state=0,
    )
    scaled = make_pipeline(StandardScaler(), network)
    return RefitRegressor(TransformedTargetRegressor(scaled, transformer=StandardScaler()))


def interpolation(neighbours):
    """What the nearest lessons taught, the nearer the more."""
    return RefitRegressor(KNeighborsRegressor(neighbours, weights="distance"))


BY_HINDSIGHT = {
    "granule cells (ours)": GranuleCells,
    "with a larger ridge": partial(GranuleCells, ridge=RIDGE),
    "their delta rule": DeltaRuleCells,
    "linear rule": partial(RefitRegressor, LinearRegression()),
    "interpolation": partial(interpolation, 2),
    "perceptron": partial(perceptron, 30, 0.1),
}
LEARNERS = {
    **{name: (AimCorrection, cells) for name, cells in BY_HINDSIGHT.items()},
    "feedback error": (FeedbackError, DeltaRuleCells),
    "distal teacher": (DistalTeacher, DeltaRuleCells),
}
