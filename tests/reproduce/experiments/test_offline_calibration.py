"""Off-line calibration repeated, with a load, and over the hold."""

import numpy as np
import pytest

from reproduce.experiments import offline_calibration as offline
from reproduce.one_draw import error_ratio, mean_best_so_far
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import mean_distance


@pytest.fixture(scope="module")
def habit(template_set):
    return plan(draw_targets(template_set, 4, np.random.default_rng(5)), template_set)


def test_a_round_that_keeps_its_best_weights_never_makes_a_reach_worse(habit):
    for holds in offline.repeat_algorithm_1(habit, keep=True, rounds=2).values():
        assert holds.shape == (3, 4, 51, 2)
        assert (np.diff(mean_distance(holds, habit.target), axis=0) <= 1e-12).all()
    without = offline.repeat_algorithm_1(habit, keep=False, rounds=1)["n = 0 only"]
    np.testing.assert_array_equal(without[0], execute(habit).hold)


def test_reaches_are_counted_until_the_mean_error_is_small_enough(habit):
    off = np.array([4.0, 2.0, 1.0])[:, None, None] / 1000 * [1, 0]
    still = (habit.target + off)[:, :, None]
    rules = {"halves": (still, 5), "once more": (still[:2], 1)}
    assert offline.reaches_until(1.5, habit, rules) == {"halves": 10, "once more": np.inf}


def test_a_load_leaves_more_error_than_an_empty_hand(habit):
    lifted, empty = (offline.errors_with_load(habit, kg)[True] for kg in (0.25, 0))
    assert lifted.shape == (9, 4)
    assert mean_best_so_far(lifted)[-1] > mean_best_so_far(empty)[-1]
    trials = broyden_calibration(habit, 8)
    left = mean_best_so_far(1000 * trials.error)
    assert left[-1] / left[0] == pytest.approx(error_ratio(trials))


def test_a_reflex_keeps_the_hand_from_drifting(habit):
    free, held = offline.hold_distances(habit), offline.reflex_distances(habit)
    assert free.shape == held.shape == (4, 151)
    assert held[:, -1].mean() < free[:, -1].mean()


def test_the_hold_is_measured_from_the_end_of_the_command(habit):
    plans = habit.with_weights(broyden_calibration(habit).best_weights)
    hold = execute(plans).hold
    at_end, miss, bias, speed = offline.hold_measures(hold, habit.target)
    distances = offline.hold_distances(plans)
    assert at_end == pytest.approx(distances[:, 0].mean())
    assert miss == pytest.approx(distances[:, : hold.shape[1]].mean())
    assert miss == pytest.approx(1000 * execute(plans).error.mean())
    assert bias == pytest.approx(1000 * execute(plans).bias.mean())
    assert speed == pytest.approx(1000 * execute(plans).speed.mean())
