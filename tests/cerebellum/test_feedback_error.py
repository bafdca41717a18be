"""A curl field: learned from the feedback's corrections, missed when it goes, then forgotten."""

import numpy as np
import pytest

from reproduce.experiments import feedback_control as measure
from reproduce.peers.motor_noise import SCATTER_MM, endpoint_deviation
from vmc_lib.arm.dynamics import hand
from vmc_lib.camera import TABLE
from vmc_lib.cerebellum.feedback_error import FeedbackErrorLearning
from vmc_lib.motor.feedback import (
    SIGHT,
    ReferenceTrajectory,
    reference_trajectory,
    simulate_feedback,
)
from vmc_lib.motor.planning import draw_targets


@pytest.fixture(scope="module")
def bends(template_set):
    """Deviations (blocks, ways) in m, 80 movements in the field; and those of ways between."""
    rng, learner = np.random.default_rng(0), FeedbackErrorLearning(template_set)
    model = measure.fit_forward_model(template_set, rng)
    return measure.curl_field_deviations(learner, template_set, model, rng, (1, 10, 9))


def test_curl_field_is_learned_within_a_hundred_movements(bends):
    size = np.abs(bends[0]).mean(axis=1)
    assert size[1] > 10 * size[0]
    assert size[10] <= 0.4 * size[1]


def test_learning_generalises_to_ways_between(bends):
    before, after = np.abs(bends[1]).mean(axis=1)
    assert after <= 0.4 * before


def test_after_effect_has_the_opposite_sign_and_washes_out(bends):
    aside = bends[0].mean(axis=1)
    assert aside[1] < 0 < aside[11]
    assert aside[11] > 0.25 * -aside[1]
    assert abs(aside[-1]) < 0.5 * aside[11]


def test_untrained_learner_changes_nothing(template_set):
    targets = draw_targets(template_set, 3, np.random.default_rng(1))
    reference = reference_trajectory(measure.exact_plans(targets, template_set))
    corrected = FeedbackErrorLearning(template_set).correct(reference)
    np.testing.assert_allclose(corrected.excitations, reference.excitations, atol=1e-12)


def test_reaches_that_the_eye_guides_scatter_by_2_mm(template_set):
    noise, rng = measure.SCATTER_SHARE, np.random.default_rng(0)
    model = measure.fit_forward_model(template_set, rng, noise=noise)
    eight = measure.centre_out(template_set)
    many = ReferenceTrajectory(*(np.repeat(x, 20, axis=0) for x in eight))
    motion = simulate_feedback(many, SIGHT, model, None, noise, rng)
    ends = motion.hand[:, -1, :2].reshape(8, 20, 2).swapaxes(0, 1)
    assert 1000 * endpoint_deviation(ends) == pytest.approx(SCATTER_MM, rel=0.1)


@pytest.mark.parametrize("turned", [0.0, -12.5])
def test_centre_out_reaches_are_equal_and_end_above_the_table(template_set, turned):
    way = hand(measure.centre_out(template_set, turned).q)[..., :2]
    length = np.linalg.norm(way[:, -1] - way[:, 0], axis=-1)
    np.testing.assert_allclose(length, measure.FARTHEST, atol=1e-6)
    assert way[:, -1, 1].min() > TABLE
    with pytest.MonkeyPatch.context() as patch:  # a centimetre more is too far
        patch.setattr(measure, "FARTHEST", measure.FARTHEST + 0.01)
        assert hand(measure.centre_out(template_set).q)[:, -1, 1].min() < TABLE


@pytest.mark.audit
def test_shipped_curl_field_meets_the_bars():
    """Six seeds: deviation in the field, after-effect, washout."""
    shipped, (new, during, _) = measure.load_results(), measure.BLOCKS
    aside, size = (shipped["field"][name] for name in ("to the left", "size"))
    gone = new + during
    assert (size[:, gone - 1] <= 0.4 * size[:, new]).all()
    assert (aside[:, new] < 0).all()
    assert (aside[:, gone] > 0).all()
    assert (aside[:, -1] < aside[:, gone]).all()
    for name, again in measure.curl_field_errors(0).items():
        np.testing.assert_allclose(again, shipped["field"][name][0], atol=0.05)
