"""The arm, its muscles and what it reaches for, as a `Scene`.

Positions are metres in the shoulder frame (x forward, y up, z to the right).
"""

from functools import cache

import numpy as np
from meshcat import geometry as g

from vmc_lib.arm.dynamics import paths
from vmc_lib.arm.kinematics import to_world
from vmc_lib.arm.model import MUSCLES, geometry
from vmc_lib.arm.muscle import force
from vmc_lib.arm.simulate import fibres
from vmc_lib.photos import TABLE
from vmc_lib.show.palette import COLOURS
from vmc_lib.show.scene import Scene

POINTS = 12  # no muscle's path has more
BONE_RADIUS, TUBE = 0.013, (0.004, 0.010)  # m: bones; muscles at rest and at their strongest
BONE, BODY, WOOD, FEATHER = 0xEDE6D6, 0xAEB7C2, 0xCDB795, 0xF4F4F0


def arm_scene(
    q, activation=6 * (0,), velocity=(0, 0), turn=0, shuttlecock=None, balls=(), trail=None
):
    """The arm in posture q (2,), in radians, on a trunk turned by `turn`.

    Muscles go from blue to red with `activation` (6,) and thicken with their force (Eq. 10), which
    also follows the joints' `velocity` (2,) in rad/s. `shuttlecock` (3,) is the middle of one that
    stands; `balls` are (position (3,), colour name) pairs; `trail` (n, 3) is a line, for instance
    the hand's path. Only the arm turns with the trunk: all else stays where it is.
    """
    scene, q = Scene(_furniture()), np.asarray(q, float)
    seen = geometry(q)
    pulls = np.minimum(force(activation, *fibres(*paths(q), velocity), maximum=1.0), 1)
    thin, thick = TUBE
    _move_tube(scene["arm/bones"], to_world(seen.joints, turn), BONE_RADIUS)
    scene["arm/hand"].set_transform(_place(to_world(seen.joints[-1], turn)))
    for name, active, share in zip(MUSCLES, activation, pulls, strict=True):
        course = seen.muscles[name]
        path = np.pad(course, ((0, POINTS - len(course)), (0, 0)), "edge")
        _move_tube(scene[f"arm/{name}"], to_world(path, turn), thin + (thick - thin) * share)
        scene[f"arm/{name}"].set_property("color", _heat(active))
    if shuttlecock is not None:
        _shuttlecock(scene, shuttlecock)
    for i, (position, colour) in enumerate(balls):
        scene[f"ball{i}"].set_object(g.Sphere(0.012), _paint(int(COLOURS[colour][1:], 16)))
        scene[f"ball{i}"].set_transform(_place(position))
    if trail is not None:
        line = g.PointsGeometry(np.float32(np.transpose(trail)))
        scene["trail"].set_object(g.Line(line, g.LineBasicMaterial(color=0x67707E)))
    return scene


@cache
def _furniture():
    """What every arm scene shares: a table, a hint of a body, and the parts that will be moved."""
    scene = Scene()
    scene.look((0.75, 0.42, 1.35), at=(0.13, -0.14, -0.06))
    scene["table"].set_object(g.Box([0.5, 0.02, 0.9]), _paint(WOOD))
    scene["table"].set_transform(_place((0.31, TABLE - 0.01, -0.05)))
    scene["body/trunk"].set_object(g.Ellipsoid([0.1, 0.3, 0.15]), _paint(BODY, 0.45))
    scene["body/trunk"].set_transform(_place((-0.03, -0.24, -0.17)))
    scene["body/head"].set_object(g.Ellipsoid([0.095, 0.12, 0.08]), _paint(BODY, 0.45))
    scene["body/head"].set_transform(_place((0.0, 0.22, -0.17)))
    _make_tube(scene["arm/bones"], 3, BONE)
    scene["arm/hand"].set_object(g.Sphere(0.02), _paint(BONE, 0.6))
    for name in MUSCLES:
        _make_tube(scene[f"arm/{name}"], POINTS, 0xFFFFFF)
    return scene


class _Bend(g.Sphere):
    """A ball of few faces: it is small, there are many, and they move."""

    def lower(self, object_data):
        return super().lower(object_data) | {"widthSegments": 10, "heightSegments": 8}


def _make_tube(part, points, colour):
    """A tube along that many points: a cylinder for each stretch, a ball for each bend."""
    stretch = g.Cylinder(1.0, 1.0)
    stretch.radialSegments = 10
    for i in range(points):
        part[f"bend{i}"].set_object(_Bend(1.0), _paint(colour))
        if i:
            part[f"stretch{i}"].set_object(stretch, _paint(colour))


def _move_tube(part, line, radius):
    for i, point in enumerate(line):
        part[f"bend{i}"].set_transform(_place(point, radius))
        if i:
            part[f"stretch{i}"].set_transform(_span(line[i - 1], point, radius))


def _shuttlecock(scene, position):
    """A shuttlecock on its skirt, the middle of its axis at `position`."""
    scene["shuttlecock"].set_transform(_place(position))
    skirt = g.Cylinder(0.06, radiusTop=0.012, radiusBottom=0.032)
    scene["shuttlecock/skirt"].set_object(skirt, _paint(FEATHER))
    scene["shuttlecock/skirt"].set_transform(_place((0, -0.01, 0)))
    scene["shuttlecock/cork"].set_object(g.Sphere(0.0135), _paint(0xD9A066))
    scene["shuttlecock/cork"].set_transform(_place((0, 0.026, 0)))


def _paint(colour, opacity=1.0):
    return g.MeshLambertMaterial(color=colour, opacity=opacity)


def _heat(active):
    """Blue at rest, red in full activation: (red, green, blue, opacity) in [0, 1]."""
    cold, hot = (np.array(list(bytes.fromhex(COLOURS[c][1:]))) / 255 for c in ("blue", "red"))
    return [*((1 - active) * cold + active * hot).round(3).tolist(), 1.0]


def _place(position, size=1.0):
    matrix = np.diag([size, size, size, 1.0])
    matrix[:3, 3] = position
    return matrix


def _span(start, end, radius):
    """The transform that lays a unit cylinder (centred, along y) from `start` to `end`."""
    along = end - start
    length = np.linalg.norm(along)
    if length < 1e-9:
        return _place(start, 1e-6)
    side = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
    side /= np.linalg.norm(side)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack(
        [radius * side, along, radius * np.cross(side, along / length)]
    )
    matrix[:3, 3] = (start + end) / 2
    return matrix
