"""Things that resemble a shuttlecock or lie beside one, as meshes in metres, y up: hard negatives.

Each takes `rng` and a colour (linear RGB). Cones, bells, cups and lamps have its outline, flowers
and paper cases its pleats, whisks and wheels its ribs.
"""

from functools import partial

import numpy as np

from reproduce.render.materials import rgb
from reproduce.render.meshes import grid_mesh, join, lathe, rotation, slab, tube
from reproduce.render.objects import CUPS, ball, pen

WHITE = np.array([0.85, 0.84, 0.80])


def around(one, count):
    """A mesh `count` times about the vertical."""
    return join(*(one.move(rotation(1, 2 * np.pi * k / count)) for k in range(count)))


def traffic_cone(rng, colour):
    """A cone with white bands on a square foot."""
    heights = np.linspace(0, 0.09, 9)
    rows = np.where((np.arange(9) // 2 % 2 == 1)[:, None], WHITE, colour)
    body = lathe(np.column_stack([np.linspace(0.03, 0.006, 9), heights]), rows, 0.5)
    return join(body, slab((0.08, 0.005, 0.08), colour * rng.uniform(0.2, 1)))


def bell(rng, colour):
    """A bell: a flared wall with a loop above."""
    t = np.linspace(0, 1, 14)
    flare = 0.02 + 0.022 * (1 - t) ** rng.uniform(1.5, 4)
    profile = [*np.column_stack([flare, 0.06 * t]), (0.012, 0.067), (0, 0.069)]
    loop = np.linspace(-0.3, np.pi + 0.3, 14)
    ring = np.column_stack([0.008 * np.cos(loop), 0.072 + 0.008 * np.sin(loop), 0 * loop])
    return join(lathe(profile, colour, rng.uniform(0.15, 0.5)), tube(ring, 0.002, colour))


def pleated_wall(rng, colour, height, narrow, wide):
    """A pleated wall, open above and below: a paper case, a lampshade, a skirt."""
    folds, angle = int(rng.integers(14, 40)), np.linspace(0, 2 * np.pi, 400)
    t = np.linspace(0, 1, 6)[:, None]
    depth = rng.uniform(0.03, 0.12) * (0.3 + t)
    radius = (narrow + (wide - narrow) * t) * (1 + depth * np.cos(folds * angle))
    points = np.broadcast_arrays(radius * np.cos(angle), height * t, radius * np.sin(angle))
    return grid_mesh(np.stack(points, axis=-1), colour, 0.7)


def paper_case(rng, colour):
    """A paper case for a small cake, often with the cake in it."""
    wall = pleated_wall(rng, colour, 0.03, 0.022, 0.034)
    top = [(0.033, 0.026), (0.036, 0.034), (0.028, 0.046), (0.012, 0.052), (0, 0.053)]
    cake = lathe(top, rgb(rng.choice(["#7a4a22", "#c98f3d", "#f0e0c0"])), 0.9)
    return join(wall, cake) if rng.random() < 0.5 else wall


def lamp(rng, colour):
    """A table lamp: a shade, smooth or pleated, on a stem."""
    shade = pleated_wall(rng, colour, 0.06, 0.045, 0.025 * rng.uniform(0.6, 1.4))
    stem = lathe([(0.03, 0), (0.03, 0.004), (0.004, 0.008), (0.004, 0.09), (0, 0.09)], colour * 0.5)
    return join(shade.move(shift=(0, 0.05, 0)), stem)


def flower(rng, colour):
    """A flower: petals that stand about a heart, more or less open, on a stem."""
    petals, opening = int(rng.integers(6, 22)), rng.uniform(0.1, 1.3)
    t, across = np.linspace(0, 1, 10)[:, None], np.linspace(-1, 1, 5)
    width = rng.uniform(0.005, 0.014) * np.sin(np.pi * (0.08 + 0.9 * t)) ** 0.7
    out, up = 0.006 + 0.04 * t * np.sin(opening), 0.04 * t * np.cos(opening) - 0.006 * t**3
    points = np.stack(np.broadcast_arrays(out, up + 0.003 * across**2, width * across), axis=-1)
    heart = lathe(
        [(0.009, -0.002), (0.01, 0.003), (0, 0.008)], rgb(rng.choice(["#d8a010", "#5a3a1a"]))
    )
    stem = tube([(0, -0.002, 0), (0.004, -0.05, 0), (0, -0.1, 0.004)], 0.002, rgb("#3f7a2a"))
    return join(heart, around(grid_mesh(points, colour, 0.6), petals), stem)


def bouquet(rng, colour):
    """Three to seven flowers whose stems meet."""
    some = []
    for _ in range(rng.integers(3, 8)):
        tilt = rotation(2, rng.uniform(-0.5, 0.5)) @ rotation(0, rng.uniform(-0.5, 0.5))
        tint = (colour * rng.uniform(0.7, 1.1)).clip(0, 1)
        some.append(flower(rng, tint).move(shift=(0, 0.1, 0)).move(tilt))
    return join(*some)


def whisk(rng, colour):
    """A whisk: wire loops on a handle."""
    angle = np.linspace(0, np.pi, 24)
    wide = rng.uniform(0.02, 0.035)
    loop = np.column_stack([wide * np.sin(angle) ** 0.8, 0.045 * (1 - np.cos(angle)), 0 * angle])
    handle = lathe([(0, -0.07), (0.007, -0.068), (0.006, 0), (0.004, 0.004), (0, 0.004)], colour)
    return join(
        around(tube(loop, 0.0008, [0.6, 0.6, 0.62], 0.2, sides=6), 2 * rng.integers(4, 8)), handle
    )


def wheel(rng, colour):
    """A spoked wheel."""
    angle = np.linspace(0, 2 * np.pi, 65)
    ring = np.column_stack([0.045 * np.cos(angle), 0 * angle, 0.045 * np.sin(angle)])
    spoke = tube([(0.005, 0, 0), (0.025, 0, 0), (0.045, 0, 0)], 0.0009, [0.6, 0.6, 0.6], sides=6)
    hub = lathe([(0.006, -0.005), (0.006, 0.005), (0, 0.005)], [0.3, 0.3, 0.32])
    return join(
        tube(ring, rng.uniform(0.002, 0.006), colour), around(spoke, rng.integers(8, 28)), hub
    )


def brush(rng, colour):
    """A brush: bristles that spread from a handle."""
    count, hair = int(rng.integers(60, 160)), rgb(rng.choice(["#e9e2cf", "#2a2420", "#b88a50"]))
    ends = rng.standard_normal((count, 2)) * rng.uniform(0.004, 0.012)
    bristles = [
        tube(
            [(0.3 * x, 0, 0.3 * z), (0.6 * x, 0.025, 0.6 * z), (x, 0.05, z)], 0.0005, hair, sides=4
        )
        for x, z in ends
    ]
    handle = lathe([(0, -0.08), (0.006, -0.075), (0.005, -0.02), (0.009, 0), (0, 0.001)], colour)
    return join(handle, *bristles)


def glass(rng, colour):
    """A goblet on a foot."""
    bowl = [(0.004, 0.045), (0.02, 0.055), (0.028, 0.075), (rng.uniform(0.02, 0.034), 0.1)]
    return lathe([(0.03, 0), (0.028, 0.003), (0.004, 0.008), *bowl], colour, 0.1)


def light_bulb(rng, colour):
    """A bulb in its screw."""
    angle = np.linspace(0.5, np.pi, 20)
    globe = np.column_stack([0.03 * np.sin(angle), 0.055 - 0.03 * np.cos(angle)])
    screw = [(0.013 + 0.001 * (k % 2), 0.002 * k) for k in range(14)]
    return join(lathe(globe, WHITE, 0.1), lathe([(0, 0), *screw], [0.45, 0.43, 0.40], 0.2))


def racket(rng, colour):
    """A badminton racket's head, with strings, and some of its shaft."""
    angle = np.linspace(0, 2 * np.pi, 97)
    a, b = rng.uniform(0.09, 0.1), rng.uniform(0.11, 0.125)
    ring = np.column_stack([a * np.cos(angle), b * np.sin(angle), 0 * angle])
    shaft = np.array([(0, -b - 0.2 * t, 0) for t in (0, 0.4, 1)])
    strings, dye = [], rgb(rng.choice(["#f2f2ee", "#f2f2ee", "#e8e020", "#e03030", "#202020"]))
    for along, across in ((a, b), (b, a)):
        for place in np.arange(-along + 0.008, along, 0.0095):
            half = across * np.sqrt(1 - (place / along) ** 2)
            ends = [(place, s * half, 0.001) for s in (-1, 0, 1)]
            path = ends if along == a else [(y, x, z) for x, y, z in ends]
            strings.append(tube(path, 0.0006, dye, sides=4))
    return join(tube(ring, 0.005, colour, 0.3), tube(shaft, 0.0035, colour, 0.3), *strings)


def cup(rng, colour):
    """One of the cups."""
    return CUPS[rng.integers(len(CUPS))](colour, WHITE if rng.random() < 0.5 else colour)


def paper(rng, colour):
    """A crumpled sheet of paper."""
    x, z = np.meshgrid(np.linspace(-0.05, 0.05, 16), np.linspace(-0.05, 0.05, 16))
    waves = [
        rng.uniform(0.003, 0.02) * np.sin(rng.normal(0, 90) * x + rng.normal(0, 90) * z + k)
        for k in range(5)
    ]
    return grid_mesh(np.stack([x * rng.uniform(0.5, 1), sum(waves), z], axis=-1), colour, 0.8)


def shoe_sole(rng, colour):
    """An oblong body with a light sole: a shoe, a slipper."""
    t = np.linspace(0, 2 * np.pi, 60)
    outline = np.column_stack([0.035 * np.cos(t) * (1 + 0.2 * np.sin(t)), 0.1 * np.sin(t)])
    rows = [(0, 1), (0.012, 1.02), (0.013, 0.97), (0.04, 0.85), (0.055, 0.55), (0.06, 0)]
    points = np.stack(
        [np.column_stack([s * outline[:, 0], 0 * t + y, s * outline[:, 1]]) for y, s in rows]
    )
    shades = np.array([WHITE, WHITE, colour, colour, colour * 0.8, colour * 0.6])
    return grid_mesh(points, shades, 0.7)


TRAINING_KINDS = (
    traffic_cone, bell, paper_case, flower, bouquet, whisk, brush, glass, racket, cup, paper,
    partial(pleated_wall, height=0.05, narrow=0.015, wide=0.035), shoe_sole, pen,
)  # fmt: skip
# Of decoys that validate and test, not train. Balls still lie about in renders that train
# (`objects.CLUTTER`), and photographs that train show wheels, a lamp and light bulbs.
HELD_OUT_KINDS = lamp, wheel, light_bulb, ball
