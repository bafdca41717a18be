"""Minimum-variance control: scatter beside rival rules, gradients, jerk."""

from functools import partial

import numpy as np
import pytest

from reproduce.peers import minimum_variance, optimal_control
from reproduce.peers.motor_noise import noisy_reach, with_noise
from vmc_lib.motor import templates
from vmc_lib.motor.inverse_dynamics import minimum_jerk_profile


def test_no_template_lies_on_the_targets():
    away = optimal_control.TARGETS[optimal_control.INNER][:, None] - templates.load().points
    assert np.linalg.norm(away, axis=-1).min() > 0.009


def test_least_variance_has_the_least_scatter():
    rules = minimum_variance.measures_by_rule(np.random.default_rng(1), repeats=40)
    scatter = {name: rows["scatter"].mean() for name, rows in rules.items()}
    assert min(scatter, key=scatter.get) == "steadiest"
    assert all(len(values) == 6 for rows in rules.values() for values in rows.values())


def test_least_variance_beats_least_effort_at_every_target():
    cheapest, steadiest = (optimal_control.arrays(name)["knots"] for name in ("optimal", "steady"))
    for knots in zip(steadiest, cheapest[optimal_control.INNER], strict=True):
        low, high = (minimum_variance.variance(x.astype(float)) for x in knots)
        assert low < high


def test_linearised_variance_equals_that_of_many_reaches():
    """To first order, and at the moments that count."""
    x = optimal_control.arrays("optimal")["knots"][12].astype(float)
    commands = np.tile(optimal_control.excitations_from_knots(x), (400, 1, 1))
    noise = partial(with_noise, share=0.04, rng=np.random.default_rng(0))
    many = noisy_reach(noise, commands).hand[:, minimum_variance.MOMENTS, :2]
    deviation = 10 * many.std(axis=0, ddof=1)
    assert np.sqrt(np.square(deviation).mean()) / 0.04 == pytest.approx(
        np.sqrt(minimum_variance.variance(x)), rel=0.1
    )


def test_gradients_equal_finite_differences():
    x = optimal_control.arrays("optimal")["knots"][12].astype(float) + 0.02
    slope = minimum_variance.variance_gradient(x)
    size = 8e-3 * np.linalg.norm(slope)
    for way in slope, np.random.default_rng(0).normal(size=x.size):
        step = 8e-3 * way / np.linalg.norm(way)
        change = minimum_variance.variance(x + step) - minimum_variance.variance(x - step)
        assert 2 * slope @ step == pytest.approx(change, rel=0.05, abs=0.03 * size)


def test_jerk_of_a_minimum_jerk_path_is_one():
    way = minimum_jerk_profile(np.arange(1001) / 700)[:, None] * [0.1, 0.2]
    assert minimum_variance.jerk(way[::10]) == pytest.approx(1)
    rough = way + 0.001 * np.sin(np.arange(1001) / 20)[:, None]
    assert minimum_variance.jerk(rough[None, ::10]) > 1.5
