"""Rows of plots, and each muscle its line in them."""

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.arm.model import MUSCLES
from vmc_lib.show.palette import COLOURS

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
        wspace=0.75 * columns / (width - 0.9 - 0.75 * (columns - 1)),  # 0.75 inches
    )
    return fig, *axes[0]


def muscle_lines(ax, x, values):
    """A line for each muscle: `values` (n, muscles) over `x` (n,)."""
    for name, line in zip(MUSCLES, np.transpose(values), strict=True):
        colour, style = STYLES[name]
        ax.plot(x, line, style, color=COLOURS[colour], label=name)
