"""Signal-dependent motor noise that is smooth in time: an arm that wavers.

The motor units of a muscle, its pool, are driven together, and what unsteadies a pull most is a
slow waver of that common drive (Dideriksen et al. 2012). So every pool has one smooth curve of
noise, and its command is multiplied by it: the stronger the command, the noisier (Harris & Wolpert
1998). How strong the noise is, is told by where the hand ends: by the standard deviation of a reach
that is repeated.
"""

from functools import cache

import numpy as np

from vmc_lib.motor.inverse_dynamics import spline
from vmc_lib.motor.planning import draw_targets, exact_weights, plan
from vmc_lib.motor.templates import load, reach

KNOTS = 12  # spline coefficients of a pool's noise: it wavers about as slowly as commands change


@cache
def noise_basis():
    """Spline basis (T, KNOTS) of the noise, scaled so that random sums have unit variance."""
    return spline(KNOTS) / np.linalg.norm(spline(KNOTS), axis=1, keepdims=True)


def noise_factor(shape, share, rng):
    """Multiplicative noise for commands of a shape (…, T, 6): 1 + share · (a smooth curve)."""
    random = rng.standard_normal((*shape[:-2], KNOTS, 6))
    return 1 + share * noise_basis() @ random


def with_noise(excitations, share, rng):
    """Excitations (…, T, 6) with signal-dependent noise, clipped to [0, 1]."""
    return np.clip(excitations * noise_factor(np.shape(excitations), share, rng), 0, 1)


def endpoint_deviation(ends):
    """The standard deviation in m of ends (repeats, n, 2) about their means, over both axes."""
    return np.sqrt(ends.var(axis=0, ddof=1).mean())


@cache
def noise_share_for(mm):
    """The share of `with_noise` with which repeated reaches end with a standard deviation of `mm`.

    ValueError when no share up to one gives so much.
    """
    from scipy.optimize import brentq

    targets = draw_targets(load(), 200, np.random.default_rng(100))
    excitations = plan(targets, load(), exact_weights).excitations

    @cache  # the ends of the search are asked for twice
    def missing(share):
        if not share:
            return -mm
        rng = np.random.default_rng(101)  # one repeat at a time: less memory
        ends = [reach(with_noise(excitations, share, rng)).endpoint for _ in range(10)]
        return 1000 * endpoint_deviation(np.array(ends)) - mm

    if not (mm == 0 or (mm > 0 and missing(1.0) > 0)):
        raise ValueError(f"no noise makes reaches end with {mm} mm; choose 0 to 20")
    return brentq(missing, 0, 1, xtol=1e-3, rtol=1e-3)
