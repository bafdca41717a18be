"""Figures of habitual planning: a reach, the parts of its miss, two frames, and effort."""

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import panels
from book.figures.reaching import arrows, ends, norm_mm, plane
from reproduce.measures.planning_error import TARGETS, mixture_and_endpoint
from reproduce.peers import optimal_control
from reproduce.peers.minimum_variance import MEASURE_NAMES, kinematic_measures
from vmc_lib.arm.model import MUSCLES
from vmc_lib.motor import templates
from vmc_lib.show import table
from vmc_lib.show.markup import minus
from vmc_lib.show.palette import COLOURS

WATCHED = {name: MEASURE_NAMES[name] for name in ("path", "farthest", "speed")}
WATCHED["height"] = "lowest above the table (mm)"


def planned_in_words(target, ended):
    """A plan for a target (2,) that took the hand to `ended` (2,)."""
    at = minus(", ".join(f"{x:z.3f}" for x in target))
    return (
        f"A target at {at} m and the four templates that plan it; the hand ends "
        f"{norm_mm(ended - target):.1f} mm away. Beside it, one muscle's excitation as a weighted "
        "sum."
    )


def parts_of_miss(rule, spacing, number):
    """The parts of each miss that the weights and the arm have, as arrows; `spacing` in cm."""
    mixed, reached = mixture_and_endpoint(rule, spacing / 100, number)
    parts = reached - mixed, mixed - TARGETS, reached - TARGETS
    by_arm, by_weights, in_all = (norm_mm(part).mean() for part in parts)
    fig, ax = plt.subplots(figsize=(4.3, 4.4))  # inches: a phone has the plot's whole width
    plane(ax, templates.load(spacing / 100).points, within=((-0.02, 0.2), (-0.51, -0.29)))
    arrows(ax, mixed, reached, "orange", f"the arm: {by_arm:.1f} mm")
    arrows(ax, TARGETS, mixed, "blue", f"the weights: {by_weights:.1f} mm")
    ax.plot(*TARGETS.T, "o", ms=4, mfc="none", color=COLOURS["green"], gid="targets")
    fig.legend(loc="outside upper right")
    ax.set_xticks([0, 0.1, 0.2])
    ax.set_title(f"the mean place misses by {in_all:.1f} mm")
    return fig


def in_frame(origin, weights, points, target):
    """A target (2,) as a frame at `origin` (2,) measures it, and the place that weights (4,) mix.

    They mix the points (4, 2) by Eq. 4 in this frame, purple; all is drawn as measured from the
    shoulder.
    """
    place = origin + weights @ (points - origin)
    fig, ax = plt.subplots(figsize=(4.3, 4.3))
    plane(ax, templates.load().points, within=((-0.08, 0.42), (-0.62, 0.34)))
    arrows(ax, [origin, origin], origin + np.array([[0.07, 0], [0, 0.07]]), "purple")
    arrows(ax, origin, target, "purple")
    x, y = target - origin
    ax.annotate(f"({x:.2f}, {y:.2f}) m", origin, (8, -13), textcoords="offset points")
    ends(ax, target, place)
    at = "mixed to ({:.3f}, {:.3f}) m".format(*place)
    away = f"{norm_mm(place - target):.0f} mm from the target"
    ax.set_title(minus(f"{at}, {away}"), fontsize=10)
    return fig


def before_and_after(before, after):
    """Misses (n,) in mm of the same targets, without the nearest template over with it."""
    fig, ax = panels(size=(4.3, 3.2))
    ax.plot(before, after, "o", ms=4, alpha=0.6, gid="targets")
    ends = [0, max(before.max(), after.max())]
    ax.plot(ends, ends, "--", color=COLOURS["grey"], gid="no change")
    ax.set(xlabel="miss with all templates (mm)", ylabel="without the nearest (mm)")
    return fig


def habit_beside_optimum(target, motions, costs):
    """The hand's way and each muscle's effort on the way to one of the optima's targets (2,).

    `motions` {name: Motion} and `costs` {name: (20, 6)}, by target and muscle, are of habit first,
    then of the optimum.
    """
    k = np.abs(optimal_control.TARGETS - target).sum(axis=1).argmin()
    fig, left, right = panels(2, (8.2, 3.4))
    plane(left, templates.load().points, ((-0.02, 0.26), (-0.55, -0.29)))
    across = np.arange(len(MUSCLES))
    for row, (name, motion) in enumerate(motions.items()):
        colour = COLOURS[("blue", "orange")[row]]
        left.plot(*motion.hand[k, :, :2].T, color=colour, gid=name)
        bars = 1000 * costs[name][k]
        right.bar(across + 0.4 * row, bars, 0.4, color=colour, label=name)
    ends(left, target, motion.endpoint[k])
    right.set_xticks(across + 0.2, MUSCLES, rotation=30)
    habit, optimum = (cost[k].mean() for cost in costs.values())
    right.set_title(f"habit spends {habit / optimum:.1f} times as much")
    most = 1000 * max(cost.max() for cost in costs.values())
    right.set(ylabel="effort (10⁻³)", ylim=(0, 1.05 * most))
    right.legend()
    return fig


def paths_table(motions, targets):
    """Medians and ranges of how each rule's reaches go, rule -> `HeldMotion`: a Markdown table."""
    rows = {}
    for name, motion in motions.items():
        measures = kinematic_measures(motion, targets)
        ends = ((np.median(x), x.min(), x.max()) for x in map(measures.get, WATCHED))
        rows[name] = ["{:.2g} ({:.2g} to {:.2g})".format(*three) for three in ends]
    return table(["median (range)", *WATCHED.values()], rows)


def costs_table(commands, target):
    """What commands for one target (name -> (T, 6)) reach and cost: a Markdown table."""
    u = np.stack([*commands.values()])
    measures = kinematic_measures(templates.reach(u), target[None])
    effort = 1000 * optimal_control.effort(u)
    columns = measures["miss"], measures["farthest"], measures["path"], effort
    heads = "plan", "miss (mm)", "farthest in the hold (mm)", WATCHED["path"], "effort (×10⁻³)"
    return table(heads, dict(zip(commands, np.transpose(columns), strict=True)), ".2f")
