"""Where the hand ends over the hold: targets are drawn anew each time."""

import numpy as np
import pytest

from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan

LIMIT = 0.001  # m, of the mean miss
STILL = 0.002  # m/s: a slower hand may be said to rest


@pytest.fixture(scope="module")
def rng():
    return np.random.default_rng()


@pytest.fixture(scope="module")
def fresh(template_set, rng):
    return plan(draw_targets(template_set, 50, rng), template_set)


def test_four_trials_bring_the_hand_to_within_a_millimetre_but_not_to_rest(fresh):
    corrected = execute(fresh.with_weights(broyden_calibration(fresh, 4).best_weights))
    assert corrected.error.mean() < LIMIT < execute(fresh).error.mean(), fresh.target
    assert corrected.speed.mean() > STILL


def test_250_movements_teach_to_aim_within_a_millimetre(template_set, fresh, rng):
    lessons = plan(draw_targets(template_set, 250, rng), template_set)
    corrected = execute(AimCorrection(template_set).update(lessons).correct(fresh))
    assert corrected.error.mean() < LIMIT, (fresh.target, lessons.target)
    assert corrected.speed.mean() > STILL
