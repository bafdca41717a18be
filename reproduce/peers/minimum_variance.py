"""The steadiest commands, a rival of habit: those after which the hand scatters least.

Where noise grows with the command, commands differ in how far they let the hand scatter; Harris and
Wolpert (1998) took the least scatter for the brain's aim. Task, arm and search are those of
`optimal_control`. The scatter is counted at three moments of the hold, to first order of the noise
of `motor_noise.with_noise`. That noise is slow; Harris and Wolpert's was white, so these are not
their commands: `measures_by_rule` shows what white noise makes of them. What ships are the optima
of the `INNER` targets, on which no template lies.
"""

from functools import cache, partial

import numpy as np

from reproduce.peers import motor_noise, optimal_control
from reproduce.peers.lqr_tracking import scatter
from reproduce.peers.optimal_control import INNER, TARGETS
from reproduce.results import arrays
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.muscle import add_noise, noisy
from vmc_lib.camera import TABLE
from vmc_lib.cerebellum.offline import gauss_newton_calibration
from vmc_lib.motor.inverse_dynamics import MOVING, SAMPLES, minimum_jerk
from vmc_lib.motor.planning import norm, plan
from vmc_lib.motor.templates import keep_last, load, reach

KNOTS = 12  # of each muscle's excitation: with 24 the hand scatters by 2 % less, at two targets
MOMENTS = [SAMPLES, 1250, 1500]  # ms: when scatter counts
NUDGE = 1e-3  # of a knot: larger than `optimal_control`'s, for what is compared are differences
WAVER = 0.03  # the share of noise by which its effect is found: about what reaches meet
LEVEL, REPEATS = 5, 100  # mm that habit scatters by; reaches by which scatter is measured
WHITE = 0.4  # of a command, each millisecond anew
EVERY = 10  # ms between the samples of a path whose jerk is asked for
MEASURE_NAMES = {  # what `measures_by_rule` measures, in words
    "scatter": "scatter (mm)",
    "path": "way / straight way",
    "jerk": "jerk / the least",
    "effort": "effort (10⁻³)",
    "miss": "miss without noise (mm)",
    "farthest": "farthest from the target in the hold (mm)",
    "speed": "speed in the hold (mm/s)",
    "white": "scatter (mm), white noise",
}


def search(target, ftol=1e-3):
    """The knots `x` of least variance, as a `scipy.optimize.OptimizeResult`.

    It ends where a step changes the variance by less than `ftol`, in dm².
    """
    return optimal_control.minimise_cost(target, variance, variance_gradient, ftol, knots=KNOTS)


def variance(x):
    """How far the hand scatters when every pool's noise is as large as its command: its variance.

    In dm², the mean over both axes and the `MOMENTS`.
    """
    effects = _noise_effects(optimal_control.excitations_from_knots(x), _unit_noises())
    return np.square(effects).sum() / effects.shape[-1]


def variance_gradient(x):
    """Gradient of the variance by the knots, (n,).

    Each noise of `_unit_noises` moves the places of the hand by its effect. All that move one
    place are first added up, each times its effect there: then a nudged knot needs two reaches a
    place, instead of two a noise.
    """
    pools = _unit_noises()
    worth = np.tensordot(
        _noise_effects(optimal_control.excitations_from_knots(x), pools), pools, axes=(0, 0)
    )
    size = np.abs(worth).max(axis=(1, 2))
    nudge = np.where(x > 0.5, -NUDGE, NUDGE)
    nudged = optimal_control.excitations_from_knots(np.vstack([x, x + np.diag(nudge)]))
    moved = np.einsum("nkk,k->n", _noise_effects(nudged, worth / size[:, None, None]), size)
    return 2 * (moved[1:] - moved[0]) / nudge / len(worth)


def make(targets=TARGETS[INNER], level=LEVEL, **how):
    """What `results/steady.npz` holds.

    The knots (n, 6 KNOTS) of targets (n, 2), by `search`; the share of noise by which the hand
    scatters by `level` mm.
    """
    knots = optimal_control.make(targets, partial(search, **how))
    return knots | {"share": np.array(motor_noise.noise_share_for(level))}


@cache
def least_variance_excitations():
    """The steadiest excitations (6, T, 6) to the inner targets."""
    return optimal_control.excitations_from_knots(arrays("steady")["knots"].astype(float))


def noise_share():
    """The share of noise by which a habitual reach scatters by `LEVEL` mm."""
    return float(arrays("steady")["share"])


@cache
def excitations_by_rule():
    """The excitations (6, T, 6) of the inner targets, by the rule that makes them."""
    habit = plan(TARGETS[INNER], load())
    learnt = gauss_newton_calibration(habit)
    return {
        "habit": habit.excitations,
        "least effort": optimal_control.optimal_excitations()[INNER],
        "steadiest": least_variance_excitations(),
        "habit of least effort": optimal_control.mix_optima().excitations,
        "calibrated habit": habit.with_weights(learnt.best_weights).excitations,
    }


def measures_by_rule(rng, repeats=REPEATS):
    """By rule and measure, one number for each of the inner targets.

    How far the hand scatters over the hold when the reach is repeated on an arm that wavers by
    `LEVEL` mm (mm, a standard deviation), or where each millisecond has its own noise; the effort
    (10⁻³), and `kinematic_measures`.
    """
    slow = partial(motor_noise.with_noise, share=noise_share(), rng=rng)
    white, found = partial(noisy, share=WHITE, rng=np.random.default_rng(2)), {}
    for name, excitations in excitations_by_rule().items():
        found[name] = {
            "scatter": _hold_scatter(slow, excitations, repeats),
            "white": _hold_scatter(white, excitations, repeats // 4),
            "effort": 1000 * optimal_control.effort(excitations),
            **kinematic_measures(reach(excitations), TARGETS[INNER]),
        }
    return found


def _hold_scatter(noise, excitations, repeats):
    """How far the hand scatters over the hold when reaches (n, T, 6) are repeated, (n,), mm."""
    many = (motor_noise.noisy_reach(noise, excitations).hold for _ in range(repeats))
    return 1000 * np.sqrt(np.square(scatter(np.array(list(many)))).mean(axis=-1))


def kinematic_measures(motion, targets):
    """Numbers by name, (n,) each, of undisturbed reaches for targets (n, 2): a `HeldMotion`.

    How far the hand is from its target during the hold, on average and at most (mm); how fast it
    moves there on average (mm/s); the way it goes, over the straight distance; how far above the
    table it stays (mm); and the `jerk`.
    """
    way, hold = motion.hand[..., :2], motion.hold
    off = hold - targets[:, None]
    return {
        "miss": 1000 * norm(off).mean(axis=-1),
        "farthest": 1000 * norm(off).max(axis=-1),
        "speed": 1000 * motion.speed,
        "path": norm(np.diff(way, axis=-2)).sum(axis=-1) / norm(targets - way[:, 0]),
        "height": 1000 * (way[..., 1].min(axis=-1) - TABLE),
        "jerk": jerk(way[..., ::EVERY, :]),
    }


def jerk(path):
    """The squared jerk of paths (…, T + 1, d) while they should move, over the least there can be.

    Of places `EVERY` so many ms. The least is that of a straight way of minimum jerk to where the
    hand is at the end.
    """
    last = MOVING // EVERY
    way = path[..., : last + 1, :]
    straight = minimum_jerk(way[..., 0, :], way[..., -1, :], last, last)
    return np.divide(*(np.square(np.diff(x, 3, axis=-2)).sum((-1, -2)) for x in (way, straight)))


def _noise_effects(excitations, noises):
    """How far noises (n, T, 6) move the places of the hand, in dm: (…, n, places)."""
    commands = keep_last(excitations)[..., None, :, :]
    both = (add_noise(commands, side * WAVER, noises) for side in (1, -1))
    ends = (hand(reach(noisy, hold=0.0).q[..., MOMENTS, :])[..., :2] for noisy in both)
    effects = 10 * np.subtract(*ends) / (2 * WAVER)
    return effects.reshape(*effects.shape[:-2], -1)


@cache
def _unit_noises():
    """Every curve of `motor_noise.noise_basis`, in one pool alone: (noises, T, 6)."""
    basis = motor_noise.noise_basis(MOMENTS[-1])
    each = np.einsum("tn,km->nktm", basis, np.eye(6))
    return each.reshape(-1, len(basis), 6)
