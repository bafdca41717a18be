"""Signal-dependent motor noise that is smooth in time: an arm that wavers.

The motor units of a muscle, its pool, are driven together, and what unsteadies a pull most is a
slow waver of that common drive (Dideriksen et al. 2012). So every pool has one smooth curve of
noise, and its command is multiplied by it: the stronger the command, the noisier (Harris & Wolpert
1998), during the hold as well. How strong the noise is, is told by where the hand ends: by the
standard deviation of a reach that is repeated.
"""

from dataclasses import replace
from functools import cache, partial

import numpy as np

from vmc_lib.arm.model import STEP
from vmc_lib.arm.simulate import UNPERTURBED
from vmc_lib.motor.inverse_dynamics import spline
from vmc_lib.motor.planning import draw_targets, exact_weights, norm, plan
from vmc_lib.motor.templates import HOLD, keep_last, load, reach

KNOTS = 12  # spline coefficients a second: noise wavers about as slowly as commands change
SCATTER_MM = 2  # mm, of a repeated reach's end: commands then vary by 1.7 %, as a finger's push


@cache
def noise_basis(samples, step=STEP):
    """Spline basis (samples, knots) of noise, scaled so that random sums have unit variance."""
    curves = spline(round(KNOTS * samples * step), samples)
    return curves / np.linalg.norm(curves, axis=1, keepdims=True)


def noise_factor(shape, share, rng, step=STEP):
    """Multiplicative noise for commands of a shape (…, T, muscles), one every `step` s.

    1 + share · (a smooth curve).
    """
    curves = noise_basis(shape[-2], step)
    draws = rng.standard_normal((*shape[:-2], curves.shape[1], shape[-1]))
    return 1 + share * curves @ draws


def with_noise(excitations, share, rng, step=STEP):
    """Excitations (…, T, muscles) with signal-dependent noise, clipped to [0, 1]."""
    return np.clip(excitations * noise_factor(np.shape(excitations), share, rng, step), 0, 1)


def noisy_reach(noise, excitations, perturbation=UNPERTURBED):
    """The `HeldMotion` of excitations (…, T, 6) and their hold, with `noise(excitations)` on both.

    If only the command were noisy, the hold would repeat the noise of its last moment.
    """
    motion = reach(noise(keep_last(excitations)), perturbation, hold=0.0)
    return replace(motion, held=round(HOLD / STEP))


def endpoint_deviation(ends):
    """The standard deviation in m of ends (repeats, n, 2) about their means, over both axes."""
    return np.sqrt(ends.var(axis=0, ddof=1).mean())


def noise_floor(holds):
    """The mean distance in m of repeated holds (repeats, n, samples, 2) from their mean path.

    It is what noise alone leaves of a miss: no rule can leave less. Each path is a part of the
    mean, which is corrected for.
    """
    repeats = len(holds)
    return np.sqrt(repeats / (repeats - 1)) * norm(holds - holds.mean(axis=0)).mean()


@cache
def noise_share_for(mm):
    """The share of `with_noise` with which repeated reaches end with a standard deviation of `mm`.

    ValueError when no share up to one gives so much.
    """
    from scipy.optimize import brentq

    targets = draw_targets(load(), 200, np.random.default_rng(100))
    excitations = plan(targets, load(), exact_weights).excitations

    @cache  # the ends of the search are asked for twice
    def excess(share):
        if not share:
            return -mm
        noise = partial(with_noise, share=share, rng=np.random.default_rng(101))
        ends = [noisy_reach(noise, excitations).endpoint for _ in range(10)]  # to spare memory
        return 1000 * endpoint_deviation(np.array(ends)) - mm

    if not (mm == 0 or (mm > 0 and excess(1.0) > 0)):
        raise ValueError(f"no noise makes reaches end with {mm} mm; choose 0 to 20")
    return brentq(excess, 0, 1, xtol=1e-3, rtol=1e-3)
