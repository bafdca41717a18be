"""Static equilibrium of the arm."""

import numpy as np
import pytest
from scipy.optimize import linprog

from reproduce.measures import holding
from vmc_lib.arm import simulate
from vmc_lib.arm.arm26 import MODEL
from vmc_lib.arm.dynamics import hand
from vmc_lib.motor.inverse_dynamics import static_activation

LOW = np.radians([10, 60])


def test_the_least_activation_gives_the_torques_that_a_held_posture_needs():
    given = holding.muscle_torques(LOW) @ static_activation(LOW)
    np.testing.assert_allclose(given, holding.required_torques(LOW), atol=0.05)
    held = simulate.simulate(
        simulate.constant_excitation(static_activation(LOW), 0.1), LOW, static_activation(LOW)
    )
    assert np.degrees(np.abs(held.q[-1] - LOW)).max() < 1


def test_a_load_costs_the_work_of_lifting_it():
    extra = holding.required_torques(LOW, 2.0) - holding.required_torques(LOW)
    turn = np.array([0.02, -0.01])  # rad
    low, high = (hand(LOW + half)[1] for half in (-turn / 2, turn / 2))
    assert extra @ turn == pytest.approx(2 * -MODEL.opt.gravity[1] * (high - low), rel=1e-3)


def test_the_busiest_muscle_does_as_little_as_it_can():
    """As linear programming has it: the least bound on all activations that give the torques."""
    gain, needed = holding.muscle_torques(LOW), holding.required_torques(LOW, 1.0)
    below = np.column_stack([np.eye(6), -np.ones(6)])
    found = linprog([0] * 6 + [1], below, np.zeros(6), np.column_stack([gain, [0, 0]]), needed)
    assert holding.busiest(LOW, 1.0) == pytest.approx(found.fun, rel=1e-3)
