"""Shuttlecocks as meshes: feathered, worn and of nylon, in metres, y up, the cork on y = 0."""

from dataclasses import replace

import numpy as np

from reproduce.render.materials import rgb
from reproduce.render.meshes import grid_mesh, join, lathe, rotation, tube
from vmc_lib.show.props import BALL, LEAN, LENGTH, RIM

FEATHERS = 16
FEATHER = np.array([0.88, 0.86, 0.80])


def shuttlecock(rng):
    """A feathered shuttlecock along +y: cork tip at the origin, the skirt's rim at y = LENGTH."""
    foot = _foot(rng, (0.037, 0.048))
    feathers = [_feather(rng).move(rotation(1, 2 * np.pi * k / FEATHERS)) for k in range(FEATHERS)]
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


def worn_shuttlecock(rng):
    """A feathered shuttlecock along +y that was played with: feathers bent, a few of them lost."""
    bend, lost = rng.uniform(0, 0.07), rng.uniform(0, 0.1)
    shade = rgb(rng.choice(["#ffffff", "#ffffff", "#f3ead2", "#e6e9ee"]))
    feathers = []
    for k in range(FEATHERS):
        foot = np.array([_cone(0.025), 0.025, 0])
        tilt = rotation(2, bend * rng.normal()) @ rotation(0, bend * rng.normal())
        feather = _feather(rng).move(shift=-foot).move(tilt, foot)
        if rng.random() > lost:
            feather = replace(feather, colours=feather.colours * shade)
            feathers.append(feather.move(rotation(1, 2 * np.pi * k / FEATHERS)))
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
    vane = grid_mesh(np.stack([x, y, z], axis=-1), shade)
    y = np.linspace(0.023, LENGTH - 0.002, 8)
    quill = np.column_stack([_cone(y) - 0.0004, y, 0 * y])
    return join(vane, tube(quill, np.linspace(0.0011, 0.0005, 8), FEATHER * 0.9, sides=6))


def rest_on_table(mesh, standing, roll, heading):
    """The shuttlecock on its skirt, or on cork and rim, turned; and the middle of its axis."""
    tilt = np.pi if standing else LEAN - np.pi / 2
    turn = rotation(1, heading) @ rotation(2, tilt) @ rotation(1, roll)
    turned = mesh.move(turn)
    drop = turned.vertices[:, 1].min()
    return turned.on_table(), turn @ [0, LENGTH / 2, 0] - [0, drop, 0]
