"""The ablation of torques, against the simulator."""

import numpy as np
import pytest

from reproduce.measures.effects_off import joint_rotations
from vmc_lib.arm import simulate

START, BRA = np.radians([-20, 95]), [0, 0, 0, 0, 0, 0.5]


def motion(excitation, seconds=0.1):
    commands = simulate.constant_excitation(excitation, seconds)
    return simulate.simulate(commands, START, np.zeros(6))


def test_with_nothing_off_it_is_the_simulated_movement():
    pulled = motion([0.1, 0, 0.2, 0, 0.1, 0.5])
    assert joint_rotations(pulled) == pytest.approx(pulled.q[-1] - START, abs=1e-9)


def test_an_uncoupled_shoulder_is_not_thrown_by_the_forearm():
    """The brachialis, which spans the elbow, then does nothing to it in the first two steps."""
    pulled, slack = motion(BRA, 0.002), motion([0] * 6, 0.002)
    alone = joint_rotations(pulled, coupled=False) - joint_rotations(slack, coupled=False)
    thrown = joint_rotations(pulled) - joint_rotations(slack)
    assert alone[0] == pytest.approx(0, abs=1e-12)
    assert thrown[0] < 0 < alone[1]


def test_a_constant_muscle_pulls_as_at_the_start():
    first, long = motion([0] * 6, 0.001), motion([0] * 6)
    assert joint_rotations(first, constant=["TRIlong"]) == pytest.approx(joint_rotations(first))
    assert abs(joint_rotations(long, constant=["TRIlong"]) - joint_rotations(long)).max() > 1e-3
