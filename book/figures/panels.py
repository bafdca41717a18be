"""Rows of plots, and each muscle its line in them."""

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.arm.model import MUSCLES
from vmc_lib.show.figures import margins
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
    apart = 0.75  # inches
    room = (size[0] - 0.9 - apart * (columns - 1)) / columns  # for each plot
    grid = {"layout": "none", "gridspec_kw": {"wspace": apart / room}}
    fig, axes = plt.subplots(1, columns, figsize=size, squeeze=False, **grid)
    margins(fig)
    return fig, *axes[0]


def muscle_lines(ax, x, values):
    """A line for each muscle: `values` (n, muscles) over `x` (n,)."""
    for name, line in zip(MUSCLES, np.transpose(values), strict=True):
        colour, style = STYLES[name]
        ax.plot(x, line, style, color=COLOURS[colour], label=name)
