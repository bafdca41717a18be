"""Learning curves at a person's noise (`motor_noise`): how many more tries does it then take?

What a rule keeps after a noisy try was partly luck, so it is given once more, and judged by that.
Without noise the same targets are those of `nulls.tries`, or practised here as well.
"""

from functools import partial

import numpy as np

from reproduce.experiments import calibration, nulls, online_calibration
from reproduce.experiments.calibration import MANY, SCENARIOS
from reproduce.experiments.controller_comparison import templates_with_noise
from reproduce.peers.motor_noise import PERSON, endpoint_deviation, with_noise
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, norm, plan

OFF_LINE, WHOLE_ARM = "off-line", "whole arm"
CALM, NOISY = "calm", "a person's noise"
WHOLE_ARM_SHARE = 0.0077  # of each command: so the finger scatters by `PERSON` mm, about


def person_share():
    """The share of each command by which it wavers where the hand scatters by `PERSON` mm."""
    return calibration.load_results("unsteady")[f"{PERSON} mm"]["noise"][0]


def templates_of_person(stream, noise=NOISY):
    """The templates, on an arm with a person's noise, which `stream` seeds; or on a `CALM` one."""
    wavers = None if noise == CALM else partial(with_noise, share=person_share())
    return templates_with_noise(wavers, stream)


def kept_again(habit, trials):
    """The `Movement`s (trials, n) of what is kept after each trial, given once more: no luck."""
    best = [trials.error[: k + 1].argmin(axis=0) for k in range(len(trials.error))]
    kept = np.take_along_axis(trials.weights, np.array(best)[..., None], axis=0)
    return execute(habit.with_weights(kept))


def curves_by_tries(habit, rules, repeats=20):
    """What each rule leaves of habit's miss after 0, 1, … tries, by name, (trials,).

    Also habit's miss and how far its repeated reaches end from their mean, both in mm; and what
    "noise alone" leaves: how far the hand is from the mean of its own ways over the hold.
    """
    many = execute(habit.with_weights(np.tile(habit.weights, (repeats, 1, 1))))
    miss, unbiased = many.error.mean(), np.sqrt(repeats / (repeats - 1))
    return {
        "habit": 1000 * miss,
        "scatter": 1000 * endpoint_deviation(many.endpoint),
        "noise alone": unbiased * norm(many.hold - many.hold.mean(axis=0)).mean() / miss,
        **{
            k: kept_again(habit, rule(habit)).error.mean(axis=1) / miss for k, rule in rules.items()
        },
    }


def off_line(seed, count=25):
    """`curves_by_tries` of the rules of `nulls`, for the same targets, with one seed.

    But Broyden's makes four tries: after many, noise can leave it a belief that moves no hand.
    """
    rng, past = np.random.default_rng(seed), templates_of_person((seed, 5))
    _, targets = (draw_targets(past, n, rng) for n in (200, count))
    rules = nulls.offline_rules(rng) | {nulls.OURS: partial(broyden_calibration, n_trials=4)}
    return curves_by_tries(plan(targets, past), rules)


def online(seed, scenario, noise=NOISY):
    """What Algorithm 2 and granule cells leave of habit's miss after 0, 25, … movements, by name.

    Of the 25 movements practised first, and of 100 never practised, as in chapter 11; one seed.
    """
    rng = np.random.default_rng(seed)
    plans = online_calibration.draw_plans(templates_of_person((seed, 6), noise), scenario, rng)
    histories = {
        "Algorithm 2": online_calibration.algorithm_2_history(plans, hindsight=True),
        "granule cells": online_calibration.granule_cell_history(plans, rng)[1],
    }
    return {
        f"{learner}, {movements}": left
        for learner, history in histories.items()
        for movements, left in online_calibration.remaining(history, plans).items()
    }


def whole_arm(seed, share=WHOLE_ARM_SHARE, count=2, trials=4):
    """`curves_by_tries` of Broyden calibration on the arm of 63 muscles, with one seed."""
    from reproduce.whole_arm import experiment, habits  # MuJoCo comes with them

    past, rng = habits.load_templates(), np.random.default_rng((seed, 7))
    targets = experiment.draw_targets_3d(past, count=count, rng=np.random.default_rng(seed))
    habit = experiment.plan_reaches(targets, experiment.with_noise(past, share, rng))
    rules = {"Broyden": partial(broyden_calibration, n_trials=trials)}
    return curves_by_tries(habit, rules, repeats=5)


def online_name(scenario, noise):
    """Under which name the curves of a scenario ship, `CALM` or `NOISY`."""
    return f"online, {scenario}, {noise}"


def arm_name(noise):
    """Under which name the curves of the whole arm ship, `CALM` or `NOISY`."""
    return f"{WHOLE_ARM}, {noise}"


def make(scenarios=SCENARIOS, seeds=MANY, movements=25, **size):
    """What `results/learning_curves.json` holds: every curve with every seed.

    Off-line for so many `movements`; `size` is that of `whole_arm`.
    """
    experiments = {OFF_LINE: partial(off_line, count=movements)}
    for noise, share in {CALM: 0, NOISY: WHOLE_ARM_SHARE}.items():
        for scenario in scenarios:
            experiments[online_name(scenario, noise)] = partial(
                online, scenario=scenario, noise=noise
            )
        experiments[arm_name(noise)] = partial(whole_arm, share=share, **size)
    return calibration.make(experiments, seeds)


load_results = partial(calibration.load_results, "learning_curves")


def first_below(level, curves):
    """Tries until the mean of `curves` (draws, 1 + tries) is at most `level`; infinite if never."""
    return min(np.flatnonzero(curves.mean(axis=0) <= level), default=np.inf)
