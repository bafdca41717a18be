"""Online calibration: correct the plan before moving, from what past movements taught.

`WeightCorrection` is the paper's g (Eq. 8, Algorithm 2): a linear regression of Δw on the target,
the weights and the templates' positions. `AimCorrection` is ours: it learns where to aim instead,
by granule cells, each excited by its own small region of targets, that feed a few Purkinje weights
(Marr, 1969; Albus, 1971).

Both learn by hindsight: wherever the hand went, what was commanded was the right command for going
there. That is step 5 of Algorithm 2, and direct inverse modelling (Jordan & Rumelhart, 1992).

Both have `correct(plan)`, the plan with what was learned, and `update(plan)`, which moves and
learns; that is a batch of plans.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Self

import numpy as np

from vmc_lib.cerebellum.offline import Rule, calibrate
from vmc_lib.checks import (
    as_numbers,
    check_count,
    check_features,
    is_positive,
    is_within,
)
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import (
    RULES,
    Plan,
    check_batch,
    check_plan,
    check_templates,
    exact_weights,
    is_surrounded,
    plan,
    rule_called,
    surrounding,
)
from vmc_lib.motor.templates import TemplateSet
from vmc_lib.short_repr import short

# With Eq. 5's power of 1 the weights have a kink at every template; chosen on validation targets
smooth_weights = partial(exact_weights, power=1.25)
TOGETHER = 5  # movements of a batch that are made before the next are aimed


def equation_8(plan: Plan) -> np.ndarray:
    """The inputs of the paper's g, for a plan: p_t, every w_i and every p_i, (…, 2 + 3 N).

    Eq. 8 names w_i^off and p_i^off, "the positions of the movement after off-line calibration",
    which a movement still to be made does not have. Here they are the plan's weights and `points`.
    """
    check_plan(plan)
    points = plan.points.reshape(*plan.points.shape[:-2], -1)
    return np.concatenate([plan.target, plan.weights, points], axis=-1)


def mossy_fibres(plan: Plan) -> np.ndarray:
    """The mossy fibres' input: a plan's target, also among its templates, (…, 4 or 6)."""
    check_plan(plan)
    return np.concatenate([plan.target, plan.target - plan.points.mean(axis=-2)], axis=-1)


class LinearRegression:
    """Least squares with an intercept, the paper's g; scikit-learn's, without its import."""

    def fit(self, X: np.ndarray, y: np.ndarray) -> Self:
        """Learn y (n, k) at X (n, d), forgetting all else."""
        X, y = as_numbers("X", X), as_numbers("y", y)
        if X.ndim != 2 or y.shape[:1] != X.shape[:1] or not X.size:
            raise ValueError(f"X {X.shape} and y {y.shape}: give (n, d) and (n, k)")
        self.mean_, self.intercept_ = X.mean(axis=0), y.mean(axis=0)
        self.slopes_ = np.linalg.lstsq(X - self.mean_, y - self.intercept_, rcond=1e-6)[0]
        return self

    def predict(self, X: np.ndarray) -> np.ndarray:
        """The answers (n, k) at X (n, d)."""
        if not hasattr(self, "slopes_"):
            raise ValueError("the regression has learned nothing yet: fit it first")
        if (X := as_numbers("X", X)).shape[-1:] != self.mean_.shape:
            raise ValueError(f"X {X.shape}: give rows of {len(self.mean_)} features")
        return self.intercept_ + (X - self.mean_) @ self.slopes_


@dataclass(eq=False)
class WeightCorrection:
    """Eq. 8, learned by Algorithm 2 as it is printed; or, without `hindsight`, by another reading.

    A training pair says which Δw was right for a target. As printed, "the modified weights w_i' and
    position p_a'" are learned: w' was right for p_a', where it took the hand. In the other reading
    w' is learned as if it had been right for the target p_t that it was calibrated for.

    Parameters
    ----------
    hindsight : bool
        Learn as printed, or by the other reading.
    weigh : {"habitual", "exact"} or callable
        The rule of planning, as `plan` takes it; the paper's is Eq. 5.
    g : estimator
        With scikit-learn's methods, from `inputs` to Δw; the paper's is linear.
    inputs : callable
        What g gets to know of a plan.

    Examples
    --------
    >>> from vmc_lib.motor.templates import load
    >>> plans = plan(np.array([[0.15, -0.4], [0.12, -0.38]]), load())
    >>> WeightCorrection().update(plans).correct(plans).weights.shape
    (2, 4)
    """

    hindsight: bool = True
    weigh: str | Callable = "habitual"
    g: Any = field(default_factory=LinearRegression)
    inputs: Callable = equation_8
    training_pairs: list = field(default_factory=list)

    def correct(self, plan: Plan) -> Plan:
        """The plan with the learned Δw added; as `weigh` has it before the first update."""
        check_plan(plan)
        planned = self._planned(plan)
        if not self.training_pairs:
            return planned
        return planned.with_weights(planned.weights + self.g.predict(self.inputs(planned)))

    def update(self, plan: Plan, rule: Rule = "published") -> Self:
        """Algorithm 2, its steps for every plan of a batch; `rule`, as `calibrate` takes it."""
        check_batch(plan)
        online = self.correct(plan)  # 1, 2: "calibrated weights w_i^on = w_i + Δw_i^on"
        modified = online.with_weights(calibrate(online, rule).best_weights)  # 3, 4: "w_i' = …"
        place = plan.target
        if self.hindsight:
            place = execute(modified).endpoint  # 4: "actual p_a'"
        right = self._planned(replace(plan, target=place))
        self.training_pairs.append((self.inputs(right), modified.weights - right.weights))
        self.g.fit(*map(np.concatenate, zip(*self.training_pairs, strict=True)))  # 5: "… to g'"
        return self

    def _planned(self, plan):
        weigh = rule_called(self.weigh, RULES)
        return plan.with_weights(weigh(plan.target, plan.points))


class AimCorrection:
    """Learn how far beyond a target to aim for the hand to end on it, then satisfy Eq. 4 there.

    It begins with what is known without moving: aiming at a template needs no correction.

    Parameters
    ----------
    template_set : TemplateSet
        The remembered reaches.
    cells : GranuleCells, optional
        The regression that learns.
    neighbours : array (n, N), optional
        Rows of templates that may be mixed; by default the fours around any place in the plane.

    Examples
    --------
    >>> from vmc_lib.motor.templates import load
    >>> plans = plan(np.array([[0.15, -0.4], [0.12, -0.38]]), load())
    >>> learner = AimCorrection(load()).update(plans)
    >>> bool(execute(learner.correct(plans)).error.max() < execute(plans).error.max())
    True
    """

    def __init__(
        self,
        template_set: TemplateSet,
        cells: "GranuleCells | None" = None,
        neighbours: np.ndarray | None = None,
    ) -> None:
        check_templates(template_set)
        if not (cells is None or hasattr(cells, "partial_fit")):
            raise ValueError(f"cells {short(cells)} learn nothing: give GranuleCells()")
        self.cells, points = cells or GranuleCells(), template_set.points
        fours = np.asarray(_neighbours(points) if neighbours is None else neighbours)
        if fours.ndim != 2 or not np.isin(fours, np.arange(len(points))).all():
            raise ValueError(f"neighbours {short(fours)}: give rows of templates, (n, N)")
        known = plan(template_set.points[fours], template_set, rows=fours[:, None])
        self.cells.fit(_rows(mossy_fibres(known)), np.zeros_like(_rows(known.target)))

    def correct(self, plan: Plan) -> Plan:
        """The plan aimed where it should be for the hand to end on the target."""
        return self._at(plan, self.aim(plan))

    def aim(self, plan: Plan) -> np.ndarray:
        """Where to aim, (…, d), for the hand to end on the plan's target."""
        check_plan(plan)
        shift = self.cells.predict(_rows(mossy_fibres(plan)))
        return plan.target + shift.reshape(plan.target.shape)

    def update(self, plan: Plan) -> Self:
        """Move, and learn from where the hand went: a training pair for each movement of the batch.

        `TOGETHER` are made at once; the next are aimed with what was learned from those.
        """
        check_batch(plan)
        for first in range(0, len(plan.target), TOGETHER):
            some = plan[first : first + TOGETHER]
            aim = self.aim(some)
            end = execute(self._at(some, aim)).endpoint
            self.cells.partial_fit(*self.training_pairs(some, aim, end))
        return self

    def training_pairs(
        self, plan: Plan, aim: np.ndarray, endpoint: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Mossy fibres (B, 2 d) of movements, and how far beyond to aim there, (B, d).

        By hindsight: each aim was right for the place where its movement ended.
        """
        return mossy_fibres(replace(plan, target=endpoint)), aim - endpoint

    def _at(self, plan, aim):
        return plan.with_weights(smooth_weights(aim, plan.points))


def _neighbours(points):
    """The fours of templates (n, 4) that surround some place in the plane."""
    axes = np.linspace(points.min(axis=0), points.max(axis=0), 40).T
    spots = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    return np.unique(surrounding(spots[is_surrounded(spots, points)], points), axis=0)


def _rows(values):
    return values.reshape(-1, values.shape[-1])


class GranuleCells:
    """Ridge regression on a random radial-basis expansion, updated batch by batch.

    Its methods are those of scikit-learn's regressions. They raise ValueError for numbers that are
    not finite, and for another number of features than was learned from.

    `cells` granule cells with receptive fields of the given `width` (in the units of X) lie at
    random about the first inputs; `ridge` is the L2 penalty on the Purkinje weights.
    """

    def __init__(
        self, width: float = 0.05, cells: int = 600, ridge: float = 3e-4, random_state: int = 0
    ) -> None:
        self.width, self.cells, self.ridge, self.random_state = width, cells, ridge, random_state

    def fit(self, X: np.ndarray, y: np.ndarray) -> Self:
        """Forget everything, place the cells about X (n, d), learn y (n,) or (n, k)."""
        X, y = _finite(X), _finite(y)
        if X.ndim != 2 or not X.size or y.shape[:1] != X.shape[:1]:
            raise ValueError(f"X {X.shape} and y {y.shape}: give (n, d), and (n,) or (n, k)")
        check_count("cells", self.cells, least=1)
        if not is_positive(self.width):
            raise ValueError(f"a width of {self.width}: give one above 0, in the units of X")
        if not is_within(self.ridge, 0, np.inf):
            raise ValueError(f"a ridge of {short(self.ridge)}: give a number, 0 or more")
        rng = np.random.default_rng(self.random_state)
        low, high = X.min(axis=0) - self.width, X.max(axis=0) + self.width
        self.centres_ = rng.uniform(low, high, (self.cells, X.shape[1]))
        self.gram_ = np.zeros((self.cells, self.cells))
        self.climbing_ = np.zeros((self.cells, *y.shape[1:]))
        return self.partial_fit(X, y)

    def partial_fit(self, X: np.ndarray, y: np.ndarray) -> Self:
        """Learn these as well; in which order batches come does not matter."""
        if not hasattr(self, "centres_"):
            return self.fit(X, y)
        active, y = self.excite(X), _finite(y)
        if y.shape != (len(active), *self.climbing_.shape[1:]):
            k = self.climbing_.shape[1:]
            raise ValueError(f"y {y.shape} at {len(active)} X: give {(len(active), *k)}")
        self.gram_ += active.T @ active
        self.climbing_ += active.T @ y
        regularised_gram = self.gram_ + self.ridge * np.eye(self.cells)
        self.purkinje_ = np.linalg.solve(regularised_gram, self.climbing_)
        return self

    def predict(self, X: np.ndarray) -> np.ndarray:
        """The correction (n,) or (n, k) for each X (n, d)."""
        return self.excite(X) @ self.purkinje_

    def excite(self, X: np.ndarray) -> np.ndarray:
        """How active each granule cell is, (n, cells) in [0, 1], for each X (n, d)."""
        X = _finite(X)
        if not hasattr(self, "centres_"):
            raise ValueError("the cells have learned nothing yet: fit them first")
        check_features(X, self.centres_.shape[1])
        away = zip(X.T, self.centres_.T, strict=True)  # one axis after the other: little memory
        squares = sum(np.subtract.outer(x, centre) ** 2 for x, centre in away)
        return np.exp(-squares / (2 * self.width**2))


def _finite(values):
    values = as_numbers("what to learn from,", values)
    if not np.isfinite(values).all():
        raise ValueError("NaN or infinity among the numbers to learn from: leave those out")
    return values
