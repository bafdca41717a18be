"""The whole arm: MyoArm's 63 muscles on the seven joints of shoulder, elbow, forearm and wrist.

The fingers are held straight. Collarbone and shoulder blade follow the upper arm, in fixed shares.
Positions are in the book's axes from the right shoulder, in m: x forward, y up, z to the right.
`arm63.xml` is made by `reproduce.whole_arm.derive`; muscles obey MuJoCo's own law, as in MyoArm.
"""

from copy import copy
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco import rollout

from vmc_lib.arm import arm26  # noqa: F401  (it keeps the warnings of MuJoCo on the console)
from vmc_lib.motor import templates

FILE = Path(__file__).with_name("arm63.xml")
MODEL = mujoco.MjModel.from_xml_path(str(FILE))
MUSCLES = [MODEL.actuator(k).name for k in range(MODEL.nu)]
JOINTS = (
    *("elv_angle_r", "shoulder_elv_r", "shoulder_rot_r", "elbow_flexion_r"),
    *("pro_sup_r", "deviation_r", "flexion_r"),
)
FREE = [MODEL.joint(name).qposadr[0] for name in JOINTS]
LIMITS = MODEL.jnt_range[FREE]  # (7, 2), rad
STEPS = 10  # of 2 ms: a command changes fifty times a second
TICK = STEPS * MODEL.opt.timestep  # s
TICKS, HOLD = 60, round(templates.HOLD / TICK)  # commands of a reach; how often the last is kept on
STATE = mujoco.mjtState.mjSTATE_FULLPHYSICS
_TIP = MODEL.site("fingertip").id
# Room to compute in: to make it takes longer than to use it. Who reads from it has written first
_DATA = mujoco.MjData(MODEL)


def _joint_coupling():
    """How all 18 joints turn with the seven free ones, (18, 7)."""
    shares = np.zeros((MODEL.nq, len(FREE)))
    shares[FREE, range(len(FREE))] = 1
    for one, other, data in zip(MODEL.eq_obj1id, MODEL.eq_obj2id, MODEL.eq_data, strict=True):
        shares[one, FREE.index(other)] = data[1]
    return shares


JOINT_COUPLING = _joint_coupling()


class Motion(NamedTuple):
    """A movement, or a batch of them, sampled after each command."""

    joints: np.ndarray  # (…, T, 18), rad
    velocity: np.ndarray  # (…, T, 18), rad/s
    activation: np.ndarray  # (…, T, 63)

    @property
    def hold(self):
        """The path of the tip of the index finger over the hold, (…, HOLD + 1, 3), m."""
        return fingertip(self.joints[..., -HOLD - 1 :, :])

    @property
    def endpoint(self):
        """Where the finger is on average over the hold, (…, 3), m."""
        return self.hold.mean(axis=-2)


def move(excitations, posture, activation, dampers=1.0):
    """The `Motion` that excitations (…, T, 63) give the arm from rest in a posture (7,), rad.

    The last of them is kept on for the hold. `dampers` is the share that is left of the joints'.
    """
    model = copy(MODEL)
    model.dof_damping *= dampers
    _DATA.time, _DATA.qpos[:], _DATA.qvel[:] = 0, JOINT_COUPLING @ posture, 0
    _DATA.act[:] = activation
    first = np.empty(mujoco.mj_stateSize(MODEL, STATE))
    mujoco.mj_getState(MODEL, _DATA, first, STATE)
    *batch, ticks, _ = np.shape(excitations)
    now = np.minimum(np.arange(STEPS * (ticks + HOLD)) // STEPS, ticks - 1)
    controls = np.reshape(excitations, (-1, ticks, MODEL.nu))[:, now]
    states, _ = rollout.rollout(model, _DATA, np.tile(first, (len(controls), 1)), controls)
    parts = np.split(states[:, STEPS - 1 :: STEPS, 1:], [MODEL.nq, 2 * MODEL.nq], axis=-1)
    return Motion(*(x.reshape(*batch, ticks + HOLD, -1) for x in parts))


def tip_and_jacobian(posture):
    """Where a posture (7,) puts the tip of the index finger, (3,), m, and its slopes (3, 7)."""
    slopes = np.zeros((3, MODEL.nv))
    _DATA.qpos[:] = JOINT_COUPLING @ posture
    mujoco.mj_kinematics(MODEL, _DATA)
    mujoco.mj_comPos(MODEL, _DATA)
    mujoco.mj_jacSite(MODEL, _DATA, slopes, None, _TIP)
    return _DATA.site_xpos[_TIP].copy(), slopes @ JOINT_COUPLING


def fingertip(joints):
    """Where joints (…, 18), rad, put the tip of the index finger: (…, 3), m."""
    at = []
    for q in np.reshape(joints, (-1, MODEL.nq)):
        _DATA.qpos[:] = q
        mujoco.mj_kinematics(MODEL, _DATA)
        at.append(_DATA.site_xpos[_TIP].copy())
    return np.reshape(at, (*np.shape(joints)[:-1], 3))


def required_torque(posture, velocity, acceleration):
    """Inverse dynamics at posture, velocity, acceleration (7,): torque (7,), muscles' gain (7, 63).

    Whatever activation (63,) satisfies torque = gain @ activation gives this acceleration.
    """
    data = _DATA
    data.qpos[:], data.qvel[:] = JOINT_COUPLING @ posture, JOINT_COUPLING @ velocity
    mujoco.mj_fwdPosition(MODEL, data)
    mujoco.mj_fwdVelocity(MODEL, data)
    mass, arms = np.zeros((MODEL.nv, MODEL.nv)), np.zeros((MODEL.nu, MODEL.nv))
    mujoco.mj_fullM(MODEL, data, mass)
    moment = data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind
    mujoco.mju_sparse2dense(arms, *moment)
    slack, full = _muscle_forces(0.0), _muscle_forces(1.0)
    needed = (
        mass @ JOINT_COUPLING @ acceleration + data.qfrc_bias - data.qfrc_passive - arms.T @ slack
    )
    return JOINT_COUPLING.T @ needed, JOINT_COUPLING.T @ (arms * (full - slack)[:, None]).T


def stiffness(posture, nudge=1e-4):
    """Joint stiffness at a posture (7,), N m/rad: of slack muscles (7, 7), of active (7, 7, 63).

    A nudged arm is brought back by slack + active @ activation, which is symmetric; along an
    eigenvector whose eigenvalue is negative, it is carried on.
    """
    still, ways = np.zeros(len(FREE)), nudge * np.vstack([np.eye(len(FREE)), -np.eye(len(FREE))])
    torque, gain = (
        np.subtract(*np.split(np.array(x), 2)) / (2 * nudge)
        for x in zip(*(required_torque(posture + way, still, still) for way in ways), strict=True)
    )
    return torque, -gain


def _muscle_forces(activation):
    """The muscles' forces (63,) in N in the state that is set, all as active as this."""
    _DATA.act[:] = activation
    mujoco.mj_fwdActuation(MODEL, _DATA)
    return _DATA.actuator_force.copy()
