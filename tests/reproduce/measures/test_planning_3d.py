"""Planning in three dimensions: a template is repeated, corrections reduce the error."""

import numpy as np
import pytest

from reproduce.measures import planning_3d
from vmc_lib.arm.kinematics import TRUNK, to_world
from vmc_lib.motor import templates


@pytest.fixture(scope="module")
def flat():
    return templates.load(0.08)


@pytest.fixture(scope="module")
def memories(flat):
    return planning_3d.with_trunk_turns(flat)


def test_a_turn_carries_the_hand_about_the_trunk(memories):
    points = memories.points.reshape(-1, len(planning_3d.TURNS), 3)
    radius = np.linalg.norm(points[..., [0, 2]] - TRUNK, axis=-1)
    np.testing.assert_allclose(radius, np.broadcast_to(radius[:, :1], radius.shape))
    np.testing.assert_allclose(points[..., 1], np.broadcast_to(points[:, :1, 1], radius.shape))


def test_a_memory_alone_is_repeated(memories):
    again = memories.reach(memories.excitations[[7]])
    np.testing.assert_allclose(again.endpoint, memories.points[[7]])


def test_the_eight_memories_lie_round_the_target(flat, memories):
    target = to_world(np.array([0.15, -0.40, 0.06]), np.radians(30))
    points = memories.points[planning_3d.surrounding(target, flat)]
    assert np.all((points.min(axis=0) < target) & (target < points.max(axis=0)))


def test_practice_brings_the_hand_nearer(flat):
    places = np.array([[0.12, -0.40, 0.06], [0.17, -0.39, 0.06], [0.15, -0.42, 0.06]])
    targets = to_world(places, np.radians([12.0, 28, 44]))
    trials = planning_3d.plan_and_correct(targets, flat)
    planned, *_, last = trials.error
    np.testing.assert_allclose(trials.weights.sum(axis=-1), 1)
    assert np.all(last < 0.5 * planned)
    assert trials.movements[-1].bias.mean() < 0.1 * planned.mean()


def test_a_place_beyond_experience_is_refused(flat):
    with pytest.raises(ValueError, match="reach"):
        planning_3d.surrounding(np.array([0.9, -0.4, 0.1]), flat)
    with pytest.raises(ValueError, match="turn"):
        planning_3d.surrounding(to_world([0.15, -0.40, 0.06], np.radians(-30)), flat)


def test_each_correction_reduces_the_error():
    numbers = planning_3d.experiment(0, count=8, trials=2)
    assert 0 < numbers["planned / reach"] < 0.1
    assert 0 < numbers["in the plane"] < 0.1
    assert 0 < numbers["exact / reach"] < 0.7 * numbers["planned / reach"]
    assert 0 < numbers["corrected 2 ×"] < numbers["corrected 1 ×"] < 1
    assert numbers == planning_3d.experiment(0, count=8, trials=2)
