"""Minimum-variance control, a rival of habit: the commands with the least endpoint scatter.

Where noise grows with the command, commands differ in how far they let the hand scatter; Harris and
Wolpert (1998) took the least scatter for the brain's aim. Task, arm and search are those of
`optimal_control`. The scatter is counted at three moments of the hold, to first order of the noise
of `motor_noise.with_noise`. What ships are the optima of those inner targets of `optimal_control`
on which no template lies.
"""

from functools import cache, partial

import numpy as np

from reproduce.peers import motor_noise, optimal_control
from reproduce.peers.optimal_control import INNER, TARGETS
from reproduce.peers.optimal_feedback import scatter
from reproduce.results import arrays
from vmc_lib.motor.inverse_dynamics import MOVING, SAMPLES, minimum_jerk
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import load, reach

AMONG = [1, 3, 4, 5, 7]  # of the nine `INNER` targets, those on which no template lies
NEW = INNER[AMONG]
HOLD = slice(MOVING, None, 150)  # ms: when scatter counts
NUDGE = 1e-3  # of a knot: larger than `optimal_control`'s, for what is compared are differences
WAVER = 0.03  # the share of noise by which its effect is found: about what reaches meet
LEVEL, REPEATS = 5, 100  # mm that habit scatters by; reaches by which scatter is measured
EVERY = 10  # ms between the samples of a path whose jerk is asked for


def search(target, ftol=3e-3):
    """The knots `x` of least variance, as a `scipy.optimize.OptimizeResult`.

    It ends where a step changes the variance by less than `ftol`, in cm².
    """
    return optimal_control.minimise_cost(target, variance, variance_gradient, ftol=ftol)


def variance(x):
    """How far the hand scatters when every pool's noise is as large as its command: its variance.

    In cm², the mean over both axes and the moments of `HOLD`.
    """
    return (
        np.square(_noise_effects(optimal_control.excitations_from_knots(x), _unit_noises())).sum()
        / _position_count()
    )


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
    return 2 * (moved[1:] - moved[0]) / nudge / _position_count()


def make(targets=TARGETS[NEW], level=LEVEL, **how):
    """What `results/steady.npz` holds.

    The knots (n, 6 KNOTS) of targets (n, 2), by `search`; the share of noise by which the hand
    scatters by `level` mm.
    """
    knots = optimal_control.make(targets, partial(search, **how))
    return knots | {"share": np.array(motor_noise.noise_share_for(level))}


@cache
def optimal_excitations():
    """The excitations (5, T, 6) of least variance to the `NEW` targets."""
    return optimal_control.excitations_from_knots(arrays("steady")["knots"].astype(float))


def noise_share():
    """The share of noise by which a habitual reach scatters by `LEVEL` mm."""
    return float(arrays("steady")["share"])


def excitations_by_rule():
    """The excitations (5, T, 6) of the `NEW` targets, by the rule that makes them."""
    return {
        "habit": plan(TARGETS[NEW], load()).excitations,
        "least effort": optimal_control.optimal_excitations()[NEW],
        "least variance": optimal_excitations(),
        "habit of least effort": optimal_control.mix_optima().excitations[AMONG],
    }


def compare_rules(rng, repeats=REPEATS):
    """By rule and measure, one number for each of the `NEW` targets.

    How far the hand scatters when the reach is repeated on an arm that wavers by `LEVEL` mm (mm, a
    standard deviation), how far it misses without noise (mm), the effort, and the `jerk`.
    """
    found = {}
    for name, excitations in excitations_by_rule().items():
        wavered = (motor_noise.with_noise(excitations, noise_share(), rng) for _ in range(repeats))
        many = np.array([reach(one).endpoint for one in wavered])  # one at a time: less memory
        calm = reach(excitations)
        found[name] = {
            "scatter": 1000 * scatter(many),
            "miss": 1000 * np.linalg.norm(calm.endpoint - TARGETS[NEW], axis=-1),
            "effort": optimal_control.effort(excitations),
            "jerk": jerk(calm.hand[..., :2]),
        }
    return found


def jerk(path):
    """The squared jerk of paths (…, T + 1, d) while they should move, over the least there can be.

    The least is that of a straight way of minimum jerk to where the hand is at the end.
    """
    way = path[..., : MOVING + 1, :]
    straight = minimum_jerk(way[..., 0, :], way[..., -1, :], MOVING)
    both = (
        np.square(np.diff(x[..., ::EVERY, :], 3, axis=-2)).sum((-1, -2)) for x in (way, straight)
    )
    return np.divide(*both)


def _noise_effects(excitations, noises):
    """How far noises (n, T, 6) move the places of the hand, in cm: (…, n, places)."""
    ends = (
        _hold_positions(np.clip(excitations[..., None, :, :] * (1 + side * WAVER * noises), 0, 1))
        for side in (1, -1)
    )
    return np.subtract(*ends) / (2 * WAVER)


def _hold_positions(excitations):
    """Where the hand is at the moments of `HOLD`, in cm, (…, places)."""
    return 100 * reach(excitations).hand[..., HOLD, :2].reshape(
        *excitations.shape[:-2], _position_count()
    )


def _position_count():
    return 2 * len(range(SAMPLES + 1)[HOLD])


@cache
def _unit_noises():
    """Every curve of `motor_noise.noise_basis`, in one pool alone: (6 KNOTS, T, 6)."""
    each = np.einsum("tn,km->nktm", motor_noise.noise_basis(), np.eye(6))
    return each.reshape(-1, SAMPLES, 6)
