"""A curl field: learned from the feedback's corrections, missed when it goes, then forgotten."""

import numpy as np
import pytest

from reproduce.experiments import feedback_control as measure
from vmc_lib.cerebellum.feedback_error import FeedbackErrorLearning
from vmc_lib.motor.feedback import reference_trajectory
from vmc_lib.motor.planning import draw_targets


@pytest.fixture(scope="module")
def bends(template_set):
    """Deviations (blocks, targets) in m, 100 movements in the field; and those of other targets."""
    rng, learner = np.random.default_rng(0), FeedbackErrorLearning(template_set)
    model = measure.fit_forward_model(template_set, rng)
    return measure.curl_field_deviations(learner, template_set, model, rng, (1, 20, 8))


def test_curl_field_is_learned_within_a_hundred_movements(bends):
    size = np.abs(bends[0]).mean(axis=1)
    assert size[1] > 10 * size[0]
    assert size[20] <= 0.4 * size[1]


def test_learning_generalises_to_other_targets(bends):
    before, after = np.abs(bends[1]).mean(axis=1)
    assert after <= 0.4 * before


def test_after_effect_has_the_opposite_sign_and_washes_out(bends):
    aside = bends[0].mean(axis=1)
    assert aside[1] < 0 < aside[21]
    assert aside[21] > 0.25 * -aside[1]
    assert abs(aside[-1]) < 0.5 * aside[21]


def test_untrained_learner_changes_nothing(template_set):
    targets = draw_targets(template_set, 3, np.random.default_rng(1))
    reference = reference_trajectory(measure.exact_plans(targets, template_set))
    corrected = FeedbackErrorLearning(template_set).correct(reference)
    np.testing.assert_allclose(corrected.excitations, reference.excitations, atol=1e-12)


def test_shipped_results_meet_the_bars():
    """Six seeds: deviation in the field, after-effect, washout; jumps and tremor."""
    shipped = measure.load_results()
    aside, size = (shipped["field"][name] for name in ("to the left", "size"))
    assert (size[:, 21] <= 0.4 * size[:, 2]).all()
    assert (aside[:, 2] < 0).all()
    assert (aside[:, 22] > 0).all()
    assert (aside[:, -1] < aside[:, 22]).all()
    jumps = shipped["reaches"]["forward model, jumps within 10 mm"]
    assert (jumps >= 0.9).all()
    shaking, calm = (
        shipped["reaches"][f"{arm}, tremor (mm²)"] for arm in list(measure.ARMS)[:0:-1]
    )
    assert (shaking > 5 * calm).all()
