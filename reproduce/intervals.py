"""How sure a number is that was measured a few times: 95 % intervals of a mean and of a share."""

import numpy as np
from scipy.stats import t


def student(values):
    """The mean of `values` (n, …) over the first axis, and half its 95 % interval's width, (…).

    Student's t: it speaks of what changed from value to value, a seed or a training, and of nothing
    else. ValueError for fewer than two values.
    """
    n = len(values)
    if n < 2:
        raise ValueError(f"{n} values have no spread: give two or more")
    half = t.ppf(0.975, n - 1) * np.std(values, axis=0, ddof=1) / np.sqrt(n)
    return np.mean(values, axis=0), half


def wilson(right, n, z=1.96):
    """The lower and upper end of the 95 % interval of a share, `right` of `n` (Wilson 1927)."""
    share, z2 = right / n, z * z / n
    middle, half = share + z2 / 2, z * np.sqrt(share * (1 - share) / n + z2 / n / 4)
    return (middle - half) / (1 + z2), (middle + half) / (1 + z2)
