"""Eq. 9–11 and their guards."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from vmc_lib.arm import muscle

UNIT = st.floats(0, 1)
ANY = st.floats(-1e6, 1e6)


def test_the_curves_hold_the_papers_values():
    np.testing.assert_allclose(muscle.force_length(0.95), 1)
    np.testing.assert_allclose(
        muscle.force_velocity(np.array([-1, 0, 0.5])), [0.068, 1.011, 1.6], atol=1e-3
    )
    np.testing.assert_allclose(muscle.passive_force(1.22), 1.3 * np.arctan(0.1))
    np.testing.assert_allclose(muscle.activation_rate(1, 0), 100)
    np.testing.assert_allclose(muscle.activation_rate(0, 1), -25)


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
def test_force_velocity_is_guarded_beyond_its_range(v):
    low, high = muscle.force_velocity(np.array(muscle.VELOCITY_RANGE))
    assert low - 1e-12 <= muscle.force_velocity(v) <= max(high, 1.6) + 1e-12


@given(ANY)
def test_passive_force_does_not_push_below_its_range(length):
    assert 0 <= muscle.passive_force(length) < 1.3 * np.pi / 2 + 1e-12
    assert length > 0.22 or muscle.passive_force(length) == 0
