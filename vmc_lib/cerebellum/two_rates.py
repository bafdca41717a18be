"""Adaptation from reach to reach as two memories: one learns and forgets fast, one slowly.

The state-space model of Smith et al. (2006, PLoS Biology 4:e179). The rates are close to theirs.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers, check_kind


class Rates(NamedTuple):
    """Of the fast memory and of the slow one: what is kept to the next reach, what is learned."""

    kept: tuple = (0.6, 0.99)
    learned: tuple = (0.2, 0.03)


RATES = Rates()


def adapt(disturbance: ArrayLike, rates: Rates = RATES) -> np.ndarray:
    """States (T, 2) of the fast and slow process before each trial, under a `disturbance` (T,).

    What both hold together is taken off the disturbance; both learn from the error that is left.
    A disturbance that is not a number is a reach without an error, one that is guided straight.
    ValueError when a memory would grow without end.
    """
    if (disturbance := as_numbers("disturbance", disturbance)).ndim != 1:
        raise ValueError(f"disturbance of shape {disturbance.shape}: give one for each reach, (T,)")
    check_kind("rates", rates, Rates, "Rates(kept=(0.6, 0.99), learned=(0.2, 0.03))")
    kept, learned = as_numbers("kept", rates.kept), as_numbers("learned", rates.learned)
    if not kept.shape == learned.shape == (2,):
        raise ValueError(f"{rates}: give two of each, of the fast memory and of the slow one")
    if np.abs(np.linalg.eigvals(np.diag(kept) - learned[:, None])).max() >= 1:
        raise ValueError(f"{rates} never settle; keep less than 1, and learn less")
    held = np.zeros((len(disturbance) + 1, 2))
    for k, pushed in enumerate(disturbance):
        error = 0.0 if np.isnan(pushed) else pushed - held[k].sum()
        held[k + 1] = kept * held[k] + learned * error
    return held[:-1]
