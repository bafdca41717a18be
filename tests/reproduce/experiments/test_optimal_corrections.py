"""Corrections on the way, of reaches that noise or a weak muscle disturbs."""

import numpy as np
import pytest

from reproduce.experiments import optimal_corrections as corrections


@pytest.fixture(scope="module")
def factors():
    noise, weak = corrections.disturbances(np.random.default_rng(0))
    return noise[:8], weak


def test_corrections_steady_the_hand_and_stand_in_for_a_weak_muscle(factors):
    alone, at_once, late = (
        corrections.scatter_and_miss(*factors, "least effort", ms) for ms in (None, 0, 120)
    )
    assert at_once[0][-1] < late[0][-1] < alone[0][-1]
    assert at_once[1].mean() < late[1].mean() < alone[1].mean()


def test_without_a_disturbance_corrections_change_nothing(factors):
    undisturbed = np.ones_like(factors[1][:1])
    alone, corrected = (corrections.hand_paths(undisturbed, "habit", ms) for ms in (None, 0))
    np.testing.assert_allclose(corrected, alone, atol=1e-6)
