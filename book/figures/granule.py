"""Granule cells along a line of targets, and the Purkinje cell that sums them; also in the page."""

import numpy as np

from book.figures.panels import panels
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


def fit_line(places, aside, x, order, width, lessons):
    """`GranuleCells` after so many lessons of a line, in an `order` (n,).

    A lesson is a place (n, 1) where the hand ended, in m, and how far `aside` (n,) to aim, in mm.
    """
    some = order[:lessons]
    return GranuleCells(width, CELLS).fit(places[some], aside[some])


def off_by(places, aside, x, order, width, lessons):
    """How far their sum is from what the arm needs, in mm, on average over the line x (m,)."""
    needed = np.interp(x, places[:, 0], aside)
    learned = fit_line(places, aside, x, order, width, lessons).predict(x[:, None])
    return np.abs(learned - needed).mean()


def bells(places, aside, x, order, width, lessons, place):
    """What the arm needs along a line, what the cells have learned, and how they answer at a place.

    The place is one of `x`.
    """
    data = places, aside, x, order, width, lessons
    cells, needed = fit_line(*data), np.interp(x, places[:, 0], aside)
    said, active = cells.predict(x[:, None]), cells.excite([[place]])[0]
    now, some = np.argmin(np.abs(x - place)), order[:lessons]
    off = abs(said[now] - needed[now])
    fig, ax = _plot()
    ax.plot(x, FLOOR - FLOOR * cells.excite(x[:, None])[:, SHOWN], color=COLOURS["line"], lw=1)
    ax.scatter(cells.centres_, np.full(CELLS, FLOOR / 2), (6 * active) ** 2, COLOURS["orange"])
    lines = (x, needed), (x, said.clip(FLOOR, TOP)), (places[some, 0], aside[some])
    for (style, colour), line in zip(LOOKS.values(), lines, strict=False):
        ax.plot(*line, style, color=COLOURS[colour])
    ax.plot([place] * 2, [said[now].clip(FLOOR, TOP), needed[now]], color=COLOURS["purple"], lw=3)
    ax.set_title(f"off by {off_by(*data):.2f} mm on average, here by {off:.2f}")
    return fig


def _plot():
    fig, ax = panels(size=(6.5, 3.6))
    for name, (style, colour) in LOOKS.items():
        ax.plot([], [], style, color=COLOURS[colour], label=name)
    ax.set(xlabel="where the hand ends, forward (m)", ylabel="aim aside (mm)")
    ax.set(xlim=(-0.01, 0.25), ylim=(FLOOR, TOP))
    fig.subplots_adjust(bottom=0.3)  # room for the legend
    fig.legend(loc="lower center", ncols=3)
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
