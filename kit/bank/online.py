"""Online calibration: the paper's linear rule (Eq. 8), granule cells, and a world that changes."""

import numpy as np

from kit.question import between, choice, count, number, pick
from vmc_lib.cerebellum.adaptation import least_lesson
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.motor.planning import EYE, turned


def _cells(width, centres):
    """Granule cells at these places (n, 1)."""
    cells = GranuleCells(width, len(centres))
    cells.centres_ = np.asarray(centres, float)[:, None]
    return cells


def numbers_that_g_is_told(rng):
    n, space = between(rng, 2, 12, 1), pick(rng, 2, 3)
    return count(
        f"A plan mixes {n} templates in {('a plane', 'space')[space - 2]}. How many numbers is the "
        "paper's g told (Eq. 8: the target, every weight, every template's position)?",
        space + n + space * n,
        "numbers",
        "D + N + D N, with D coordinates a position.",
    )


def numbers_that_g_learns(rng):
    n = between(rng, 2, 12, 1)
    return count(
        f"A plan mixes {n} templates in a plane. How many numbers does a linear g learn (Eq. 8, a "
        "bias for each of its outputs included)?",
        n * (2 + 3 * n + 1),
        "numbers",
        "N outputs, each with 2 + 3 N slopes and a bias.",
    )


def corrected_weight(rng):
    weight, offline = between(rng, 0.1, 0.5, 0.05), between(rng, -0.1, 0.1, 0.01)
    learned = between(rng, -0.15, 0.15, 0.01)
    what, answer = pick(
        rng,
        ("is planned with before the movement (w_on)", weight + learned),
        ("enters the lesson afterwards (w')", weight + learned + offline),
    )
    return number(
        f"A template has the weight {weight}; g says Δw_on = {learned}, and off-line calibration "
        f"then adds Δw_off = {offline}. Which weight {what} in Algorithm 2?",
        answer,
        hint="w_on = w + Δw_on, then w' = w_on + Δw_off",
        tolerance=0.001,
    )


def lesson_of_a_miss(rng):
    x, miss = between(rng, 10, 24, 1), between(rng, 2, 9, 1)
    reading = pick(rng, "as printed", "in the other reading")
    return number(
        f"The target is at x = {x} cm. With the modified weights w' the hand ended {miss} mm "
        f"beyond it. For which x, {reading} of Algorithm 2, is w' learnt as right?",
        x + (miss / 10 if reading == "as printed" else 0),
        "cm",
        "As printed, by hindsight: for where w' took the hand. Otherwise: for the target.",
        tolerance=0.01,
    )


def granule_cell(rng):
    width, away = pick(rng, 2, 4, 5, 8, 10), between(rng, 1, 12, 1)
    return number(
        f"A granule cell's field is {width} cm wide (a Gaussian's standard deviation). How active "
        f"is it for a target {away} cm from its centre, 1 being the most?",
        _cells(width, [0.0]).excite(np.array([[float(away)]]))[0, 0],
        hint="exp(-d² / (2 width²))",
        tolerance=0.003,
    )


def purkinje_sum(rng):
    width, places = pick(rng, 2.0, 4.0, 5.0), np.sort(rng.permutation(np.arange(1, 12))[:2])
    weights = np.round(rng.uniform(-3, 3, 2), 1)
    active = _cells(width, places).excite(np.array([[6.0]]))[0]
    return number(
        f"Two granule cells have fields {width} cm wide, centred at {places.tolist()} cm; their "
        f"Purkinje weights are {weights.tolist()} mm. What correction do they make together for a "
        "target at 6 cm?",
        active @ weights,
        "mm",
        "Each cell's activity times its weight, added.",
        tolerance=0.03,
    )


def ridge_of_one_cell(rng):
    wanted, active = between(rng, -8, 8, 1) or 5, between(rng, 0.2, 1, 0.1)
    ridge, lessons = pick(rng, 0.01, 0.1, 0.5, 1), between(rng, 1, 8, 1)
    return number(
        f"One granule cell is {active} active in each of {lessons} lesson(s), and each wants "
        f"{wanted} mm. With the ridge {ridge}, what does its Purkinje weight become?",
        lessons * active * wanted / (lessons * active**2 + ridge),
        "mm",
        "Σ a y / (Σ a² + ridge)",
    )


def lesson_with_caution(rng):
    caution, miss = pick(rng, 0.1, 0.25, 0.3, 0.5, 1.0), between(rng, 5, 40, 1)
    taken = least_lesson(np.ones((1, 1)), np.array([[float(miss)]]), caution)[0, 0]
    return number(
        f"A reach misses by {miss} mm. A lone lesson with a caution of {caution} takes a share of "
        "the error away. How large is the next miss at the same target?",
        miss - taken,
        "mm",
        "The lesson takes 1 / (1 + caution).",
        tolerance=0.05,
    )


def behind_a_prism(rng):
    degrees, away = between(rng, -15, 15, 1) or 8, between(rng, 40, 70, 5)
    point = EYE + np.array([away / 100, 0])
    return number(
        f"A prism turns all that the eye sees by {degrees} degrees about the eye. How far from its "
        f"true place is a thing seen that is {away} cm away?",
        100 * np.linalg.norm(turned(point, np.radians(degrees)) - point),
        "cm",
        "2 × distance × sin(angle / 2)",
    )


def after_effect(rng):
    shift, learned = between(rng, 20, 80, 5), between(rng, 0.5, 1, 0.05)
    side = pick(rng, "left", "right")
    other = {"left": "right", "right": "left"}[side]
    sizes = [f"{shift * learned:g} mm to the {way}" for way in (side, other)]
    return choice(
        f"Through a prism the world looks shifted by {shift} mm to the {side}. The arm has learnt "
        f"to take {learned:.0%} of that away. Then the prism is taken off. Where does the next "
        "reach end?",
        (*sizes, "on the target"),
        sizes[1],
        "The correction stays when its cause is gone: as large as was learnt, the other way.",
    )
