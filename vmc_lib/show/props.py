"""What lies before the arm: a table, a shuttlecock and a cup, and balls that mark places.

Each takes a meshcat visualizer and puts itself there. Shapes are metres.
"""

import numpy as np
from meshcat import geometry as g

from vmc_lib.camera import TABLE
from vmc_lib.show.palette import COLOURS

WOOD, CORK, BAND, FEATHERS = 0xC08F5A, 0xE3CFA0, 0x1D4F91, (0xFFFFFF, 0xCDD5DF)
LENGTH, RIM, BALL = 0.085, 0.033, 0.013  # a shuttlecock: axis, radius of its skirt, of its cork
# rad, how a lying one's axis rises: the slope of the line that touches the skirt's rim and the ball
LEAN = np.arctan2(RIM, LENGTH - BALL) - np.arcsin(BALL / np.hypot(LENGTH - BALL, RIM))
MUG = (0.04, 0.09)  # a cup: radius of its rim, height
SKIRT = 0.024  # from the cork's tip to where the skirt begins
VANE = [  # a feather: how far along the axis, and half its width there
    *((SKIRT, 0.001), (0.036, 0.0012), (0.042, 0.0032), (0.06, 0.0052), (0.079, 0.0063)),
    (LENGTH, 0.0032),
]


def table(part, photo=None):
    """A table with its top at `TABLE`: of wood, or in the colour that it has in a photo."""
    top, thick = (0.56, 0.9), 0.026
    colour = WOOD if photo is None else _median_colour(_table_pixels(photo))
    part["top"].set_object(g.Box([top[0], thick, top[1]]), paint(colour))
    part["top"].set_transform(place((0.36, TABLE - thick / 2, -0.05)))
    for i, (x, z) in enumerate([(0.12, -0.46), (0.6, -0.46), (0.12, 0.36), (0.6, 0.36)]):
        part[f"leg{i}"].set_object(g.Box([0.045, 0.6, 0.045]), paint(colour))
        part[f"leg{i}"].set_transform(place((x, TABLE - thick - 0.3, z)))


def ball(part, position, colour):
    """A small ball in a named colour; nothing hides it, nor its halo, which hides little itself."""
    for name, radius, opacity in (("core", 0.006, 0.9), ("halo", 0.02, 0.2)):
        _mark(part[name], g.Sphere(radius), colour, opacity)
    part.set_transform(place(position))


def diamond(part, position, colour):
    """A small octahedron in a named colour, which nothing hides."""
    _mark(part, lathe([(0, -0.011), (0.011, 0), (0, 0.011)], sides=4), colour)
    part.set_transform(place(position))


def line(part, ends, colour):
    """A thin line between two ends (2, 3) in a named colour, which nothing hides."""
    points = g.PointsGeometry(np.transpose(ends).astype(np.float32))
    part.set_object(g.Line(points, g.LineBasicMaterial(color=_number(colour), depthTest=False)))


def _mark(part, shape, colour, opacity=0.9):
    paint = g.MeshBasicMaterial(color=_number(colour), opacity=opacity, depthTest=False)
    part.set_object(shape, paint)
    part["<object>"].set_property("castShadow", False)


def _number(colour):
    return int(COLOURS[colour][1:], 16)


def shuttlecock(part, photo):
    """The shuttlecock of a photo: on its skirt, or lying as its box in the photo says."""
    x = np.linspace(0, np.pi / 2, 7)
    dome = BALL * np.column_stack([np.sin(x), 1 - np.cos(x)])
    part["cork"].set_object(lathe([*dome, (0.95 * BALL, SKIRT), (0, SKIRT)]), paint(CORK))
    part["band"].set_object(lathe([(BALL, 0.018), (BALL, SKIRT)]), paint(BAND))
    for k, colour in enumerate(FEATHERS):  # by turns, or at a distance they were one grey arch
        angle = 2 * np.pi * np.arange(k, 16, 2) / 16
        part[f"feathers{k}"].set_object(_feathers(angle), paint(colour, 0x404040))
    part.set_transform(shuttlecock_pose(photo))


def shuttlecock_pose(photo):
    """Where the photo's shuttlecock is: a transform of one along +y, its cork's tip at 0.

    A lying one heads where its outline would fill the box in the photo best.
    """
    if photo.pose == "standing":
        return _pose(photo.target, np.array([0.0, -1.0, 0.0]))
    heading = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    level = np.cos(LEAN) * np.array([np.cos(heading), np.sin(heading)])
    poses = [_pose(photo.target, np.array([x, np.sin(LEAN), z])) for x, z in level.T]
    rim = RIM * np.array([np.cos(heading), 0 * heading, np.sin(heading)]).T + [0, LENGTH, 0]
    outline = np.vstack([rim, 0.4 * rim - [0, 0.4 * LENGTH - BALL, 0]])  # skirt and cork

    def off(pose):
        pixels = photo.camera.project(outline @ pose[:3, :3].T + pose[:3, 3])
        return np.abs([pixels.min(axis=0), pixels.max(axis=0)] - box).sum()

    box = photo.boxes["shuttlecock"].reshape(2, 2)
    return min(poses, key=off)


def cup_foot(photo):
    """Where the photo's cup stands on the table (3,): its middle is that of its box."""
    middle = photo.boxes["cup"].reshape(2, 2).astype(int).mean(0)
    x, _, z = photo.camera.back_project([middle], TABLE + MUG[1] / 2)[0]
    return np.array([x, TABLE, z])


def cup(part, photo):
    """The photo's cup, a mug in the colour that it has there."""
    x0, y0, x1, y1 = photo.boxes["cup"].astype(int)
    patch = photo.image[(y0 + 2 * y1) // 3 : y1 - 8, (2 * x0 + x1) // 3 : (x0 + 2 * x1) // 3]
    outside, inside = (
        [(0, 0), (0.037, 0), MUG],
        [(0.036, 0.09), (0.034, 0.005), (0, 0.005)],
    )
    part.set_object(lathe([*outside, *inside]), paint(_median_colour(patch)))
    part.set_transform(place(cup_foot(photo)))


def _table_pixels(photo):
    """The photo's pixels (n, 3) of the table round its shuttlecock, but for what stands there."""
    aside = np.linspace(-0.2, 0.2, 41)  # m
    x, z = np.meshgrid(photo.target[0] + aside, photo.target[2] + aside)
    around = np.column_stack([x.ravel(), np.full(x.size, TABLE), z.ravel()])
    column, row = np.rint(photo.camera.project(around)).astype(int).T
    high, wide = photo.image.shape[:2]
    free = (0 <= column) & (column < wide) & (0 <= row) & (row < high)
    for x0, y0, x1, y1 in photo.boxes.values():
        free &= ~((x0 <= column) & (column <= x1) & (y0 <= row) & (row <= y1))
    return photo.image[row[free], column[free]]


def _median_colour(pixels):
    """The median of pixels (…, 3) as 0xRRGGBB."""
    red, green, blue = np.median(pixels.reshape(-1, 3), axis=0).astype(int)
    return int(red << 16 | green << 8 | blue)


def lathe(profile, sides=32):
    """A mesh: the profile (n, 2) of (radius, height) turned about y."""
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    radius, height = np.array(profile, float).T[:, :, None]
    around = np.broadcast_arrays(radius * np.cos(angle), height, radius * np.sin(angle))
    return surface(np.stack(around, axis=-1))


def _feathers(angles):
    """A mesh of the shuttlecock's feathers that stand at `angles` (n,) round its axis."""
    height, half = np.array(VANE).T[:, :, None]
    radius = BALL - 0.002 + (RIM - BALL + 0.002) * (height - SKIRT) / (LENGTH - SKIRT)
    angle = angles[:, None, None] + half / radius * [-1, 1]
    around = np.broadcast_arrays(radius * np.cos(angle), height, radius * np.sin(angle))
    return surface(np.stack(around, axis=-1))


def surface(points):
    """A mesh over grids of points (..., rows, columns, 3)."""
    corner = np.arange(points[..., 0].size).reshape(points.shape[:-1])
    a, b = corner[..., :-1, :-1], corner[..., :-1, 1:]
    c, d = corner[..., 1:, 1:], corner[..., 1:, :-1]
    faces = np.stack([a, c, b, a, d, c], axis=-1).reshape(-1, 3)
    return g.TriangularMeshGeometry(points.reshape(-1, 3), faces)


def paint(colour, glow=0):
    """A matt surface in a colour, 0xRRGGBB, that in the shade still shows so much of its `glow`."""
    return g.MeshLambertMaterial(color=colour, emissive=glow)


def place(position):
    """The transform (4, 4) that moves something to `position` (3,)."""
    matrix = np.eye(4)
    matrix[:3, 3] = position
    return matrix


def _pose(middle, axis):
    """The transform that lays +y along `axis` (3,), with the middle of the length at `middle`."""
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([side, axis, np.cross(side, axis)])
    matrix[:3, 3] = middle - LENGTH / 2 * axis
    return matrix
