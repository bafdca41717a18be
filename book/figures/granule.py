"""Granule cells along a line of targets, and the Purkinje cell that sums them; also in the page."""

import numpy as np

from book.figures.panels import legend_above, panels
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.show.palette import COLOURS

CELLS, SHOWN = 40, slice(None, None, 3)  # how many there are, and whose bells are drawn
FLOOR, TOP = -3, 16  # mm, of the plot
LOOKS = {
    "what the arm needs": ("-", "grey"),
    "the Purkinje cell's sum": ("-", "red"),
    "lessons": ("o", "blue"),
    "active granule cells": ("o", "orange"),
    "error": ("-", "purple"),
}


def fit_line(excite, purkinje, places, aside, x, order, width, lessons):
    """Granule cells after so many lessons of a line, in an `order` (n,).

    A lesson is a place (n, 1) where the hand ended, in m, and how far `aside` (n,) to aim, in mm.
    `excite(places, centres, width)` is how active the cells are, (n, cells), and `purkinje(active,
    aside, ridge)` their weights (cells,). Returns the cells' centres, and along the line x (m,) how
    active they are (m, cells) and their weighted sum (m,).
    """
    some = order[:lessons]
    cells = GranuleCells(width, CELLS).fit(places[some], aside[some])  # for where they lie
    weights = purkinje(excite(places[some], cells.centres_, width), aside[some], cells.ridge)
    active = excite(x[:, None], cells.centres_, width)
    return cells.centres_, active, active @ weights


def off_by(excite, purkinje, places, aside, x, order, width, lessons):
    """How far their sum is from what the arm needs, in mm, on average over the line x (m,)."""
    *_, said = fit_line(excite, purkinje, places, aside, x, order, width, lessons)
    return np.abs(said - np.interp(x, places[:, 0], aside)).mean()


def off_by_width(*line, lessons):
    """The same for many widths, the last of what `off_by` takes before the lessons."""
    *line, widths = line
    off = [off_by(*line, width, lessons) for width in widths]
    fig, ax = panels(size=(4.3, 2.6))
    ax.plot(widths, off, color=COLOURS["red"])
    ax.set(xscale="log", ylim=(0, 5), xlabel="cells' width (m)", ylabel="off by (mm)")
    ax.set_title(f"least at {widths[np.argmin(off)]:.3f} m: {min(off):.2f} mm")
    return fig


def bells(excite, purkinje, places, aside, x, order, width, lessons, place):
    """What the arm needs along a line, what the cells have learned, and how they answer at a place.

    The place is one of `x`.
    """
    data = excite, purkinje, places, aside, x, order, width, lessons
    (centres, active, said), needed = fit_line(*data), np.interp(x, places[:, 0], aside)
    now, some = np.argmin(np.abs(x - place)), order[:lessons]
    off = abs(said[now] - needed[now])
    fig, ax = _plot()
    ax.plot(x, FLOOR - FLOOR * active[:, SHOWN], color=COLOURS["line"], lw=1)
    ax.scatter(centres, np.full(CELLS, FLOOR / 2), (6 * active[now]) ** 2, COLOURS["orange"])
    lines = (x, needed), (x, said.clip(FLOOR, TOP)), (places[some, 0], aside[some])
    for (style, colour), line in zip(LOOKS.values(), lines, strict=False):
        ax.plot(*line, style, color=COLOURS[colour])
    ax.plot([place] * 2, [said[now].clip(FLOOR, TOP), needed[now]], color=COLOURS["purple"], lw=3)
    ax.set_title(f"off by {off_by(*data):.2f} mm on average, here by {off:.2f}")
    return fig


def _plot():
    fig, ax = panels(size=(4.3, 3.6))
    for name, (style, colour) in LOOKS.items():
        ax.plot([], [], style, color=COLOURS[colour], label=name)
    ax.set(xlabel="where the hand ends, forward (m)", ylabel="aim aside (mm)")
    ax.set(xlim=(-0.01, 0.25), ylim=(FLOOR, TOP))
    legend_above(fig, 1.1)
    return fig, ax


def bells_in_page(places, aside, x, order):
    """The same for the page to work out (see `explore`)."""
    given = {
        "lessons": np.c_[places[order, 0], aside[order]].tolist(),
        "uniform": np.random.default_rng(GranuleCells().random_state).random(CELLS).tolist(),
        "ridge": GranuleCells().ridge,
        "line": [x.tolist(), np.interp(x, places[:, 0], aside).tolist()],
        "edges": [FLOOR, TOP],
        "shown": SHOWN.step,
    }
    return "bells", lambda: _plot()[0], given
