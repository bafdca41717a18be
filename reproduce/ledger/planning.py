"""The ledger's rows on planning: Table IV, Figs. 3 and 9, claims of the text."""

from functools import cache

import numpy as np

from reproduce import paper, results
from reproduce.experiments import planning_3d
from reproduce.experiments.calibration import SCENARIOS, SEEDS, load_results, repeat_over_seeds
from reproduce.ledger.entry import Quantity, Row, mean, trivial_quantity
from reproduce.peers import optimal_control
from vmc_lib import photos
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, exact_weights, habitual_weights, plan
from vmc_lib.where.localiser import Localiser

PLANNED = {"better": -1, "rounding": paper.planned_rounding()}


@cache
def planned_error_ratios(spacing=templates.SPACING, rule=habitual_weights, count=200):
    """The mean miss over the mean reach, for each of SEEDS draws of targets: (seeds,)."""
    return np.array(
        [_planned_error_ratio(seed, templates.load(spacing), rule, count) for seed in SEEDS]
    )


def _planned_error_ratio(seed, template_set, rule, count):
    targets = draw_targets(template_set, count, np.random.default_rng(seed))
    plans = plan(targets, template_set, rule)
    return execute(plans).error.mean() / np.linalg.norm(targets, axis=-1).mean()


def _table_4():
    claimed, name = paper.planned_error_ratio(), "planned error over reach"
    others = {"8 cm": planned_error_ratios(0.08), "4 cm": planned_error_ratios(0.04)}
    rounding = PLANNED["rounding"]
    return [
        mean(name, claimed, load_results()[SCENARIOS[0]]["planned / reach"], rounding=rounding),
        *(
            mean(f"{name}, templates {apart} apart", claimed, values, rounding=rounding)
            for apart, values in others.items()
        ),
    ]


def _figure_3():
    """From the eye to the shoulder, with the trained localiser: as good as the arm is to be?"""
    limit = paper.MEAN_ERROR["off-line"] / np.linalg.norm(paper.TARGETS, axis=1).mean()
    quantities = []
    for level in photos.LEVELS:
        localiser, shots = Localiser.load(level), photos.load(level, "test")
        places = [localiser.locate(s.image, s.boxes["shuttlecock"], s.camera) for s in shots]
        true = np.array([shot.target for shot in shots])
        gaps = np.linalg.norm(places - true, axis=1) / np.linalg.norm(true, axis=1)
        name = f"place seen, off the true one, over its distance ({level})"
        quantities.append(mean(name, limit, gaps, better=-1, bound=True))
    return quantities


def _figure_9():
    template_set = templates.load()
    habit = plan(draw_targets(template_set, 20, np.random.default_rng(2)), template_set)
    summed = np.einsum("bi,bitm->btm", habit.weights, template_set.excitations[habit.rows])
    worst = (paper.TABLE_4_ERRORS / np.linalg.norm(paper.TARGETS, axis=-1)).max()
    digits = paper.planned_rounding()
    return [
        mean(
            "near: miss over reach, below the worst example",
            worst,
            planned_error_ratios(),
            better=-1,
            bound=True,
        ),
        mean(
            "not on it: the same, above the last digit",
            digits,
            planned_error_ratios(),
            better=1,
            bound=True,
        ),
        trivial_quantity("templates N", paper.TEMPLATES, habit.weights.shape[-1]),
        trivial_quantity(
            "plan beside weighted sum, largest gap",
            0,
            np.abs(habit.excitations - summed).max().round(9),
        ),
    ]


def _nearby():
    """Half of one reach and half of its neighbour's: how far from half-way does it end?"""
    template_set = templates.load()
    gaps = np.linalg.norm(template_set.points[:, None] - template_set.points, axis=-1)
    pairs = np.argwhere(np.triu((gaps > 0) & (gaps < 1.1 * templates.SPACING)))
    habit = plan(template_set.points[pairs].mean(axis=1), template_set, rows=pairs)
    astray = execute(habit).error / gaps[*pairs.T]
    return [
        mean("half-way mixtures end astray, over the gap", 0.5, astray, better=-1, bound=True),
        mean("mixtures that end between the two", 1, (astray < 0.5).astype(float)),
    ]


def _few_templates():
    few, some, many = (
        planned_error_ratios(spacing) for spacing in sorted(templates.SPACINGS, reverse=True)
    )
    return [
        mean("planned error, templates 6 cm apart over 8", 1, some / few, better=-1, bound=True),
        mean("planned error, templates 4 cm apart over 6", 1, many / some, better=-1, bound=True),
    ]


def _computation():
    """How much quicker a plan is than the exact optimum, and how often that tries the arm."""
    timed = {row["task"]: row for row in results.records("bench/planning")["rows"]}
    quicker = timed["habitual plan"]["× faster than optimal control"]
    found = optimal_control.search(optimal_control.TARGETS[12])
    tried = found.nfev + found.njev * (1 + found.x.size)
    return [
        Quantity("times quicker than optimal control", 1, quicker, better=1, bound=True),
        trivial_quantity(
            "movements tried for an optimum (habit: 0)", 0, tried, better=1, bound=True
        ),
    ]


def _effort():
    """What habit spends over the optimum, with our templates and with optima for templates."""
    habit, best = (
        plan(optimal_control.TARGETS, templates.load()),
        optimal_control.optimal_excitations(),
    )
    mixed = optimal_control.effort(
        optimal_control.mix_optima().excitations
    ) / optimal_control.effort(best[optimal_control.INNER])
    spent = optimal_control.effort(habit.excitations) / optimal_control.effort(best)
    return [
        mean("effort of habit over the optimum", 1, spent, better=1, bound=True),
        mean("the same where habit mixes optima", 1, mixed, better=1, bound=True),
    ]


@cache
def errors_3d():
    """Draws in space: name -> (seeds,)."""
    return repeat_over_seeds(planning_3d.experiment)


def _figure_3d():
    found, claimed = errors_3d(), paper.planned_error_ratio()
    left = "error after {} over planned"
    return [
        mean("planned error over reach, in space", claimed, found["planned / reach"], **PLANNED),
        mean(left.format("one correction"), 1, found["corrected 1 ×"], better=-1, bound=True),
        mean(left.format("three corrections"), 1, found["corrected 3 ×"], better=-1, bound=True),
    ]


def _exact():
    claimed, name = paper.planned_error_ratio(), "planned error over reach, {}, exact weights"
    return [
        mean(
            name.format("in the plane"),
            claimed,
            planned_error_ratios(rule=exact_weights),
            **PLANNED,
        ),
        mean(name.format("in space"), claimed, errors_3d()["exact / reach"], **PLANNED),
    ]


ROWS = (
    Row(
        "Table IV",
        "A habitual plan misses by a few per cent of the reach.",
        "09_planning",
        _table_4,
        differs="It depends on how densely templates lie, which the paper does not print: "
        "somewhere between 8 cm and our 6 cm the numbers would agree. It is another arm, too, and "
        "our reaches are measured from the shoulder; the paper does not say from where.",
    ),
    Row(
        "Fig. 3",
        "What the eye sees is expressed from the shoulder.",
        "09_planning",
        _figure_3,
        note="The paper gives no number. A place should be no farther off than the hand that is to "
        "reach it: the limit is the paper's error after calibration.",
    ),
    Row(
        "Fig. 9",
        "A plan is the weighted sum of excitations, and ends near the target, not on it.",
        "09_planning",
        _figure_9,
    ),
    Row(
        "III, Block 2",
        "Similar excitations lead to nearby positions, so mixtures end in between.",
        "09_planning",
        _nearby,
    ),
    Row(
        "IV C, templates",
        "The error is larger when templates are few.",
        "09_planning",
        _few_templates,
    ),
    Row(
        "IV C, computation",
        "Habit spares the computation of an optimal movement.",
        "09_planning",
        _computation,
    ),
    Row(
        "III, Block 2, effort",
        "An optimal movement spends less effort than a habitual one.",
        "09_planning",
        _effort,
        differs="With our templates it does. But they were made to move smoothly; where habit "
        "mixes optima instead, it spends {q[the same where habit mixes optima].obtained:.2f} times "
        "the least effort, which these few targets do not tell from 1. Nor does the optimum know "
        "of the table: it may pass through it.",
    ),
    Row(
        "IV C, space",
        "The method is proposed for three dimensions.",
        "14_beyond",
        _figure_3d,
        differs="It works there, and corrections mend it. But Eq. 5 now spreads the weight over "
        "eight memories, some of them far from the target. See *Ours, Eq. 5*.",
    ),
    Row(
        "Ours, Eq. 5",
        "Weights that satisfy Eq. 4 exactly miss by less.",
        "14_beyond",
        _exact,
    ),
)
