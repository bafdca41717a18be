"""The arm's plane seen from the right, in metres: the whole of it, or where the templates lie."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MultipleLocator

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import LIMITS, geometry
from vmc_lib.motor.templates import REACH, START
from vmc_lib.photos import TABLE
from vmc_lib.show.palette import COLOURS

ALL = ((-0.02, 0.26), (-0.51, -0.29))  # the plane before the trunk, from (x, y) low to high


def plane(ax, templates, within=ALL):
    """The table's edge, how far the arm reaches, where it starts, and the templates (N, 2)."""
    angle = np.linspace(-np.pi / 2, 0, 200)
    ax.axhline(TABLE, color=COLOURS["grey"], lw=1, ls="--")
    ax.plot(REACH * np.cos(angle), REACH * np.sin(angle), color=COLOURS["grey"], lw=1, ls=":")
    ax.plot(*hand(START)[:2], "s", ms=6, mfc="none", color=COLOURS["ink"])
    ax.plot(*np.transpose(templates), "o", ms=4, color=COLOURS["grey"])
    ax.set(xlim=within[0], ylim=within[1], aspect="equal", xlabel="forward (m)", ylabel="up (m)")
    ax.yaxis.set_major_locator(MultipleLocator(0.1))
    ax.grid(False)


def plane_view(paths=(), points=(), postures=(), ax=None):
    """The arm's plane seen from the right, in metres; returns the figure.

    It shows the shoulder, the table top, and how far a straight arm reaches. `paths` holds
    (path (n, 2 or 3), label, colour name), `points` (position, label, colour name), `postures`
    (q (2,), label, colour name); labels may be empty.
    """
    if ax is None:
        _, ax = plt.subplots(figsize=(4.4, 4.4), layout="none")
        ax.set_position((0.16, 0.12, 0.8, 0.82))
    straight = np.linspace(*LIMITS[0], 90)
    rim = hand(np.stack([straight, 0 * straight], axis=-1))
    ax.plot(*rim.T[:2], ":", color=COLOURS["grey"], linewidth=1)
    ax.axhline(TABLE, color=COLOURS["grey"], linewidth=1)
    ax.plot(0, 0, "o", color=COLOURS["ink"], markersize=7)
    for q, label, colour in postures:
        joints = geometry(q).joints
        ax.plot(*joints.T[:2], "o-", color=COLOURS[colour], label=label, linewidth=4, alpha=0.6)
    for path, label, colour in paths:
        ax.plot(*np.transpose(path)[:2], color=COLOURS[colour], label=label)
    for position, label, colour in points:
        ax.plot(*position[:2], "o", color=COLOURS[colour])
        ax.annotate(label, position[:2], (5, 5), textcoords="offset points", color=COLOURS[colour])
    ax.set(xlim=(-0.2, 0.58), ylim=(-0.6, 0.12), aspect="equal", xlabel="x (m)", ylabel="y (m)")
    return ax.figure
