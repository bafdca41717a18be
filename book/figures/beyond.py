"""Figures of the chapter beyond the paper."""

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import panels
from book.figures.reaching import norm_mm
from reproduce.experiments.obstacle_avoidance import RADIUS
from vmc_lib.arm.model import MUSCLES
from vmc_lib.show import dot_plot, note
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane
from vmc_lib.show.palette import COLOURS
from vmc_lib.statistics import student

TRIED = ((-0.05, 0.3), (-0.53, -0.25))  # the plane round the obstacles, m


def miss_histogram(miss):
    """How many reaches miss by how much: `miss` (n,) in mm, on a logarithmic axis, a median."""
    fig, ax = panels(size=(5.5, 3.2))
    ax.stairs(*np.histogram(miss, np.geomspace(0.01, 40, 37)), fill=True)
    median = np.median(miss)
    ax.axvline(median, color="C1", label=f"median {median:.2g} mm")
    ax.set(xscale="log", xlabel="miss at the end of the reach (mm)")
    ax.set(ylabel="reaches", ylim=(0, 20), yticks=range(0, 21, 5))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.legend(loc="upper left")
    return fig


def learning_curves(ratios, learners, counts):
    """What learners leave of habit's miss after `counts` (k,) of movements, and what noise leaves.

    `ratios` (seeds, k) by the learner's name and "held-out"; means with 95 % intervals.
    """
    fig, ax = panels(size=(6.5, 3.4))
    for k, name in enumerate(learners):
        beside = np.array(counts) * 1.04 ** (k - 1)
        ax.errorbar(beside, *student(ratios[f"{name}, held-out"]), fmt="o-", ms=4, label=name)
    floor = ratios["nothing but noise"].mean()
    ax.axhline(floor, color=COLOURS["grey"], ls=":", label="the noise alone")
    ax.set(xlabel="movements", ylabel="left of habit's miss")
    ax.set(xscale="log", ylim=(0, 1.7))
    ax.set_xticks(counts, counts)
    ax.legend(ncols=2, loc="upper right")
    return fig


def scatter_and_miss(uncorrected, weak_miss, corrected, corrected_weak_miss):
    """How far reaches scatter on their way, and miss with each muscle weak; both in mm.

    Scatter (151,), `uncorrected` by rule; misses (6,), of the commands alone and corrected.
    """
    time = np.arange(len(corrected)) / 100  # s
    fig, left, right = panels(2, (8.2, 3.4))
    for (rule, scatter), hue in zip(uncorrected.items(), ("grey", "orange", "green"), strict=True):
        left.plot(time, scatter, color=COLOURS[hue], label=rule)
    left.plot(time, corrected, color=COLOURS["blue"], label="corrected")
    left.axvspan(0.7, 1.5, color=COLOURS["grey"], alpha=0.15, lw=0)
    left.set(xlabel="time (s)", ylabel="scatter (mm)", ylim=(0, 3.5))
    left.set_title(f"in the hold {corrected[100:].mean():.1f} mm")
    left.legend()
    right.plot(weak_miss, MUSCLES, "o", color=COLOURS["orange"])
    right.plot(corrected_weak_miss, MUSCLES, "o", color=COLOURS["blue"])
    right.set(xlabel="miss when this one is weak (mm)", xlim=(-1, None))
    right.invert_yaxis()
    return fig


def miss_and_drive(rules, who):
    """By every rule the miss, and by one of them how hard each muscle is driven: two dot plots."""
    misses = {when: {rule: row[when]["miss"] for rule, row in rules.items()} for when in rules[who]}
    drives = {
        when: dict(zip(MUSCLES, 100 * row["drive"].T, strict=True))
        for when, row in rules[who].items()
    }
    return (
        dot_plot(misses, "miss (mm)", xlim=(0, None)),
        dot_plot(drives, f"driven by {who} (%)", xlim=(0, None)),
    )


def error_divided(rows):
    """What divides the error of a sweep's records: a tenfold size, on average, and all of it."""
    first, last = rows[0], rows[-1]
    whole = first["error"] / last["error"]
    return whole ** (1 / np.log10(last["size"] / first["size"])), whole


def scaling(rows, quantity, measure):
    """Error and seconds against size, both logarithmic, of a sweep's records.

    `quantity` is what grows, `measure` names the error.
    """
    marked = [0, len(rows) // 2, -1]
    fig, *axes = panels(2)
    curves = ("error", measure, "blue"), ("seconds", "seconds to learn", "orange")
    for ax, (key, label, hue) in zip(axes, curves, strict=True):
        sizes, values = np.array([(row["size"], row[key]) for row in rows]).T
        ax.loglog(sizes, values, "o-", color=COLOURS[hue])
        ax.set(xlabel=quantity, ylabel=label)
        ax.set_xticks(sizes[marked], sizes[marked].astype(int))
        ax.set_yticks(values[marked], [f"{v:.3g}" for v in values[marked]])
    axes[0].set_title(f"a tenfold divides by {error_divided(rows)[0]:.1f}")
    return fig


def reach_in_space(trials, target, trial):
    """One trial of a reach for one of several targets in space: the arm's scene, and its miss."""
    movement = trials.movements[trial]
    motion, turn = movement.motion
    moves = motion.q[target], motion.activation[target]
    scene = arm_scene(*moves, turn=turn[target], balls=[(movement.plan.target[target], "green")])
    return scene, note(f"misses by {1000 * trials.error[trial, target]:.1f} mm")


def detour(templates, detours, k, key, time):
    """The hand's path up to a time (s) past ball k of `detours`, by its (route, senses)."""
    path = detours.paths[key][k, : round(100 * time) + 1]
    fig, ax = plt.subplots(figsize=(6, 4))
    plane(ax, templates, within=TRIED)
    ax.add_patch(plt.Circle(detours.balls[k], RADIUS, color=COLOURS["orange"]))
    if key[0] != "straight":
        ax.plot(*detours.vias[k], "+", ms=9, color=COLOURS["purple"], gid="via-point")
    ax.plot(*detours.targets[k], "o", ms=9, mfc="none", color=COLOURS["green"], gid="target")
    ax.plot(*path.T, color=COLOURS["blue"], gid="path")
    ax.plot(*path[-1], "o", ms=5, color=COLOURS["red"], gid="the hand")
    nearest = norm_mm(path - detours.balls[k]).min()
    ax.set_title(f"the hand came within {nearest:.0f} mm of the ball's middle")
    return fig
