"""Random scenes, level by level: what stands where, before which camera, in what light."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from reproduce.render import materials, meshes, objects, shuttlecocks
from reproduce.render.materials import rgb
from vmc_lib import marker_sheet
from vmc_lib.arm.kinematics import to_world
from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import CLASSES, HEIGHT, WIDTH

HAND = 0.06  # how far to the right of the shoulder the hand moves, about (m)
MIDDLE = np.array([0.19, -0.42, -0.07])  # of the places the hand can reach
BORDER = 8  # pixels kept free around the shuttlecock and the cup
VISIBLE = 0.96  # the least share of either that nothing else hides

GLAZES = "#1b3f9c #a8321e #1f5f3a #d29a12 #efebe2 #26282e #0e6a75 #74142a #d85f17 #6f8fb0".split()
COVERS = "#8c1d24 #17365f #1e4d36 #c07a14 #2a2a30 #5a2d5f #b8b2a2 #0f5f66".split()
PAIRS = {
    materials.wood: ["#c98f52 #7c4720", "#8a5630 #44230f", "#d9b47c #a06a33", "#573722 #281509"],
    materials.cloth: ["#e6e0d0 #27447c", "#efe6d6 #a82f2b", "#3f6145 #22382a", "#d8cbb0 #84623b"],
    materials.stone: ["#d8d4cc #858079", "#5a6165 #1d2124", "#b7a185 #5f4c39", "#3b5147 #14211b"],
    materials.plain: ["#e9e5db #c9c2b2", "#24595f #1a4347", "#383b41 #27292d", "#a64a1c #853a15"],
}


@dataclass(frozen=True)
class Light:
    """A square window: direction from the table (3,), side (m), colour; and the room's light."""

    direction: np.ndarray
    size: float
    colour: np.ndarray
    fill: np.ndarray


@dataclass(frozen=True)
class Scene:
    """All that a photo needs, in the shoulder frame; `things` has "shuttlecock" and "cup" first."""

    things: dict
    table: np.ndarray
    gloss: float
    light: Light
    camera: Camera
    target: np.ndarray
    turn: float
    pose: str


def look(centre, distance, elevation, azimuth, focal, roll=0.0):
    """The camera that looks at `centre` from behind it (azimuth > 0: from the left) and above."""
    level = np.array([np.cos(azimuth), 0, np.sin(azimuth)])
    forward = np.cos(elevation) * level - np.sin(elevation) * np.array([0, 1, 0])
    right = np.cross(level, [0, 1, 0])
    axes = np.stack([right, np.cross(forward, right), forward])
    middle = np.array([WIDTH, HEIGHT]) / 2
    return Camera(focal, middle, meshes.rotation(2, roll) @ axes, centre - distance * forward)


EYE = look(MIDDLE, distance=0.75, elevation=np.radians(60), azimuth=0.27, focal=800.0)


def free_eye(rng):
    """Another camera for every photo."""
    return look(
        MIDDLE + rng.uniform(-0.03, 0.03, 3),
        distance=rng.uniform(0.65, 0.95),
        elevation=np.radians(rng.uniform(35, 70)),
        azimuth=rng.uniform(-0.8, 1.1),
        focal=rng.uniform(680, 860),
        roll=rng.uniform(-0.1, 0.1),
    )


def light_from(elevation, azimuth, size, warmth, fill):
    """A light; `warmth` −1 is a blue sky, 0 white, 1 a lamp."""
    level = np.cos(elevation)
    direction = [level * np.cos(azimuth), np.sin(elevation), level * np.sin(azimuth)]
    tint = np.array([1 + 0.22 * warmth, 1.0, 1 - 0.28 * warmth])
    return Light(np.array(direction), size, tint, fill * np.array([0.95, 1.0, 1.07]))


@cache
def rig_table():
    """The one wooden table of the rig."""
    light, dark = map(rgb, PAIRS[materials.wood][0].split())
    return materials.wood(np.random.default_rng(7), light, dark)


def setting(level, rng):
    """Table, its gloss, the light, the cup and the shuttlecock (still at the origin) of a photo."""
    if level != "varied":
        light = light_from(0.95, 2.5, 0.6, 0.15, 0.22)
        cup = objects.mug(rgb("#1b3f9c"), rgb("#efebe2"))
        return rig_table(), 0.45, light, cup, shuttlecocks.shuttlecock(np.random.default_rng(3))
    make = list(PAIRS)[rng.integers(len(PAIRS))]
    texture = make(rng, *map(rgb, rng.choice(PAIRS[make]).split()))
    gloss = {materials.stone: 0.2, materials.cloth: 0.95}.get(make, rng.uniform(0.3, 0.6))
    light = light_from(
        rng.uniform(0.6, 1.4), rng.uniform(0, 2 * np.pi), rng.uniform(0.15, 1.2),
        rng.uniform(-0.7, 1), rng.uniform(0.1, 0.35),
    )  # fmt: skip
    glaze = rgb(rng.choice(GLAZES))
    inside = glaze if rng.random() < 0.4 else rgb("#efebe2")
    cup = objects.CUPS[rng.integers(len(objects.CUPS))](glaze, inside)
    return texture, gloss, light, cup, shuttlecocks.shuttlecock(rng)


def circle(mesh):
    """Centre (2,) and radius of a circle on the table that holds the mesh."""
    flat = mesh.vertices[:, [0, 2]]
    centre = (flat.min(axis=0) + flat.max(axis=0)) / 2
    return centre, np.linalg.norm(flat - centre, axis=1).max()


def is_apart(mesh, others):
    """Whether the mesh keeps clear of all the others, by 4 mm."""
    centre, radius = circle(mesh)
    rounds = map(circle, others)
    return all(np.linalg.norm(centre - c) > radius + r + 0.004 for c, r in rounds)


def is_whole(mesh, camera):
    """Whether the camera sees all of the mesh, with a border around it."""
    pixels = camera.project(mesh.vertices)
    return bool(np.all((pixels > BORDER) & (pixels < [WIDTH - BORDER, HEIGHT - BORDER])))


def place(mesh, rng, centre, near, far):
    """The mesh, turned at random, `near` to `far` from `centre` on the table in some direction."""
    angle, distance = rng.uniform(0, 2 * np.pi), rng.uniform(near, far)
    spot = [centre[0] + distance * np.cos(angle), TABLE, centre[2] + distance * np.sin(angle)]
    return mesh.move(meshes.rotation(1, rng.uniform(0, 2 * np.pi)), spot)


def draw(level, rng, furnish=setting):
    """A random scene of the level: shuttlecock and cup whole in the picture, nothing touching."""
    table, gloss, light, cup, feathered = furnish(level, rng)
    while True:
        camera = EYE if level == "rig" else free_eye(rng)
        turn, reach = np.radians(rng.uniform(-10, 60)), rng.uniform(0.08, 0.22)
        standing = bool(rng.random() < 0.25)
        roll, heading = rng.uniform(0, 2 * np.pi, 2)
        bird, middle = shuttlecocks.rest_on_table(feathered, standing, roll, heading)
        target = to_world(np.array([reach, TABLE + middle[1], HAND]), turn)
        bird = bird.move(shift=target - middle)
        vessel = place(cup, rng, target, 0.08, 0.24)
        if is_apart(vessel, [bird]) and is_whole(bird, camera) and is_whole(vessel, camera):
            break
    things = {"shuttlecock": bird, "cup": vessel}
    for k in range(rng.integers(4) if level == "varied" else 0):
        make, colour = objects.CLUTTER[rng.integers(len(objects.CLUTTER))], rgb(rng.choice(COVERS))
        for _ in range(20):
            thing = place(make(rng, colour), rng, MIDDLE, 0, 0.3)
            if is_apart(thing, things.values()):
                things[f"{make.__name__} {k}"] = thing
                break
    pose = "standing" if standing else "lying"
    return Scene(things, table, gloss, light, camera, target, float(turn), pose)


def draw_with_sheet(rng):
    """A varied scene with the printed sheet on its table, before a hand-held camera.

    The camera has shuttlecock and cup whole in its picture, and half of the markers' corners.
    """
    while True:
        scene = draw("varied", rng)
        focal, width = rng.uniform(420, 800), rng.uniform(0.6, 0.85)  # of the table seen, m
        camera = look(
            np.array([0.19, TABLE, 0.06]) + rng.uniform(-0.04, 0.04, 3) * [1, 0, 1],
            distance=width * focal / WIDTH,
            elevation=np.radians(rng.uniform(40, 75)),
            azimuth=rng.uniform(-0.6, 0.9),
            focal=focal,
            roll=rng.uniform(-0.1, 0.1),
        )
        corners = camera.project(marker_sheet.marker_corners().reshape(-1, 3))
        inside = np.all((corners > 0) & (corners < [WIDTH, HEIGHT]), axis=1)
        pair = (scene.things[name] for name in CLASSES)
        if inside.mean() >= 0.5 and all(is_whole(thing, camera) for thing in pair):
            return replace(scene, table=with_sheet(scene.table), camera=camera)


def with_sheet(table):
    """A table's texture with the sheet on it: texels and the sheet's pixels are millimetres."""
    x, _, z = np.round(1000 * (marker_sheet.CORNER - MIDDLE)).astype(int)
    column, row = len(table) // 2 + x, len(table) // 2 - z
    wide, high = marker_sheet.PAGE
    covered = table.copy()
    ink = marker_sheet.page_image().T[::-1, ::-1, None] / 255
    covered[row - wide : row, column - high : column] = 0.04 + 0.76 * ink  # toner, paper
    return covered


def draw_in_full_view(draw, masks):
    """A scene of `draw()` in which shuttlecock and cup are in full view, and the boxes around them.

    Draws until one is. `masks` gives, by name, a thing's mask alone and among the others.
    """
    while True:
        scene = draw()
        visibility = masks(scene)
        if all(part.sum() >= VISIBLE * whole.sum() for whole, part in visibility.values()):
            return scene, {name: mask_box(visibility[name][1]) for name in CLASSES}


def mask_box(mask):
    """The smallest box (x0, y0, x1, y1) around a mask."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return [int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1]
