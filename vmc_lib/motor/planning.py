"""Habitual planning (Eq. 3–5): a new reach as a weighted sum of templates.

Every function takes one target (D,) or a batch (B, D), in m: in the arm's plane, D = 2, or, but for
`draw_targets`, in space, D = 3.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib import NoReach
from vmc_lib.checks import as_numbers, check_count, check_kind, check_rng, is_within
from vmc_lib.motor.templates import TemplateSet, offsets
from vmc_lib.short_repr import short, short_repr


@dataclass(frozen=True, eq=False)
class Plan:
    """Which templates a reach uses, and how much of each."""

    template_set: TemplateSet
    target: np.ndarray  # (…, D)
    rows: np.ndarray  # (…, N): of the template set
    weights: np.ndarray  # (…, N)

    __repr__ = short_repr

    @property
    def points(self) -> np.ndarray:
        """Where these templates reach, p_i, (…, N, D), m."""
        return self.template_set.points[self.rows]

    @property
    def excitations(self) -> np.ndarray:
        """The mix of Eq. 3, u_t(t) = Σ w_i u_i(t), (…, T, 6), clipped to a command's limits."""
        share = np.zeros((*self.weights.shape[:-1], len(self.template_set.points)))
        *batch, _ = np.indices(self.rows.shape, sparse=True)
        np.add.at(share, (*batch, self.rows), self.weights)  # a row chosen twice has both weights
        mixed = np.tensordot(share, self.template_set.excitations, axes=1)
        return np.clip(mixed, *self.template_set.limits)

    def __getitem__(self, which: Any) -> Self:
        """Some plans of a batch; ValueError where it would be a part of one plan."""
        parts = {name: getattr(self, name)[which] for name in ("target", "rows", "weights")}
        if not np.ndim(parts["target"]):
            raise ValueError(f"a plan for {self.target} is no batch: plan for targets (B, 2)")
        return replace(self, **parts)

    def with_weights(self, weights: ArrayLike) -> Self:
        """The same templates, weighted otherwise; leading axes may be added, for many trials."""
        weights = as_numbers("weights", weights)
        if weights.shape[-1:] != self.rows.shape[-1:]:
            raise ValueError(
                f"weights {short(weights)}: give one for each of {self.rows.shape[-1]} templates"
            )
        return replace(self, weights=weights, rows=np.broadcast_to(self.rows, weights.shape))


def habitual_weights(target: ArrayLike, points: np.ndarray, power: float = 1) -> np.ndarray:
    """Inverse-distance weights of templates, summing to 1 (Eq. 5).

    A target on a template gives that template all the weight, the limit of the equation.

    Parameters
    ----------
    target : array (…, D)
        Where to reach, m.
    points : array (…, N, D)
        Where the templates reach, m.
    power : float
        Of the inverse distance; 1 in the paper.

    Returns
    -------
    array (…, N)

    References
    ----------
    The paper, Eq. 5 (inverse distance weighting).

    Examples
    --------
    >>> points = np.array([[0.1, -0.3], [0.4, -0.4]])
    >>> habitual_weights(np.array([0.1, -0.4]), points).round(3).tolist()
    [0.75, 0.25]
    """
    distance = _distances(target, points)
    if not is_within(power, -np.inf, np.inf):
        raise ValueError(f"power = {short(power)}: give a number, as 1 or 2")
    on = distance < 1e-9
    nearness = np.where(on, 1, distance) ** -power
    nearness = np.where(on.any(axis=-1, keepdims=True), on, nearness)
    return nearness / nearness.sum(axis=-1, keepdims=True)


def exact_weights(target: ArrayLike, points: np.ndarray, power: float = 1) -> np.ndarray:
    """Weights (…, N) that satisfy Eq. 4, Σ w_i p_i = p_t, and sum to 1: the nearest to Eq. 5's."""
    habit = habitual_weights(target, points, power)
    missing = target - (habit[..., None, :] @ points)[..., 0, :]
    return habit + least_change(np.swapaxes(points, -1, -2), missing)


RULES = {"habitual": habitual_weights, "exact": exact_weights}  # of planning: Eq. 5, Eq. 4
Rule = Literal["habitual", "exact"] | Callable[[np.ndarray, np.ndarray], np.ndarray]


def least_change(jacobian: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """The smallest Δw (…, N) with Σ Δw = 0 that shifts the hand by `shift` (…, D).

    The minimum-norm solution, by the pseudo-inverse. `jacobian` (…, D, N) says where each weight
    takes the hand; for Eq. 4 it is the points p_i, in the arm's plane (D = 2) or in space (3).
    ValueError when the templates lie on one line (in space, in one plane), for then they cannot
    span the shift.
    """
    centred = jacobian - jacobian.mean(axis=-1, keepdims=True)
    strength = np.linalg.svd(centred, compute_uv=False)
    if np.any(strength[..., -1] <= 1e-6 * strength[..., 0]):
        raise ValueError(
            "the templates lie on one line, or in space in one plane; choose templates around "
            "the target"
        )
    return (np.linalg.pinv(centred) @ shift[..., None])[..., 0]


def surrounding(target: ArrayLike, points: np.ndarray) -> np.ndarray:
    """The nearest point (of N, 2) in each of the four quadrants round a target: rows (…, 4).

    In space, (of N, 3) in each of the eight octants: rows (…, 8).
    `NoReach` when one of them is empty: the target is outside what experience covers.
    """
    if not np.all(inside := is_surrounded(target, points)):
        alone = np.atleast_2d(target)[~np.atleast_1d(inside)][0]
        raise NoReach(f"target {alone} m is not surrounded by templates; move it inside them")
    return _by_orthant(target, points).argmin(axis=-1)


def nearest(target: ArrayLike, points: np.ndarray, count: int) -> np.ndarray:
    """The `count` points (of N, D) nearest to a target (…, D): rows (…, count).

    ValueError when there are fewer points, or fewer than one is asked for.
    """
    check_count("count", count, least=1)
    if count > len(points):
        raise ValueError(f"cannot choose {count} of {len(points)} templates")
    return _distances(target, points).argsort(axis=-1, kind="stable")[..., :count]


def _distances(target, points):
    """From targets (…, D) to points (…, N, D), (…, N); ValueError where one is not finite."""
    distances = norm(offsets(points, target))
    if not np.isfinite(distances).all():
        raise ValueError(
            f"target {short(target)}, points {short(points)}: give finite places, in m"
        )
    return distances


def is_surrounded(target: ArrayLike, points: np.ndarray) -> np.ndarray:
    """Whether targets (…, D) have a point (of N, D) in every quadrant or octant round them, (…)."""
    return np.isfinite(_by_orthant(target, points).min(axis=-1, initial=np.inf)).all(axis=-1)


def _by_orthant(target, points):
    """Distances (…, 2^D, N), infinite to points in other quadrants or octants.

    No distance is in the first quadrant, and in the last octant.
    """
    away = offsets(points, target)
    which = _quadrant(away) if away.shape[-1] == 2 else (away >= 0) @ [1, 2, 4]
    here = which[..., None, :] == np.arange(2 ** away.shape[-1])[:, None]
    return np.where(here, norm(away)[..., None, :], np.inf)


def _quadrant(away):
    """Which quadrant offsets (…, 2) lie in, 0 to 3, anticlockwise."""
    return np.floor(np.arctan2(away[..., 1], away[..., 0]) / (np.pi / 2)) % 4


def draw_targets(template_set: TemplateSet, count: int, rng: np.random.Generator) -> np.ndarray:
    """Targets (count, 2), drawn evenly from the plane that the templates surround.

    ValueError where they surround so little of it that the draw does not fill up.
    """
    check_templates(template_set)
    check_count("count", count)
    check_rng(rng)
    low, high = template_set.points.min(axis=0), template_set.points.max(axis=0)
    drawn = rng.uniform(low, high, (4 * count + 20, 2))
    return first_inside(drawn, is_surrounded(drawn, template_set.points), count)


def first_inside(drawn: np.ndarray, inside: np.ndarray, count: int) -> np.ndarray:
    """The first places (count, D) of those drawn (n, D) that lie inside, (n,) true or false.

    ValueError where these are fewer.
    """
    if inside.sum() < count:
        raise ValueError(
            f"the templates surround {inside.sum()} of {len(drawn)} places drawn, too few for "
            f"{count} targets; take templates that cover more of it"
        )
    return drawn[inside][:count]


def plan(
    target: ArrayLike,
    template_set: TemplateSet,
    rule: Rule = "habitual",
    rows: ArrayLike | None = None,
) -> Plan:
    """Plan a reach, or a batch, as a weighted sum of templates (Eq. 3–5).

    Parameters
    ----------
    target : array (…, D)
        Where the hand should end, m.
    template_set : TemplateSet
        The remembered reaches.
    rule : {"habitual", "exact"} or callable
        By Eq. 5, or by Eq. 4 as well; or a function of your own: weights (…, N) from a target and
        the templates' points (…, N, D).
    rows : array (…, N), optional
        Which templates; by default the nearest in each quadrant, or octant.

    Returns
    -------
    Plan

    Raises
    ------
    ValueError
        Where a target is not finite, or of another dimension than the templates' points; where a
        row is none of the template set; where no rule has that name.
    vmc_lib.NoReach
        Where a target is not surrounded by templates.

    Examples
    --------
    >>> from vmc_lib.motor.templates import load
    >>> reach = plan([0.15, -0.4], load())
    >>> reach.weights.shape, reach.excitations.shape
    ((4,), (1000, 6))
    """
    check_templates(template_set)
    weigh = rule_called(rule, RULES)
    target, axes = as_numbers("target", target), template_set.points.shape[-1:]
    if target.shape[-1:] != axes or not np.all(np.isfinite(target)):
        raise ValueError(f"target {target} must be finite positions (…, {axes[0]}) in m")
    if rows is None:
        rows = surrounding(target, template_set.points)
    else:
        given, known = np.atleast_1d(as_numbers("rows", rows)), np.arange(len(template_set.points))
        if not (given.size and np.isin(given, known).all()):
            raise ValueError(f"rows {rows} must be of the {len(known)} templates, 0 to {known[-1]}")
        rows = given.astype(int)
        if rows.ndim > max(target.ndim, 1):
            raise ValueError(f"rows {rows.shape} of a target {target.shape}: give (N,) or (…, N)")
    rows = np.broadcast_to(rows, (*target.shape[:-1], rows.shape[-1]))
    weights = weigh(target, template_set.points[rows])
    if np.shape(weights) != rows.shape:
        raise ValueError(
            f"the rule gave weights {short(weights)}: it must return them as {rows.shape}"
        )
    return Plan(template_set, target, rows, weights)


def rule_called(name: str | Callable, rules: Mapping[str, Callable]) -> Callable:
    """The function of that name in a table of rules; a function itself as it is.

    ValueError for a name that none has.
    """
    if callable(name):
        return name
    if not isinstance(name, str) or name not in rules:
        names = ", ".join(map(repr, rules))
        raise ValueError(
            f"no rule is called {short(name)}: choose from {names}, or give a function"
        )
    return rules[name]


def check_templates(template_set: object) -> None:
    """Raise ValueError where what should be a `TemplateSet` is none."""
    check_kind("template_set", template_set, TemplateSet, "what motor.templates.load() returns")


def check_plan(plan: Any) -> None:
    """Raise ValueError where it is no `Plan`, or not of one weight for each of its rows."""
    check_kind("plan", plan, Plan, "what plan(target, template_set) returns")
    if np.shape(plan.weights) != np.shape(plan.rows):
        raise ValueError(
            f"a plan of weights {np.shape(plan.weights)} and rows {np.shape(plan.rows)}: "
            "give plan.with_weights(one for each row)"
        )


def check_batch(plan: Plan) -> None:
    """Raise ValueError where a plan is none, or of one reach."""
    check_plan(plan)
    if plan.target.ndim != 2:
        raise ValueError(f"a plan for {plan.target} is no batch; plan for targets (B, 2)")


def norm(vectors: np.ndarray) -> np.ndarray:
    """The Euclidean norms (…) of vectors (…, d)."""
    return np.linalg.norm(vectors, axis=-1)
