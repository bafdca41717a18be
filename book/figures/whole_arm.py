"""The whole arm as lines: its bones, and each muscle on its way, seen from the side and from above.

What is drawn is played back: the movement is simulated first.
"""

import mujoco
import numpy as np
from matplotlib.collections import LineCollection

from book.figures.panels import panels
from reproduce.whole_arm import plant
from vmc_lib.show import COLOURS

BONES = ("humerus_r", "ulna_r", "lunate_r")  # shoulder, elbow and wrist are where these begin
VIEWS = {"from the side": (0, 1, "up (m)"), "from above": (0, 2, "to the right (m)")}


def lines(joints):
    """The bones' ends (4, 3), and of every muscle the points (n, 3) that it runs through, in m."""
    data = mujoco.MjData(plant.MODEL)
    data.qpos[:] = joints
    mujoco.mj_fwdPosition(plant.MODEL, data)
    places = data.wrap_xpos.reshape(-1, 3)
    ways = [
        places[first : first + count]
        for first, count in zip(data.ten_wrapadr, data.ten_wrapnum, strict=True)
    ]
    ends = [data.body(name).xpos for name in BONES]
    return np.array([*ends, data.site("fingertip").xpos]), ways


def views(motion, moment, target):
    """A movement at one of its moments, the finger's way so far, and the target (a green ring)."""
    fig, *axes = panels(2, (8.2, 3.9))
    bones, ways = lines(motion.joints[moment])
    tips = np.array([lines(q)[0][-1] for q in motion.joints[: moment + 1 : 3]])
    active = motion.activation[moment]
    for ax, (title, (x, y, label)) in zip(axes, VIEWS.items(), strict=True):
        paths = [way[:, [x, y]] for way in ways]
        ax.plot(bones[:, x], bones[:, y], color=COLOURS["line"], lw=7, solid_capstyle="round")
        shade = np.clip(0.22 + 1.6 * active, 0, 1)
        ax.add_collection(
            LineCollection(paths, colors=COLOURS["red"], alpha=shade, lw=0.7 + 2 * active)
        )
        ax.plot(tips[:, x], tips[:, y], color=COLOURS["blue"], lw=1.4)
        ax.plot(bones[-1, x], bones[-1, y], "o", ms=4, color=COLOURS["blue"])
        ring = {"ms": 9, "mfc": "none", "mew": 1.8, "color": COLOURS["green"]}
        ax.plot(target[x], target[y], "o", **ring)
        low, high = ((-0.4, 0.25), (0.35, -0.4))[y == 2]
        ax.set(xlim=(-0.2, 0.68), ylim=(low, high), aspect="equal")
        ax.set(xlabel="forward (m)", ylabel=label, title=title)
    return fig
