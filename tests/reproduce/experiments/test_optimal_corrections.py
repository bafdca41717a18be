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
    assert at_once[0][-1] < late[0][-1] < alone[0][-1]
    assert at_once[1].mean() < late[1].mean() < alone[1].mean()


def test_without_a_disturbance_corrections_change_nothing(factors):
    undisturbed = np.ones_like(factors[1][:1])
    alone, corrected = (corrections.hand_paths(undisturbed, "habit", ms) for ms in (None, 0))
    np.testing.assert_allclose(corrected, alone, atol=1e-6)


def test_means_by_rule_are_those_of_every_measure_and_run():
    numbers = {name: np.array([1.0, 3.0]) for name in MEASURE_NAMES}
    measures = {"habit": numbers, "least effort": {k: 2 * x for k, x in numbers.items()}}
    runs = {"uncorrected": [(np.arange(151), np.array([k, k + 2])) for k in (4, 7)]}
    means = corrections.means_by_rule(measures, list(measures), runs, [9, 8])
    assert len(means) == len(MEASURE_NAMES) + 2
    assert means["effort (10⁻³)"] == [2, 4]
    assert means["scatter (mm), uncorrected"] == [125, 125]  # over the hold, ticks 100 to 150
    assert means["miss (mm), one weak, uncorrected"] == [5, 8]
