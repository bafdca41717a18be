"""Corrections on the way, of reaches that noise or a weak muscle disturbs."""

import numpy as np
import pytest

from reproduce.experiments import optimal_corrections as corrections
from reproduce.peers.minimum_variance import MEASURE_NAMES


@pytest.fixture(scope="module")
def factors():
    noise, weak = corrections.disturbances(np.random.default_rng(0))
    return noise[:8], weak


def test_corrections_steady_the_hand_and_stand_in_for_a_weak_muscle(factors):
    alone, at_once, late = (
        corrections.scatter_and_miss(*factors, "least effort", ms) for ms in (None, 0, 120)
    )
    ends = [scatter[:, -1].mean() for scatter, _ in (at_once, late, alone)]
    assert ends == sorted(ends)
    assert at_once[1].mean() < late[1].mean() < alone[1].mean()


def test_without_a_disturbance_corrections_change_nothing(factors):
    undisturbed = np.ones_like(factors[1][:1])
    alone, corrected = (corrections.hand_paths(undisturbed, "habit", ms) for ms in (None, 0))
    np.testing.assert_allclose(corrected, alone, atol=1e-6)


def test_draws_by_rule_are_those_of_every_measure_and_run():
    numbers = {name: np.array([1.0, 3.0]) for name in MEASURE_NAMES}
    measures = {"habit": numbers, "least effort": {k: 2 * x for k, x in numbers.items()}}
    way = np.stack([np.arange(151), np.arange(151) + 1])  # of two targets
    runs = {"uncorrected": [(way, np.array([[k, 0], [k + 2, 4]])) for k in (4, 7)]}
    draws = corrections.draws_by_rule(measures, list(measures), runs)
    assert len(draws) == len(MEASURE_NAMES) + 1
    np.testing.assert_array_equal(draws["effort (10⁻³)"], [[1, 3], [2, 6]])
    np.testing.assert_array_equal(draws["scatter (mm), uncorrected"], [[125, 126]] * 2)
    np.testing.assert_array_equal(draws["miss (mm), one weak, uncorrected"], [[5, 2], [8, 2]])


def test_least_beyond_luck_is_a_row_that_is_less_target_by_target():
    low, less, chance = np.array([[1.0, 5.0, 9.0, 4.0], [0.9, 1.1, 1, 1], [-2, 2, 3, -1]])
    assert corrections.surely_least(np.array([low + less, low])) == 1
    assert corrections.surely_least(np.array([low + chance, low])) is None
    assert corrections.surely_least(np.array([low, low + less, low + chance])) is None


def test_corrections_that_are_paid_for_the_way_steady_it_too(factors):
    """In the hold both do as well; half-way only those that the price asks to."""
    alone, at_end, all_the_way = (
        corrections.scatter_and_miss(*factors, "least effort", late, **paid)[0].mean(axis=0)
        for late, paid in ((None, {}), (0, {}), (0, {"since": 0}))
    )
    assert at_end[35] > 0.5 * alone[35]
    assert all_the_way[35] < 0.1 * alone[35]
    assert all_the_way[-1] == pytest.approx(at_end[-1], rel=0.1)
