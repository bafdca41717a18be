"""Questions on online calibration: Eq. 8, granule cells, and a world that changes."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, count, numeric, picture, steps, tenths
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


CENTRES = np.arange(0, 41, 2)  # cm, of the granule cells along a line
HERE = 20  # cm, the place that is practised


def lessons(width, places, caution, n):
    """The share of a constant error that is left at places (k,) before each of n lessons, (n, k).

    All lessons are at `HERE`.
    """
    taught, *asked = (activity(width, CENTRES, place) for place in (HERE, *places))
    weights, left = np.zeros((len(CENTRES), 1)), []
    for _ in range(n):
        left.append(1 - np.array(asked) @ weights[:, 0])
        weights += minimum_norm_update(taught[None], 1 - taught[None] @ weights, caution)
    return np.array(left)


def two_places(width, away, caution):
    return lessons(width, (HERE, HERE + away), caution, 9).T


def practice_curves(axes, width, away, caution, swap):
    """What is left of the error at two places, in nine reaches that are each followed by a lesson.
    A ends at {ends[0]:.2f}, B at {ends[1]:.2f}."""
    a, b = two_places(width, away, caution)[[swap, 1 - swap]]
    curves(axes, range(1, 10), {"A": a, "B": b}, "reach", "error left")
    axes.set_ylim(0, 1.05)


@picture(practice_curves)
@choice("A", "B", hint="What is learnt at one place reaches its neighbours only in part.")
def which_was_practised(
    width=(3, 4, 5, 6), away=(4, 5, 6, 8), caution=(0.3, 0.5, 1, 2), swap=(0, 1)
):
    """All lessons are given at one place. The curves are that place and another, {away} cm away.
    Which one was never practised?"""
    return 1 - swap, {"ends": two_places(width, away, caution)[[swap, 1 - swap], -1]}


ALONG = np.arange(-16, 17.0)  # cm from the practised place


def spread(width):
    """The share of an error that practice at `HERE` takes away, along a line, (33,)."""
    return 1 - lessons(width, HERE + ALONG, 0.01, 4)[-1]


def two_spreads(axes, pair):
    """How much of the error is taken away, against the distance from the practised place, for two
    networks: two bells with their tops there. 8 cm away A has {at[0]:.2f}, B {at[1]:.2f}."""
    named = dict(zip("AB", map(spread, pair), strict=True))
    curves(axes, ALONG, named, "cm from the practised place", "taken away (share)")


@picture(two_spreads)
@choice(
    "A",
    "B",
    "neither: a lesson changes its own place alone",
    hint="Wide fields carry a lesson far, also to places where it is wrong.",
)
def which_teaches_too_far(
    pair=lambda rng: rng.permutation([2, 3, 4, 5, 6])[:2], there=(6, 8, 10, 12)
):
    """Practice at 0 cm, with two kinds of granule cells. {there} cm away the world errs the other
    way. Which network does more harm there?"""
    return np.argmax(pair), {"at": [spread(width)[24] for width in pair]}


def three_transfers(width, order):
    """Transfers of what was learnt against distance, of which only one is not local, (3, 17)."""
    distance = ALONG[16:]
    local = spread(width)[16:]
    return np.array([0.8 + 0 * distance, local, 0.6 * local])[order]


def transfers(axes, width, order):
    """Three experiments: after-effects, as a share of what was learnt, against the distance from
    the trained place, 0 to 16 cm: {said}."""
    named = dict(zip("ABC", three_transfers(width, order), strict=True))
    curves(axes, ALONG[16:], named, "cm from the trained place", "after-effect (share)")
    axes.set_ylim(0, 1.05)


@picture(transfers)
@choice("A", "B", "C", hint="Cells with local fields cannot know of a place where none was active.")
def against_local_fields(width=steps(2.5, 5, 0.25), order=lambda rng: rng.permutation(3)):
    """After practice at one place, three laboratories look for the after-effect elsewhere. Whose
    result would speak against granule cells with fields of a few centimetres?"""
    ends = three_transfers(width, order)[:, [0, -1]]
    said = (f"{name} from {a:.2f} to {b:.2f}" for name, (a, b) in zip("ABC", ends, strict=True))
    return int(np.flatnonzero(order == 0)[0]), {"said": "; ".join(said)}


def through_a_prism(shift, learned):
    """Sideways misses in mm: 5 reaches as usual, 20 with a prism, 10 without, (35,)."""
    kept = learned * (1 - np.exp(-np.arange(20) / 4)) / (1 - np.exp(-5))
    after = learned * np.exp(-np.arange(10) / 3)
    return shift * np.concatenate([np.zeros(5), 1 - kept, -after])


def prism_curve(axes, shift, learned):
    """Sideways misses in mm against the reach: none in the first 5, then up to {shift} and falling
    in the next 20, with a prism; in the first without it {first:.0f}, and then back to 0."""
    curves(axes, range(1, 36), {"": through_a_prism(shift, learned)}, "reach", "miss (mm)")
    axes.plot(range(1, 36), through_a_prism(shift, learned), "C0.")
    axes.set_yticks(np.arange(-80, 90, 10))


@picture(prism_curve)
@numeric(hint="The first miss without the prism, over the first with it.", tolerance=0.05)
def learnt_behind_a_prism(shift=(40, 50, 60, 70, 80), learned=steps(0.4, 0.9, 0.05)):
    """A prism was worn from reach 6 to reach 25. Which share of its shift had the arm learnt to
    take away, by the after-effect?"""
    return learned, {"first": -shift * learned}
