"""LQR tracking tested on noise and on weak muscles, beside the same commands alone.

The commands are those of `minimum_variance.excitations_by_rule`; the corrections on the way are
those of `lqr_tracking`.
"""

from functools import cache

import numpy as np

from reproduce.experiments.muscle_weakness import TARGETS, muscle_strength
from reproduce.peers import lqr_tracking, minimum_variance, motor_noise
from vmc_lib.arm.model import MUSCLES
from vmc_lib.motor.feedback import TICK
from vmc_lib.motor.inverse_dynamics import SAMPLES
from vmc_lib.motor.templates import keep_last, mean_distance, reach

HOLD_TICKS = slice(SAMPLES // TICK, None)  # ticks


def disturbances(rng):
    """Factors of the commands: noise (repeats, 6, T, 6), and each muscle weak (6, 6, T, 6)."""
    shape = keep_last(minimum_variance.least_variance_excitations()).shape
    repeated = minimum_variance.REPEATS, *shape
    noise = motor_noise.noise_factor(repeated, minimum_variance.noise_share(), rng)
    weak = np.array([muscle_strength(name) for name in MUSCLES])
    return noise, np.broadcast_to(weak[:, None, None], (len(MUSCLES), *shape))


def scatter_and_miss(noise, weak, rule, late=None):
    """How far the hand scatters on its way, (151,), and misses with each muscle weak, (6,), in mm.

    Means over the targets; noise and weakness are `disturbances`. Of a rule's commands alone,
    or with the best corrections, where deviations are known `late`, in ms.
    """
    scatter = lqr_tracking.scatter(hand_paths(noise, rule, late))
    miss = mean_distance(hand_paths(weak, rule, late)[..., HOLD_TICKS, :], TARGETS)
    return 1000 * scatter.mean(axis=0), 1000 * miss.mean(axis=-1)


def means_by_rule(measures, rules, runs, known):
    """Means of all measures: {a measure in words: its mean by rule (rules,)}.

    `measures` are those without disturbances, `runs` each rule's (scatter, misses with one muscle
    weak) by how it is corrected, and `known` its miss where it knows which muscle is weak.
    """
    calm = {
        words: [measures[r][k].mean() for r in rules]
        for k, words in minimum_variance.MEASURE_NAMES.items()
        if k != "scatter"
    }
    held = {how: [scatter[HOLD_TICKS].mean() for scatter, _ in run] for how, run in runs.items()}
    weak = {how: [miss.mean() for _, miss in run] for how, run in runs.items()}
    return (
        calm
        | {f"scatter (mm), {how}": means for how, means in held.items()}
        | {f"miss (mm), one weak, {how}": means for how, means in weak.items()}
        | {"miss (mm), one weak, known (habit: aim learnt)": known}
    )


def hand_paths(factors, rule, late=None):
    """The hand's paths (…, 6, 151, 2) in m, under a rule's commands times factors (…, 6, T, 6)."""
    if late is not None:
        return lqr_tracking.move(_feedback_law(rule), factors, late // TICK)[0]
    commands = keep_last(minimum_variance.excitations_by_rule()[rule])
    motions = (reach(np.clip(commands * factor, 0, 1), hold=0.0) for factor in factors)
    return np.array([motion.hand[:, ::TICK, :2] for motion in motions])


@cache
def _feedback_law(rule):
    return lqr_tracking.feedback_law(minimum_variance.excitations_by_rule()[rule])
