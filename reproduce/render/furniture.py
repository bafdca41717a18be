"""Other tables, cups and lights than those of `scene`, for scenes that no model has learnt from."""

import numpy as np

from reproduce.render import materials, meshes, objects, scene, shuttlecocks
from reproduce.render.materials import rgb

COLOURS = "#c7413b #2f6f9f #e0b33c #3d3a4a #5d8f57 #d9d2c3 #7b4b8a #e08a5b".split()


def tiles(rng, light, dark):
    """Glazed tiles with joints; each has its own shade."""
    v, u = np.mgrid[0 : materials.SIZE, 0 : materials.SIZE]
    side = rng.integers(90, 220)
    shade = 0.12 * rng.standard_normal((30, 30))[v // side, u // side]
    joint = (v % side < 5) | (u % side < 5)
    return materials.blend(light, dark, np.where(joint, 1.0, 0.15 + shade))


def terrazzo(rng, light, dark):
    """A pale ground with chips in it."""
    chips = materials.noise(rng, 160, 160) > 1.1
    return materials.blend(light, dark, 0.1 + 0.75 * chips + 0.05 * materials.cloud(rng, 5))


def mats(rng, light, dark):
    """Stripes of two widths, as of a woven mat."""
    across = np.arange(materials.SIZE) // rng.integers(8, 20) % 5 < 2
    uneven = 0.1 * materials.noise(rng, 500, 60)
    return materials.blend(light, dark, 0.7 * across[:, None] + 0.15 + uneven)


def tumbler(colour, inside):
    """A cup that is wider above, with a thick foot."""
    side = [(0.024, 0), (0.03, 0.002), (0.029, 0.012), (0.034, 0.06), (0.045, 0.11)]
    return objects.vessel(side, 0.002, colour, inside, 0.15)


def stein(colour, inside):
    """A tall, narrow mug with a large square handle."""
    body = objects.vessel([(0.037, 0), (0.037, 0.01), (0.034, 0.12)], 0.004, colour, inside)
    return meshes.join(body, objects.handle((0.034, 0.11), (0.036, 0.02), 0.04, 0.007, colour))


def bowl(colour, inside):
    """A wide cup without a handle."""
    angle = np.linspace(0.2, 1.5, 12)
    side = [(0.02 + 0.04 * np.sin(a), 0.062 * (1 - np.cos(a))) for a in angle]
    return objects.vessel(side, 0.003, colour, inside, 0.6)


def setting(_, rng):
    """As `scene.setting`: other tables, cups and lights."""
    light, dark = (rgb(code) for code in rng.choice(COLOURS, 2, replace=False))
    table = (tiles, terrazzo, mats)[rng.integers(3)](rng, 0.6 * light + 0.2, dark)
    lamp = scene.light_from(
        rng.uniform(0.5, 1.5), rng.uniform(0, 2 * np.pi), rng.uniform(0.1, 0.8),
        rng.uniform(-1, 1), rng.uniform(0.2, 0.5),
    )  # fmt: skip
    glaze, inside = rgb(rng.choice(COLOURS)), rgb(rng.choice(COLOURS))
    cup = (tumbler, stein, bowl)[rng.integers(3)](glaze, inside)
    return table, 0.5, lamp, cup, shuttlecocks.shuttlecock(rng)
