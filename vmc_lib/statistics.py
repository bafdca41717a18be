"""How sure a number is that was measured a few times, and how sure a difference."""

import numpy as np


def student(values):
    """The mean of `values` (n, …) over the first axis, and half its 95 % interval's width, (…).

    Student's t: it speaks of what changed from value to value, a seed or a training, and of nothing
    else. ValueError for fewer than two values.
    """
    from scipy.special import (
        stdtrit,
    )  # here, like all of SciPy: who shows no interval need not wait

    n = len(values)
    if n < 2:
        raise ValueError(f"{n} values have no spread: give two or more")
    error = np.std(values, axis=0, ddof=1) / np.sqrt(n)
    return np.mean(values, axis=0), stdtrit(n - 1, 0.975) * error


def wilson(right, n):
    """The lower and upper end of the 95 % interval of a share, `right` of `n` (Wilson 1927).

    Counts that are means over trainings are rounded first.
    """
    from scipy.stats import binomtest

    interval = binomtest(round(right), round(n)).proportion_ci(method="wilson")
    return interval.low, interval.high


def mcnemar(one, other):
    """Of two methods' answers, (n,) each, right or not: only one right, only the other right, p.

    If neither is better, each wins about half of the cases on which they differ (McNemar 1947).
    """
    from scipy.stats import binomtest

    wins, losses = int((one & ~other).sum()), int((other & ~one).sum())
    return wins, losses, binomtest(wins, wins + losses).pvalue if wins + losses else 1.0


def holm(chances):
    """Chances (n,) of many tests, corrected for their number (Holm 1979)."""
    order = np.argsort(chances)
    left = len(chances) - np.arange(len(chances))
    corrected = np.empty(len(chances))
    corrected[order] = np.minimum(np.maximum.accumulate(np.array(chances)[order] * left), 1)
    return corrected
