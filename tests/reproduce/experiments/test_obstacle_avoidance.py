"""Obstacle avoidance: the planned path, and that of the arm under feedback, are free."""

import numpy as np
import pytest

from reproduce.experiments import feedback_control, obstacle_avoidance
from vmc_lib.motor.feedback import ReferenceTrajectory, reference_trajectory
from vmc_lib.motor.templates import load


@pytest.fixture(scope="module")
def plans():
    targets, balls = obstacle_avoidance.obstacles(load(), 5, np.random.default_rng(3))
    pairs = [
        obstacle_avoidance.plan_around(*pair, load()) for pair in zip(targets, balls, strict=True)
    ]
    way = ReferenceTrajectory(
        *(np.concatenate(parts) for parts in zip(*(w for _, w in pairs), strict=True))
    )
    return targets, balls, way


def test_second_path_avoids_the_ball(plans):
    """The first, straight one meets it."""
    targets, balls, way = plans
    straight = obstacle_avoidance.reference_paths(
        reference_trajectory(feedback_control.exact_plans(targets, load()))
    )
    assert obstacle_avoidance.clearance(straight, balls).max() < 0.001
    assert np.linalg.norm(straight[:, -1] - straight[:, 0], axis=-1).min() > obstacle_avoidance.LONG
    ways = obstacle_avoidance.reference_paths(way)
    assert obstacle_avoidance.clearance(ways, balls).min() > obstacle_avoidance.APART
    np.testing.assert_allclose(ways[:, -1], targets, atol=1e-6)


def test_arm_under_feedback_avoids_the_ball_and_arrives():
    detours = obstacle_avoidance.simulate_detours(load(), np.random.default_rng(0), 5)
    arm = "forward model"
    assert detours.touches("straight", arm).all()
    assert not detours.touches("by a via-point", arm).any()
    assert detours.miss("by a via-point", arm).max() < 0.01


def test_unavoidable_ball_is_refused(monkeypatch):
    monkeypatch.setattr(obstacle_avoidance, "APART", 1.0)
    with pytest.raises(ValueError, match="move the ball"):
        obstacle_avoidance.plan_around(np.array([0.07, -0.42]), np.array([0.1, -0.4]), load())
