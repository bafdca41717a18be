"""The whole arm as lines: its bones, and each muscle on its way, seen from the side and from above.

What is drawn is played back: the movement is simulated first.
"""

import mujoco
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D

from book.figures.panels import panels
from book.figures.reaching import RING
from reproduce.whole_arm import experiment, habits, plant
from vmc_lib.show import COLOURS, table

BONES = ("humerus_r", "ulna_r", "lunate_r")  # shoulder, elbow and wrist are where these begin
VIEWS = {"from the side": (0, 1, "up (m)"), "from above": (0, 2, "to the right (m)")}
CORNER = np.array([0.02, 0.02]), np.array([0.3, 0.352])  # of a plot: a square, its place and size
NEAR = 0.05  # m: how far around the target one sees in the corner
BONE = {"color": COLOURS["grey"], "alpha": 0.4, "lw": 7, "solid_capstyle": "round"}

SETS = {"14 commands": "14 commands", "34 commands": "34 commands"}  # of memories, as figures say
SETS |= {"27 memories": "63 commands", "any posture": "any posture", "64 memories": "64 memories"}
JOINTS = "shoulder, 1", "shoulder, 2", "shoulder, 3", "elbow", "forearm"
JOINTS += "wrist, sideways", "wrist, up and down"
ROLES = {
    "SUBSC": "turning the upper arm inward, and drawing it back where DELT1 draws it forward (in a "
    "body it also holds the ball in its socket, which here cannot slip)",
    "SUPSP": "drawing the arm back, and turning it inward a little",
    "INFSP": "turning the upper arm outward",
    "DELT1": "lifting the arm forward",
    "PECM1": "drawing the arm forward and inward",
    "PECM2": "drawing the arm forward and inward",
    "BRD": "bending the elbow",
    "BRA": "bending the elbow",
    "BIClong": "bending the elbow",
}


def lines(joints):
    """The bones' ends (4, 3), and of every muscle the points (n, 3) that it runs through, in m."""
    data = arm_data(joints)
    places = data.wrap_xpos.reshape(-1, 3)
    ways = [
        places[first : first + count]
        for first, count in zip(data.ten_wrapadr, data.ten_wrapnum, strict=True)
    ]
    ends = [data.body(name).xpos for name in BONES]
    return np.array([*ends, data.site("fingertip").xpos]), ways


def arm_data(joints):
    """MuJoCo's data of the arm with its joints (18,) so."""
    data = mujoco.MjData(plant.MODEL)
    data.qpos[:] = joints
    mujoco.mj_fwdPosition(plant.MODEL, data)
    return data


def corrected_reach(trials, targets, k, correction, time):
    """The k-th reach of some `Trials` to targets (n, 3), after corrections, at a `time` in s."""
    motion = plant.Motion(*(x[k] for x in trials.movements[correction].motion))
    return views(motion, max(round(time / plant.TICK) - 1, 0), targets[k])


def nudge_plot(activation, dampers):
    """How far the finger is from its place after small nudges, while activations (63,) hold on."""
    away = 1000 * experiment.nudge(activation, dampers)[:, ::4]
    fig, ax = panels(size=(4.3, 2.6))
    ax.plot(4 * plant.TICK * np.arange(away.shape[1]), away.T, color=COLOURS["blue"])
    ax.set(xlabel="time (s)", ylabel="finger off its place (mm)", ylim=(0, 150))
    ax.set(title=f"after 3 s on average {away[:, -1].mean():.0f} mm")
    return fig


def dampers_table(activation):
    """What resists each joint's turning where reaches start: dampers and muscles, Markdown."""

    def resistance(velocity):
        need, pull = plant.required_torque(habits.START, velocity, 0 * velocity)
        return need - pull @ activation

    shares, ways = plant.JOINT_COUPLING, 0.01 * np.eye(7)  # rad/s
    dampers = np.diag(shares.T * plant.MODEL.dof_damping @ shares)
    brakes = [(resistance(v) - resistance(-v)) @ v / (2 * v @ v) for v in ways]
    columns = JOINTS, dampers, brakes - dampers
    rows = list(zip(*columns, strict=True))
    return table(["joint", "dampers (N m s/rad)", "muscles (N m s/rad)"], rows, ".2f")


def stop_table(draws):
    """What is left once the place is corrected, and the drift too: mean and range of draws."""
    rows = []
    for kind, movements in {"place": 5, "place and drift": 13}.items():
        found = (1000 * draws[f"{kind}, {measure}"] for measure in ("miss", "speed"))
        texts = (f"{x.mean():.1f} ({x.min():.1f} to {x.max():.1f})" for x in found)
        rows.append([kind, *texts, movements])
    heads = "corrected", "miss (mm)", "speed over the hold (mm/s)", "movements"
    return table(heads, rows)


def measures_table(many, online):
    """What was measured of planned and corrected reaches, and of granule cells: Markdown."""
    rows = [
        ["planned miss / way", many["planned / way"]],
        ["the same with Eq. 4 exact", many["Eq. 4 / way"]],
        ["speed over the hold (m/s)", many["planned speed"]],
        ["the same, two corrections", many["corrected speed"]],
        ["stray over the hold (m)", many["planned stray"]],
        ["the same, two corrections", many["corrected stray"]],
        ["left, granule cells, in sample", online["in-sample"]],
        ["left, granule cells, held-out", online["held-out"]],
    ]
    return table(["measured", "mean (95 % interval)"], rows)


def activation_curves(holds):
    """How active all muscles are, name -> (63,), the most active first; dotted, 5 %."""
    fig, ax = panels(size=(4.3, 2.7))
    for (name, active), colour in zip(holds.items(), ("green", "blue"), strict=True):
        places = np.arange(1, len(active) + 1)
        ax.plot(places, np.sort(active)[::-1], ".-", color=COLOURS[colour], label=name)
    ax.axhline(0.05, ls=":", color=COLOURS["grey"], gid="5 %")
    ax.set(xlabel="muscles, the most active first", ylabel="activation", xlim=(0, 64))
    ax.legend()
    return fig


def strongest(activation):
    """The four most active muscles of (63,), name -> activation, the strongest first."""
    return {plant.MUSCLES[m]: activation[m] for m in np.argsort(-activation)[:4]}


def shares_text(active):
    """Muscles' activations, name -> share, in words."""
    return ", ".join(f"{name} {share:.0%}" for name, share in active.items())


def roles_text(names):
    """What muscles do, those of one role together; KeyError for one that `ROLES` lacks."""
    named = {}
    for name in names:
        named.setdefault(ROLES[name], []).append(name)
    return "; ".join(f"{' and '.join(muscles)}: {role}" for role, muscles in named.items())


def views(motion, moment, target):
    """A movement at one of its moments, the finger's way so far, and the target (a green ring).

    A plot for each view; in its corner, the target's surroundings, larger.
    """
    bones, ways = lines(motion.joints[moment])
    tips = plant.fingertip([*motion.joints[:moment:3], motion.joints[moment]])
    away = 1000 * np.linalg.norm(tips[-1] - target)
    active = motion.activation[moment]
    shade = np.clip(0.22 + 1.6 * active, 0, 1)
    fig, *axes = panels(2, size=(8.2, 3.65))
    for ax, (title, (x, y, label)) in zip(axes, VIEWS.items(), strict=True):
        paths = [way[:, [x, y]] for way in ways]
        ax.plot(bones[:, x], bones[:, y], **BONE, gid="bones")
        ax.add_collection(
            LineCollection(paths, colors=COLOURS["red"], alpha=shade, lw=0.7 + 2 * active)
        )
        for near in ({}, corner(ax, target[[x, y]], upside_down=y == 2)):
            blue = {"color": COLOURS["blue"], **near}
            ax.plot(tips[:, x], tips[:, y], lw=1.4, gid="the finger's way", **blue)
            ax.plot(tips[-1, x], tips[-1, y], "o", ms=4, gid="the finger", **blue)
            ax.plot(target[x], target[y], "o", ms=9, **RING, gid="target", **near)
        view_from(ax, y, label, f"{title}: {away:.0f} mm away")
    return fig


def corner(ax, middle, upside_down):
    """What draws in a framed corner of a plot, larger, what lies around `middle` (2,).

    It has no axes of its own: a demo draws them for longer than all that is in them.
    """
    place, size = CORNER
    frame = ax.add_patch(Rectangle(place, *size, transform=ax.transAxes, fill=False, lw=0.8))
    larger = (
        Affine2D().translate(*-middle).scale(*size / (2 * NEAR) * [1, -1 if upside_down else 1])
    )
    return {"transform": larger.translate(*place + size / 2) + ax.transAxes, "clip_path": frame}


def view_from(ax, y, label, title):
    """The axes of a view, which shows the axis `y` upwards."""
    low, high = ((-0.45, 0.3), (0.35, -0.4))[y == 2]
    ax.set(xlim=(-0.2, 0.68), ylim=(low, high), aspect="equal")
    ax.set(xticks=(0, 0.3, 0.6), yticks=(-0.3, 0, 0.3))
    ax.set(xlabel="forward (m)", ylabel=label, title=title)
