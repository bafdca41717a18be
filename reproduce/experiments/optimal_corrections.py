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
from vmc_lib.statistics import t_interval

HOLD_TICKS = slice(SAMPLES // TICK, None)  # ticks


def disturbances(rng):
    """Factors of the commands: noise (repeats, 6, T, 6), and each muscle weak (6, 6, T, 6)."""
    shape = keep_last(minimum_variance.least_variance_excitations()).shape
    repeated = minimum_variance.REPEATS, *shape
    noise = motor_noise.noise_factor(repeated, minimum_variance.noise_share(), rng)
    weak = np.array([muscle_strength(name) for name in MUSCLES])
    return noise, np.broadcast_to(weak[:, None, None], (len(MUSCLES), *shape))


def scatter_and_miss(noise, weak, rule, late=None, **paid):
    """How far the hand scatters on its way, (6, 151), and misses with each muscle weak, in mm.

    The misses are (muscles, 6); noise and weakness are `disturbances`. Of a rule's commands alone,
    or with the best corrections, where deviations are known `late`, in ms. They are `paid` for
    in the hold alone, or `since` another tick.
    """
    scatter = lqr_tracking.scatter(hand_paths(noise, rule, late, **paid))
    miss = mean_distance(hand_paths(weak, rule, late, **paid)[..., HOLD_TICKS, :], TARGETS)
    return 1000 * scatter, 1000 * miss


def draws_by_rule(measures, rules, runs):
    """All measures, one number for each target: {a measure in words: (rules, 6)}.

    `measures` are those without disturbances, `runs` each rule's `scatter_and_miss` by how it is
    corrected.
    """
    calm = {
        words: [measures[r][k] for r in rules]
        for k, words in minimum_variance.MEASURE_NAMES.items()
        if k != "scatter"
    }
    held = {
        how: [scatter[:, HOLD_TICKS].mean(axis=-1) for scatter, _ in run]
        for how, run in runs.items()
    }
    weak = {how: [miss.mean(axis=0) for _, miss in run] for how, run in runs.items()}
    rows = (
        calm
        | {f"scatter (mm), {how}": each for how, each in held.items()}
        | {f"miss (mm), one weak, {how}": each for how, each in weak.items()}
    )
    return {words: np.array(each) for words, each in rows.items()}


def surely_least(draws):
    """The row of (rules, n) that is least, target by target beyond luck; None where none is.

    Its paired differences from each other row have 95 % intervals above 0.
    """
    best = draws.mean(axis=1).argmin()
    middles, halves = zip(*map(t_interval, np.delete(draws, best, 0) - draws[best]), strict=True)
    return best if (np.array(middles) > halves).all() else None


def hand_paths(factors, rule, late=None, **paid):
    """The hand's paths (…, 6, 151, 2) in m, under a rule's commands times factors (…, 6, T, 6)."""
    if late is not None:
        return lqr_tracking.move(_feedback_law(rule, **paid), factors, late // TICK)[0]
    commands = keep_last(minimum_variance.excitations_by_rule()[rule])
    motions = (reach(np.clip(commands * factor, 0, 1), hold=0.0) for factor in factors)
    return np.array([motion.hand[:, ::TICK, :2] for motion in motions])


@cache
def _feedback_law(rule, **paid):
    return lqr_tracking.feedback_law(minimum_variance.excitations_by_rule()[rule], **paid)
