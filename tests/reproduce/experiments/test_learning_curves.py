"""Learning curves at a person's noise: shipped, reproducible, and judged without luck."""

import numpy as np
import pytest

from reproduce.experiments import learning_curves, nulls
from reproduce.experiments.learning_curves import CALM, NOISY, arm_name, online_name
from reproduce.peers.motor_noise import PERSON
from vmc_lib.cerebellum.offline import Trials, broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


def test_without_noise_what_is_kept_misses_as_it_did():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(0)), load())
    trials = broyden_calibration(habit, 2)
    again = learning_curves.kept_again(habit, trials).error
    np.testing.assert_allclose(again, np.minimum.accumulate(trials.error), atol=1e-9)


def test_a_lucky_try_is_given_again_without_its_luck():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(0)), load())
    weights = np.stack([habit.weights, habit.weights])
    lucky = Trials(weights, None, np.array([3 * [0.01], 3 * [0.0]]), ())
    again = learning_curves.kept_again(habit, lucky).error
    np.testing.assert_allclose(again, np.tile(execute(habit).error, (2, 1)), atol=1e-9)


def test_tries_until_a_level():
    curves = np.array([[1.0, 0.5, 0.1], [1.0, 0.7, 0.3]])
    assert learning_curves.first_below(0.6, curves) == 1
    assert learning_curves.first_below(0.1, curves) == np.inf


def test_hands_scatter_as_a_persons_does_in_what_ships():
    shipped = learning_curves.load_results()
    for name in (learning_curves.OFF_LINE, arm_name(NOISY)):
        assert shipped[name]["scatter"].shape == (20,)
        scatter = np.sqrt(np.square(shipped[name]["scatter"]).mean())
        assert scatter == pytest.approx(PERSON, rel=0.25)
    assert shipped[arm_name(CALM)]["scatter"].max() < 1e-9


def test_noise_makes_every_curve_end_higher():
    shipped = learning_curves.load_results()
    calm = nulls.load_results()[nulls.BY_TRIES_HELD]
    for rule in (nulls.PAPER, nulls.BLIND, nulls.LINE, nulls.WHOLE_HOLD):
        noisy = shipped[learning_curves.OFF_LINE][rule]
        assert (noisy - calm[rule])[:, -1].mean() > 0.02
    for scenario in learning_curves.SCENARIOS:
        calm, noisy = (shipped[online_name(scenario, noise)] for noise in (CALM, NOISY))
        for name, left in noisy.items():
            assert (left - calm[name])[:, -1].mean() > 0


@pytest.mark.audit
def test_shipped_curves_are_reproducible():
    shipped, scenario = learning_curves.load_results(), learning_curves.SCENARIOS[0]
    again = {
        learning_curves.OFF_LINE: learning_curves.off_line(0),
        online_name(scenario, NOISY): learning_curves.online(0, scenario),
        arm_name(NOISY): learning_curves.whole_arm(0),
    }
    for part, curves in again.items():
        for name, values in curves.items():
            np.testing.assert_allclose(values, shipped[part][name][0], atol=2e-3)
