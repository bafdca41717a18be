"""Figures of the chapter on noise: learning curves, estimates, what corrections leave."""

from itertools import product

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.transforms import Affine2D

from book.figures.panels import mark_now, panels, shade
from vmc_lib.arm.model import MUSCLES
from vmc_lib.show import dot_plot, table
from vmc_lib.show.palette import COLOURS
from vmc_lib.statistics import t_interval


def scatter_table(scatter):
    """`muscle_scatter` by the noise in percent: a table."""
    rows = [[percent, f"{varies:.1%}", *mm] for percent, (varies, *mm) in scatter.items()]
    heads = "σ (%)", "held at 0.1, activation varies by", "forward (mm)", "up (mm)"
    return table([*heads, "mean moved by (mm)"], rows, ".1f")


def filtered_reach(place, reports, estimate, errors, believed, alone):
    """A reach's deviation over time: real, reported and estimated (ticks,) in mm; and the errors.

    `errors` are those of filters, by the error in mm that they believe the eye to have, of which
    one is `believed`; `alone` those of the eye and of the model.
    """
    fig, left, right = panels(2, (8.2, 3.4))
    time = np.arange(1, len(place) + 1) / 100  # s
    left.plot(time, reports, ".", ms=3, color=COLOURS["orange"], label="reported")
    left.plot(time, place, color=COLOURS["grey"], label="real")
    left.plot(time, estimate, color=COLOURS["blue"], label="estimated")
    left.set(xlabel="time (s)", ylabel="off its way, forward (mm)", ylim=(-20, 20))
    above = {"loc": "lower left", "bbox_to_anchor": (0, 1), "ncols": 3, "frameon": False}
    left.legend(**above, borderaxespad=0.2, columnspacing=1, handlelength=1.2)
    right.plot(*zip(*errors.items(), strict=True), ".-", color=COLOURS["blue"])
    for (name, error), style in zip(alone.items(), ("--", ":"), strict=True):
        right.axhline(error, color=COLOURS["grey"], ls=style, label=name)
    mark_now(right, believed, errors[believed])
    right.set(xscale="log", yscale="log", ylim=(0.2, 300))  # room for the legend
    right.set(xlabel="believed error of the eye (mm)", ylabel="estimate off by (mm)")
    for axis in (right.xaxis, right.yaxis):
        axis.set_ticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
    right.minorticks_off()
    right.set_title(f"the estimate is off by {errors[believed]:.2g} mm")
    right.legend(loc="upper left")
    return fig


def trust_over_time(believed, eye, off):
    """The share of a surprise that is believed, and errors in mm, by what makes them (ticks,).

    `eye` is the eye's own error in mm.
    """
    fig, left, right = panels(2, (8.2, 3.0))
    time = np.arange(1, len(believed) + 1) / 100  # s
    left.plot(time, believed, color=COLOURS["purple"])
    left.set(xlabel="time (s)", ylabel="share believed", ylim=(0, 1))
    left.set_title(f"in the end {believed[-1]:.1%}")
    for (name, error), hue in zip(off.items(), ("grey", "blue"), strict=True):
        right.plot(time, error, color=COLOURS[hue], label=name)
    right.axhline(eye, color=COLOURS["grey"], ls="--", label=f"the eye alone: {eye:g} mm")
    right.set(xlabel="time (s)", ylabel="off by (mm)", ylim=(0, 1.3 * off["the model alone"].max()))
    right.legend(loc="upper left")
    return fig


def learning_curves(ratios, learners, counts):
    """What learners leave of habit's miss after `counts` (k,) of movements, and what noise leaves.

    `ratios` (seeds, k) by the learner's name and "held-out"; means with 95 % intervals.
    """
    fig, ax = panels(size=(4.3, 3.4))
    for k, name in enumerate(learners):
        beside = {"transform": Affine2D().scale(1.04 ** (k - 1), 1) + ax.transData}
        left = t_interval(ratios[f"{name}, held-out"])
        ax.errorbar(counts, *left, fmt="o-", ms=4, label=name, **beside)
    floor = ratios["nothing but noise"].mean()
    ax.axhline(floor, color=COLOURS["grey"], ls=":", label="the noise alone")
    ax.set(xlabel="movements", ylabel="left of habit's miss")
    ax.set(xscale="log", ylim=(0, 1.7))
    ax.set_xticks(counts, counts)
    ax.legend(ncols=2, loc="upper right")
    return fig


def scatter_and_miss(uncorrected, paid, weak_miss, corrected, corrected_weak_miss):
    """How far reaches scatter on their way, and miss with each muscle weak; both in mm.

    Scatter (151,), `uncorrected` by rule, and with corrections `paid` for the whole way; misses
    (6,), of the commands alone and corrected.
    """
    time = np.arange(len(corrected)) / 100  # s
    fig, left, right = panels(2, (8.2, 3.4))
    for (rule, scatter), hue in zip(uncorrected.items(), ("grey", "orange", "green"), strict=True):
        left.plot(time, scatter, color=COLOURS[hue], label=rule)
    left.plot(time, corrected, color=COLOURS["blue"], label="corrected")
    left.plot(time, paid, "--", color=COLOURS["blue"], lw=1, label="all the way")
    left.axvline(0.35, ymax=0.77, color=COLOURS["grey"], lw=1)
    shade(left, 0.7, 1.5)
    left.set(xlabel="time (s)", ylabel="scatter (mm)", ylim=(0, 4.4))
    left.set_title(f"in the hold {corrected[100:].mean():.1f} mm")
    left.legend(ncols=2, loc="upper left")
    right.plot(weak_miss, MUSCLES, "o", color=COLOURS["orange"], label="the command alone")
    right.plot(corrected_weak_miss, MUSCLES, "o", color=COLOURS["blue"], label="corrected")
    right.set(xlabel="miss when this one is weak (mm)", xlim=(-1, None))
    right.invert_yaxis()
    right.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1), borderaxespad=0.2)
    return fig


def miss_and_drive(rules, who):
    """By every rule the miss, and by one of them how hard each muscle is driven: two dot plots."""
    misses = {when: {rule: row[when]["miss"] for rule, row in rules.items()} for when in rules[who]}
    drives = {
        when: dict(zip(MUSCLES, 100 * row["drive"].T, strict=True))
        for when, row in rules[who].items()
    }
    return (
        dot_plot(misses, "miss (mm)", xlim=(-2, None)),
        dot_plot(drives, f"driven by {who} (%)", xlim=(-0.5, None)),
    )


def learners_table(draws, levels, learners):
    """What is left of habit's miss after the last lesson, by scatter (mm) and learner: a table."""
    rows = [
        [mm, who, *(draws[mm][f"{who}, {on}"][..., -1] for on in ("in-sample", "held-out"))]
        for mm, who in product([f"{level} mm" for level in levels], learners)
    ]
    return table(["scatter", "who learned", "in sample", "held-out"], rows, ".2f")


def efforts_table(rules):
    """Efforts before and after a weakness is corrected, and the miss then, by rule: a table."""
    rows = {
        rule: [1000 * row[when]["effort"].mean() for when in row] + [row["after"]["miss"].mean()]
        for rule, row in rules.items()
    }
    heads = "rule", "effort before (10⁻³)", "effort after (10⁻³)", "miss after (mm)"
    return table(heads, rows, ".1f")


def last_ways(ways, target, time):
    """Hands that were told the same, near their target (2,): the last 0.3 s of `ways` (n, T, 2)."""
    fig, ax = panels(size=(4.3, 4.3))
    last = 1000 * (ways[:, max(time - 300, 0) : time + 1] - target)
    ax.plot(*last.T, color=COLOURS["grey"], lw=0.8)
    ax.plot(*last[:, -1].T, "o", color=COLOURS["red"], ms=5, gid="hands")
    ax.plot(0, 0, "o", ms=16, mfc="none", mew=2, color=COLOURS["green"])
    ax.set(xlim=(-40, 40), ylim=(-20, 60), aspect="equal")
    ax.set(xlabel="forward of the target (mm)", ylabel="above it (mm)")
    return fig


def ends_and_distances(paths, target):
    """Controllers' repeated reaches (n, ticks, 2) to a target (2,): where they end, how far off.

    Left the hands from 1 to 1.5 s, right their mean distance over time.
    """
    fig, left, right = panels(2, (8.2, 3.6))
    for (name, path), hue in zip(paths.items(), ("orange", "blue"), strict=True):
        off = 1000 * (path - target)
        left.plot(*off[:, 100:151].T, color=COLOURS[hue], lw=0.8)
        left.plot(*off[:, 150].T, "o", ms=4, color=COLOURS[hue], gid=name)
        distance = np.linalg.norm(off, axis=-1)
        mean = distance[:, 100:151].mean()
        time = np.arange(distance.shape[1]) / 100  # s
        right.plot(
            time[50::2],
            distance[:, 50::2].mean(axis=0),
            color=COLOURS[hue],
            label=f"{name}: {mean:.1f} mm",
            gid=name,
        )
    left.plot(0, 0, "o", ms=16, mfc="none", mew=2, color=COLOURS["green"])
    left.set(xlim=(-20, 20), ylim=(-20, 20), aspect="equal")
    left.set(xlabel="forward of the target (mm)", ylabel="above it (mm)")
    shade(right, 1.0, 1.5)
    right.set(xlabel="time (s)", ylabel="mean distance (mm)", ylim=(0, 30), xlim=(0.5, 2.5))
    right.legend(loc="upper right")
    return fig


def minimal_intervention(path, target, bar, aim):
    """Repeated reaches (n, ticks, 2) to a point, or to an upright `bar`, that moves by `aim` (2,).

    In mm from the target (2,) as it was.
    """
    fig, ax = panels(size=(4.3, 4.5))
    off = 1000 * (path - target)
    ax.plot(*off[:, :250:2].T, color=COLOURS["grey"], lw=0.6)
    ax.plot(*off[:, -1].T, "o", ms=4, color=COLOURS["blue"], gid="hands")
    place = 1000 * np.asarray(aim)
    for at, alpha in (((0, 0), 0.35), (place, 1.0)):
        ends = [at[0], at[0]], [at[1] - 45 * bar, at[1] + 45 * bar]
        ax.plot(*ends, "-o", ms=12, mfc="none", mew=2, color=COLOURS["green"], alpha=alpha)
    forward, up = off[:, -1].mean(axis=0).round() + 0.0  # no −0
    ax.set_title(f"ends {forward:.0f} mm forward, {up:.0f} mm up")
    ax.set(xlim=(-90, 90), ylim=(-90, 90), aspect="equal")
    ax.set(xlabel="forward (mm)", ylabel="up (mm)")
    return fig


def miss_and_effort(effort, miss):
    """Effort against miss in mm, means with 95 % intervals, by controller: draws (n,) of each."""
    fig, ax = plt.subplots(figsize=(4.3, 4.4))  # inches: a phone has the plot's whole width
    marks = "grey o, purple o, red o, orange s, orange o, green o, blue o, blue s, blue ^, ink o"
    for name, mark in zip(effort, marks.split(", "), strict=True):
        (x, wide), (y, high) = t_interval(effort[name]), t_interval(miss[name])
        hue, shape = mark.split()
        form = {"fmt": shape, "label": name, "color": COLOURS[hue]}
        form |= {} if shape == "o" else {"mfc": "none", "ms": 9}  # many stand in one place
        ax.errorbar(x, y, high, wide, **form)
    ax.set(xlabel="effort / the least", ylabel="miss (mm)", xlim=(0.5, 5.0), ylim=(0, 22))
    fig.legend(loc="outside upper center", ncols=2, columnspacing=1, handlelength=1)
    return fig
