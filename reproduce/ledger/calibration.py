"""The ledger's rows on off-line calibration: Table V, Figs. 4 and 10, claims of the text.

Where a movement ends is read as we read the paper, when its command ends: that decides. What is
measured over the hold stands beside it.
"""

from functools import cache

import numpy as np

from reproduce import paper
from reproduce.experiments.calibration import AS_PRINTED, SCENARIOS, load_results, repeat_over_seeds
from reproduce.ledger.entry import (
    BELOW,
    HELD,
    Quantity,
    Row,
    mean,
    mean_of_draws,
    share,
    trivial_quantity,
)
from reproduce.measures import second_plant
from vmc_lib.arm.dynamics import hand
from vmc_lib.cerebellum.offline import algorithm_1
from vmc_lib.cerebellum.online import WeightCorrection
from vmc_lib.motor import templates
from vmc_lib.motor.execution import EYE, execute
from vmc_lib.motor.planning import draw_targets, plan

OFFLINE = {"better": -1, "rounding": paper.ratio_rounding("off-line", "planned")}
IN_SAMPLE, HELD_OUT = "in-sample", "held-out"
FIT_NOTE = "The reading is fitted: which way the error points was chosen by the published ratio. "


def printed_results(scenario=SCENARIOS[0]):
    """What `load_results` holds of a scenario, read where the command ends."""
    return load_results()[f"{scenario}, {AS_PRINTED}"]


@cache
def nearer():
    """Which movements calibration brings nearer, for each of SEEDS: name -> (seeds, movements).

    And what Algorithm 1 leaves of the planned error, by origin: name -> (seeds,).
    """
    return repeat_over_seeds(_nearer)


def _nearer(seed):
    rng, past = np.random.default_rng(seed), templates.load(hold=0.0)
    habit, others = (plan(draw_targets(past, n, rng), past) for n in (25, 100))
    planned, *tried = algorithm_1(habit).error
    learner = WeightCorrection().update(habit)
    left = {
        name: algorithm_1(habit, origin=origin).error.min(axis=0).mean() / planned.mean()
        for name, origin in (("the eye", EYE), ("the resting hand", resting_hand()))
    }
    return left | {
        "off-line": np.min(tried, axis=0) < planned,
        "searched n, error": np.min(tried, axis=0).mean() / planned.mean(),
        IN_SAMPLE: execute(learner.correct(habit)).error < planned,
        HELD_OUT: execute(learner.correct(others)).error < execute(others).error,
    }


def resting_hand():
    """Where the hand is before every movement, (2,), m."""
    return hand(templates.START)[:2]


def _table_5():
    claimed, entry, left = paper.calibrated_error_ratio("off-line"), "off-line, published", nearer()
    name = "error after over planned, {}"
    return [
        *(
            mean_of_draws(name.format(s), number, printed_results(s)[entry], fitted=True, **OFFLINE)
            for s, number in zip(SCENARIOS, (claimed, None), strict=True)
        ),
        *(
            mean_of_draws(name.format(f"from {origin}"), None, left[origin])
            for origin in ("the eye", "the resting hand")
        ),
        *(
            mean_of_draws(name.format(f"{s}, {HELD}"), None, load_results()[s][entry])
            for s in SCENARIOS
        ),
    ]


def _figure_4():
    name = "error after Eq. 6 with the searched n of Eq. 7, over planned"
    return [mean(name, 1, nearer()["searched n, error"], fitted=True, **BELOW)]


def _figure_10():
    came = nearer()["off-line"]
    name = "examples that off-line calibration brings nearer"
    return [share(name, 1, came.sum(), came.size, better=1)]


def _robots():
    limits = {"planned / reach": (None, {})}  # the paper claims no number for another robot
    return [
        mean(f"two links, torques: {name}", claimed, values, **rest)
        for name, values in repeat_over_seeds(second_plant.experiment).items()
        for claimed, rest in [limits.get(name, (1, BELOW))]
    ]


def _population_vector():
    """How far the sum of cosine-tuned votes points from the movement, °, over all directions."""
    around = np.radians(np.arange(360))
    movements = np.stack([np.cos(around), np.sin(around)], axis=-1)
    preferred = movements[::30]
    return [
        trivial_quantity("twelve directions, evenly spread", 0, leaning(movements, preferred)),
        Quantity("seven in half of them (°)", None, leaning(movements, preferred[:7])),
    ]


def leaning(movements, preferred):
    """How far the votes of neurons (n, 2) lean from movements (m, 2) at most, °."""
    votes = movements @ preferred.T @ preferred
    cosine = (votes * movements).sum(axis=-1) / np.linalg.norm(votes, axis=-1)
    return np.degrees(np.arccos(cosine.clip(max=1))).max().round(3)


def own_rules(kind, entries, rules):
    """What our own rules leave, beside what the paper's did."""
    claimed, found = paper.calibrated_error_ratio(kind), load_results()[SCENARIOS[0]]
    return [
        mean_of_draws(f"error over planned, {entry}", claimed, found[entry], **rules)
        for entry in entries
    ]


FIXED = (
    "With four fixed templates nothing is compared: the weights that Table IV prints speak "
    "against them, if Eq. 5 is meant exactly (chapter 10). "
)
OVER_THE_HOLD = (
    "Over the hold, where ours are meant to be; the paper's number is read where the command ends."
)
ROWS = (
    Row(
        "Table V",
        "Off-line calibration shrinks the error.",
        "10_offline",
        _table_5,
        note=FIT_NOTE + "So that we come near it is no proof. Over several draws the eye "
        "({q[error after over planned, from the eye].obtained:.2f}) and the resting hand "
        "({q[error after over planned, from the resting hand].obtained:.2f}) come nearer to the "
        "paper's ratio than the shoulder. We keep the shoulder, from which all our places are "
        "measured: the ratio does not choose the origin. " + FIXED,
    ),
    Row(
        "Fig. 4",
        "The error is decomposed onto the templates.",
        "10_offline",
        _figure_4,
        note=FIT_NOTE,
    ),
    Row(
        "III, population",
        "The sum of neurons' vectors predicts the movement's direction.",
        "10_offline",
        _population_vector,
        note="With cosine tuning it does so exactly where preferred directions are spread evenly; "
        "where they fill one half of the circle it is off by up to "
        "{q[seven in half of them (°)].obtained:.0f}°.",
    ),
    Row(
        "Fig. 10",
        "Off-line calibration brings each example nearer.",
        "10_offline",
        _figure_10,
        differs="Most, not each: the share of "
        "{q[examples that off-line calibration brings nearer].obtained:.3f}.",
    ),
    Row(
        "V, robots",
        "The method applies to other robots.",
        "10_offline",
        _robots,
        note="Two links that torques drive, in simulation, planned and calibrated by the same "
        "functions. The paper shows a robot of its own, in Fig. 13, and no number of it.",
    ),
    Row(
        "Fig. 13",
        "A neuro-robot with muscles and tendons is being built.",
        "10_offline",
        list,
        note="It cannot be remade: it is a photo of a prototype. See *V, robots*.",
    ),
    Row(
        "Ours, Table V",
        "Eq. 4 solved for the error, by the pseudo-inverse.",
        "10_offline",
        lambda: own_rules("off-line", [f"own off-line, {k} trials" for k in (1, 2, 4)], OFFLINE),
        note=OVER_THE_HOLD,
    ),
)
