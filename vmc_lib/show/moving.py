"""Plots of muscles and movements: each muscle its line, and one view of the arm's plane."""

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.arm.closed_form import hand
from vmc_lib.arm.model import LIMITS, MUSCLES, geometry
from vmc_lib.photos import TABLE
from vmc_lib.show.figures import COLOURS

# What straightens the elbow is blue; what bends it is orange, or red where it spans no shoulder.
STYLES = {
    "TRIlong": ("blue", "-"),
    "TRIlat": ("blue", "--"),
    "TRImed": ("blue", ":"),
    "BIClong": ("orange", "-"),
    "BICshort": ("orange", "--"),
    "BRA": ("red", "-"),
}


def panels(columns=1, size=(6.5, 2.7)):
    """A figure with a row of plots. Its layout is fixed: a demo draws many, and quickly."""
    fig, axes = plt.subplots(1, columns, figsize=size, layout="none", squeeze=False)
    width, height = size
    fig.subplots_adjust(
        left=0.7 / width,
        right=1 - 0.2 / width,
        bottom=0.5 / height,
        top=1 - 0.3 / height,
        wspace=0.75 * columns / width,
    )
    return fig, *axes[0]


def muscle_lines(ax, x, values, names=MUSCLES):
    """A line for each muscle: `values` (n, muscles) over `x` (n,)."""
    for name, line in zip(names, np.transpose(values), strict=True):
        colour, style = STYLES[name]
        ax.plot(x, line, style, color=COLOURS[colour], label=name)


def plane_view(paths=(), points=(), postures=(), ax=None):
    """The arm's plane seen from the right, in metres; returns the figure.

    It shows the shoulder, the table top, and how far a straight arm reaches. `paths` holds
    (path (n, 2 or 3), label, colour name), `points` (position, label, colour name), `postures`
    (q (2,), label, colour name); labels may be empty.
    """
    if ax is None:
        _, ax = panels(size=(4.4, 4.4))
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
