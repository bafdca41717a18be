"""Cups and clutter as meshes, in metres, y up, standing on the plane y = 0."""

import numpy as np

from reproduce.render.meshes import join, lathe, rotation, slab, tube


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
    spine = slab((0.002, y + 0.004, z), colour, 0.45).move(shift=(-x / 2, 0, 0))
    covers = [slab((x, 0.002, z), colour, 0.45, low=low) for low in (0, y + 0.002)]
    title = slab((x * 0.5, 0.0002, 0.02), [0.75, 0.65, 0.40], low=y + 0.004)
    return join(*covers, spine, pages, title.move(shift=(0, 0, -z * rng.uniform(0.1, 0.3))))


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
    return lathe(profile, colour, sides=16).move(rotation(2, np.pi / 2)).on_table()


CLUTTER = (book, phone, ball, plate, pen)
