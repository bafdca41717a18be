"""Signal-dependent motor noise: its distribution and its strength."""

from functools import partial

import numpy as np
import pytest

from reproduce.peers import minimum_variance, motor_noise
from vmc_lib.motor.planning import draw_targets, exact_weights, plan
from vmc_lib.motor.templates import load, reach


def test_motor_noise_is_multiplicative_smooth_and_independent():
    commands = np.full((300, 1000, 6), 0.5) * [1, 1, 1, 1, 0.5, 0]
    noise = motor_noise.with_noise(commands, 0.1, np.random.default_rng(0)) - commands
    np.testing.assert_allclose(noise.std(axis=(0, 1))[:5], [0.05] * 4 + [0.025], rtol=0.05)
    assert not noise[..., 5].any()
    together = np.corrcoef(noise.reshape(-1, 6)[::50, :5].T)
    assert np.abs(together - np.eye(5)).max() < 0.1
    assert np.corrcoef(noise[:, 500, 0], noise[:, 510, 0])[0, 1] > 0.95  # 10 ms later
    assert abs(np.corrcoef(noise[:, 300, 0], noise[:, 800, 0])[0, 1]) < 0.2


@pytest.mark.audit
def test_noise_share_gives_the_endpoint_deviation():
    """Other targets than those by which it was set, and other noise; one share of it ships."""
    mm = minimum_variance.LEVEL
    targets = draw_targets(load(), 200, np.random.default_rng(1))
    commands = np.tile(plan(targets, load(), exact_weights).excitations, (5, 1, 1, 1))
    share = motor_noise.noise_share_for(mm)
    noise = partial(motor_noise.with_noise, share=share, rng=np.random.default_rng(2))
    ends = motor_noise.noisy_reach(noise, commands).endpoint
    assert 1000 * motor_noise.endpoint_deviation(ends) == pytest.approx(mm, rel=0.15)
    assert share == pytest.approx(minimum_variance.noise_share(), rel=1e-6)


def test_noise_lasts_through_the_hold():
    """Were the last moment's noise kept on, the hand would drift with it."""
    seen = []
    commands = plan([0.09, -0.39], load()).excitations
    motion = motor_noise.noisy_reach(lambda u: seen.append(u) or u, commands)
    assert seen[0].shape == (1500, 6)
    np.testing.assert_array_equal(motion.q, reach(commands).q)
    np.testing.assert_array_equal(motion.hold, reach(commands).hold)


def test_impossible_noise_is_refused():
    with pytest.raises(ValueError, match="500 mm"):
        motor_noise.noise_share_for(500)
