"""Eq. 9–11 and their guards."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reproduce.peers.muscle_models import LAWS
from vmc_lib.arm import muscle

UNIT = st.floats(0, 1)
ANY = st.floats(-1e6, 1e6)


def test_muscle_curves_at_published_values():
    np.testing.assert_allclose(muscle.force_length(0.95), 1)
    np.testing.assert_allclose(
        muscle.force_velocity(np.array([-1, 0, 0.5])), [0.068, 1.011, 1.6], atol=1e-3
    )
    np.testing.assert_allclose(muscle.passive_force(1.22), 1.3 * np.arctan(0.1))
    np.testing.assert_allclose(muscle.activation_rate(1, 0), 100)
    np.testing.assert_allclose(muscle.activation_rate(0, 1), -25)


def test_laws_take_lists_and_what_euler_rounds():
    np.testing.assert_allclose(muscle.force_length([0.95, 0.95]), 1)
    np.testing.assert_allclose(muscle.force([0, 0], [0.2] * 2, 0, maximum=[1, 2]), 0)
    assert muscle.activation_rate(1, 1 + 2e-16) <= 0
    with pytest.raises(TypeError, match="positional"):
        muscle.force_length(1, 2)


@given(UNIT, UNIT)
def test_activation_moves_towards_excitation(u, a):
    rate = muscle.activation_rate(u, a)
    assert rate * (u - a) >= 0
    assert 0 <= a + 0.001 * rate <= 1


@given(UNIT, UNIT)
def test_excitation_for_inverts_activation_rate(u, a):
    rate = muscle.activation_rate(u, a)
    np.testing.assert_allclose(muscle.excitation_for(a, rate), u, atol=1e-7)


@given(ANY)
def test_force_velocity_is_bounded(v):
    low, high = muscle.force_velocity(np.array(muscle.VELOCITY_RANGE))
    assert low - 1e-12 <= muscle.force_velocity(v) <= max(high, 1.6) + 1e-12


@given(ANY)
def test_passive_force_is_bounded_and_positive(length):
    assert 0 <= muscle.passive_force(length) < 1.3 * np.pi / 2 + 1e-12
    assert length > 0.22 or muscle.passive_force(length) == 0


def test_motor_noise_grows_with_the_command():
    weak, strong = (
        muscle.noisy(np.full(20_000, u), 0.2, np.random.default_rng(0)) for u in (0.1, 0.4)
    )
    np.testing.assert_allclose([weak.mean(), strong.mean()], [0.1, 0.4], rtol=0.01)
    np.testing.assert_allclose([weak.std(), strong.std()], [0.02, 0.08], rtol=0.03)
    assert muscle.noisy(np.ones(1000), 0.5, np.random.default_rng(1)).max() == 1


@given(UNIT, st.floats(0.2, 2), st.floats(-2, 2))
def test_mujoco_force_law_equals_mujoco(a, length, v):
    constants = np.array([0, 1, 1, 0, 0.5, 1.6, 1.5, 1.3, 1.2])  # its defaults, with F0 = l0 = 1
    gain = mujoco.mju_muscleGain(length, muscle.MAX_VELOCITY * v, (0, 1), 0, constants)
    bias = mujoco.mju_muscleBias(length, (0, 1), 0, constants)
    force = LAWS["MuJoCo"].force(a, length, v, 1.0)
    np.testing.assert_allclose(force, -gain * a - bias, atol=1e-12)


@given(UNIT, UNIT)
def test_mujoco_activation_law_equals_mujoco(u, a):
    taus = np.array([muscle.TAU_ACTIVATION, muscle.TAU_DEACTIVATION, 0])
    rate = LAWS["MuJoCo"].activation_rate(u, a)
    np.testing.assert_allclose(rate, mujoco.mju_muscleDynamics(u, a, taus), rtol=1e-12, atol=1e-12)


@given(st.floats(0.05, 1), st.floats(0.5, 1.5), st.floats(-1, 1.5))
def test_thelen_force_satisfies_his_equation(a, length, v):
    """Eq. 6 of Thelen (2003) gives the speed of an active fibre from its force; ours, the force."""
    thelen = LAWS["Thelen 2003"].force
    passive = thelen(0.0, length, v, 1.0)
    active, most = thelen(a, length, v, 1.0) - passive, a * np.exp(-((length - 1) ** 2) / 0.5)
    resists = most + active / 0.3
    if active > most:
        resists = (2 + 2 / 0.3) * (1.8 * most - active) / 0.8
    speed = (0.25 + 0.75 * a) * 10 * (active - most) / resists
    np.testing.assert_allclose(speed, v * muscle.MAX_VELOCITY, atol=1e-9)


@pytest.mark.parametrize("name", LAWS)
def test_every_muscle_pulls_and_never_pushes(name):
    a, length, v = np.meshgrid(
        np.linspace(0, 1, 5), np.linspace(0.2, 2, 30), np.linspace(-4, 4, 41)
    )
    assert np.all(LAWS[name].force(a, length, v, 1.0) >= 0)
