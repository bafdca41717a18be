"""Inverse kinematics and the trunk's turn undo the forward ones, or say why not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics, rotate_by_turn, to_world, turn_towards

ANGLE = st.floats(np.radians(-59), np.radians(59))  # inside the trunk's range, not on its edge


@settings(max_examples=40, deadline=None)
@given(ANGLE, st.floats(np.radians(8), np.radians(129)))
def test_inverse_kinematics_inverts_forward_kinematics(shoulder, elbow):
    q = np.array([shoulder, elbow])
    np.testing.assert_allclose(inverse_kinematics(hand(q)[:2]), q, atol=1e-8)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.05, 0.25), st.floats(-0.43, -0.33), ANGLE)
def test_turn_towards_inverts_to_world(x, y, psi):
    target = to_world(hand(inverse_kinematics([x, y])), psi)
    turn, p = turn_towards(target)
    np.testing.assert_allclose([turn, *p], [psi, x, y], atol=1e-8)


def test_positive_turns_are_to_the_left():
    ahead = np.array([0.3, -0.4, -0.17])
    assert to_world(ahead, 0.5)[2] < ahead[2]


def test_a_turn_rotates_what_lies_between_two_points():
    points, turns = np.array([[0.3, -0.4, -0.1], [0.1, 0.2, 0.3]]), np.array([0.5, -0.8])
    between = to_world(points, turns) - to_world(np.zeros_like(points), turns)
    np.testing.assert_allclose(rotate_by_turn(points, turns), between, atol=1e-15)


@pytest.mark.parametrize(
    ("target", "complaint"),
    [
        ((1.0, -0.4, 0.1), r"\[ 1\.  -0\.4  0\.1\] m lies beyond the arm's reach"),
        ((0.1, 0.9, 0.1), r"\[0\.1 0\.9 0\.1\] m lies beyond the arm's reach"),
        ((0.0, -0.4, -0.17), "beyond the arm's reach"),
        ((-0.3, -0.4, 0.0), "needs a turn"),
        ((np.nan, -0.4, 0.0), "must be finite"),
        ((0.3, -0.4), r"of shape \(…, 3\)"),
    ],
)
def test_unreachable_targets_are_refused(target, complaint):
    with pytest.raises(ValueError, match=complaint):
        turn_towards(target)


def test_error_names_the_unreachable_position_of_a_batch():
    with pytest.raises(ValueError, match=r"position \[0\.6 0\.1\] m"):
        inverse_kinematics([[0.15, -0.4], [0.6, 0.1]])


def test_turn_towards_of_a_batch_equals_one_by_one():
    places = np.array([[0.25, -0.4, 0.1], [0.2, -0.38, 0.05], [-0.3, -0.4, 0.0]])
    turns, points = turn_towards(places[:2])
    for place, turn, point in zip(places, turns, points, strict=False):
        alone = turn_towards(place)
        np.testing.assert_allclose([turn, *point], [alone[0], *alone[1]], atol=1e-12)
    with pytest.raises(ValueError, match=r"\[-0\.3 -0\.4  0\. \] m needs a turn"):
        turn_towards(places)
