"""Figures of the page on people: their points with error bars, and the model's curves."""

import numpy as np

from book.figures.panels import panels, shade
from reproduce import people
from reproduce.experiments.forgetting_adaptation import CLAMPED, ROTATION
from vmc_lib.show.palette import COLOURS

EVERY = 4  # cycles: so many of the clamp's points are drawn
LAST = 10  # cycles: over which a clamp's end is averaged
SECOND = 3  # the second cycle of the first rotation
TURNED = slice(22, 27)  # the last five cycles of the first rotation


def clamp_end(angles):
    """The mean of the last `LAST` clamped cycles of curves (…, cycles)."""
    return np.asarray(angles)[..., CLAMPED][..., -LAST:].mean(axis=-1)


def rotation_end(angles):
    """The mean of the last five cycles of the first rotation, of curves (…, cycles)."""
    return np.asarray(angles)[..., TURNED].mean(axis=-1)


def points(ax, x, mean, sem, label):
    """People's means with their standard errors."""
    style = {"fmt": "o", "ms": 4, "lw": 1, "color": COLOURS["ink"], "zorder": 3}
    ax.errorbar(x, mean, yerr=sem, label=label, **style)


def adaptation(clamp, rotation):
    """The model's curves in degrees, (cycles,), under people's points: error clamp and rotation."""
    fig, left, right = panels(2, (8.2, 3.6))
    cycles = np.arange(len(clamp))
    for name, hue in ((people.MISSES, "ink"), (people.HITS, "grey")):
        group = people.MEASUREMENTS["clamp"][name]
        some = slice(0, None, EVERY)
        left.errorbar(
            cycles[some],
            group["mean"][some],
            yerr=group["sem"][some],
            **{"fmt": "o", "ms": 3.5, "lw": 1, "color": COLOURS[hue]},
            label=f"people, cursor {name}",
        )
    shade(left, CLAMPED.start - 0.5, CLAMPED.stop - 0.5)
    left.plot(cycles, clamp, color=COLOURS["blue"], lw=2, label="the model")
    left.set(xlabel="cycle", ylabel="hand turns by (°)", ylim=(-5, 90))
    left.set_title(f"error clamp of 3.5°: the model ends at {clamp_end(clamp):.0f}°")
    left.legend(loc="upper left")
    turned = people.MEASUREMENTS["rotation"]
    fours = np.arange(len(turned["mean"]))
    points(right, fours, turned["mean"], turned["sem"], "people")
    shade(right, 1.5, len(ROTATION) - 0.5)
    right.plot(fours, rotation, color=COLOURS["blue"], lw=2, label="the model")
    for cursor in (30, -30):
        right.axhline(cursor, color=COLOURS["grey"], ls=":", lw=1)
    right.set(xlabel="cycle", ylabel="hand turns by (°)", ylim=(-35, 45))
    right.set_title(f"rotation of 30°: the model ends at {rotation_end(rotation):.0f}°")
    right.legend(loc="lower left")
    return fig


def sizes(degrees, ends, people_end, people_sem):
    """Where the hand ends under clamps of several sizes: the model's, by setting, and people's."""
    fig, ax = panels(size=(4.3, 3.0))
    looks = ("blue", "o-"), ("purple", "o--"), ("orange", "o-")
    for (name, end), (hue, line) in zip(ends.items(), looks, strict=True):
        ax.plot(degrees, end, line, color=COLOURS[hue], label=name)
    points(ax, [3.5], [people_end], [people_sem], "people")
    ax.set(xlabel="clamp (°)", ylabel="hand ends at (°)", xlim=(0, 15), ylim=(0, 115))
    ax.legend(loc="upper left")
    return fig


def along_shares(shares, misfit, second):
    """By the share learnt, in percent: the misfit to the clamp; the rotation's second cycle.

    Of a setting with the forgetting that comes nearest to the clamp.
    """
    fig, left, right = panels(2, (8.2, 3.0))
    for ax, y in ((left, misfit), (right, second)):
        ax.plot(shares, y, "o-", color=COLOURS["blue"], label="the model")
        ax.set(xlabel="of an error it learns (%)")
    left.set(ylabel="distance (standard errors)", ylim=(0, None))
    left.set_title(f"error clamp: nearest at {shares[np.argmin(misfit)]} %")
    turned = people.MEASUREMENTS["rotation"]
    mean, sem = (turned[key][SECOND] for key in ("mean", "sem"))
    right.axhspan(mean - sem, mean + sem, color=COLOURS["grey"], alpha=0.4, lw=0)
    right.axhline(mean, color=COLOURS["ink"], lw=1, label="people")
    right.set(ylabel="hand turns by (°)", ylim=(0, 25))
    right.set_title("rotation of 30°: second cycle")
    right.legend(loc="lower right")
    return fig


def scatter(directions, by_direction, mean, sem):
    """Standard deviations in degrees by direction (n,), and people's mean as a band."""
    fig, ax = panels(size=(4.3, 3.0))
    ax.axhspan(mean - 2 * sem, mean + 2 * sem, color=COLOURS["grey"], alpha=0.4, lw=0)
    ax.axhline(mean, color=COLOURS["ink"], lw=1, label="people, hand unseen")
    ax.plot(directions, by_direction, "o-", color=COLOURS["blue"], label="the model")
    spread = by_direction.max() / by_direction.min()
    ax.set_title(f"mean {by_direction.mean():.1f}°; most over least {spread:.0f}")
    ax.set(xlabel="direction of the reach (°)", ylabel="standard deviation (°)", ylim=(0, 20))
    ax.legend(loc="upper left")
    return fig


def sources():
    """The sources as a list: each with its people, error bars, licence, and how it was read."""
    every = (people.CLAMP, people.ROTATION, people.SCATTER, people.SPEED, people.JUMP, people.SIZE)
    return "\n".join(
        f"- [{s.title}]({s.url}). *People*: {s.people}. *Error bars*: {s.bars}. "
        f"*Licence*: {s.licence}. *Read*: {s.how}."
        for s in every
    )
