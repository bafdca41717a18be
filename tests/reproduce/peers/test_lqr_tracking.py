"""LQR tracking: undisturbed the plan itself; the gains; corrections near the end."""

from functools import cache

import numpy as np
import pytest

from reproduce.peers import lqr_tracking as feedback
from reproduce.peers import minimum_variance, motor_noise, optimal_control
from vmc_lib.motor.templates import keep_last, reach

TOLD = optimal_control.optimal_excitations()[optimal_control.INNER]
HELD = keep_last(TOLD)


@cache
def law():
    return feedback.feedback_law(TOLD)


@cache
def noise():
    shape = (30, *HELD.shape)
    return motor_noise.noise_factor(shape, minimum_variance.noise_share(), np.random.default_rng(2))


def test_without_noise_the_plan_is_executed():
    path, commands = feedback.move(law(), np.ones_like(HELD))
    np.testing.assert_allclose(path, reach(TOLD).hand[:, :: feedback.TICK, :2], atol=1e-9)
    np.testing.assert_allclose(commands, HELD, atol=1e-9)


def test_gradients_equal_finite_differences():
    rng = np.random.default_rng(0)
    state, commands = law().reference[0, 40], np.full((feedback.TICK, 6), 0.3)
    state = np.concatenate([state[:4], np.full(6, 0.2)])  # away from where Eq. 9 has its kink
    by, more = 1e-4 * rng.normal(size=10), 1e-4 * rng.normal(size=6)
    A, B = feedback.linearise(state, commands)
    difference = feedback.next_states(state + by, commands + more) - feedback.next_states(
        state - by, commands - more
    )
    np.testing.assert_allclose(difference / 2, A @ by + B @ more, rtol=1e-3, atol=1e-9)


@pytest.mark.parametrize("scale", [0.7, 1.3])
def test_no_larger_or_smaller_gain_costs_less(scale):
    """In the linear arm for which they are best, from a deviation at the start."""

    def cost(gains):
        off, paid = np.full(10, 0.01), 0.0
        for t, gain in enumerate(gains):
            change = -gain @ off
            paid += np.square(change / feedback.CHANGE).sum()
            off = law().A[0, t] @ off + law().B[0, t] @ change
            if t + 1 >= feedback.MOVING // feedback.TICK:
                reference = law().reference[0, t + 1]
                ends = feedback.observe(reference + 1e-4 * off) - feedback.observe(
                    reference - 1e-4 * off
                )
                paid += np.square(ends / 2e-4).sum()
        return paid

    assert cost(law().gains[0]) < cost(scale * law().gains[0])


def test_feedback_reduces_endpoint_scatter_most():
    """Steadier at the end than the same commands unwatched; half-way it leaves most as it is."""
    blind = np.array(
        [reach(np.clip(HELD * w, 0, 1), hold=0.0).hand[:, :: feedback.TICK, :2] for w in noise()]
    )
    now, late = (feedback.move(law(), noise(), late)[0] for late in (0, 12))  # ticks: 12, as sight
    alone, watched, foreseen = (feedback.scatter(x).mean(axis=0) for x in (blind, now, late))
    assert watched[-1] < 0.2 * alone[-1]
    assert watched[50] > 0.5 * alone[50]
    assert watched[-1] < foreseen[-1] < alone[-1]
