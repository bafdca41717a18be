"""The arm is OpenSim's arm26, and its closed form is the same arm again."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from vmc_lib.arm import closed_form
from vmc_lib.arm.model import (
    DAMPING,
    LIMITS,
    MODEL,
    MUSCLES,
    STEP,
    forward,
    geometry,
    mass_matrix,
    muscle_paths,
)

MILLIMETRE = 1e-3


@pytest.fixture(scope="module")
def opensim():
    with np.load(Path(__file__).with_name("opensim.npz"), allow_pickle=False) as data:
        return dict(data)


@pytest.fixture(scope="module")
def ours(opensim):
    poses = [forward(q) for q in opensim["q"]]
    lengths, arms = zip(*[muscle_paths(pose) for pose in poses], strict=True)
    return np.array(lengths), np.array(arms), np.array([p.site("hand").xpos for p in poses])


def test_the_wrist_is_opensims(opensim, ours):
    assert np.abs(ours[2] - opensim["wrist"]).max() < 1e-9


@pytest.mark.parametrize("muscle", MUSCLES)
def test_muscle_paths_are_opensims(opensim, ours, muscle):
    k = MUSCLES.index(muscle)
    length, arm = (0.6, 1.0) if muscle == "BIClong" else (0.05, 0.3)
    assert np.abs(ours[0] - opensim["lengths"])[:, k].max() < length * MILLIMETRE
    assert np.abs(ours[1] - opensim["arms"])[..., k].max() < arm * MILLIMETRE


def test_the_bare_arm_falls_as_opensims(opensim):
    bare = mujoco.MjModel.from_xml_path(str(Path(closed_form.__file__).with_name("arm26.xml")))
    bare.dof_damping[:] = 0
    bare.opt.timestep, bare.opt.integrator = 1e-4, mujoco.mjtIntegrator.mjINT_RK4
    data = mujoco.MjData(bare)
    data.qpos = opensim["drop_start"]
    mujoco.mj_step(bare, data, 5000)
    assert np.abs(data.qpos - opensim["drop_end"]).max() < 1e-6


def test_no_muscle_path_jumps():
    for joint in range(2):
        sweep = [angle * np.eye(2)[joint] for angle in np.arange(*LIMITS[joint], 1e-3)]
        lengths, arms = map(np.array, zip(*[closed_form.paths(q) for q in sweep], strict=True))
        assert np.abs(np.diff(lengths, axis=0)).max() < 1e-4
        assert np.abs(np.diff(arms, axis=0)).max() < 1e-3


def test_closed_form_is_exact():
    rng = np.random.default_rng(0)
    q = rng.uniform(*LIMITS.T, (200, 2))
    velocity, acceleration = rng.normal(scale=3, size=(2, 200, 2))
    torque = closed_form.torque_for(q, velocity, acceleration)
    lengths, arms = closed_form.paths(q)
    for k, pose in enumerate(map(forward, q, velocity)):
        inertia = mass_matrix(pose) + STEP * np.diag(DAMPING)
        expected = inertia @ acceleration[k] + pose.qfrc_bias + DAMPING * velocity[k]
        np.testing.assert_allclose(torque[k], expected, atol=1e-11)
        np.testing.assert_allclose(closed_form.hand(q[k]), pose.site("hand").xpos, atol=1e-14)
        np.testing.assert_allclose(lengths[k], muscle_paths(pose)[0], atol=1e-8)
        np.testing.assert_allclose(arms[k], muscle_paths(pose)[1], atol=1e-6)
    back = closed_form.acceleration_from(q, velocity, torque)
    np.testing.assert_allclose(back, acceleration, atol=1e-10)


def test_geometry_draws_what_is_measured():
    q = np.radians([-20.0, 80.0])
    bodies, muscles = geometry(q)
    rotation, elbow = bodies["forearm"]
    wrist = rotation @ MODEL.site("hand").pos + elbow
    np.testing.assert_allclose(wrist, closed_form.hand(q), atol=1e-12)
    lengths, _ = closed_form.paths(q)
    for name, length in zip(MUSCLES, lengths, strict=True):
        chords = np.linalg.norm(np.diff(muscles[name], axis=0), axis=1).sum()
        assert 0.99 * length < chords <= length + 1e-8  # a chord cuts the corner of a wrap
