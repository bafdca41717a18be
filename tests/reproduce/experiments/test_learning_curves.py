"""Learning curves with 2 mm of scatter: shipped, reproducible, and judged without luck."""

import numpy as np
import pytest

from reproduce.experiments import calibration, learning_curves, nulls
from reproduce.experiments import offline_calibration as offline
from reproduce.experiments.learning_curves import CALM, NOISY, WHOLE_ARM, at_noise, online_name
from reproduce.peers.motor_noise import SCATTER_MM
from vmc_lib.cerebellum.offline import Trials, broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


def test_without_noise_what_is_kept_misses_as_it_did():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(0)), load())
    trials = broyden_calibration(habit, 2)
    again = learning_curves.repeat_best(habit, trials).error
    np.testing.assert_allclose(again, np.minimum.accumulate(trials.error), atol=1e-9)


def test_a_lucky_try_is_given_again_without_its_luck():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(0)), load())
    weights = np.stack([habit.weights, habit.weights])
    lucky = Trials(weights, None, np.array([3 * [0.01], 3 * [0.0]]), ())
    again = learning_curves.repeat_best(habit, lucky).error
    np.testing.assert_allclose(again, np.tile(execute(habit).error, (2, 1)), atol=1e-9)


def test_what_is_kept_with_a_load_is_given_again_with_it():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(0)), load())
    trials = offline.trials_with_load(habit, 0.25)[True]
    again = learning_curves.repeat_best(habit, trials, offline.move_with_load(0.25)).error
    np.testing.assert_allclose(again, np.minimum.accumulate(trials.error), atol=1e-9)


def test_tries_until_a_level():
    curves = np.array([[1.0, 0.5, 0.1], [1.0, 0.7, 0.3]])
    assert learning_curves.first_below(0.6, curves) == 1
    assert learning_curves.first_below(0.1, curves) == np.inf


def test_hands_scatter_by_2_mm_in_what_ships():
    shipped = learning_curves.load_results()
    for name in (learning_curves.OFF_LINE, at_noise(WHOLE_ARM, NOISY)):
        assert shipped[name]["scatter"].shape == (20,)
        scatter = np.sqrt(np.square(shipped[name]["scatter"]).mean())
        assert scatter == pytest.approx(SCATTER_MM, rel=0.25)
    assert shipped[at_noise(WHOLE_ARM, CALM)]["scatter"].max() < 1e-9


def test_noise_makes_every_curve_end_higher():
    shipped = learning_curves.load_results()
    calm = nulls.load_results()[nulls.BY_TRIES_HELD]
    for rule in (nulls.EQ_6_7, nulls.BLIND, nulls.LINE, nulls.LEAST_SQUARES):
        noisy = shipped[learning_curves.OFF_LINE][rule]
        assert (noisy - calm[rule])[:, -1].mean() > 0.02
    for scenario in learning_curves.SCENARIOS:
        calm, noisy = (shipped[online_name(scenario, noise)] for noise in (CALM, NOISY))
        for name, left in noisy.items():
            assert (left - calm[name])[:, -1].mean() > 0


def test_noise_leaves_more_after_rounds_tries_with_a_load_and_in_changed_worlds():
    worlds = calibration.load_results()["perturbations"]
    pairs = [
        *map(learning_curves.load_pair, (learning_curves.ROUNDS, learning_curves.WITH_LOAD)),
        (worlds, learning_curves.load_results()[learning_curves.WORLDS]),
    ]
    for calm, noisy in pairs:
        assert calm.keys() == noisy.keys()
        more = [(noisy[name] - mm)[:, -1].mean() for name, mm in calm.items()]
        assert np.mean(more) > 0.5


@pytest.mark.audit
def test_shipped_curves_are_reproducible():
    shipped, scenario = learning_curves.load_results(), learning_curves.SCENARIOS[0]
    again = {
        learning_curves.OFF_LINE: learning_curves.offline_curves(0),
        online_name(scenario, NOISY): learning_curves.online_curves(0, scenario),
        at_noise(WHOLE_ARM, NOISY): learning_curves.whole_arm(0),
        at_noise(learning_curves.ROUNDS, NOISY): learning_curves.round_misses(0),
        at_noise(learning_curves.WITH_LOAD, NOISY): learning_curves.with_load(0),
        learning_curves.WORLDS: learning_curves.changed_worlds(0),
        at_noise(learning_curves.MEMORIES, NOISY): learning_curves.memory_curves(0),
    }
    for part, curves in again.items():
        for name, values in curves.items():
            np.testing.assert_allclose(values, shipped[part][name][0], atol=2e-3)
