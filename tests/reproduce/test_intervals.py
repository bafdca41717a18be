"""Intervals beside SciPy's own."""

import numpy as np
import pytest
from scipy import stats

from reproduce.intervals import student, wilson


def test_student_agrees_with_scipy():
    values = np.random.default_rng(0).normal(size=(6, 2))
    mean, half = student(values)
    low, high = stats.t.interval(0.95, 5, values.mean(axis=0), stats.sem(values))
    np.testing.assert_allclose([mean - half, mean + half], [low, high])


def test_one_value_has_no_interval():
    with pytest.raises(ValueError, match="1 values have no spread"):
        student([3.0])


@pytest.mark.parametrize("right, n", [(40, 40), (37, 40), (1, 7)])
def test_wilson_agrees_with_scipy(right, n):
    theirs = stats.binomtest(right, n).proportion_ci(method="wilson")
    assert wilson(right, n) == pytest.approx((theirs.low, theirs.high), abs=1e-4)
