"""Muscle weakness: which controllers compensate for it?

Each muscle in turn gets only `LEFT` of its commands, as if the nerve carried no more. Habit learns
from its errors, in the aim or in the pull (`Adaptation`); it never learns which muscle is weak. The
rivals know it. Least effort searches again. The steadiest commands need no search: noise is a share
of the command, so that the weak muscle, told twice as much, pulls and scatters as before. People
whose wrist lost a muscle, in a simulation, drove all their muscles more (de Rugy et al. 2012).
"""

from dataclasses import replace
from functools import cache, partial
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.calibration import SEEDS, repeat_over_seeds
from reproduce.measures.changed_worlds import train_aim_correction
from reproduce.peers import minimum_variance, optimal_control
from reproduce.results import arrays
from vmc_lib.arm.model import MUSCLES
from vmc_lib.cerebellum.adaptation import CORRECTIONS, Adaptation
from vmc_lib.cerebellum.online import TOGETHER
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load, mean_distance, reach

LEFT = 0.5
WHEN = "before", "after"  # it is corrected
TARGETS = optimal_control.TARGETS[optimal_control.INNER]  # nobody practises these
RIVALS = "least effort", "steadiest"


def muscle_strength(muscle):
    """What is left of each muscle's command, (6,), where the one of this name is weak."""
    if muscle not in MUSCLES:
        raise ValueError(f"the arm has no muscle {muscle!r}; choose one of {MUSCLES}")
    return np.where(np.array(MUSCLES) == muscle, LEFT, 1.0)


def weak_arm(muscle):
    """The templates of the healthy arm, as they are remembered, on one whose `muscle` is weak."""
    return replace(load(), reach=partial(_weak_reach, muscle_strength(muscle)))


def learn_weak_arm(seed, count=100, before=150, muscles=MUSCLES):
    """What habit makes of each muscle's weakness, in one draw: numbers by name.

    It has practised `before` movements with the healthy arm, and then `count` with the weak one: of
    these, and of as many others, the mean miss in mm, and `command_measures`, before and after.
    """
    rng = np.random.default_rng(seed)
    skill = train_aim_correction(load(), rng, before)
    practised, others = (draw_targets(load(), count, rng) for _ in range(2))
    found = {}
    for muscle, corrects in product(muscles, CORRECTIONS):
        lessons, unseen, test = (plan(x, weak_arm(muscle)) for x in (practised, others, TARGETS))
        learner = Adaptation(skill, load(), corrects)
        for when, more in zip(WHEN, (0, count), strict=True):
            for first in range(0, more, TOGETHER):
                learner.update(lessons[first : first + TOGETHER])
            rows = {
                "in-sample": _mean_miss(learner, lessons),
                "held-out": _mean_miss(learner, unseen),
            }
            rows |= command_measures(learner.correct(test).excitations, muscle)
            found |= {f"{muscle}, {corrects}, {when}, {name}": x for name, x in rows.items()}
    return found


def command_measures(excitations, muscle):
    """Numbers by name of commands (6, T, 6) to `TARGETS`, where this `muscle` is weak.

    The mean miss in mm, the mean effort, and how hard each muscle is driven, (6,): the root of its
    command's mean square.
    """
    hold = reach(excitations * muscle_strength(muscle)).hold
    return {
        "miss": 1000 * mean_distance(hold, TARGETS).mean(),
        "effort": optimal_control.effort(excitations).mean(),
        "drive": np.sqrt(np.square(excitations).mean(axis=(0, 1))),
    }


def search_optima(targets=TARGETS, muscles=MUSCLES):
    """What muscles get by least effort, where one is known to be weak: knots (muscles, n, 72)."""
    each = product(muscles, targets)
    found = Parallel()(
        delayed(optimal_control.search)(goal, muscle_strength(muscle)) for muscle, goal in each
    )
    knots = np.array([optimum.x for optimum in found], np.float32)
    return knots.reshape(len(muscles), len(targets), -1)


def make(seeds=SEEDS, targets=TARGETS, muscles=MUSCLES, **size):
    """What `results/weakened.npz` holds: the cheapest knots, and `learn_weak_arm` by seed."""
    habit = repeat_over_seeds(partial(learn_weak_arm, muscles=muscles, **size), seeds)
    return {"least effort": search_optima(targets, muscles)} | habit


load_results = partial(arrays, "weakened")


@cache
def compare_rules(muscle):
    """By rule and by `WHEN`, `command_measures` where this muscle is weak.

    Of habit, which corrects its aim or its pull, there are six draws, (6, …); of a rival, (1, …).
    """
    commands_by_rule, found = minimum_variance.excitations_by_rule(), {}
    for corrects in CORRECTIONS:
        keys = {when: f"{muscle}, {corrects}, {when}" for when in WHEN}
        found[f"habit, {corrects}"] = {
            when: {name: load_results()[f"{key}, {name}"] for name in ("miss", "effort", "drive")}
            for when, key in keys.items()
        }
    cheapest = optimal_control.excitations_from_knots(
        load_results()["least effort"][MUSCLES.index(muscle)].astype(float)
    )
    again = cheapest, np.minimum(commands_by_rule["steadiest"], muscle_strength(muscle))
    for rival, got in zip(RIVALS, again, strict=True):
        both = zip(WHEN, (commands_by_rule[rival], got / muscle_strength(muscle)), strict=True)
        found[rival] = {
            when: {name: np.array([x]) for name, x in command_measures(commands, muscle).items()}
            for when, commands in both
        }
    return found


def habit_misses():
    """Habit's mean misses in mm, draws (6,): by weak muscle and what it corrects.

    Held-out before; in-sample and held-out after.
    """
    columns = "before, held-out", "after, in-sample", "after, held-out"
    return {
        key: [load_results()[f"{', '.join(key)}, {name}"] for name in columns]
        for key in product(MUSCLES, CORRECTIONS)
    }


def corrected_miss(rule):
    """The mean miss in mm over all weak muscles, each known, or habit's aim corrected for it."""
    name = "habit, aim" if "habit" in rule else rule
    return np.mean([compare_rules(muscle)[name]["after"]["miss"].mean() for muscle in MUSCLES])


def _weak_reach(share, excitations, perturbation):
    return reach(excitations * share, perturbation)


def _mean_miss(learner, test):
    """The mean miss in mm of plans that a learner corrects."""
    return 1000 * execute(learner.correct(test)).error.mean()
