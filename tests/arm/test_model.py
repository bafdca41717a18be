"""The arm is OpenSim's arm26, and its trigonometric polynomials are the same arm again."""

from itertools import product

import mujoco
import numpy as np
import pytest

from reproduce.results import arrays
from reproduce.training import arm_tables
from vmc_lib.arm import dynamics
from vmc_lib.arm.arm26 import MODEL, forward, geometry, mass_matrix, muscle_paths
from vmc_lib.arm.model import DAMPING, F0, L0, LIMITS, MUSCLES, SLACK, STEP, XML

MILLIMETRE = 1e-3


@pytest.fixture(scope="module")
def opensim():
    reference = arrays("opensim")
    shoulder = np.degrees(reference["q"][:, 0])
    within = (shoulder > -71) & (shoulder < 31)  # beyond, OpenSim's own paths jump
    return reference | {k: reference[k][within] for k in ("q", "lengths", "arms", "wrist")}


@pytest.fixture(scope="module")
def ours(opensim):
    poses = [forward(q) for q in opensim["q"]]
    lengths, arms = zip(*[muscle_paths(pose) for pose in poses], strict=True)
    return np.array(lengths), np.array(arms), np.array([p.site("hand").xpos for p in poses])


def test_parameters_are_those_that_mujoco_reads():
    assert [MODEL.tendon(k).name for k in range(MODEL.ntendon)] == list(MUSCLES)
    for name, values in (("F0", F0), ("L0", L0), ("slack", SLACK)):
        np.testing.assert_array_equal(MODEL.numeric(name).data, values)
    np.testing.assert_array_equal(MODEL.jnt_range, LIMITS)
    np.testing.assert_array_equal(MODEL.dof_damping, DAMPING)
    assert MODEL.opt.timestep == STEP


def test_opensim_reference_covers_the_joint_range(opensim):
    assert len(opensim["q"]) == 21 * 14
    np.testing.assert_allclose(np.degrees(opensim["q"].min(axis=0)), [-70, 0], atol=1e-9)
    np.testing.assert_allclose(np.degrees(opensim["q"].max(axis=0)), [30, 130])


def test_wrist_position_equals_opensim(opensim, ours):
    assert np.abs(ours[2] - opensim["wrist"]).max() < 1e-9


@pytest.mark.parametrize("muscle", MUSCLES)
def test_muscle_paths_equal_opensim(opensim, ours, muscle):
    k = MUSCLES.index(muscle)
    length, arm = (0.6, 1.0) if muscle == "BIClong" else (0.05, 0.3)
    assert np.abs(ours[0] - opensim["lengths"])[:, k].max() < length * MILLIMETRE
    assert np.abs(ours[1] - opensim["arms"])[..., k].max() < arm * MILLIMETRE


def test_fall_without_muscles_equals_opensim(opensim):
    bare = mujoco.MjModel.from_xml_string(XML)
    bare.dof_damping[:] = 0
    bare.opt.timestep, bare.opt.integrator = 1e-4, mujoco.mjtIntegrator.mjINT_RK4
    for start, end in zip(opensim["released"], opensim["swung"], strict=True):
        data = mujoco.MjData(bare)
        data.qpos = start
        mujoco.mj_step(bare, data, 5000)
        assert np.abs(data.qpos - end).max() < 1e-6


def test_muscle_paths_are_continuous():
    for joint, other in product(range(2), (0.0, 1.0, 2.0)):
        q = np.full((3000, 2), other)
        q[:, joint] = np.linspace(*LIMITS[joint], len(q))
        angle = q[1, joint] - q[0, joint]
        lengths, arms = dynamics.paths(q)
        assert np.abs(np.diff(arms, axis=0)).max() < 0.15 * angle  # m: steep is no jump
        slope = -np.diff(lengths, axis=0) / angle
        between = (arms[:-1, joint] + arms[1:, joint]) / 2
        assert np.abs(slope - between).max() < 1e-5  # a length that jumped would leave its slope


def test_an_angle_that_is_no_number_gives_none():
    lengths, arms = dynamics.paths([[0, np.nan], [0, 1]])
    assert np.isnan(lengths[0]).all()
    assert np.isnan(arms[0, 1]).all()
    assert np.isfinite(lengths[1]).all()
    assert np.isfinite(arms[1]).all()


def test_closed_form_dynamics_equal_mujoco():
    rng = np.random.default_rng(0)
    q = rng.uniform(*LIMITS.T, (200, 2))
    velocity, acceleration = rng.normal(scale=3, size=(2, 200, 2))
    torque = dynamics.torque_for(q, velocity, acceleration)
    lengths, arms = dynamics.paths(q)
    for k, pose in enumerate(map(forward, q, velocity)):
        inertia = mass_matrix(pose) + STEP * np.diag(DAMPING)
        expected = inertia @ acceleration[k] + pose.qfrc_bias + DAMPING * velocity[k]
        np.testing.assert_allclose(torque[k], expected, atol=1e-11)
        np.testing.assert_allclose(dynamics.hand(q[k]), pose.site("hand").xpos, atol=1e-14)
        np.testing.assert_allclose(lengths[k], muscle_paths(pose)[0], atol=1e-8)
        np.testing.assert_allclose(arms[k], muscle_paths(pose)[1], atol=1e-6)
    back = dynamics.forward_dynamics(q, velocity, torque)
    np.testing.assert_allclose(back, acceleration, atol=1e-10)


def test_closed_forms_that_ship_equal_mujoco():
    table = np.swapaxes(arm_tables.path_table(), 1, 2)
    np.testing.assert_allclose(dynamics.tables()[..., :12], table, rtol=0, atol=dynamics.UNIT)
    for load in (0, 0.7, 10):
        shipped = np.hstack(dynamics.coefficients(load))
        np.testing.assert_allclose(shipped, arm_tables.coefficients(load), rtol=0, atol=2e-9)


def test_a_load_is_a_point_at_the_wrist():
    """It weighs as the hand rises (m g dy/dq), and resists as the hand moves (m Jᵀ J)."""
    q, turns, mass = np.radians([20.0, 90.0]), np.eye(2), 0.7
    jacobian = np.transpose([dynamics.hand(q + t) - dynamics.hand(q - t) for t in 1e-5 * turns])
    jacobian /= 2e-5
    still = np.zeros((2, 2))
    weight, pull = (
        dynamics.torque_for([q, q], still, turn, mass) - dynamics.torque_for([q, q], still, turn)
        for turn in (still, turns)
    )
    np.testing.assert_allclose(weight[0], mass * -MODEL.opt.gravity[1] * jacobian[1], atol=1e-6)
    np.testing.assert_allclose(pull - weight, mass * jacobian.T @ jacobian, atol=1e-6)


def test_geometry_agrees_with_hand_and_lengths():
    q = np.radians([-20.0, 80.0])
    bodies, muscles = geometry(q)
    rotation, elbow = bodies["forearm"]
    wrist = rotation @ MODEL.site("hand").pos + elbow
    np.testing.assert_allclose(wrist, dynamics.hand(q), atol=1e-12)
    lengths, _ = dynamics.paths(q)
    for name, length in zip(MUSCLES, lengths, strict=True):
        chords = np.linalg.norm(np.diff(muscles[name], axis=0), axis=1).sum()
        assert 0.99 * length < chords <= length + 1e-8  # a chord cuts the corner of a wrap
