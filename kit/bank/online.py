"""Questions on online calibration: Eq. 8, granule cells, and a world that changes."""

import numpy as np

from kit.question import choice, count, numeric, steps, tenths
from vmc_lib.cerebellum.adaptation import minimum_norm_update
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.motor.execution import EYE, rotate_about_eye


def activity(width, centres, target):
    """The activities (n,) of granule cells with these centres (n,) for a target; all in cm."""
    cells = GranuleCells(width, len(centres))
    cells.centres_ = np.asarray(centres, float)[:, None]  # by hand what `fit` would place
    return cells.excite(np.array([[float(target)]]))[0]


@count("numbers", "D + N + D N, with D coordinates a position.")
def numbers_that_g_is_told(n=steps(2, 12, 1), space=(("a plane", 2), ("space", 3))):
    """A plan mixes {n} templates in {space[0]}. How many numbers is the paper's g told (Eq. 8: the
    target, every weight, every template's position)?"""
    return space[1] + n + space[1] * n


@count("numbers", "N outputs, each with 2 + 3 N slopes and a bias.")
def numbers_that_g_learns(n=steps(2, 12, 1)):
    """A plan mixes {n} templates in a plane. How many numbers does a linear g learn (Eq. 8, a bias
    for each of its outputs included)?"""
    return n * (2 + 3 * n + 1)


@numeric(hint="w_on = w + Δw_on, then w' = w_on + Δw_off", tolerance=0.001)
def corrected_weight(
    weight=steps(0.1, 0.5, 0.05),
    offline=steps(-0.1, 0.1, 0.01),
    learned=steps(-0.15, 0.15, 0.01),
):
    """A template has the weight {weight}; g says Δw_on = {learned}, and off-line calibration then
    adds Δw_off = {offline}. Which weight enters the lesson afterwards
    (w' of Algorithm 2)?"""
    return weight + learned + offline


@numeric(
    "cm",
    "They are right for the place to which they took the hand.",
    tolerance=0.01,
)
def lesson_of_a_miss(x=steps(10, 24, 1), miss=steps(2, 9, 1)):
    """The target is at x = {x} cm. With corrected weights the hand ended {miss} mm beyond it. One
    learns by hindsight: for which x are these weights a perfect example?"""
    return x + miss / 10


@numeric(hint="exp(-d² / (2 width²))", tolerance=0.003)
def granule_cell(width=(2, 4, 5, 8, 10), away=steps(1, 12, 1)):
    """A granule cell's field is {width} cm wide (a Gaussian's standard deviation). How active is it
    for a target {away} cm from its centre, 1 being the most?"""
    return activity(width, [0], away)[0]


@numeric("mm", "Each cell's activity times its weight, added.", tolerance=0.03)
def purkinje_sum(
    width=(2.0, 4.0, 5.0),
    places=lambda rng: np.sort(rng.permutation(np.arange(1, 12))[:2]),
    weights=tenths(-3, 3, 2),
):
    """Two granule cells have fields {width} cm wide, centred at {places} cm; their Purkinje weights
    are {weights} mm. What correction do they make together for a target at 6 cm?"""
    return activity(width, places, 6) @ weights


@numeric("mm", "Σ a y / (Σ a² + ridge)")
def ridge_of_one_cell(
    wanted=steps(-8, 8, 1, zero=5),
    active=steps(0.2, 1, 0.1),
    ridge=(0.01, 0.1, 0.5, 1),
    lessons=steps(2, 8, 1),
):
    """One granule cell is {active} active in each of {lessons} lessons, and each wants {wanted}
    mm. With the ridge {ridge}, what does its Purkinje weight become?"""
    return lessons * active * wanted / (lessons * active**2 + ridge)


@numeric("mm", "The lesson takes 1 / (1 + caution).", tolerance=0.05)
def lesson_with_caution(caution=(0.1, 0.25, 0.3, 0.5, 1.0), miss=steps(5, 40, 1)):
    """A reach misses by {miss} mm. A lone lesson with a caution of {caution} takes a share of the
    error away. How large is the next miss at the same target?"""
    return miss - minimum_norm_update(np.ones((1, 1)), np.array([[float(miss)]]), caution)[0, 0]


@numeric("cm", "2 × distance × sin(angle / 2)")
def behind_a_prism(degrees=steps(-15, 15, 1, zero=8), away=steps(40, 70, 5)):
    """A prism turns all that the eye sees by {degrees} degrees about the eye. How far from its true
    place is a thing seen that is {away} cm away?"""
    point = EYE + np.array([away / 100, 0])
    return 100 * np.linalg.norm(rotate_about_eye(point, np.radians(degrees)) - point)


@choice(
    "{size:g} mm to the {side}",
    "{size:g} mm to the {other}",
    "on the target",
    hint="The correction stays when its cause is gone: as large as was learnt, the other way.",
)
def after_effect(shift=steps(20, 80, 5), learned=steps(0.5, 1, 0.05), side=("left", "right")):
    """Through a prism the world looks shifted by {shift} mm to the {side}. The arm has learnt to
    take {learned:.0%} of that away. Then the prism is taken off. Where does the next reach end?"""
    return 1, {"size": shift * learned, "other": {"left": "right", "right": "left"}[side]}
