"""Learning curves with 2 mm of scatter (`motor_noise`): how many more tries does it then take?

What a rule keeps after a noisy try was partly luck, so it is given once more, and judged by that.
Without noise the same targets are those of `nulls.errors_by_tries` and of `block_errors`, or
practised here as well. In a changed world nothing is kept: every movement is to a new target.
"""

from functools import partial

import numpy as np

from reproduce.experiments import calibration, nulls, online_calibration
from reproduce.experiments.calibration import (
    MANY,
    SCENARIOS,
    SEEDS,
    repeat_over_seeds,
    round_results,
)
from reproduce.experiments.controller_comparison import templates_with_noise
from reproduce.experiments.offline_calibration import (
    LOADS,
    move_with_load,
    repeat_algorithm_1,
    trials_with_load,
)
from reproduce.experiments.planning_ablation import repeat
from reproduce.measures.changed_worlds import block_errors
from reproduce.peers.motor_noise import SCATTER_MM, endpoint_deviation, noise_floor, with_noise
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import mean_distance

OFF_LINE, WHOLE_ARM, MEMORIES = "off-line", "whole arm", "memories of the whole arm"
ROUNDS, WITH_LOAD, WORLDS = "rounds", "with a load", "changed worlds"
CALM, NOISY = "calm", f"{SCATTER_MM} mm of scatter"
KEPT = {True: "only if it is better", False: "always"}  # what a round of Algorithm 1 finds
GUARDED = {True: "guards", False: "no guards"}
WHOLE_ARM_SHARE = 0.0077  # of each command: so the finger scatters by `SCATTER_MM` mm, about
WHOLE_ARM_SHARES = {CALM: 0, NOISY: WHOLE_ARM_SHARE}


def scatter_share():
    """The share of each command by which it wavers where the hand scatters by `SCATTER_MM` mm."""
    return calibration.load_results("unsteady")[f"{SCATTER_MM} mm"]["noise"][0]


def noisy_templates(stream, noise=NOISY):
    """The templates, on an arm whose hand scatters, which `stream` seeds; or on a `CALM` one."""
    wavers = None if noise == CALM else partial(with_noise, share=scatter_share())
    return templates_with_noise(wavers, stream)


def repeat_best(habit, trials, execute=execute):
    """The `Movement`s (trials, n) of what is kept after each trial, given once more: no luck."""
    best = [trials.error[: k + 1].argmin(axis=0) for k in range(len(trials.error))]
    kept = np.take_along_axis(trials.weights, np.array(best)[..., None], axis=0)
    return execute(habit.with_weights(kept))


def curves_by_tries(habit, rules, repeats=20):
    """What each rule leaves of habit's miss after 0, 1, … tries, by name, (trials,).

    Also habit's miss and how far its repeated reaches end from their mean, both in mm; and what
    "noise alone" leaves (`noise_floor`).
    """
    many = execute(repeat(habit, repeats))
    miss = many.error.mean()
    return {
        "habit": 1000 * miss,
        "scatter": 1000 * endpoint_deviation(many.endpoint),
        "noise alone": noise_floor(many.hold) / miss,
        **{
            k: repeat_best(habit, rule(habit)).error.mean(axis=1) / miss
            for k, rule in rules.items()
        },
    }


def offline_curves(seed, count=25):
    """`curves_by_tries` of the rules of `nulls`, for the same targets, with one seed.

    But Broyden's makes four tries: after many, noise can leave it a belief that moves no hand.
    """
    rng = np.random.default_rng(seed)
    habit = nulls.draw_habit(noisy_templates((seed, 5)), rng, count)
    rules = nulls.offline_rules(rng) | {nulls.BROYDEN: partial(broyden_calibration, n_trials=4)}
    return curves_by_tries(habit, rules)


def round_misses(seed, noise=NOISY, count=25):
    """The mean miss in mm after 0, 1, … rounds of Algorithm 1, by `rounds_name`; one seed."""
    past, rng = noisy_templates((seed, 8), noise), np.random.default_rng(seed)
    habit = nulls.draw_habit(past, rng, count)
    return {
        rounds_name(n, keep): 1000 * mean_distance(holds, habit.target).mean(axis=1)
        for keep in KEPT
        for n, holds in repeat_algorithm_1(habit, keep).items()
    }


def rounds_name(n, keep):
    """Under which name the rounds of one of `GRIDS` ship."""
    return f"{n}, kept {KEPT[keep]}"


def with_load(seed, noise=NOISY, count=25):
    """The mean miss in mm of what is kept after 0, 1, … tries with each load, by `load_name`."""
    past, rng = noisy_templates((seed, 9), noise), np.random.default_rng(seed)
    habit = nulls.draw_habit(past, rng, count)
    return {
        load_name(name, guarded): 1000
        * repeat_best(habit, trials, move_with_load(kg)).error.mean(1)
        for name, kg in LOADS.items()
        for guarded, trials in trials_with_load(habit, kg).items()
    }


def load_name(load, guarded):
    """Under which name the tries with one of `LOADS` ship."""
    return f"{load}, {GUARDED[guarded]}"


def changed_worlds(seed, **size):
    """What `block_errors` finds where the hand scatters by `SCATTER_MM`; one seed."""
    return block_errors(seed, past=noisy_templates((seed, 10)), **size)


def online_curves(seed, scenario, noise=NOISY):
    """What Algorithm 2 and granule cells leave of habit's miss after 0, 25, … movements, by name.

    Of the 25 movements practised first, and of 100 never practised, as in chapter 11; one seed.
    """
    rng = np.random.default_rng(seed)
    plans = online_calibration.draw_plans(noisy_templates((seed, 6), noise), scenario, rng)
    histories = {
        "Algorithm 2": online_calibration.algorithm_2_history(plans, hindsight=True),
        "granule cells": online_calibration.granule_cell_history(plans, rng)[1],
    }
    return {
        f"{learner}, {movements}": left
        for learner, history in histories.items()
        for movements, left in online_calibration.error_shares(history, plans).items()
    }


def whole_arm(seed, noise=NOISY, count=2, trials=4):
    """`corrections` on the arm of 63 muscles by the memories that ship, with one seed."""
    from reproduce.whole_arm import experiment, habits  # MuJoCo comes with them

    past, rng = habits.load_templates(), np.random.default_rng((seed, 7))
    targets = experiment.draw_targets_3d(past, count=count, rng=np.random.default_rng(seed))
    return corrections(targets, past, noise, rng, trials)


def memory_curves(seed, noise=NOISY, count=3, trials=4, sides=(3, 4), shared=(14, 34)):
    """What corrections leave by other memories, all asked for the same targets; one seed.

    By name, (1 + trials,); and "…, scatter": how far repeated reaches end from their mean, in mm.
    """
    from reproduce.whole_arm import experiment

    sets = dict(experiment.memory_sets(sides, shared))
    sets[experiment.ANY_POSTURE] = experiment.memories_of_any_posture(seed, sides[0])
    rng = np.random.default_rng(seed)
    targets, found = experiment.draw_targets_3d(*sets.values(), count=count, rng=rng), {}
    for name, past in sets.items():
        curves = corrections(targets, past, noise, np.random.default_rng((seed, 11)), trials)
        found |= {name: curves["Broyden"], f"{name}, scatter": curves["scatter"]}
    return found


def corrections(targets, past, noise, rng, trials):
    """`curves_by_tries` of Broyden calibration by memories `past`, `CALM` or `NOISY`."""
    from reproduce.whole_arm import experiment

    habit = plan(targets, experiment.with_noise(past, WHOLE_ARM_SHARES[noise], rng))
    rules = {"Broyden": partial(broyden_calibration, n_trials=trials)}
    return curves_by_tries(habit, rules, repeats=5)


def at_noise(part, noise):
    """Under which name curves ship, `CALM` or `NOISY`."""
    return f"{part}, {noise}"


def online_name(scenario, noise):
    """Under which name those of `online_curves` ship."""
    return at_noise(f"online, {scenario}", noise)


def in_both(experiments):
    """Experiments that take a `noise`, `CALM` and `NOISY`, by `at_noise`."""
    return {
        at_noise(part, noise): partial(experiment, noise=noise)
        for noise in (CALM, NOISY)
        for part, experiment in experiments.items()
    }


ON_LINE = {f"online, {each}": partial(online_curves, scenario=each) for each in SCENARIOS}
MANY_DRAWS = {OFF_LINE: offline_curves} | in_both(ON_LINE | {WHOLE_ARM: whole_arm})
SIX_DRAWS = in_both({ROUNDS: round_misses, WITH_LOAD: with_load, MEMORIES: memory_curves})
SIX_DRAWS |= {WORLDS: changed_worlds}


def make(experiments=MANY_DRAWS | SIX_DRAWS, seeds=None):
    """What `results/learning_curves.json` holds: every curve with every seed."""
    return round_results(
        {
            name: repeat_over_seeds(experiment, seeds or (SEEDS if name in SIX_DRAWS else MANY))
            for name, experiment in experiments.items()
        }
    )


load_results = partial(calibration.load_results, "learning_curves")


def load_pair(part):
    """What ships of a part, `CALM` and `NOISY`."""
    shipped = load_results()
    return [shipped[at_noise(part, noise)] for noise in (CALM, NOISY)]


def first_below(level, curves):
    """Tries until the mean of `curves` (draws, 1 + tries) is at most `level`; infinite if never."""
    return min(np.flatnonzero(curves.mean(axis=0) <= level), default=np.inf)
