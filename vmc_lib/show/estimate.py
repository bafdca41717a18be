"""An estimate with its 95 % interval, from draws or as given, and how it is written."""

from math import floor, log10
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers
from vmc_lib.show.markup import minus
from vmc_lib.statistics import t_interval


class Estimate(NamedTuple):
    """A value and the ends of its interval; the same number three times where there is none.

    As text "0.34 (0.27 to 0.42)": with two digits of the interval's width, or as a format says,
    each of the three: f"{estimate:.0%}".

    >>> f"{Estimate(0.34, 0.27, 0.42):.0%}"
    '34% (27% to 42%)'
    """

    value: float
    low: float
    high: float

    def __str__(self):
        return format(self)

    def __format__(self, spec):
        width = self.high - self.low
        if not width > 0:
            return minus(format(self.value, spec or ".3g"))
        spec = spec or f".{max(0, 1 - floor(log10(width)))}f"
        value, low, high = (minus(format(x, spec)) for x in self)
        return f"{value} ({low} to {high})"


def estimate(value: ArrayLike) -> Estimate:
    """The `Estimate` of draws (n,), by Student's t; or of a number, or of (value, low, high).

    Draws are an array or a list, an interval is a tuple. A single draw has no interval.

    >>> print(estimate([2.9, 3.1, 3.4, 2.6]))
    3.0 (2.5 to 3.5)
    """
    if isinstance(value, tuple):
        if len(value) != 3:
            raise ValueError(f"{value} is no estimate: give (value, low, high), or a list of draws")
        as_numbers("estimate", value)
        return Estimate(*value)
    draws = np.ravel(as_numbers("draws", value))
    if len(draws) == 1:
        return Estimate(*3 * (draws[0],))
    mean, half = t_interval(draws)
    return Estimate(mean, mean - half, mean + half)
