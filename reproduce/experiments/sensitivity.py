"""How much hangs on choices: the paper's constants and readings, and ours, changed one at a time.

Where a change makes another arm, its templates are found anew on that arm. All reach for the same
targets. Tables IV to VI are measured again on OpenSim's own muscle (Thelen 2003).
"""

from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import cache, partial
from unittest.mock import patch

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments import calibration
from reproduce.experiments.calibration import (
    AS_PRINTED,
    MANY,
    SCENARIOS,
    coarse_algorithm_1,
    error_ratios,
    round_results,
)
from reproduce.one_draw import template_rows
from reproduce.peers.muscle_models import LAWS
from reproduce.training import reach_templates
from vmc_lib import data
from vmc_lib.arm import dynamics, engines, muscle
from vmc_lib.cerebellum.offline import algorithm_1, gauss_newton_calibration
from vmc_lib.cerebellum.online import WeightCorrection
from vmc_lib.motor import inverse_dynamics, templates
from vmc_lib.motor.execution import EYE, execute
from vmc_lib.motor.planning import draw_targets, first_inside, is_surrounded, norm, plan
from vmc_lib.show.markup import minus

ASTRAY = 0.01  # m: a reach that ends so far from its goal is none to remember
MARGIN = 0.008  # m: so far inside of what templates surround; those of another arm end elsewhere
HABIT, ALGORITHM_1 = "habit", "Algorithm 1"
ONLINE, LEAST_SQUARES = "Algorithm 2, new reaches", "least squares"
RULES = HABIT, ALGORITHM_1, ONLINE, LEAST_SQUARES
AS_IT_IS, THELEN = "as it is", "Thelen 2003"
PRINTED_ON_THELEN = f"{SCENARIOS[0]}, {AS_PRINTED}, {THELEN}"
ON_THELEN = "with OpenSim's own muscle (Thelen's)"  # in words


def with_constant(factor, name, *modules):
    """Replacements, (module, name, value), of a constant by so many times its value."""
    return [(module, name, factor * getattr(module, name)) for module in modules]


def from_posture(*degrees):
    """Replacements by which every reach begins in another posture."""
    start = np.radians(degrees)
    return [(module, "START", start) for module in (templates, reach_templates)]


def with_duration(seconds):
    """Replacements by which a movement of the same command lasts as long."""
    slower = partial(inverse_dynamics.minimum_jerk, moving=round(1000 * seconds))
    return [(reach_templates, "minimum_jerk", slower)]


def of_muscle(law):
    """Replacements by which the muscles have another law."""
    return [(muscle, name, getattr(LAWS[law], name)) for name in ("activation_rate", "force")]


def with_lags(factor):
    """Replacements by which activation rises and falls so many times as slowly."""
    constants = "TAU_ACTIVATION", "TAU_DEACTIVATION"
    return [x for name in constants for x in with_constant(factor, name, muscle)]


def with_damping(factor):
    """Replacements by which the joints are damped so many times as much."""
    return [x for name in ("SHOULDER", "ELBOW") for x in with_constant(factor, name, dynamics)]


def with_strength(factor):
    """Replacements by which the muscles are so many times as strong."""
    return with_constant(factor, "F0", engines, inverse_dynamics)


CHOICES = {  # what we chose -> what else might have been: of `misses`, the arguments
    "templates apart, 6 cm": {f"{cm} cm": {"spacing": cm / 100} for cm in (4, 8)},
    "templates mixed, 4": {f"the nearest {n}": {"number": n} for n in (3, 8)},
    "start, −20° and 95°": {
        minus(f"{x}° and {y}°"): {"arm": from_posture(x, y)} for x, y in ((-30, 105), (-10, 85))
    },
    "duration, 0.7 s": {f"{s} s": {"arm": with_duration(s)} for s in (0.5, 0.9)},
    "greatest forces F0": {f"{k:g} ×": {"arm": with_strength(k)} for k in (0.8, 1.25)},
    "optimal length": {f"{k:g} ×": {"arm": with_constant(k, "L0", engines)} for k in (0.95, 1.05)},
    "time constants": {f"{k:g} ×": {"arm": with_lags(k)} for k in (0.5, 2)},
    "damping of joints": {f"{k:g} ×": {"arm": with_damping(k)} for k in (0.5, 2)},
    "Eq. 7, from the shoulder": {
        "from the eye": {"origin": EYE},
        "from the resting hand": {"origin": templates.HOME},
    },
    "error, to the target": {"from the target": {"sign": -1}},
    "Algorithm 2, as printed": {"the other reading": {"hindsight": False}},
}


@contextmanager
def changed_arm(arm=()):
    """The model with such replacements, and with what then holds the arm where it starts."""
    with ExitStack() as replaced:
        for one in arm:
            replaced.enter_context(patch.object(*one))
        rest = {"activation": inverse_dynamics.static_activation(templates.START)}
        read = {"rest": rest, "templates": data.arrays("templates")}.get
        replaced.enter_context(patch.object(templates, "arrays", read))
        yield


def find_templates(spacing=templates.SPACING, hold=templates.HOLD):
    """A `TemplateSet` found anew on the arm as it now is, of reaches that end where they should."""
    goals = reach_templates.reachable_grid(spacing)
    knots = np.array([reach_templates.find_reach(goal) for goal in goals])
    excitations = np.clip(inverse_dynamics.spline() @ knots, 0, 1)
    past = templates.simulate_templates(excitations, hold)
    right = norm(past.points - goals) < ASTRAY
    return replace(past, points=past.points[right], excitations=past.excitations[right])


@cache
def targets(count=20):
    """Targets (count, 2) that the templates of every spacing surround.

    ValueError where the draw holds fewer.
    """
    drawn = draw_targets(templates.load(0.08), 4 * count, np.random.default_rng(7))
    corners = MARGIN * np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])
    sets = [templates.load(apart).points for apart in templates.SPACINGS]
    inside = np.all([is_surrounded(drawn + c, some) for some in sets for c in corners], axis=0)
    return first_inside(drawn, inside, count)


def misses(
    arm=(), spacing=templates.SPACING, number=4, origin=(0.0, 0.0), sign=1, hindsight=True, count=20
):
    """Mean distances over the hold, (count,), mm, by each of `RULES`.

    Algorithm 2 has practised 25 other movements; least squares are our off-line calibration.
    """
    goals = targets(count)
    with changed_arm(arm):
        past = find_templates(spacing) if arm else templates.load(spacing)
        others = draw_targets(past, 25, np.random.default_rng(8))
        habit, practised = (
            plan(some, past, rows=template_rows(some, past.points, number))
            for some in (goals, others)
        )
        rule = partial(coarse_algorithm_1, origin=origin, sign=sign)
        learner = WeightCorrection(hindsight).update(practised, rule=rule)
        found = {
            HABIT: execute(habit).error,
            ALGORITHM_1: algorithm_1(habit, origin=origin, sign=sign).error.min(axis=0),
            ONLINE: execute(learner.correct(habit)).error,
            LEAST_SQUARES: gauss_newton_calibration(habit).error.min(axis=0),
        }
    return {rule: 1000 * error for rule, error in found.items()}


def thelen_templates(spacing):
    """The excitations (N, T, 6) of templates found on Thelen's muscle.

    With our spacing the search settles at 16 of 19 places; targets lie between those.
    """
    with changed_arm(of_muscle(THELEN)):
        return find_templates(spacing).excitations


def thelen_tables(excitations, seed, **size):
    """`calibration.error_ratios` on Thelen's muscle, as printed, for one seed."""
    with changed_arm(of_muscle(THELEN)):
        return error_ratios(
            seed, hold=0.0, past=templates.simulate_templates(excitations, 0.0), **size
        )


def make(choices=CHOICES, spacing=templates.SPACING, seeds=MANY, count=20, **size):
    """What `results/sensitivity.json` holds: `misses` by choice, and Thelen's tables by seed.

    The latter with templates of one `spacing`.
    """
    settings = {AS_IT_IS: {}} | {
        name_of(choice, other): given
        for choice, others in choices.items()
        for other, given in others.items()
    }
    past, size = thelen_templates(spacing), {"experiments": 1, **size}
    draws = [thelen_tables(past, seed, **size) for seed in seeds]
    found = Parallel()(delayed(misses)(**given, count=count) for given in settings.values())
    parts = dict(zip(settings, found, strict=True))
    parts[PRINTED_ON_THELEN] = {k: [draw[k] for draw in draws] for k in draws[0]}
    return round_results(parts)


def name_of(choice, other):
    """Under which name the results of a choice ship."""
    return f"{choice}: {other}"


load_results = partial(calibration.load_results, "sensitivity")


def load_thelen_tables():
    """What Tables IV to VI measure with Thelen's muscle, where the command ends."""
    return load_results()[PRINTED_ON_THELEN]
