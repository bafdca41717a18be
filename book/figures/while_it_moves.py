"""Figures of feedback control: hands on their way, a curl field's learning curve, two memories.

Hands move in the plane, in metres, with a sample every millisecond.
"""

from itertools import product

import numpy as np

from book.figures.panels import curves, panels, shade, shade_change
from book.figures.reaching import RING, norm_mm
from reproduce.experiments import feedback_control as measure
from reproduce.measures.path_measures import end_error, end_speed, end_swing, push_error
from vmc_lib.cerebellum.forward_model import arm_copy, state_inputs
from vmc_lib.cerebellum.online import GranuleCells, LinearRegression
from vmc_lib.motor.feedback import SIGHT
from vmc_lib.show import dot_plot, table
from vmc_lib.show.arm_plane import plane
from vmc_lib.show.markup import number
from vmc_lib.show.palette import COLOURS

SIZE, WITHIN = (8.2, 3.3), ((-0.08, 0.3), (-0.53, -0.2))  # inches; m
FAR = (-0.2, 0.32), WITHIN[1]  # m: as far as a loop swings that is fast and late
EVERY = 10  # ms
GUIDE = {"color": COLOURS["grey"], "gid": "guide"}


def path_and_distance(
    templates, path, goal, titles=("", ""), reference=None, top=200, within=WITHIN
):
    """A hand's path (T, 2) and its goal (2,), and over time its distance from there.

    Or from the `reference` (T, 2), where the hand should be. A figure and its two plots.
    """
    fig, left, right = panels(2, SIZE)
    if reference is not None:
        left.plot(*reference[::EVERY].T, ":", lw=1.5, **GUIDE)
    plane(left, templates, within)
    left.plot(*path[::EVERY].T, color=COLOURS["blue"], gid="path")
    left.plot(*path[::EVERY][-1], "o", ms=5, color=COLOURS["red"], gid="hand")
    left.plot(*goal, "o", ms=9, **RING, gid="target")
    distance = norm_mm(path - (goal if reference is None else reference))[::EVERY]
    right.plot(EVERY / 1000 * np.arange(len(distance)), distance, color=COLOURS["blue"])
    label = "to the target (mm)" if reference is None else "off its way (mm)"
    right.set(xlabel="time (s)", ylabel=label, ylim=(0, top))
    for ax, title in zip((left, right), titles, strict=True):
        ax.set_title(title)
    return fig, left, right


def target_jump(templates, paths, first, second, k, time):
    """The k-th of n paths (n, T, 2) until a `time` in s; targets jump from (2,) to (n, 2)."""
    fig, left, right = path_and_distance(templates, paths[k, : round(1000 * time) + 1], second[k])
    left.plot(*first, "o", ms=9, **RING, alpha=0.35, gid="target before")
    shade(right, measure.JUMPS_AT, measure.JUMPS_AT + SIGHT.delay)
    distances = norm_mm(paths[:, ::EVERY] - second[:, None])
    seconds = EVERY / 1000 * np.arange(distances.shape[1])
    right.plot(seconds, distances[k], lw=1, zorder=1.9, **GUIDE)
    if time == seconds[-1]:
        off, speed = end_error(paths, second), end_speed(paths)
        left.set_title(f"from 1.5 to 2 s: {off[k]:.0f} mm off, at {speed[k]:.0f} mm/s")
        right.set_title(f"all four jumps: {off.mean():.0f} mm off, at {speed.mean():.0f} mm/s")
    return fig


def late_loop(templates, path, goal):
    """A hand's path (T, 2) to its goal (2,): how far off it ends, and how far it swings."""
    off, swing, speed = end_error(path, goal), end_swing(path), end_speed(path)
    titles = f"from 1.5 to 2 s: {off:.0f} mm off", f"swings by {swing:.0f} mm, at {speed:.0f} mm/s"
    return path_and_distance(templates, path, goal, titles, top=280, within=FAR)[0]


def push(templates, path, goal, reference, at):
    """A hand's path (T, 2), pushed at `at` s, beside its reference (T, 2)."""
    most, end = push_error(path, reference, at)
    titles = f"in the end {end:.0f} mm off", f"at most {most:.0f} mm off"
    fig, _, right = path_and_distance(templates, path, goal, titles, reference, top=160)
    right.axvspan(at, at + 0.05, color=COLOURS["red"], alpha=0.25, lw=0)
    right.axvspan(at + 0.05, at + SIGHT.delay, color=COLOURS["grey"], alpha=0.2, lw=0)
    return fig


def tremor_and_overshoot(tremors, overshoots, limit):
    """Two dot plots, name -> mm² and name -> mm, with a line at a `limit` in mm."""
    fig = dot_plot({"": tremors}, "power, 3 to 8 Hz (mm²)")
    low, high = min(tremors.values()), max(tremors.values())
    fig.axes[0].set(xscale="log", xlim=(low / 2, 2 * high))
    far = dot_plot({"": overshoots}, "overshoot (mm)")
    far.axes[0].axvline(limit, color=COLOURS["grey"], ls="--", lw=1)
    return fig, far


def gain_curves(gains, by_gain, gain):
    """A plot for each measure of `by_gain`, measure -> arm -> (n,), over n gains; one is marked."""
    fig, *axes = panels(len(by_gain), SIZE)
    k = gains.index(gain)
    for ax, (measured, lines) in zip(axes, by_gain.items(), strict=True):
        for arm, line in lines.items():
            ax.plot(gains, line, ".-", label=f"{arm}: {number(line[k])}", gid=arm)
        ax.axvline(gain, ymax=0.68, color=COLOURS["red"], lw=1.5, gid="now")  # below the legend
        ax.set(xscale="log", yscale="log", xlabel="gain (1/s²)", ylabel=measured)
        ax.set_xticks(gains, gains)
        ax.minorticks_off()
        ax.set_ylim(top=100 * max(map(max, lines.values())))  # room for the legend
        ax.legend(loc="upper left")
    return fig


def curl_field(templates, paths, reference, deviations, block, blocks):
    """Hands' paths (n, T, 2) in a block beside the reference, and the learning curve (blocks,), mm.

    `blocks` counts those before, in and after the field.
    """
    fig, left, right = panels(2, SIZE)
    plane(left, templates, WITHIN)
    for path, line in zip(paths, reference, strict=True):
        left.plot(*line[::20].T, ":", lw=1, **GUIDE)
        left.plot(*path[::20].T, color=COLOURS["blue"])
    shade_change(right, blocks)
    curves(right, range(len(deviations)), {"": deviations[: block + 1]}, (block, deviations[block]))
    bound = 1.2 * np.abs(deviations).max()
    right.set(xlabel="block of 8 reaches", ylabel="to the left (mm)")
    right.set(xlim=(-1, len(deviations)), ylim=(-bound, bound))
    return fig


def two_rates(states):
    """What the fast and the slow memory hold, (n, 2), and together.

    Lines stand after the first hundred reaches, and before the last.
    """
    fig, ax = panels(size=(4.3, 3.2))
    for change in (100, len(states) - 100):
        ax.axvline(change, color=COLOURS["grey"], lw=1, ls=":")
    for name, line in zip(("fast", "slow"), states.T, strict=True):
        ax.plot(line, lw=1.2, label=name)
    ax.plot(states.sum(axis=1), color=COLOURS["ink"], label="together")
    ax.set(xlabel="reach", ylabel="answered share", ylim=(-0.8, 1.05))
    ax.legend(loc="lower right")
    return fig


def models_by_lessons(template_set, counts):
    """Forward models by what they know: nothing, inertia alone, so many reaches, the equations."""
    draws = (np.random.default_rng(5) for _ in counts)
    learnt = [measure.fit_forward_model(template_set, *x) for x in zip(draws, counts, strict=True)]
    felt = [f"{n} reach{'es' * (n > 1)} felt" for n in counts]
    inert = {"no model": None, "it goes on as it goes": lambda q, velocity, activation: 0 * q}
    return inert | dict(zip(felt, learnt, strict=True)) | {"the true equations": arm_copy()}


def null_models(template_set, counts):
    """Forward models by (rule, inputs) and count: granule cells' nulls, from the same lessons."""
    rules = {
        "least squares": LinearRegression,
        "granule cells": lambda: GranuleCells(width=1.0, cells=300, ridge=1e-3),
    }
    inputs = {"torque": state_inputs, "activations": measure.active_inputs}
    kinds = [*product(rules, inputs)]
    kinds.remove(("granule cells", "torque"))  # the chapter's own
    return {
        (rule, told, n): measure.fit_null_model(
            template_set, np.random.default_rng(5), n, rules[rule](), inputs[told]
        )
        for rule, told in kinds
        for n in counts
    }


def null_table(overshoots, own, counts):
    """How far the hand overshoots, mm, by rule, by inputs, and by reaches felt: a table.

    `own` (counts,) are the granule cells' of the chapter.
    """
    rows = [["granule cells", "torque", *own]]
    for rule, told in dict.fromkeys(key[:2] for key in overshoots):
        rows.append([rule, told, *(overshoots[rule, told, n] for n in counts)])
    felt = [f"{n} reach{'es' * (n > 1)} felt" for n in counts]
    return table(["overshoot (mm) by", "from posture, speed and", *felt], rows, ".1f")


def kinematics_table(gains):
    """All measures at gain 30, with late sight alone and with a forward model: a table."""
    arms, measures = ("late sight", "forward model"), ("swing (mm²)", "overshoot (mm)")
    measures += "tremor (mm²)", "path over distance"
    measures += "miss after a jump (mm)", "speed after a jump (mm/s)"
    rows = {m: [gains[f"{arm}, 30, {m}"] for arm in arms] for m in measures}
    return table(["measured", *arms], rows)


def field_table(draws, blocks):
    """How far reaches deviate in a curl field and after it, in six draws: a table."""
    new, gone = blocks[0], sum(blocks[:2])
    rows = {
        "before the field": ("size", 0),
        "first block in the field": ("size", new),
        "last block in the field": ("size", gone - 1),
        "first block without it, to the left": ("to the left", gone),
        "last block without it, to the left": ("to the left", -1),
        "ways halfway between: in the field, before": ("held-out", 0),
        f"after {8 * blocks[1]} reaches of the others": ("held-out", 1),
    }
    rows = {name: [draws[part][:, n]] for name, (part, n) in rows.items()}
    return table(["reaches", "deviation (mm), 95 % interval"], rows)
