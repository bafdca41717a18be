"""Comparisons: estimates with their intervals, as a dot plot, in words and in one table."""

import math
from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from vmc_lib.show.demo import figure
from vmc_lib.show.estimate import estimate
from vmc_lib.show.figures import margins
from vmc_lib.show.palette import COLOURS
from vmc_lib.show.svg_renderer import text_width, wrap

LONGEST = 1.95  # inches, of a row's name on one line


def compare(
    series: Mapping[str, Mapping[str, Any]],
    measure: str,
    published: Mapping[str, float] | None = None,
    xlim: tuple[float, float] | None = None,
    alt: str | None = None,
) -> None:
    """Show a `dot_plot`; its numbers stand folded below, and its description comes from them."""
    figure(lambda: dot_plot(series, measure, published, xlim), alt=alt)


def dot_plot(
    series: Mapping[str, Mapping[str, Any]],
    measure: str,
    published: Mapping[str, float] | None = None,
    xlim: tuple[float, float] | None = None,
) -> Figure:
    """A table as a picture: a dot for each row of each series, with its interval; a figure.

    `series` maps a label to its rows, and a row's name to draws (n,), to (value, low, high) or to a
    number (see `estimate`); `measure` names what is measured. `published` maps rows to what the
    paper printed, shown as ticks. For several levels or measures, call it for each and show the
    tuple of figures.

    >>> dot_plot({"ours": {"rig": [3.1, 2.8, 3.3], "free": 4.2}}, "miss (mm)").axes[0].get_xlabel()
    'miss (mm)'
    """
    _check_series(series, published)
    if not (xlim is None or np.shape(xlim) == (2,)):
        raise ValueError(f"xlim {xlim!r}: give (low, high)")
    every = *series.values(), published or {}
    names = list(dict.fromkeys(name for rows in every for name in rows))
    shown = [wrap(name, LONGEST) for name in names]  # a phone has the plot's whole width
    lines = [line for name in shown for line in name.split("\n")]
    room = 0.15 + max(map(text_width, lines))
    most = max(name.count("\n") for name in shown) + 1
    row = max(0.16 + 0.14 * len(series), 0.19 * most * (most > 1))
    size = max(4.2, room + 2.1), 0.95 + len(names) * row
    fig, ax = plt.subplots(figsize=size, layout="none")
    for k, (label, rows) in enumerate(series.items()):
        apart = 0.5 * ((k + 0.5) / len(series) - 0.5)
        value, low, high = np.transpose([estimate(row) for row in rows.values()])
        places = [names.index(name) + apart for name in rows]
        style = dict(fmt="o", ms=4.5, elinewidth=1.4, label=label, zorder=3)
        ax.errorbar(value, places, xerr=(value - low, high - value), **style)
    if published:
        places = [names.index(name) for name in published]
        style = dict(fmt="|", ms=15, mew=1.6, color=COLOURS["ink"], label="published")
        ax.errorbar(list(published.values()), places, **style)
    ax.set_yticks(range(len(names)), shown)
    ax.set(xlabel=measure, xlim=xlim, ylim=(len(names) - 0.5, -0.5))
    labels = ax.get_legend_handles_labels()[1]
    ncols = 4 if len("".join(labels)) < 24 else 3
    rows = math.ceil(len(labels) / ncols) if len(labels) > 1 else 0
    if rows:
        fig.legend(loc="upper center", ncols=ncols, columnspacing=1, handletextpad=0.3)
    margins(fig, left=room, top=0.12 + 0.22 * rows)
    return fig


def _check_series(series, published):
    """Raise ValueError for what are no series, or no published numbers."""
    for label, given in series.items() if isinstance(series, Mapping) else [("", series)]:
        if not isinstance(given, Mapping):
            raise ValueError(
                f"series {label!r} is {given!r}: give {{label: {{row: draws}}}}, two dictionaries"
            )
    if not series or not (published is None or isinstance(published, Mapping)):
        raise ValueError(
            f"series {list(series)}, published {published!r}: give {{label: {{row: draws}}}}, one "
            "label or more, and {row: number}"
        )
