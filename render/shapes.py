"""The things on the table, built from triangles: metres, y up, standing on the plane y = 0."""

from dataclasses import dataclass, replace

import numpy as np

from render.materials import rgb
from vmc_lib.show.props import BALL, LEAN, LENGTH, RIM

FEATHERS = 16
FEATHER = np.array([0.88, 0.86, 0.80])


@dataclass(frozen=True)
class Mesh:
    """Triangles: vertices (n, 3), faces (m, 3), and linear RGB colours (n, 3)."""

    vertices: np.ndarray
    faces: np.ndarray
    colours: np.ndarray
    roughness: float = 0.5

    def moved(self, rotation=None, shift=(0, 0, 0)):
        """The same mesh, turned by `rotation` (3, 3) and then shifted."""
        turned = self.vertices if rotation is None else self.vertices @ rotation.T
        return replace(self, vertices=turned + shift)

    def on_table(self):
        """The same mesh, lowered or raised until it rests on y = 0."""
        return self.moved(shift=(0, -self.vertices[:, 1].min(), 0))

    def normals(self):
        """Unit normals (n, 3): the mean over a vertex's faces, weighted by their areas."""
        a, b, c = self.vertices[self.faces].transpose(1, 0, 2)
        normals = np.zeros_like(self.vertices)
        for corner in self.faces.T:
            np.add.at(normals, corner, np.cross(b - a, c - a))
        return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def join(*meshes):
    """One mesh out of many; it keeps the first one's roughness."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]),
        np.concatenate([mesh.colours for mesh in meshes]),
        meshes[0].roughness,
    )


def rotation(axis, angle):
    """The rotation (3, 3) by `angle` about coordinate axis 0, 1 or 2."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return turn


def sheet(points, colour, roughness=0.5):
    """A grid of points (rows, columns, 3) as a surface; `colour` is one, one a row or a point."""
    rows, columns, _ = points.shape
    corner = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    faces = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    colour = np.asarray(colour, float)
    colours = np.broadcast_to(colour[:, None] if colour.ndim == 2 else colour, points.shape)
    return Mesh(points.reshape(-1, 3), faces, colours.reshape(-1, 3), roughness)


def lathe(profile, colour, roughness=0.3, sides=64):
    """The profile (n, 2) of (radius, height) turned about the vertical, from the bottom up.

    A corner is sharp when its point stands twice in the profile.
    """
    radius, height = np.array(profile, float).T[:, :, None]
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    points = np.broadcast_arrays(radius * np.cos(angle), height, radius * np.sin(angle))
    return sheet(np.stack(points, axis=-1), colour, roughness)


def tube(path, radius, colour, roughness=0.5, sides=12):
    """A tube about the path (n, 3); its radius is one number or one per point of the path."""
    path = np.asarray(path, float)
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    reference = np.eye(3)[np.argmin(np.abs(along).max(axis=0))]
    side = np.cross(along, reference)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, along)
    angle = np.linspace(0, 2 * np.pi, sides + 1)[None, :, None]
    ring = np.cos(angle) * side[:, None] + np.sin(angle) * up[:, None]
    radius = np.broadcast_to(radius, len(path))[:, None, None]
    return sheet(path[:, None] + radius * ring, colour, roughness)


def slab(size, colour, roughness=0.5, low=0.0):
    """A block of `size` (x, y, z) with sharp edges, centred on the vertical, from y = low up."""
    faces = []
    for axis in range(3):
        for sign in (-1, 1):
            quad = np.full((2, 2, 3), sign, float)
            quad[..., (axis + 1) % 3] = [[-1, -1], [1, 1]]
            quad[..., (axis + 2) % 3] = [[-1, 1], [-1, 1]]
            faces.append(sheet(quad * np.array(size) / 2, colour, roughness))
    return join(*faces).moved(shift=(0, low + size[1] / 2, 0))


def shuttlecock(rng):
    """A feathered shuttlecock along +y: cork tip at the origin, the skirt's rim at y = LENGTH."""
    foot = _foot(rng, (0.037, 0.048))
    feathers = [_feather(rng).moved(rotation(1, 2 * np.pi * k / FEATHERS)) for k in range(FEATHERS)]
    return join(*foot, *feathers)


def _foot(rng, threads):
    """Its cork with a coloured band, and rings of thread at some heights."""
    angle = np.linspace(0, np.pi / 2, 10)
    dome = np.column_stack([BALL * np.sin(angle), BALL * (1 - np.cos(angle))])
    profile = [*dome, (BALL, 0.019), (BALL, 0.019), (BALL, 0.025), (BALL, 0.025), (0, 0.025)]
    band = rgb(rng.choice(["#b3202a", "#1d4f91", "#1f7a3f", "#20242b"]))
    cork = np.where(np.arange(len(profile))[:, None] < len(dome) + 1, [0.84, 0.81, 0.74], band)
    rings = [_thread(height, band * 0.5 + 0.2) for height in threads]
    return [lathe(profile, cork, roughness=0.6, sides=32), *rings]


def worn(rng):
    """A feathered shuttlecock along +y that was played with: feathers bent, a few of them lost."""
    bend, lost = rng.uniform(0, 0.07), rng.uniform(0, 0.1)
    shade = rgb(rng.choice(["#ffffff", "#ffffff", "#f3ead2", "#e6e9ee"]))
    feathers = []
    for k in range(FEATHERS):
        foot = np.array([_cone(0.025), 0.025, 0])
        tilt = rotation(2, bend * rng.normal()) @ rotation(0, bend * rng.normal())
        feather = _feather(rng).moved(shift=-foot).moved(tilt, foot)
        if rng.random() > lost:
            feather = replace(feather, colours=feather.colours * shade)
            feathers.append(feather.moved(rotation(1, 2 * np.pi * k / FEATHERS)))
    return join(*_foot(rng, (0.037, 0.048)), *feathers)


def nylon(rng, dye):
    """A nylon shuttlecock along +y: ribs that rings hold, close above and far apart below."""
    ribs, rim = int(rng.integers(14, 22)), rng.uniform(0.9, 1.05)
    angle, turn = np.linspace(0, 2 * np.pi, 12 * ribs + 1), np.linspace(0, 2 * np.pi, ribs + 1)[:-1]
    thick = rng.uniform(0.8, 1.3)

    def strand(angle, height, radius):
        r = _cone(height) * rim
        path = np.column_stack(np.broadcast_arrays(r * np.cos(angle), height, r * np.sin(angle)))
        return tube(path, thick * radius, dye, 0.35, sides=5)

    scallop = LENGTH - rng.uniform(0.001, 0.004) * (1 - np.abs(np.cos(ribs * angle / 2)))
    close = rng.uniform(0.042, 0.052)
    rings = [0.034, *np.arange(close, LENGTH - 0.004, rng.uniform(0.0026, 0.0045))]
    along, upper = np.linspace(0.022, LENGTH, 9), np.linspace(close, LENGTH - 0.003, 7)
    fine = int(rng.integers(2, 5))  # strands from rib to rib
    between = [a + 2 * np.pi / ribs * k / fine for a in turn for k in range(1, fine)]
    return join(
        *_foot(rng, ()),
        *(strand(a, along, np.linspace(0.0012, 0.0007, 9)) for a in turn),
        *(strand(a, upper, 0.0004) for a in between),
        *(strand(angle, height, 0.0004) for height in rings),
        strand(angle, scallop, 0.0009),
    )


def _cone(height):
    return 0.0105 + (RIM - 0.0105) * (height - 0.025) / (LENGTH - 0.025)


def _thread(height, colour):
    angle = np.linspace(0, 2 * np.pi, 49)
    radius = _cone(height) + 0.0004
    path = np.column_stack([radius * np.cos(angle), np.full(49, height), radius * np.sin(angle)])
    return tube(path, 0.0009, colour, sides=6)


def _feather(rng):
    """One feather on the x > 0 side: a quill that carries a curved vane with a rounded tip."""
    t = np.linspace(0, 1, 14)[:, None]  # from the foot of the vane to its tip
    across = np.linspace(-1, 1, 7)
    width = 0.0085 * np.sqrt(np.clip(1 - t**6, 0.03, 1)) * np.clip(0.25 + 2.2 * t, 0, 1)
    height = 0.044 + (LENGTH - 0.044) * t - 0.006 * across**2 * t**4
    lean = across * 0.22  # each vane lies over its neighbour, as roof tiles do
    radius = _cone(height) + width * (lean - 0.25 * across**2)
    shade = FEATHER * rng.uniform(0.93, 1.0)
    x, y, z = np.broadcast_arrays(radius, height, width * across)
    vane = sheet(np.stack([x, y, z], axis=-1), shade)
    y = np.linspace(0.023, LENGTH - 0.002, 8)
    quill = np.column_stack([_cone(y) - 0.0004, y, 0 * y])
    return join(vane, tube(quill, np.linspace(0.0011, 0.0005, 8), FEATHER * 0.9, sides=6))


def resting(mesh, standing, roll, heading):
    """The shuttlecock on its skirt, or on cork and rim, turned; and the middle of its axis."""
    tilt = np.pi if standing else LEAN - np.pi / 2
    turn = rotation(1, heading) @ rotation(2, tilt) @ rotation(1, roll)
    turned = mesh.moved(turn)
    drop = turned.vertices[:, 1].min()
    return turned.on_table(), turn @ [0, LENGTH / 2, 0] - [0, drop, 0]


def vessel(profile, wall, colour, inside, roughness=0.3):
    """A cup's wall: up the outside, over a rounded lip, down the inside."""
    outer = np.array(profile)
    inner = np.maximum(outer[::-1] - [wall, 0], [0, 2 * wall])
    lip = outer[-1] + np.array([[-0.15, 0.35], [-0.5, 0.5], [-0.85, 0.35]]) * wall
    points = [(0, 0), *outer, *lip, *inner, (0, inner[-1, 1])]
    colours = np.where(np.arange(len(points))[:, None] < len(outer) + 3, colour, inside)
    return lathe(points, colours, roughness)


def handle(top, bottom, reach, thickness, colour):
    """A bent handle between two points (radius, height) of a cup's side."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 20)
    middle, half = np.add(top, bottom) / 2, np.subtract(top, bottom) / 2
    x = middle[0] + half[0] * np.sin(angle) + reach * np.cos(angle)
    y = middle[1] + half[1] * np.sin(angle)
    return tube(np.column_stack([x, y, 0 * x]), thickness, colour, roughness=0.3)


def mug(colour, inside):
    """A straight mug with a handle."""
    side = [(0.034, 0), (0.0385, 0.003), (0.04, 0.009), (0.04, 0.05), (0.04, 0.09)]
    body = vessel(side, 0.004, colour, inside)
    return join(body, handle((0.038, 0.076), (0.038, 0.022), 0.03, 0.0055, colour))


def teacup(colour, inside):
    """A rounded, low cup with a small handle."""
    angle = np.linspace(0.15, 1.45, 12)
    bowl = [(0.022 + 0.025 * np.sin(a), 0.006 + 0.056 * (1 - np.cos(a))) for a in angle]
    body = vessel([(0.022, 0), (0.023, 0.006), *bowl], 0.003, colour, inside)
    return join(body, handle((0.044, 0.048), (0.035, 0.016), 0.02, 0.004, colour))


def beaker(colour, inside):
    """A cup without a handle, wider at the top."""
    side = [(0.026, 0), (0.03, 0.003), (0.033, 0.03), (0.037, 0.065), (0.041, 0.1)]
    return vessel(side, 0.003, colour, inside)


def espresso(colour, inside):
    """A small thick cup with a ring for a handle."""
    side = [(0.02, 0), (0.024, 0.004), (0.029, 0.02), (0.032, 0.038), (0.033, 0.058)]
    body = vessel(side, 0.005, colour, inside)
    return join(body, handle((0.032, 0.046), (0.03, 0.018), 0.019, 0.0045, colour))


CUPS = (mug, teacup, beaker, espresso)


def book(rng, colour):
    """A closed book: two covers, a spine and the block of pages between."""
    x, z, y = rng.uniform(0.11, 0.15), rng.uniform(0.17, 0.21), rng.uniform(0.012, 0.03)
    pages = slab((x - 0.006, y, z - 0.008), [0.80, 0.74, 0.60], 0.9, low=0.002)
    spine = slab((0.002, y + 0.004, z), colour, 0.45).moved(shift=(-x / 2, 0, 0))
    covers = [slab((x, 0.002, z), colour, 0.45, low=low) for low in (0, y + 0.002)]
    title = slab((x * 0.5, 0.0002, 0.02), [0.75, 0.65, 0.40], low=y + 0.004)
    return join(*covers, spine, pages, title.moved(shift=(0, 0, -z * rng.uniform(0.1, 0.3))))


def phone(rng, colour):
    """A telephone: a dark, glossy screen in a coloured case."""
    case = slab((0.072, 0.008, 0.148), colour, 0.3)
    return join(case, slab((0.067, 0.0004, 0.14), [0.012, 0.013, 0.016], 0.1, low=0.008))


def ball(rng, colour):
    """A ball between a table tennis and a tennis ball in size."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 24)
    radius = rng.uniform(0.02, 0.033)
    return lathe(radius * np.column_stack([np.cos(angle), 1 + np.sin(angle)]), colour, 0.5)


def plate(rng, colour):
    """A flat plate with a raised rim."""
    size = rng.uniform(0.07, 0.1)
    under = [(0, 0), (0.6 * size, 0), (0.65 * size, 0.002), (size, 0.012), (size, 0.012)]
    above = [(size, 0.015), (0.66 * size, 0.006), (0.6 * size, 0.004), (0, 0.004)]
    return lathe([*under, *above], colour)


def pen(rng, colour):
    """A pen that lies on its side."""
    profile = [(0, 0), (0.001, 0), (0.004, 0.014), (0.0045, 0.016), (0.0045, 0.13), (0, 0.134)]
    return lathe(profile, colour, sides=16).moved(rotation(2, np.pi / 2)).on_table()


CLUTTER = (book, phone, ball, plate, pen)
