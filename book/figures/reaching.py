"""Figures of reaches in the arm's plane, and their scene: for planning and calibration.

Most functions draw on matplotlib axes. Positions are in the plane, in metres.
"""

import numpy as np
from matplotlib.collections import LineCollection

from book.figures.panels import panels
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.model import MUSCLES
from vmc_lib.motor.planning import norm
from vmc_lib.motor.templates import mean_distance
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane
from vmc_lib.show.markup import minus
from vmc_lib.show.palette import COLOURS

RING = {"mfc": "none", "mew": 1.8, "color": COLOURS["green"]}  # a target's mark


def weight_threads(ax, target, points, weights):
    """Threads from the target (2,) to the templates used (N, 2), as thick as their weights (N,)."""
    threads(ax, target, points, color=COLOURS["blue"], lw=10 * np.abs(weights))
    ax.plot(*np.transpose(points), "o", ms=7, color=COLOURS["blue"], gid="templates used")
    for point, weight in zip(points, weights, strict=True):
        away = 7 if point[1] >= target[1] else -14  # from the threads
        ax.annotate(f"{weight:.2f}", point, (0, away), textcoords="offset points", ha="center")


def ends(ax, targets, reached):
    """Targets (…, 2) as green rings; where the hand ended (…, 2) as red dots, each on a line."""
    targets, reached = np.reshape(targets, (-1, 2)), np.reshape(reached, (-1, 2))
    threads(ax, targets, reached, color=COLOURS["red"], lw=1)
    ax.plot(*targets.T, "o", ms=8, **RING, gid="targets", zorder=4)  # above arrows
    ax.plot(*reached.T, "o", ms=4, color=COLOURS["red"], gid="the hand", zorder=4)


def reaches(ax, templates, targets, reached, title=""):
    """The plane with its templates (N, 2), and reaches: `ends` of targets and hands (…, 2)."""
    plane(ax, templates)
    ends(ax, targets, reached)
    ax.set_title(title)


def norm_mm(vectors):
    """How long vectors (…, d) in m are, in mm."""
    return 1000 * norm(vectors)


def mean_mm(holds, targets):
    """Mean distance (…,) in mm of hands over the hold (…, n, T, 2) from targets (n, 2), in m."""
    return 1000 * mean_distance(holds, targets).mean(axis=-1)


def threads(ax, tails, tips, **style):
    """Straight lines from tails (…, 2) to tips (n, 2); `style` as for a LineCollection."""
    ax.add_collection(LineCollection(np.stack(np.broadcast_arrays(tails, tips), axis=1), **style))


def arrows(ax, tails, tips, colour, label=None):
    """Arrows from tails (…, 2) to tips (…, 2) in one named colour; the label is for a legend."""
    tails, tips = (np.reshape(p, (-1, 2)) for p in np.broadcast_arrays(tails, tips))
    ax.quiver(
        *tails.T,
        *(tips - tails).T,
        angles="xy",
        scale_units="xy",
        scale=1,
        width=0.005,
        minlength=0,
        color=COLOURS[colour],
        label=label,
        zorder=3,
    )


def corrections(ax, target, reached, points, change):
    """Fig. 4: the error, the way from the hand to each template (N, 2), and its weight's change."""
    plane(ax, points, within=np.stack([points.min(axis=0) - 0.015, points.max(axis=0) + 0.015], -1))
    arrows(ax, reached, points, "grey")
    arrows(ax, reached, target, "blue")
    for point, by in zip(points, change, strict=True):
        text = minus(f"{by:+.3f}")
        away = 6 if point[1] >= reached[1] else -14  # from the arrows
        ax.annotate(text, point, (0, away), textcoords="offset points", ha="center")


def weighted_sum(ax, excitations, weights):
    """Fig. 9: one muscle's excitations (N, T), each times its weight (N,), and their sum."""
    time = np.arange(excitations.shape[-1]) / 1000
    for n, part in enumerate(weights[:, None] * excitations):
        ax.plot(time, part, color=COLOURS["blue"], lw=1, label="$w_i u_i$" if n == 0 else None)
    ax.plot(time, weights @ excitations, color=COLOURS["red"], label=r"$u_t = \sum w_i u_i$")
    ax.set(xlabel="time (s)", ylabel="excitation")
    ax.legend(loc="upper left")


def plan_figures(past, muscle, reach=None):
    """Two figures: a plan in the plane, and one muscle's excitation as its sum; or both empty.

    The plan is that of a `reach`, a `Movement`, and mixes templates of `past`.
    """
    (in_plane, left), (over_time, right) = (panels(1, (4.1, 3.4)) for _ in range(2))
    plane(left, past.points)
    commands, weights = np.empty((1, 0)), np.ones(1)
    if reach is not None:
        one = reach.plan
        commands, weights = past.excitations[one.rows, :, muscle], one.weights
        weight_threads(left, one.target, one.points, weights)
        ends(left, one.target, reach.endpoint)
        left.set_title(f"the hand misses by {1000 * reach.error:.1f} mm")
    weighted_sum(right, commands, weights)
    right.set(title=f"excitation of {MUSCLES[muscle]}", xlim=(-0.05, 1.05), ylim=(0, 0.3))
    return in_plane, over_time


def plan_in_page(past, muscle, ended):
    """The same for the page to work out (see `explore`); `ended` (N, 2) for all its positions."""
    every = 20  # ms
    commands = past.excitations[:, ::every, muscle]
    given = {"points": past.points, "commands": commands.round(4), "ends": ended.round(5)}
    given = {name: values.tolist() for name, values in given.items()} | {"every": every / 1000}
    return "plan", lambda: plan_figures(past, muscle), given


def reach_scene(motion, target):
    """The arm in one movement's motion to a target (2,), a green ball; its end point is red."""
    balls = [(hand(inverse_kinematics(target)), "green")]
    end = motion.wrist.mean(axis=0), motion.speed
    return arm_scene(motion, balls=balls, end=end)
