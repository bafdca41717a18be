"""Weights of their own for the hold take away drift that one set of weights leaves."""

import numpy as np

from reproduce.measures.hold_calibration import calibrate, place_and_drift
from vmc_lib.motor import templates
from vmc_lib.motor.planning import draw_targets, plan


def test_place_and_drift_shrink_with_the_trials():
    rng = np.random.default_rng(3)
    past = templates.load()
    habit = plan(draw_targets(past, 4, rng), past)
    wanted = np.concatenate([habit.target, 0 * habit.target], axis=-1)
    left = np.linalg.norm(place_and_drift(calibrate(habit, 4)) - wanted, axis=-1)
    assert (np.diff(left, axis=0) <= 0).all()  # the best so far
    assert left[-1].mean() < 0.2 * left[0].mean()


def test_the_path_of_no_change_is_the_habits():
    past = templates.load()
    habit = plan(np.array([[0.08, -0.4]]), past)
    [path] = calibrate(habit, 0)
    np.testing.assert_allclose(path.mean(axis=-2), past.reach(habit.excitations).endpoint)
