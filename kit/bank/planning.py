"""Questions on habitual planning: nearness, and how far a mixture misses (Eq. 3–5)."""

from types import SimpleNamespace

import numpy as np

from kit.bank.drawing import curves, points
from kit.question import choice, numeric, picture, steps
from vmc_lib.motor.inverse_dynamics import minimum_jerk_profile
from vmc_lib.motor.planning import habitual_weights, least_change, surrounding


def four_templates(rng):
    """Four templates round a target, in whole centimetres: target (2,), points (4, 2)."""
    away = rng.integers(1, 6, (4, 2)) * [[1, 1], [-1, 1], [-1, -1], [1, -1]]
    target = rng.integers([10, -45], [20, -35])
    at, *names = (f"({x:g}, {y:g})" for x, y in [target, *target + away])
    target = target.astype(float)
    return SimpleNamespace(target=target, points=target + away, at=at, names=", ".join(names))


def distances(count):
    """A function of an rng: so many distances (count,) from 1 to 9 cm."""
    return lambda rng: rng.integers(1, 10, count).astype(float)


@numeric(hint="1/d1 over the sum of 1/d1 and 1/d2: linear interpolation.")
def two_templates(share=steps(0.05, 0.95, 0.05)):
    """There are two templates, and a target on the line between them, {share:.0%} of the way to the
    second. What is the weight of the first (Eq. 5)?"""
    return habitual_weights(np.array([share]), np.array([[0.0], [1.0]]))[0]


@numeric(hint="One over its distance, over the sum of all four.")
def weight_by_nearness(cm=distances(4), place=(1, 2, 3, 4)):
    """Four templates lie {cm} cm from the target. What is the weight of the one in place {place} of
    this list (Eq. 5)?"""
    return habitual_weights(np.zeros(1), cm[:, None])[place - 1]


@numeric(hint="As Eq. 5, with d to that power in place of d.")
def weight_with_a_power(cm=distances(3), power=(0.5, 2, 3)):
    """Three templates lie {cm} cm from the target. Nearness is one over the distance to the power
    {power}. What is the weight of the first?"""
    return habitual_weights(np.zeros(1), cm[:, None], power)[0]


@numeric("mm", "The length of Σ w_i p_i - p_t; mind the millimetres.", tolerance=0.1)
def miss_of_equation_four(four=four_templates):
    """The target is {four.at} cm, the templates' points are {four.names} cm. With the weights of
    Eq. 5, how far from the target is Σ w_i p_i, which Eq. 4 wants there?"""
    weights = habitual_weights(four.target, four.points)
    return 10 * np.linalg.norm(weights @ four.points - four.target)


@numeric(hint="By symmetry +x, +x, -x, -x; then side · 2x = shift.")
def least_change_of_four(side=steps(4, 10, 1), shift=steps(2, 20, 1)):
    """Four templates lie at the corners of a square of {side} cm. The mixture should move by
    {shift} mm along one side. By how much must the weight of a corner on that side change, if the
    change is to be the smallest that sums to zero?"""
    corners = side / 2 * np.array([[1.0, -1, -1, 1], [1, 1, -1, -1]])
    return least_change(corners, np.array([shift / 10, 0]))[0]


def four_weights(rng):
    """Four weights with two decimals whose sum is not 1."""
    weights = np.round(rng.dirichlet(np.ones(4)), 2)
    weights[0] = round(float(weights[0] + (-0.1, 0.1, 0.2, 0.3)[rng.integers(4)]), 2)
    return weights


@numeric(
    "cm",
    "|Σ w_i - 1| × distance: only weights that sum to one do not mind the origin.",
    tolerance=0.05,
)
def origin_of_the_plane(weights=four_weights, apart=steps(10, 40, 5)):
    """The weights of four templates are {weights}. All positions are now measured from an origin
    {apart} cm away. How far is the place that Σ w_i p_i describes from the place it described
    before?"""
    return abs(weights.sum() - 1) * apart


@numeric(
    hint="No nerve can tell less than 0 or more than 1: the sum is held to these limits.",
    tolerance=0.005,
    zero=True,
)
def mixture_beyond_the_limits(
    extra=(0.3, 0.4, 0.6, 0.8),
    high=steps(0.6, 1, 0.1),
    low=steps(0, 0.4, 0.1),
    order=(1, -1),
):
    """Two templates excite a muscle by [{high}, {low}]; their weights are {weights}. What does the
    book's plan tell the muscle (Eq. 3)?"""
    weights = np.array([1 + extra, -extra])[::order]
    return np.clip(weights @ [high, low], 0, 1), {"weights": weights}


QUADRANTS = (
    "above and in front of it",
    "above and behind it",
    "below and behind it",
    "below and in front of it",
)


@choice(*(f"{{names[{k}]}}" for k in range(8)), hint="Only two lie there; the nearer one is taken.")
def nearest_in_its_quadrant(
    four=four_templates, order=lambda rng: rng.permutation(8), quadrant=range(4)
):
    """The target is {four.at} cm (x forward, y up). Which of these templates does the plan take
    from the quadrant {where}?"""
    farther = four.points + 2 * np.sign(four.points - four.target)
    points = np.vstack([four.points, farther])[order]
    names = [f"({x:g}, {y:g})" for x, y in points]
    right = surrounding(four.target, points)[quadrant]
    return right, {"names": names, "where": QUADRANTS[quadrant]}


@numeric(hint="10 s³ - 15 s⁴ + 6 s⁵", tolerance=0.002)
def share_of_the_way(share=steps(0.05, 0.95, 0.05)):
    """A minimum-jerk movement has used {share:.0%} of its time. What share of the way is done?"""
    return minimum_jerk_profile(share)


def three_mixtures(four, weights):
    """Where a mixture of four templates ends by these weights, evenly, and with the weights the
    other way round: (3, 2), cm."""
    return np.array([weights @ four.points, four.points.mean(axis=0), weights[::-1] @ four.points])


def draw_uneven_mixture(rng):
    """Four templates, and weights that mix them elsewhere than their middle."""
    four, weights = four_templates(rng), rng.permutation([0.6, 0.2, 0.1, 0.1])
    away = np.diff(three_mixtures(four, weights)[[0, 1, 2, 0]], axis=0)
    return (four, weights) if np.linalg.norm(away, axis=1).min() > 0.8 else draw_uneven_mixture(rng)


def plane(axes, mix, order):
    """Four templates in the plane, each with its weight: {said}. Three crosses: {crosses}."""
    four, weights = mix
    templates = {
        f"{w:g}{' ' * k}": p for k, (w, p) in enumerate(zip(weights, four.points, strict=True))
    }
    points(axes, templates, "forward (cm)", "up (cm)")
    crosses = dict(zip("ABC", three_mixtures(*mix)[order], strict=True))
    points(axes, crosses, "forward (cm)", "up (cm)", "x")


@picture(plane)
@choice("A", "B", "C", hint="Each point times its weight, added: near those that weigh most.")
def where_it_is_mixed_to(mix=draw_uneven_mixture, order=lambda rng: rng.permutation(3)):
    """Four templates (dots) have the weights beside them. At which cross is Σ w p?"""
    four, weights = mix
    said = zip(weights, four.points, strict=True)
    crosses = zip("ABC", three_mixtures(*mix)[order], strict=True)
    return int(np.flatnonzero(order == 0)[0]), {
        "said": "; ".join(f"{w:g} at ({x:g}, {y:g})" for w, (x, y) in said),
        "crosses": "; ".join(f"{name} at ({x:.1f}, {y:.1f})" for name, (x, y) in crosses),
    }


POWERS = np.arange(1, 7)


def two_valleys(rng):
    """Mean misses (mm) by six powers, on the data to choose by and on the test data, (2, 6)."""
    chosen, other = rng.permutation(POWERS)[:2]
    return np.array([6 + abs(POWERS - chosen), 7 + abs(POWERS - other)]) + 0.5 * rng.integers(3)


def validation_and_test(axes, misses):
    """Mean misses in mm for the powers 1 to 6. Validation: {misses[0]}. Test: {misses[1]}."""
    named = dict(zip(("validation", "test"), misses, strict=True))
    curves(axes, POWERS, named, "power of the distance", "mean miss (mm)")
    axes.set_yticks(np.arange(5, 15))


@picture(validation_and_test)
@numeric("mm", "Choose where validation is lowest; report the test there, once.", tolerance=0.2)
def miss_to_report(misses=two_valleys):
    """A power of the distance is to be chosen (Eq. 5 has 1). Which mean miss does one report?"""
    return misses[1, misses[0].argmin()]
