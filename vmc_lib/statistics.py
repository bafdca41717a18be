"""How sure a number is that was measured a few times, and how sure a difference."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers, check_count, is_within
from vmc_lib.short_repr import short


def student(values: ArrayLike) -> tuple[Any, Any]:
    """The mean of `values` (n, …) over the first axis, and half its 95 % interval's width, (…).

    Student's t: it speaks of what changed from value to value, a seed or a training, and of nothing
    else. ValueError for fewer than two values.
    """
    values = np.atleast_1d(as_numbers("values", values))
    n = len(values)
    if n < 2:
        raise ValueError(f"{n} values have no spread: give two or more")
    error = np.std(values, axis=0, ddof=1) / np.sqrt(n)
    return np.mean(values, axis=0), student_quantile(n - 1) * error


@cache
def student_quantile(n: int) -> float:
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

    if not (is_within(n, 1, np.inf) and is_within(right, 0, n)):
        raise ValueError(f"{short(right)} of {short(n)} is no share: give counts, right first")
    interval = binomtest(round(right), round(n)).proportion_ci(method="wilson")
    return interval.low, interval.high


def mcnemar(one: np.ndarray, other: np.ndarray) -> tuple[int, int, float]:
    """Of two methods' answers, (n,) each, right or not: only one right, only the other right, p.

    If neither is better, each wins about half of the cases on which they differ (McNemar 1947).
    """
    from scipy.stats import binomtest

    for answers in (one, other):
        if not np.isin(answers, (False, True)).all():
            raise ValueError(f"answers {short(answers)}: give True or False for each question")
    one, other = np.asarray(one, bool), np.asarray(other, bool)
    if one.shape != other.shape:
        raise ValueError(f"answers {one.shape} and {other.shape}: give those to the same questions")
    wins, losses = int((one & ~other).sum()), int((other & ~one).sum())
    return wins, losses, binomtest(wins, wins + losses).pvalue if wins + losses else 1.0


def holm(chances: ArrayLike) -> np.ndarray:
    """Chances (n,) of many tests, corrected for their number (Holm 1979)."""
    chances = np.atleast_1d(as_numbers("chances", chances))
    if chances.ndim != 1 or not np.all((chances >= 0) & (chances <= 1)):
        raise ValueError(f"chances {short(chances)}: give a list of p-values, 0 to 1")
    order = np.argsort(chances)
    left = len(chances) - np.arange(len(chances))
    corrected = np.empty(len(chances))
    corrected[order] = np.minimum(np.maximum.accumulate(chances[order] * left), 1)
    return corrected
