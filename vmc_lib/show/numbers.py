"""The numbers behind a plot as a table, taken from the plot itself: for who reads, not sees."""

import html

import numpy as np
from matplotlib.container import BarContainer
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FuncFormatter

from vmc_lib.show.markup import number
from vmc_lib.show.palette import COLOURS

POINTS, DOTS, SERIES = 9, 24, 12  # at most so many are told: of a line, of dots, of a plot's curves
_NAMES = {value: name for name, value in COLOURS.items()}


def numbers(drawn):
    """A table (HTML) of the curves, dots and bars in the figures of what a draw function returned.

    A list: of one table, or empty where nothing is a figure. Each row is a point: what it belongs
    to, its x, its y. Of a long line some points are told, evenly spread over the
    axis; of many curves the first, and how many more there are.
    """
    figures = [
        p for p in (drawn if isinstance(drawn, tuple) else (drawn,)) if isinstance(p, Figure)
    ]
    rows = [row for figure in figures for ax in figure.axes for row in _rows(ax)]
    return ["\n".join(["<table>", *rows, "</table>"])] if figures else []


def _rows(ax):
    """An axes' table rows, under a row that says what is measured."""
    told = list(_series(ax))
    if told:
        title, x, y = ax.get_title(), ax.get_xlabel() or "x", ax.get_ylabel() or "y"
        yield _row("th", title, x, y)
    across, up = _reader(ax.xaxis), _reader(ax.yaxis)
    for name, xs, ys in told[:SERIES]:
        for x, y in zip(xs, ys, strict=True):
            yield _row("td", name, across(x), up(y))
    if len(told) > SERIES:
        yield _row("td", f"and {len(told) - SERIES} more", "", "")


def _series(ax):
    """(name, xs, ys) of what was plotted against the axes' own measures; not their guide lines."""
    for line in ax.lines:
        xs, ys = np.broadcast_arrays(*(np.ravel(v) for v in line.get_data(orig=False)))
        kind, most = ("dots", DOTS) if line.get_linestyle() == "None" else ("line", POINTS)
        if line.get_transform() == ax.transData and len(xs) and line.get_visible():
            some = _spread(xs, most, ax.get_xscale() == "log")
            yield _name(line, f"{_NAMES.get(line.get_color(), '')} {kind}"), xs[some], ys[some]
    for bars in ax.containers:
        if isinstance(bars, BarContainer):
            boxes = [bar.get_bbox() for bar in bars]
            if bars.orientation == "vertical":
                yield _name(bars, "bars"), [(b.x0 + b.x1) / 2 for b in boxes], bars.datavalues
            else:
                yield _name(bars, "bars"), bars.datavalues, [(b.y0 + b.y1) / 2 for b in boxes]


def _spread(xs, most, logarithmic):
    """Which of the points xs (n,) to tell, at most so many, evenly spread over the axis."""
    last = len(xs) - 1
    if logarithmic and last >= most and (np.diff(xs) > 0).all():
        return np.unique(np.abs(xs[:, None] - np.geomspace(xs[0], xs[-1], most)).argmin(axis=0))
    return np.unique(np.linspace(0, last, most).round().astype(int))


def _name(artist, otherwise):
    label = str(artist.get_label())
    return otherwise.strip() if label.startswith("_") else label


def _reader(axis):
    """How an axis tells a value: where its places have names, by the nearest name."""
    if isinstance(formatter := axis.get_major_formatter(), FixedFormatter | FuncFormatter):
        places = axis.get_ticklocs()
        names = [str(name) for name in formatter.format_ticks(places)]
        if all(name[:1].isalpha() for name in names):
            return lambda value: names[np.abs(places - value).argmin()]
    return number


def _row(cell, *texts):
    return "<tr>" + "".join(f"<{cell}>{html.escape(text)}</{cell}>" for text in texts) + "</tr>"
