"""The arm as a MuJoCo model: OpenSim's arm26, two joints and six muscles (`arm26.xml`)."""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.dynamics import check_posture, check_radians
from vmc_lib.arm.model import MUSCLES, XML, check_load
from vmc_lib.checks import as_numbers, cached, check_kind, shape_of

LOG = mujoco.MjLogConfig.get()
LOG.logto_file = False  # no file in the reader's folder: a warning is on the console
LOG.set()

MODEL = mujoco.MjModel.from_xml_string(XML)


class Geometry(NamedTuple):
    """Where everything is in one posture, for drawing; all in the shoulder frame."""

    bodies: dict  # name -> (rotation (3, 3), position (3,)): x_world = rotation @ x + position
    muscles: dict  # name -> path (n, 3) from origin to insertion, tangent points of wraps included

    @property
    def joints(self) -> np.ndarray:
        """Shoulder, elbow and wrist, (3, 3)."""
        rotation, elbow = self.bodies["forearm"]
        _, shoulder = self.bodies["humerus"]
        return np.array([shoulder, elbow, elbow + rotation @ MODEL.site("hand").pos])


@cached
def model_with_load(load: float) -> mujoco.MjModel:
    """The model with a weight of `load` kg, a point, held at the wrist; `MODEL` itself for 0."""
    check_load(load)
    if load == 0:
        return MODEL
    spec = mujoco.MjSpec.from_string(XML)
    # Without `ipos` its mass would lie as far from the wrist again as the wrist from the elbow
    weight = {"mass": load, "ipos": [0, 0, 0], "inertia": [1e-9] * 3, "explicitinertial": True}
    spec.body("forearm").add_body(name="held", pos=MODEL.site("hand").pos, **weight)
    return spec.compile()


def forward(
    q: ArrayLike, velocity: ArrayLike = (0.0, 0.0), data: mujoco.MjData | None = None
) -> mujoco.MjData:
    """MuJoCo's data (new, or `data` overwritten) with one posture and joint velocity computed.

    ValueError for a posture in degrees.
    """
    check_radians("posture", as_numbers("posture", q))
    data = data or mujoco.MjData(MODEL)
    data.qpos, data.qvel = q, velocity
    mujoco.mj_forward(data.model, data)
    return data


def muscle_paths(data: mujoco.MjData) -> tuple[np.ndarray, np.ndarray]:
    """Musculotendon lengths (…, 6) and moment arms (…, 2, 6) in m of MuJoCo's current posture.

    `data` is MuJoCo's own, or a `mujoco.batch.Batch` of many. A moment arm is minus the change of
    length with the angle: positive turns the joint positively.
    """
    slopes = np.reshape(data.ten_J, (*data.ten_length.shape, MODEL.nv))
    return data.ten_length, -np.swapaxes(slopes, -1, -2)


def geometry(q: ArrayLike) -> Geometry:
    """`Geometry` of one posture (2,): the pose of each body and the path of each muscle.

    ValueError for another shape, or far beyond the joints' limits.
    """
    if shape_of("posture", q) != (2,):
        raise ValueError(f"posture {q} must be (shoulder, elbow), in rad")
    check_posture(q)
    data = forward(q)
    names = [MODEL.body(k).name for k in range(1, MODEL.nbody)]
    bodies = {n: (data.body(n).xmat.reshape(3, 3).copy(), data.body(n).xpos.copy()) for n in names}
    points = data.wrap_xpos.reshape(-1, 3)
    ends = zip(data.ten_wrapadr, data.ten_wrapadr + data.ten_wrapnum, strict=True)
    paths = [points[first:last].copy() for first, last in ends]
    return Geometry(bodies, dict(zip(MUSCLES, paths, strict=True)))


def mass_matrix(data: mujoco.MjData) -> np.ndarray:
    """The joints' inertia (2, 2) in kg m² at MuJoCo's current posture."""
    check_kind("data", data, mujoco.MjData, "forward(q)")
    matrix = np.empty((MODEL.nv, MODEL.nv))
    mujoco.mj_fullM(data.model, data, matrix)
    return matrix


def dynamics_at(postures: np.ndarray, load: float = 0.0) -> np.ndarray:
    """The terms of the dynamics, as `dynamics` has them, and the hand, in postures (n, 2): (n, 10).

    With a `load` in kg at the wrist.
    """
    postures = as_numbers("postures", postures)
    if postures.ndim != 2 or postures.shape[1] != 2:
        raise ValueError(f"postures {postures.shape}: give (shoulder, elbow) in rad, (n, 2)")
    data = mujoco.MjData(model_with_load(load))
    return np.array([_snapshot(q, data) for q in postures])


def _snapshot(q, data):
    gravity = forward(q, data=data).qfrc_bias.copy()
    inertia = mass_matrix(data)
    # A turning shoulder throws the forearm outwards, and a bending elbow the upper arm.
    swing = forward(q, (1, 0), data).qfrc_bias[1] - gravity[1]
    bend = forward(q, (0, 1), data).qfrc_bias[0] - gravity[0]
    terms = [inertia[0, 0], inertia[0, 1], inertia[1, 1], swing, bend, *gravity]
    return [*terms, *data.site("hand").xpos]
