"""The arm's plane seen from the right, in metres: the whole of it, or where the templates lie."""

import numpy as np
from matplotlib.ticker import MultipleLocator

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import LIMITS
from vmc_lib.camera import TABLE
from vmc_lib.motor.templates import HOME
from vmc_lib.show.palette import COLOURS

WHOLE = ((-0.2, 0.58), (-0.6, 0.12))  # from (x, y) low to high
BEFORE = ((-0.02, 0.26), (-0.51, -0.29))  # the part before the trunk, where the templates lie


def plane_view(ax, within=WHOLE):
    """The shoulder, the table's edge, and (dotted) how far a straight arm reaches."""
    straight = np.linspace(*LIMITS[0], 200)
    rim = hand(np.stack([straight, 0 * straight], axis=-1))
    ax.axhline(TABLE, color=COLOURS["grey"], lw=1, ls="--")
    ax.plot(*rim.T[:2], ":", color=COLOURS["grey"], lw=1, gid="guide")
    ax.plot(0, 0, "o", color=COLOURS["ink"], ms=7, gid="guide")
    ax.set(xlim=within[0], ylim=within[1], aspect="equal", xlabel="forward (m)", ylabel="up (m)")
    ax.yaxis.set_major_locator(MultipleLocator(0.1 if np.ptp(within[1]) > 0.2 else 0.02))
    ax.grid(False)


def plane(ax, templates, within=BEFORE):
    """The same with the templates (N, 2), and a square where every reach starts."""
    plane_view(ax, within)
    ax.plot(*HOME, "s", ms=6, mfc="none", color=COLOURS["ink"], gid="guide")
    ax.plot(*np.transpose(templates), "o", ms=4, color=COLOURS["grey"], gid="templates")
