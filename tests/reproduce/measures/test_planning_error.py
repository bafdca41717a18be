"""The two parts of a habitual plan's miss: what its weights mix, and what the arm makes of it."""

import numpy as np

from reproduce.measures.planning_error import TARGETS, mean_bias, mixture_and_endpoint
from vmc_lib.motor.planning import exact_weights


def test_exact_weights_leave_the_arms_part_alone():
    mixed, reached = mixture_and_endpoint(exact_weights)
    np.testing.assert_allclose(mixed, TARGETS, atol=1e-9)
    part = 1000 * np.linalg.norm(reached - mixed, axis=-1).mean()
    np.testing.assert_allclose(mean_bias(exact_weights), part)


def test_nearest_templates_mix_another_place_than_quadrants():
    assert not np.allclose(mixture_and_endpoint(number=3)[0], mixture_and_endpoint()[0])
