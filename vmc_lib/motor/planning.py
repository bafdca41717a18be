"""Habitual planning (Eq. 3–5): a new reach as a weighted sum of templates.

Every function takes one target (2,) or a batch (B, 2). Positions are in the arm's plane, in m.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from vmc_lib import NoReach
from vmc_lib.arm.simulate import UNPERTURBED, Perturbation
from vmc_lib.motor.templates import TemplateSet

PART = 512  # movements simulated at once
EYE = np.array([0.10, 0.25])  # above and a little in front of the shoulder


@dataclass(frozen=True, eq=False)
class Plan:
    """Which templates a reach uses, and how much of each."""

    template_set: TemplateSet
    target: np.ndarray  # (…, 2): where it is seen
    chosen: np.ndarray  # (…, N): rows of the template set
    weights: np.ndarray  # (…, N)
    perturbation: Perturbation = UNPERTURBED  # what the arm will meet; the plan does not know it …
    prism: float = 0.0  # … nor, in rad, how far glass before the eyes turns what they see

    @property
    def points(self):
        """Where the chosen templates reach: p_i, (…, N, 2)."""
        return self.template_set.points[self.chosen]

    @property
    def excitations(self):
        """Eq. 3: u_t(t) = Σ w_i u_i(t), (…, T, 6), held to the limits of a command, [0, 1]."""
        share = np.zeros((*self.weights.shape[:-1], len(self.template_set.points)))
        np.put_along_axis(share, self.chosen, self.weights, axis=-1)
        mixed = np.tensordot(share, self.template_set.excitations, axes=1)
        return np.clip(mixed, *self.template_set.limits)

    def move(self):
        """The `Motion` that the plan gives the arm. A plan is moved once, and remembers it."""
        return self._motion

    @cached_property
    def _motion(self):
        return self.template_set.reach(self.excitations, self.perturbation)

    def reached(self):
        """Where the hand is seen to end, (…, 2); in space (…, 3), where there is no prism."""
        return turned(self._ends, self.prism) if self.prism else self._ends

    def missed(self):
        """How far from the target the hand is seen to end, (…), m."""
        return np.linalg.norm(self.reached() - self.target, axis=-1)

    @cached_property
    def _ends(self):
        count = self.weights.shape[-1]
        weights, chosen = self.weights.reshape(-1, count), self.chosen.reshape(-1, count)
        if len(weights) <= PART:
            return self.move().reached
        parts = [  # a larger batch is moved in parts, and its motions forgotten, to spare memory
            replace(self, chosen=chosen[i : i + PART], weights=weights[i : i + PART]).move().reached
            for i in range(0, len(weights), PART)
        ]
        return np.concatenate(parts).reshape(*self.weights.shape[:-1], -1)

    def __getitem__(self, rows):
        """Some plans of a batch."""
        parts = {name: getattr(self, name)[rows] for name in ("target", "chosen", "weights")}
        return replace(self, **parts)

    def with_weights(self, weights):
        """The same templates, weighted otherwise; leading axes may be added, for many trials."""
        return replace(self, weights=weights, chosen=np.broadcast_to(self.chosen, weights.shape))

    def perturbed(self, perturbation=UNPERTURBED, prism=0.0):
        """The same plan under a `Perturbation`, a load or a force field, or behind a prism."""
        return replace(self, perturbation=perturbation, prism=prism)


def turned(points, angle):
    """Plane positions (…, 2) turned about the eye by `angle`, upwards where it is positive."""
    c, s = np.cos(angle), np.sin(angle)
    return (points - EYE) @ np.array([[c, s], [-s, c]]) + EYE


def habitual_weights(target, points, power=1):
    """Eq. 5: weights (…, N) by nearness of the templates' points (…, N, 2), summing to 1.

    Nearness is one over the distance; the paper has its first `power`. A target on a template
    gives that template all the weight, the limit of the equation.
    """
    distance = np.linalg.norm(points - target[..., None, :], axis=-1)
    on = distance < 1e-9
    nearness = np.where(on, 1, distance) ** -power
    nearness = np.where(on.any(axis=-1, keepdims=True), on, nearness)
    return nearness / nearness.sum(axis=-1, keepdims=True)


def exact_weights(target, points, power=1):
    """Weights (…, N) that satisfy Eq. 4, Σ w_i p_i = p_t, and sum to 1: the nearest to Eq. 5's."""
    habit = habitual_weights(target, points, power)
    missing = target - (habit[..., None, :] @ points)[..., 0, :]
    return habit + least_change(np.swapaxes(points, -1, -2), missing)


def least_change(jacobian, shift):
    """The smallest Δw (…, N) with Σ Δw = 0 that shifts the hand by `shift` (…, D).

    `jacobian` (…, D, N) says where each weight takes the hand; for Eq. 4 it is the points p_i, in
    the arm's plane (D = 2) or in space (3). ValueError when the templates lie on one line (in
    space, in one plane), for then they cannot span the shift.
    """
    centred = jacobian - jacobian.mean(axis=-1, keepdims=True)
    strength = np.linalg.svd(centred, compute_uv=False)
    if np.any(strength[..., -1] <= 1e-6 * strength[..., 0]):
        raise ValueError(
            "the templates lie on one line, or in space in one plane; choose templates around "
            "the target"
        )
    return (np.linalg.pinv(centred) @ shift[..., None])[..., 0]


def surrounding(target, points):
    """The nearest point (of N, 2) in each of the four quadrants round a target: rows (…, 4).

    `NoReach` when a quadrant is empty: the target is outside the plane that experience covers.
    """
    if not np.all(inside := surrounded(target, points)):
        alone = np.atleast_2d(target)[~np.atleast_1d(inside)][0]
        raise NoReach(f"target {alone} m is not surrounded by templates; move it inside them")
    return _by_quadrant(target, points).argmin(axis=-1)


def nearest(target, points, count):
    """The `count` points (of N, 2) nearest to a target (…, 2): rows (…, count).

    ValueError when there are fewer points, or fewer than one is asked for.
    """
    if not 1 <= count <= len(points):
        raise ValueError(f"cannot choose {count} of {len(points)} templates")
    distance = np.linalg.norm(points - np.asarray(target)[..., None, :], axis=-1)
    return distance.argsort(axis=-1, kind="stable")[..., :count]


def surrounded(target, points):
    """Whether targets (…, 2) have a point (of N, 2) in every quadrant round them, (…)."""
    return np.isfinite(_by_quadrant(target, points).min(axis=-1)).all(axis=-1)


def _by_quadrant(target, points):
    """Distances (…, 4, N), infinite to points in other quadrants; no distance is in the first."""
    away = points - target[..., None, :]
    quadrant = np.floor(np.arctan2(away[..., 1], away[..., 0]) / (np.pi / 2)) % 4
    here = quadrant[..., None, :] == np.arange(4)[:, None]
    return np.where(here, np.linalg.norm(away, axis=-1)[..., None, :], np.inf)


def draw_targets(template_set, count, rng):
    """Targets (count, 2), drawn evenly from the plane that the templates surround.

    ValueError where they surround so little of it that the draw does not fill up.
    """
    low, high = template_set.points.min(axis=0), template_set.points.max(axis=0)
    drawn = rng.uniform(low, high, (4 * count + 20, 2))
    inside = drawn[surrounded(drawn, template_set.points)]
    if len(inside) < count:
        raise ValueError(
            f"the templates surround {len(inside)} of {len(drawn)} places drawn, too few for "
            f"{count} targets; take templates that cover the plane"
        )
    return inside[:count]


def plan(target, template_set, rule=habitual_weights, chosen=None):
    """Plan a reach to `target` (…, 2) with the four surrounding templates (or those `chosen`).

    In space targets are (…, 3), as the templates' points are, and `chosen` must be given.
    """
    target, axes = np.asarray(target, dtype=float), template_set.points.shape[-1:]
    if target.shape[-1:] != axes or not np.all(np.isfinite(target)):
        raise ValueError(f"target {target} must be finite plane positions (…, {axes[0]}) in m")
    if chosen is None:
        chosen = surrounding(target, template_set.points)
    chosen = np.broadcast_to(chosen, (*target.shape[:-1], np.shape(chosen)[-1]))
    return Plan(template_set, target, chosen, rule(target, template_set.points[chosen]))
