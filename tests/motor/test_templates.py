"""Movement templates are held still on their grid, and can be found again."""

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.optimize import lsq_linear

from reproduce.training import reach_templates
from vmc_lib import photos
from vmc_lib.arm.kinematics import inverse_kinematics, turn_towards
from vmc_lib.data import arrays
from vmc_lib.motor import inverse_dynamics, templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import is_surrounded, plan

HOLD = round(1000 * templates.HOLD)  # ms


@pytest.mark.parametrize("spacing", templates.SPACINGS)
def test_templates_end_at_rest_on_their_points(spacing):
    template_set = templates.load(spacing)
    motion = templates.reach(template_set.excitations)
    grid = reach_templates.reachable_grid(spacing)
    assert np.linalg.norm(motion.endpoint - grid, axis=-1).max() < 2e-4
    still = execute(plan(template_set.points, template_set, rows=np.arange(len(grid))[:, None]))
    assert still.speed.max() < 0.002
    assert still.stray.max() < 0.0005
    np.testing.assert_array_equal(template_set.points, motion.endpoint)


@pytest.mark.parametrize("hold", [0.25, 0.5, 1.0])
def test_speed_is_the_paths_length_over_the_holds_time(hold):
    movement = execute(plan([0.15, -0.4], templates.load(hold=hold)))
    path = movement.motion.hand[-1 - round(1000 * hold) :: templates.EVERY, :2]
    length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    assert movement.speed == pytest.approx(length / hold)
    assert movement.motion.speed == pytest.approx(length / hold)


def test_without_a_hold_there_is_no_speed():
    movement = execute(plan([0.15, -0.4], templates.load(hold=0.0)))
    for speed in (lambda: movement.speed, lambda: movement.motion.speed):
        with pytest.raises(ValueError, match="a hold of 0 s: give a longer hold"):
            speed()


def test_mujoco_reaches_the_same_points():
    template_set = templates.load(0.08)
    compiled = templates.reach(template_set.excitations[:4]).hand[:, -1 - HOLD, :2]
    motion = templates.simulate(template_set.excitations[:4], templates.START, engine="mujoco")
    np.testing.assert_allclose(motion.endpoint, compiled, atol=1e-6)


@pytest.mark.parametrize("level", photos.LEVELS)
def test_template_sets_surround_every_shuttlecock(level):
    shots = [shot for split in photos.SPLITS for shot in photos.load(level, split)]
    places = np.array([turn_towards(shot.target)[1] for shot in shots])
    for spacing in templates.SPACINGS:
        assert is_surrounded(places, templates.load(spacing).points).all()


def test_shipped_templates_are_reproducible():
    goal = reach_templates.reachable_grid(0.08)[5]
    again = inverse_dynamics.spline() @ reach_templates.find_reach(goal)
    np.testing.assert_allclose(templates.reach(again, hold=0).endpoint, goal, atol=1e-6)
    np.testing.assert_allclose(again, templates.load(0.08).excitations[5], atol=1e-3)
    rest = inverse_dynamics.static_activation(templates.START)
    np.testing.assert_allclose(arrays("rest")["activation"], rest, atol=1e-6)


def test_splines_equal_scipys():
    knots = inverse_dynamics.KNOTS
    edges = np.concatenate([[0] * 3, np.linspace(0, 1, knots - 2), [1] * 3])
    x = np.linspace(0, 1, inverse_dynamics.SAMPLES)
    expected = BSpline.design_matrix(x, edges, 3).toarray()
    np.testing.assert_allclose(inverse_dynamics.spline(), expected, atol=1e-14)


def test_bounded_least_squares_equal_scipys():
    rng = np.random.default_rng(0)
    for _ in range(20):
        torque, gain = inverse_dynamics.required_torque(np.tile(rng.uniform(-1, 2, 2), (2, 1)))
        matrix, wanted = np.vstack([gain[0], 0.01 * np.eye(6)]), np.append(torque[0], np.zeros(6))
        expected = lsq_linear(matrix, wanted, (0, 1), method="bvls").x
        found = inverse_dynamics.bounded_least_squares(matrix, wanted)
        np.testing.assert_allclose(found, expected, atol=1e-10)


def test_static_activation_holds_the_posture():
    q = inverse_kinematics([0.12, -0.4])
    motion = templates.simulate(np.tile(inverse_dynamics.static_activation(q), (300, 1)), q)
    np.testing.assert_allclose(motion.q[-1], q, atol=0.02)


def test_an_unknown_spacing_is_refused():
    with pytest.raises(ValueError, match=r"0\.05 m apart"):
        templates.load(0.05)
