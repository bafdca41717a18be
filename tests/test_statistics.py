"""Intervals beside SciPy's own."""

import numpy as np
import pytest
from scipy import stats

from vmc_lib.statistics import holm, mcnemar, t_interval, wilson


def test_student_agrees_with_scipy():
    values = np.random.default_rng(0).normal(size=(6, 2))
    mean, half = t_interval(values)
    low, high = stats.t.interval(0.95, 5, values.mean(axis=0), stats.sem(values))
    np.testing.assert_allclose([mean - half, mean + half], [low, high])


def test_interval_of_equal_values_is_zero():
    assert t_interval([2.0, 2.0, 2.0]) == (2.0, 0.0)


def test_one_value_has_no_interval():
    with pytest.raises(ValueError, match="1 values have no spread"):
        t_interval([3.0])


@pytest.mark.parametrize(("right", "n"), [(40, 40), (37, 40), (1, 7)])
def test_wilson_by_its_formula(right, n):
    """The ends are the shares p that lie z standard errors, √(p(1 − p)/n), from what was seen."""
    z = 1.96
    low, high = wilson(right, n)
    assert 0 <= low <= right / n <= high <= 1
    for end in (low, high):
        gap = abs(right / n - end)
        assert gap == pytest.approx(z * np.sqrt(end * (1 - end) / n), abs=1e-4)


def test_counts_may_be_means_over_trainings():
    assert wilson(37.4, 40) == wilson(37, 40)


def test_mcnemar_counts_only_where_two_differ():
    one = np.array([True] * 9 + [False] * 3 + [True] * 50)
    other = np.array([False] * 9 + [True] * 3 + [True] * 50)
    assert mcnemar(one, other) == (9, 3, stats.binomtest(9, 12).pvalue)
    assert mcnemar(one, one) == (0, 0, 1.0)


def test_holm_by_hand():
    """The smallest of three times three, the next times two, none below one before it."""
    np.testing.assert_allclose(holm([0.04, 0.01, 0.03]), [0.06, 0.03, 0.06])
    assert holm([0.9, 0.8]).max() == 1
