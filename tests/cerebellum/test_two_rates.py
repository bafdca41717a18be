"""Two memories: what they learn, save and disturb."""

import numpy as np
import pytest

from vmc_lib.cerebellum.two_rates import Rates, adapt


def test_slow_process_ends_with_more():
    memories = adapt(np.ones(200))
    assert memories.shape == (200, 2)
    assert 0.7 < memories[-1].sum() < 1
    assert memories[5, 0] > memories[5, 1]
    assert memories[-1, 1] > memories[-1, 0]


def test_steps_satisfy_the_equation():
    rates = Rates((0.5, 0.9), (0.3, 0.1))
    memories = adapt(np.array([1.0, 1.0, np.nan, 0.0]), rates)
    np.testing.assert_allclose(memories[1], [0.3, 0.1])
    np.testing.assert_allclose(memories[2], [0.5 * 0.3 + 0.3 * 0.6, 0.9 * 0.1 + 0.1 * 0.6])
    np.testing.assert_allclose(memories[3], memories[2] * [0.5, 0.9])


def test_savings():
    """Savings: a few pushes the other way hide what is known; the slow memory keeps it."""
    first = np.ones(150)
    memories = adapt(np.concatenate([first, -np.ones(20), first])).sum(axis=1)
    hidden = 150 + np.flatnonzero(memories[150:] <= 0)[0]
    again = adapt(np.concatenate([first, -np.ones(hidden - 150), first])).sum(axis=1)
    assert abs(again[hidden]) < 0.1
    assert again[hidden + 10] - again[hidden] > 1.1 * (again[10] - again[0])


def test_spontaneous_recovery():
    """Spontaneous recovery: with errors held at zero, what was learned first returns."""
    memories = adapt(np.concatenate([np.ones(150), -np.ones(10), np.full(20, np.nan)])).sum(axis=1)
    assert memories[165:].max() > memories[160] + 0.1


def test_unstable_rates_are_refused():
    with pytest.raises(ValueError, match="never settle"):
        adapt(np.ones(3), Rates((1.2, 0.99), (0.1, 0.02)))
