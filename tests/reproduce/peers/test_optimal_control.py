"""Optimal control: at the target, at rest, and with less effort than habit."""

import numpy as np
import pytest

from reproduce.peers import optimal_control
from vmc_lib.motor import templates
from vmc_lib.motor.planning import exact_weights, plan


def test_every_optimum_is_at_its_target_and_stays():
    motion = templates.reach(optimal_control.optimal_excitations())
    hand = motion.hand[:, [700, 1000], :2]
    assert np.linalg.norm(hand - optimal_control.TARGETS[:, None], axis=-1).max() < 1e-3
    assert np.abs(motion.velocity[..., -1, :]).max() < 0.02


def test_every_optimum_costs_less_than_habit():
    efforts = optimal_control.effort(optimal_control.optimal_excitations())
    for rule in (None, exact_weights):
        habit = plan(optimal_control.TARGETS, templates.load(), *([rule] if rule else []))
        share = efforts / optimal_control.effort(habit.excitations)
        assert share.max() < 1.05  # habit saves a little where it misses: it need not be there
        assert np.median(share) < 0.5


def test_mixed_optima_cost_little_more():
    """The price of habit is its templates', not the mixing's."""
    cheap = optimal_control.mix_optima()
    np.testing.assert_allclose(cheap.weights, 0.25, atol=1e-3)  # half-way between all four
    efforts = optimal_control.effort(optimal_control.optimal_excitations())[optimal_control.INNER]
    habit = plan(cheap.target, templates.load())
    mixed, shipped = (
        np.mean(optimal_control.effort(p.excitations) / efforts) for p in (cheap, habit)
    )
    assert mixed < 1.5 < 3 < shipped


def test_shipped_optima_are_reproducible():
    effort = optimal_control.effort(optimal_control.solve(optimal_control.TARGETS[12]))
    shipped = optimal_control.effort(optimal_control.optimal_excitations()[12])
    np.testing.assert_allclose(effort, shipped, rtol=0.01)


def test_gradients_equal_finite_differences():
    x = np.random.default_rng(0).uniform(0.02, 0.2, 6 * optimal_control.KNOTS)
    step = 1e-5 * np.random.default_rng(1).normal(size=x.size)
    change = optimal_control._ends(x + step) - optimal_control._ends(x - step)
    np.testing.assert_allclose(2 * optimal_control._end_gradients(x) @ step, change, atol=2e-6)


def test_effort_is_the_mean_square():
    assert optimal_control.effort(np.full((3, 10, 6), 0.5)) == pytest.approx([0.25] * 3)


def test_targets_outside_are_refused():
    with pytest.raises(ValueError, match="not surrounded"):
        optimal_control.solve(np.array([0.5, -0.4]))
