"""The whole arm as lines: its bones, and each muscle on its way, seen from the side and from above.

What is drawn is played back: the movement is simulated first.
"""

import mujoco
import numpy as np
from matplotlib.collections import LineCollection
from meshcat.geometry import MeshLambertMaterial, TriangularMeshGeometry

from book.figures.panels import panels
from reproduce.whole_arm import plant
from vmc_lib.show import COLOURS, things
from vmc_lib.show.scene import Scene

BONES = ("humerus_r", "ulna_r", "lunate_r")  # shoulder, elbow and wrist are where these begin
VIEWS = {"from the side": (0, 1, "up (m)"), "from above": (0, 2, "to the right (m)")}
CORNER = (0.02, 0.02, 0.3, 0.352)  # of a plot: a square, the target's surroundings in it
SIDES = 5  # of a tube
BONE, REST, FULL = np.array([[0.91, 0.87, 0.79], [0.93, 0.74, 0.70], [0.78, 0.02, 0.06]])
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


def scene(motion, moment, target):
    """The same arm at one of its moments, as a scene to be turned: bones, and muscles as tubes.

    The redder a muscle, the more active; green is the target, blue the finger's tip.
    """
    bones, ways = lines(motion.joints[moment])
    shown = Scene()
    shown.look((0.75, 0.05, 0.7), at=(0.24, -0.13, 0.0))
    limbs = [_tube(bones[k : k + 2], 0.008) for k in range(len(bones) - 1)]
    shown["bones"].set_object(*_tubes(limbs, np.tile(BONE, (len(limbs), 1))))
    shade = np.clip(3 * motion.activation[moment], 0, 1)[:, None]
    muscles = [_tube(way, 0.0038) for way in ways]
    shown["muscles"].set_object(*_tubes(muscles, REST + shade * (FULL - REST)))
    things.ball(shown["tip"], bones[-1], "blue")
    things.ball(shown["target"], target, "green")
    return shown


def _tube(way, radius):
    """Rings (n, SIDES + 1, 3) round the points of a way (n, 3)."""
    along = way[-1] - way[0]
    side = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    across = np.stack([side, np.cross(along, side)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    angle = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    return way[:, None] + radius * np.column_stack([np.cos(angle), np.sin(angle)]) @ across


def _tubes(rings, colours):
    """One mesh of many tubes, each in its colour (n, 3), and its paint: a viewer's one object."""
    meshes = [things.surface(ring) for ring in rings]
    sizes = [len(mesh.vertices) for mesh in meshes]
    firsts = np.cumsum([0, *sizes[:-1]])
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    faces = np.concatenate([m.faces + first for m, first in zip(meshes, firsts, strict=True)])
    shades = np.repeat(colours, sizes, axis=0)
    return TriangularMeshGeometry(vertices, faces, shades), MeshLambertMaterial(vertexColors=True)
