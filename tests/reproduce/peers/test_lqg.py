"""LQG control: Riccati and Kalman by other formulas, late reports, and what nobody asked for."""

from functools import cache

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from reproduce.experiments import rival_controllers as rivals
from reproduce.peers import lqg
from reproduce.peers.state_estimation import estimate, kalman_gains
from vmc_lib.arm.muscle import activation_rate
from vmc_lib.motor.feedback import TICK

TARGET = rivals.TARGETS[9]
SHARE = 0.1  # of a command, at each tick


@cache
def law(axes=lqg.EVERY_WAY, jump=(0.0, 0.0)):
    return rivals.lqg_law(TARGET + np.array(jump), axes=axes)


def test_gains_far_from_the_end_are_those_of_the_algebraic_riccati_equation():
    """Of the muscles that no bound holds: SciPy's formula, for an arm at rest on its target."""
    still, told = np.tile(lqg.rest(), (400, 1)), np.full((399, 6), 0.3)
    A, B = lqg.linearise(still[:-1], np.repeat(told[:, None], TICK, axis=1))
    target = lqg.hand(still[0, :2])[:2] + np.array([0, 0.01])
    _, gains = lqg.riccati(still, told, A, B, target, price=5.0)
    C, free = lqg.task_slopes(still)[-1], gains[150].any(axis=1)
    b = B[0][:, free]
    assert free.any()
    assert not free.all()
    S = solve_discrete_are(A[0], b, C.T @ C, 5.0 * np.eye(free.sum()))
    best = np.linalg.solve(5.0 * np.eye(free.sum()) + b.T @ S @ b, b.T @ S @ A[0])
    np.testing.assert_allclose(gains[150][free], best, rtol=1e-3, atol=1e-4)


def test_commands_are_within_bounds_and_no_small_change_is_cheaper():
    rng, calm = np.random.default_rng(0), rivals.lqg_law(TARGET, 0.0)
    paid = lqg.cost(calm.reference, calm.commands, TARGET)
    bumps = 0.01 * rng.standard_normal((20, 1, 6)) * np.hanning(len(calm.commands))[:, None]
    tried = lqg.roll_out(calm.commands, change=bumps)
    assert (lqg.cost(*tried, TARGET) > 0.999 * paid).all()
    assert calm.commands.min() >= 0
    assert calm.commands.max() <= 1


def test_without_delay_the_filter_is_that_of_state_estimation():
    spread = SHARE * law().B * law().commands[:, None]
    C = np.broadcast_to(lqg.SENSED, (len(law().A), 4, 10))
    other = kalman_gains(law().A, C, spread @ np.swapaxes(spread, -1, -2), lqg.ERRORS)
    np.testing.assert_allclose(lqg.filter_gains(law(), 0, SHARE), other)


def test_a_late_report_gives_the_estimate_of_then_carried_on_to_now():
    late, reports = 3, 0.01 * np.random.default_rng(0).standard_normal((40, 4))
    A = law().A[:40]
    some = lqg.Law(*(x[:40] for x in law()))
    now, then = (
        estimate(*lqg.augment(A, d), lqg.filter_gains(some, d, SHARE), given)
        for d, given in ((0, reports), (late, np.vstack([np.zeros((late, 4)), reports[:-late]])))
    )
    x = now[30 - late]
    for a in A[31 - late : 31]:
        x = a @ x
    np.testing.assert_allclose(then[30, :10], x, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("late", [0, 12])
def test_without_noise_the_reference_is_followed(late):
    filters = lqg.filter_gains(law(), late, SHARE)
    ticks = len(law().commands)
    still = np.zeros((1, ticks, TICK, 6)), np.zeros((1, ticks, 4))
    states, sent = lqg.steer(law(), filters, 0.0, *still)
    np.testing.assert_allclose(states[0], law().reference, atol=1e-9)
    np.testing.assert_allclose(sent[0], law().commands, atol=1e-9)


def test_with_prompt_and_exact_senses_it_is_lqr():
    """The same reaches as by feedback that knows the whole state; 120 ms later, others."""
    luck, ends = rivals.draw_luck(4, 3), {}
    draws = np.swapaxes(luck.noise, 0, 1).reshape(4, -1, TICK, 6)
    for late in (0, 12):
        filters = lqg.filter_gains(law(), late, SHARE, lqg.ERRORS / 100)
        states, _ = lqg.steer(law(), filters, 0.3, draws, np.zeros((4, len(law().A), 4)))
        ends[late] = lqg.hand(states[:, 80:, :2])
    now, way = np.tile(lqg.rest(), (4, 1)), []
    for t, told in enumerate(law().commands):
        u = np.clip(told - (now - law().reference[t]) @ law().gains[t].T, 0, 1)
        u = np.interp(u, *lqg.mean_pulls(0.3)[::-1])[:, None] * (1 + 0.3 * draws[:, t])
        now = lqg.next_states(now, np.clip(u, 0, 1))
        way.append(now)
    exact = lqg.hand(np.stack(way, axis=1)[:, 79:, :2])
    off = {late: np.abs(end - exact).max() for late, end in ends.items()}
    assert off[0] < 0.0005 < off[12]


def test_mean_pulls_are_those_of_equation_9():
    """Of a command that jumps between two levels, by hand; without noise every pull is its own."""
    assert activation_rate(0.6, 0.5) > -activation_rate(0.4, 0.5)
    levels, pulls = lqg.mean_pulls(0.4)
    assert (pulls[10:30] > levels[10:30]).all()
    levels, pulls = lqg.mean_pulls(0.0)
    np.testing.assert_allclose(pulls, levels, atol=1e-9)


@pytest.mark.audit
def test_a_jump_is_followed_where_it_matters_and_left_alone_where_not():
    """A point that jumps up by 5 cm; and an upright bar, of which only forward is paid for."""
    luck, moved = rivals.draw_luck(4, 3), {}
    for axes in (lqg.EVERY_WAY, (1.0, 0.0)):
        first, second = law(axes), law(axes, (0.0, 0.05))
        ends = [
            rivals.lqg_paths(one, luck)[0][:, -1].mean(axis=0)
            for one in (first, lqg.switch(first, second, 27))
        ]
        moved[axes] = 1000 * (ends[1] - ends[0])[1]
    assert moved[lqg.EVERY_WAY] > 45
    assert abs(moved[1.0, 0.0]) < 5
