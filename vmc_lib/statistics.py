"""How sure a number is that was measured a few times, and how sure a difference."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers, check_count, is_within, shape_of
from vmc_lib.short_repr import short


def t_interval(values: ArrayLike) -> tuple[Any, Any]:
    """Student's t interval: the mean of `values` (n, …) and half its 95 % interval's width, (…).

    It speaks of what changed from value to value, a seed or a training, and of nothing else.
    ValueError for fewer than two values, or one that is not finite.
    """
    values = np.atleast_1d(as_numbers("values", values))
    n = len(values)
    if n < 2:
        raise ValueError(f"{n} values have no spread: give two or more")
    if not np.isfinite(values).all():
        raise ValueError(f"values {short(values)}: give finite numbers")
    error = np.std(values, axis=0, ddof=1) / np.sqrt(n)
    return np.mean(values, axis=0), t_quantile(n - 1) * error


@cache
def t_quantile(n: int) -> float:
    """The 97.5 % point of Student's t with n degrees of freedom, 1, 2, …"""
    check_count("n", n, least=1)
    low, high = 0.0, 13.0
    for _ in range(60):
        t = (low + high) / 2
        angle = np.arctan2(t, np.sqrt(n))
        term, total = np.cos(angle) ** (n % 2), 0.0
        for power in range(n % 2, n - 1, 2):
            total += term
            term *= (power + 1) / (power + 2) * np.cos(angle) ** 2
        within = np.sin(angle) * total
        within = 2 / np.pi * (angle + within) if n % 2 else within
        low, high = (t, high) if within < 0.95 else (low, t)
    return t


def wilson(right: float, n: float) -> tuple[float, float]:
    """The lower and upper end of the 95 % interval of a share, `right` of `n` (Wilson 1927).

    Counts that are means over trainings are rounded first.
    """
    from scipy.stats import binomtest

    whole = n != 1 or right in (0, 1)  # of one case, a part is a share itself
    if not (is_within(n, 1, np.inf) and is_within(right, 0, n) and whole):
        raise ValueError(f"{short(right)} of {short(n)} is no share: give counts, right first")
    interval = binomtest(round(right), round(n)).proportion_ci(method="wilson")
    return interval.low, interval.high


def mcnemar(one: np.ndarray, other: np.ndarray) -> tuple[int, int, float]:
    """McNemar's exact test of two methods' answers, (n,) each, right or not (McNemar 1947).

    If neither is better, each wins about half of the cases on which they differ. Returns how often
    only the one is right, how often only the other, and p.
    """
    from scipy.stats import binomtest

    for answers in (one, other):
        if not shape_of("answers", answers) or not np.isin(answers, (False, True)).all():
            raise ValueError(f"answers {short(answers)}: give True or False for each question")
    one, other = np.asarray(one, bool), np.asarray(other, bool)
    if one.shape != other.shape:
        raise ValueError(f"answers {one.shape} and {other.shape}: give those to the same questions")
    wins, losses = int((one & ~other).sum()), int((other & ~one).sum())
    return wins, losses, binomtest(wins, wins + losses).pvalue if wins + losses else 1.0


def holm(p_values: ArrayLike) -> np.ndarray:
    """Holm-Bonferroni correction of the p-values (n,) of many tests (Holm 1979)."""
    p_values = np.atleast_1d(as_numbers("p_values", p_values))
    if p_values.ndim != 1 or not np.all((p_values >= 0) & (p_values <= 1)):
        raise ValueError(f"p-values {short(p_values)}: give a list of them, 0 to 1")
    order = np.argsort(p_values)
    left = len(p_values) - np.arange(len(p_values))
    corrected = np.empty(len(p_values))
    corrected[order] = np.minimum(np.maximum.accumulate(p_values[order] * left), 1)
    return corrected
