"""How sure a number is that was measured a few times: 95 % intervals of a mean and of a share."""

import numpy as np
from scipy.stats import binomtest, sem, t


def student(values):
    """The mean of `values` (n, …) over the first axis, and half its 95 % interval's width, (…).

    Student's t: it speaks of what changed from value to value, a seed or a training, and of nothing
    else. ValueError for fewer than two values.
    """
    n = len(values)
    if n < 2:
        raise ValueError(f"{n} values have no spread: give two or more")
    return np.mean(values, axis=0), t.interval(0.95, n - 1)[1] * sem(values)


def wilson(right, n):
    """The lower and upper end of the 95 % interval of a share, `right` of `n` (Wilson 1927).

    Counts that are means over trainings are rounded first.
    """
    interval = binomtest(round(right), round(n)).proportion_ci(method="wilson")
    return interval.low, interval.high
