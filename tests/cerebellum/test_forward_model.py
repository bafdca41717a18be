"""A forward model, learned from reaches alone, predicts what commands do."""

import numpy as np
import pytest

from reproduce.experiments.feedback_control import exact_plans, fit_forward_model
from vmc_lib.cerebellum.forward_model import ForwardModel, arm_copy
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets


def at_rest_and_on_the_way(motion, every=50):
    return [
        x[:, every:-1:every].reshape(-1, x.shape[-1])
        for x in (motion.q, motion.velocity, motion.activation)
    ]


def test_forward_model_improves_with_movements(template_set):
    rng = np.random.default_rng(0)
    others = execute(exact_plans(draw_targets(template_set, 20, rng), template_set)).motion
    states = at_rest_and_on_the_way(others)
    truth = arm_copy()(*states)
    off = [
        (fit_forward_model(template_set, np.random.default_rng(1), count)(*states) - truth).std()
        for count in (1, 20)
    ]
    assert off[1] < 0.1 * truth.std()
    assert off[1] < 0.5 * off[0]


def test_forward_model_fits_what_it_was_trained_on(template_set):
    targets = draw_targets(template_set, 5, np.random.default_rng(2))
    motion = execute(exact_plans(targets, template_set)).motion
    model, lessons = ForwardModel(), at_rest_and_on_the_way(motion, 20)
    truth = arm_copy()(*lessons)
    prediction = model.update(motion)(*lessons)
    assert np.abs(prediction - truth).max() < 0.1 * np.abs(truth).max()


def test_arm_copy_scales_with_muscle_strength():
    q, velocity, activation = np.array([[0.0, 1.0]]), np.zeros((1, 2)), np.full((1, 6), 0.3)
    weak, true, strong = (arm_copy(s)(q, velocity, activation) for s in (0.5, 1, 1.5))
    np.testing.assert_allclose(strong - true, true - weak)
    with pytest.raises(ValueError, match="-1 times as strong"):
        arm_copy(-1)
