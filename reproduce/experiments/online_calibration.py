"""Online calibration as its chapter shows it: where the hand ends, lesson by lesson.

Algorithm 2 and granule cells as they practise, lesions of either calibration, and adaptation to a
changed world; each for one draw, whose movements are kept. `calibration` has the six draws.
"""

from copy import copy
from itertools import product

import numpy as np

from reproduce.experiments.calibration import SCENARIOS, coarse_algorithm_1, nearest_templates
from reproduce.measures.changed_worlds import (
    BLOCKS,
    NOTHING,
    Curve,
    adaptation_curve,
    without_learning,
)
from vmc_lib.cerebellum.adaptation import CORRECTIONS, Adaptation
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.cerebellum.online import AimCorrection, GranuleCells, WeightCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import mean_distance

READINGS = {"right for the place reached (as printed)": True, "right for the target": False}
STEPS = range(0, 151, 25)  # movements practised by granule cells


def draw_plans(template_set, scenario, rng):
    """Habitual plans of a scenario, by name: 25 that will be practised, 100 that never will."""
    if scenario == SCENARIOS[1]:
        template_set = nearest_templates(template_set, draw_targets(template_set, 1, rng)[0])
    others, practised = (plan(draw_targets(template_set, n, rng), template_set) for n in (200, 25))
    return {"practised": practised, "never practised": others[:100]}


def learn(model, plans, lessons, **options):
    """Hands over the hold, name -> (lessons + 1, n, T, 2), before the first lesson and after each.

    `plans` maps names to plans that the model corrects; a lesson is a batch of plans that it
    practises. `options` are passed to its `update`.
    """
    history = {name: [] for name in plans}
    for lesson in (None, *lessons):
        if lesson is not None:
            model.update(lesson, **options)
        for name, some in plans.items():
            history[name].append(execute(model.correct(some)).hold)
    return {name: np.array(holds) for name, holds in history.items()}


def error_shares(history, plans):
    """Share of the planned error that is left after each lesson, name -> (lessons + 1,)."""
    left = {}
    for name, some in plans.items():
        errors = mean_distance(history[name], some.target)
        left[name] = errors.mean(axis=-1) / execute(some).error.mean()
    return left


def algorithm_2_history(plans, hindsight, experiments=5):
    """What `learn` returns for Algorithm 2, by either reading of its step 5."""
    lessons = experiments * [plans["practised"]]
    return learn(WeightCorrection(hindsight), plans, lessons, rule=coarse_algorithm_1)


def granule_cell_history(plans, rng):
    """An `AimCorrection` that has practised, new movements in each lesson; and its history."""
    template_set = plans["practised"].template_set
    new = [plan(draw_targets(template_set, 25, rng), template_set) for _ in STEPS[2:]]
    learner = AimCorrection(template_set)
    return learner, learn(learner, plans, [plans["practised"], *new])


def holds_by_width(widths, plans):
    """Hands over the hold, name -> width -> (n, T, 2), once cells practised plans["practised"]."""
    practised = plans["practised"]
    learners = {
        width: AimCorrection(practised.template_set, GranuleCells(width)).update(practised)
        for width in widths
    }
    return {
        name: {width: execute(one.correct(some)).hold for width, one in learners.items()}
        for name, some in plans.items()
    }


def lesions(habit, trained):
    """Two attempts at plans, `Movement`s, by each lesion: (online, off-line) kept -> attempts.

    Online calibration corrects the first; off-line calibration sees its error and corrects it.
    """
    attempts = {}
    for online, offline in product((True, False), repeat=2):
        first = second = trained.correct(habit) if online else habit
        if offline:
            second = first.with_weights(broyden_calibration(first, 1).best_weights)
        attempts[online, offline] = execute(first), execute(second)
    return attempts


def adapt_to_worlds(trained, template_set, worlds, seeds=(3, 4)):
    """An `Adaptation` at the end of each changed world, and the `Curve` there: two dictionaries.

    Their keys are a world and one of `CURES`; the last has a curve alone.
    """
    learners, curves = {}, {}
    before, during, after = BLOCKS
    for world, change in worlds.items():
        for cure in CORRECTIONS:
            learner = Adaptation(trained, template_set, cure)
            first, second = map(np.random.default_rng, seeds)
            learning = adaptation_curve(learner, template_set, first, change, (before, during, 0))
            learners[world, cure] = copy(learner)  # before it fades
            fading = adaptation_curve(learner, template_set, second, change, (after, 0, 0))
            curves[world, cure] = Curve(*map(np.concatenate, zip(learning, fading, strict=True)))
        target = curves[world, cure].target  # of the same seeds, the same for every correction
        curves[world, NOTHING] = without_learning(trained, template_set, change, target)
    return learners, curves


def after_effects(trained, adapted, plans, change):
    """`Movement`s in a changed world, once it is learned, and once it is taken away again."""
    later = adapted.correct(plans)
    return execute(trained.correct(plans), **change), execute(later, **change), execute(later)
