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
CORNER = (0.02, 0.02, 0.3, 0.352)  # of a plot: a square, the target's surroundings in it
NEAR = 0.05  # m: how far they reach


def lines(joints):
    """The bones' ends (4, 3), and of every muscle the points (n, 3) that it runs through, in m."""
    data = placed(joints)
    places = data.wrap_xpos.reshape(-1, 3)
    ways = [
        places[first : first + count]
        for first, count in zip(data.ten_wrapadr, data.ten_wrapnum, strict=True)
    ]
    ends = [data.body(name).xpos for name in BONES]
    return np.array([*ends, data.site("fingertip").xpos]), ways


def placed(joints):
    """MuJoCo's data of the arm with its joints (18,) so."""
    data = mujoco.MjData(plant.MODEL)
    data.qpos[:] = joints
    mujoco.mj_fwdPosition(plant.MODEL, data)
    return data


def views(motion, moment, target):
    """A movement at one of its moments, the finger's way so far, and the target (a green ring).

    A figure for each view; in its corner, the target's surroundings, larger.
    """
    bones, ways = lines(motion.joints[moment])
    tips = np.array([lines(q)[0][-1] for q in [*motion.joints[:moment:3], motion.joints[moment]]])
    away = 1000 * np.linalg.norm(tips[-1] - target)
    active = motion.activation[moment]
    shade = np.clip(0.22 + 1.6 * active, 0, 1)
    drawn = []
    for title, (x, y, label) in VIEWS.items():
        fig, ax = panels(size=(4.1, 3.9))
        paths = [way[:, [x, y]] for way in ways]
        ax.plot(bones[:, x], bones[:, y], color=COLOURS["line"], lw=7, solid_capstyle="round")
        ax.add_collection(
            LineCollection(paths, colors=COLOURS["red"], alpha=shade, lw=0.7 + 2 * active)
        )
        near = ax.inset_axes(CORNER, xticks=[], yticks=[])
        near.spines[:].set_visible(True)
        for each in (ax, near):
            each.plot(tips[:, x], tips[:, y], color=COLOURS["blue"], lw=1.4)
            each.plot(tips[-1, x], tips[-1, y], "o", ms=4, color=COLOURS["blue"])
            ring = {"ms": 9, "mfc": "none", "mew": 1.8, "color": COLOURS["green"]}
            each.plot(target[x], target[y], "o", **ring)
        view_from(ax, y, label, f"{title}: {away:.0f} mm away")
        side = NEAR * (-1 if y == 2 else 1)
        near.set(xlim=(target[x] - NEAR, target[x] + NEAR))
        near.set(ylim=(target[y] - side, target[y] + side))
        drawn.append(fig)
    return tuple(drawn)


def view_from(ax, y, label, title):
    """The axes of a view, which shows the axis `y` upwards."""
    low, high = ((-0.45, 0.3), (0.35, -0.4))[y == 2]
    ax.set(xlim=(-0.2, 0.68), ylim=(low, high), aspect="equal")
    ax.set(xlabel="forward (m)", ylabel=label, title=title)
