"""What the viewer needs of the model to draw the arm in any posture.

A scene then carries joint angles and activations alone. Points of a muscle's path that glide over a
bone as a joint turns come from MuJoCo, at angles so close that the viewer may fill in between.
"""

from functools import cache

import mujoco
import numpy as np

from vmc_lib.arm.arm26 import MODEL, forward
from vmc_lib.arm.kinematics import TRUNK
from vmc_lib.arm.model import F0, L0, LIMITS, MUSCLES, SLACK

STRENGTH = 9e5  # N/m²: a drawn belly's cross-section is F0 / STRENGTH (ours, for the eye)
BEFORE = (0.3, 0.2, 0.3, 0.62, 0.5, 0.3)  # share of each tendon before the belly (ours, by eye)
TURNS = 41  # angles at which a gliding point is known
BODIES = [MODEL.body(name).id for name in ("world", "humerus", "forearm")]


@cache
def anatomy():
    """What the viewer draws the arm with, as JSON takes it.

    `joints`: where each turns in its parent's frame (3,), and its axis (3,); `hand`: the wrist in
    the forearm's frame (3,); `limits` (2, 2) in rad; `trunk`: x and z of the axis that it turns
    about (2,), m. `muscles`: name, tendon's `slack` in m, the
    belly's `volume` in m³, the share of the tendon `before` it, and the `path`: points `on` a body
    (trunk 0, humerus 1, forearm 2), `at` one place (3,) or, between the limits of a `joint`, many.
    """
    joints = [
        {"at": MODEL.body_pos[body].tolist(), "axis": MODEL.joint(k).axis.tolist()}
        for k, body in enumerate(BODIES[1:])
    ]
    numbers = zip(MUSCLES, SLACK, F0 / STRENGTH * L0, BEFORE, strict=True)
    return {
        "joints": joints,
        "hand": MODEL.site("hand").pos.tolist(),
        "limits": LIMITS.tolist(),
        "trunk": TRUNK.tolist(),
        "muscles": [
            {"name": name, "slack": slack, "volume": volume, "before": before, "path": _path(k)}
            for k, (name, slack, volume, before) in enumerate(numbers)
        ],
    }


def _path(muscle):
    """The points of one muscle's path, as `anatomy` describes them."""
    points, first = [], MODEL.tendon_adr[muscle]
    for part in range(first, first + MODEL.tendon_num[muscle]):
        thing = MODEL.wrap_objid[part]
        if MODEL.wrap_type[part] == mujoco.mjtWrap.mjWRAP_SITE:
            on = BODIES.index(MODEL.site_bodyid[thing])
            points.append({"on": on, "at": [MODEL.site_pos[thing].round(6).tolist()]})
        else:
            ends = [MODEL.wrap_objid[part - 1], MODEL.wrap_objid[part + 1]]
            points += _glide(muscle, thing, ends)
    return points


def _glide(muscle, geom, ends):
    """The three points where a muscle touches, winds round and leaves what it wraps."""
    joint = int(MODEL.site_bodyid[ends[1]] == BODIES[2])  # the one between the two ends
    angles = np.linspace(*LIMITS[joint], TURNS)
    touched = np.stack([_touched(muscle, geom, ends, a * np.eye(2)[joint]) for a in angles], 1)
    return [{"on": 1, "joint": joint, "at": at.round(5).tolist()} for at in touched]


def _touched(muscle, geom, ends, q):
    """The same in one posture, in the humerus's frame (3, 3); where it runs free, on its line."""
    data = forward(q)
    rows = slice(data.ten_wrapadr[muscle], data.ten_wrapadr[muscle] + data.ten_wrapnum[muscle])
    points = data.wrap_xpos.reshape(-1, 3)[rows][data.wrap_obj.ravel()[rows] == geom]
    centre, axes = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    if not len(points):
        start, end = data.site_xpos[ends]
        share = np.clip((centre - start) @ (end - start) / np.sum((end - start) ** 2), 0, 1)
        points = np.repeat([start + share * (end - start)], 2, axis=0)
    middle = (points.mean(axis=0) - centre) @ axes  # of the chord: pushed out, onto the arc
    free = [True, True, MODEL.geom_type[geom] == mujoco.mjtGeom.mjGEOM_SPHERE]
    out = np.linalg.norm(middle[free])
    if out < MODEL.geom_size[geom][0]:
        middle[free] *= MODEL.geom_size[geom][0] / out
    three = np.array([points[0], axes @ middle + centre, points[1]])
    humerus = data.body("humerus")
    return (three - humerus.xpos) @ humerus.xmat.reshape(3, 3)
