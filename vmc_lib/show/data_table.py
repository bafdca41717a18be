"""The data of plots, read from the plots themselves, as tables."""

import html
from typing import NamedTuple

import numpy as np
from matplotlib.category import StrCategoryFormatter
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FuncFormatter

from vmc_lib.show.estimate import Estimate
from vmc_lib.show.markup import number
from vmc_lib.show.palette import COLOURS

POINTS, DOTS, SERIES = 9, 24, 12  # at most so many in a table: of a line, of dots, of a plot
COLUMNS = 6  # of a wide table, at most
_COLOUR_NAMES = {value: name for name, value in COLOURS.items()}
_COLOUR_NAMES |= {COLOURS["line"]: "pale", COLOURS["ink"]: "dark"}


class DataTable(str):
    """Markup of the tables with a picture's data, one for each of its plots."""


class Series(NamedTuple):
    """A line, dots or bars: `values` (n,) at `keys` (n,), the `ends` (n, 2) of their intervals."""

    name: str
    kind: str  # such as red dots, blue line, bars
    keys: np.ndarray
    values: np.ndarray
    ends: np.ndarray
    listed: np.ndarray  # the places that a table lists

    def at(self, i):
        """The value at place i as text, with its interval."""
        low, high = self.ends[i]
        return str(Estimate(self.values[i], low, high)) if high > low else number(self.values[i])


class Panel(NamedTuple):
    """A plot: what it is called, what its keys and values measure, and its series."""

    title: str
    key: str
    value: str
    series: list
    text: object  # a key as text
    named: bool  # keys are names, as in a dot plot


def figures_of(picture):
    """The matplotlib figures in what a draw function returned."""
    parts = picture if isinstance(picture, tuple) else (picture,)
    return [part for part in parts if isinstance(part, Figure)]


def data_tables(picture):
    """A list of the `DataTable` of what a draw function returned; empty where nothing is a figure.

    A row for each key and a column for each series, or where their keys differ a row for each
    point. Of a long line some points are listed, evenly spread over the axis; of many lines the
    first, and how many more there are.
    """
    tables = [_table(panel) for panel in panels(picture) if panel.series]
    return [DataTable("\n".join(tables))] if figures_of(picture) else []


def panels(picture):
    """The `Panel`s of what a draw function returned, without colour bars."""
    axes = (ax for figure in figures_of(picture) for ax in figure.axes)
    return [_panel(ax) for ax in axes if ax.get_label() != "<colorbar>"]


def _panel(ax):
    """What an axes shows; its keys stand along x, or along y where y has names or bars lie."""
    lying = any(getattr(bars, "orientation", "") == "horizontal" for bars in ax.containers)
    turned = bool(lying or _names(ax.yaxis))
    key, value = (ax.yaxis, ax.xaxis) if turned else (ax.xaxis, ax.yaxis)
    names, title = _names(key), ax.get_title()
    measure = value.get_label_text() or title or "value"
    series = list(_series(ax, int(turned)))
    unnamed = measure if len(series) == 1 else ""
    return Panel(
        title,
        key.get_label_text() or ("case" if names else "xy"[turned]),
        measure,
        [one._replace(name=one.name or unnamed or one.kind) for one in series],
        names or number,
        bool(names),
    )


def _series(ax, turned):
    """The `Series` that were plotted against the axes' own measures.

    A line's `gid` names what a legend need not, or names with a number that changes; guide lines
    have "guide", and are left out.
    """
    logarithmic = (ax.yaxis if turned else ax.xaxis).get_scale() == "log"
    for line, owner in _plotted(ax):
        points = _points(line)
        keys, values = (_rounded(points[i], (ax.xaxis, ax.yaxis)[i]) for i in (turned, 1 - turned))
        known = np.isfinite(keys) & np.isfinite(values) & ((keys > 0) | (not logarithmic))
        if not known.any():
            continue
        ends = np.stack([values, values], axis=1)
        if owner is not line and (owner.has_xerr if turned else owner.has_yerr):
            bars = owner.lines[2][0 if turned else -1]  # x before y, where there are both
            ends = np.array([path.vertices for path in bars.get_paths()])[..., 1 - turned]
        kind, most = _kind(line), DOTS if line.get_linestyle() == "None" else POINTS
        some = _spread(keys[known], most, logarithmic)
        name = line.get_gid() or _label(owner)
        yield Series(name, kind, keys[known], values[known], ends[known], some)
    for bars in ax.containers:
        if isinstance(bars, BarContainer):
            boxes = np.array([bar.get_bbox().get_points() for bar in bars])
            values = np.asarray(bars.datavalues, float)
            ends, some = np.stack([values, values], axis=1), np.arange(len(values))
            keys = boxes.mean(axis=1)[:, turned]
            yield Series(_label(bars), "bars", keys, values, ends, some)


def _plotted(ax):
    """The visible lines on an axes' own measures, each with its owner: itself, or error bars."""
    owners = {c.lines[0]: c for c in ax.containers if isinstance(c, ErrorbarContainer)}
    for line in ax.lines:
        guide = not line.get_transform().contains_branch(ax.transData)
        guide = guide or line.get_gid() == "guide"
        if line.get_visible() and not guide:
            yield line, owners.get(line, line)


def _points(line):
    return np.broadcast_arrays(*(np.ravel(v) for v in line.get_data(orig=False)))


def _kind(line):
    kind = "dots" if line.get_linestyle() == "None" else "line"
    return f"{_COLOUR_NAMES.get(line.get_color(), '')} {kind}".strip()


def name_curves(figure):
    """Name a figure's curves for `sound.js`: lines of many points that run to the right."""
    for line, owner in (each for ax in figure.axes for each in _plotted(ax)):
        x, name = _points(line)[0], line.get_gid() or _label(owner) or _kind(line)
        if (
            line.get_linestyle() != "None"
            and len(x) > 2
            and (np.diff(x[np.isfinite(x)]) >= 0).all()
        ):
            line.set_gid(f"curve:{name.replace('$', '')}")


def _rounded(values, axis):
    """Values (n,), 0 where they are too small to be seen on their axis; places in m to 0.1 mm."""
    values = np.asarray(values, float)
    if axis.get_label_text().endswith("(m)"):
        values = values.round(4) + 0.0  # no −0
    least = 1e-9 * np.abs(axis.get_view_interval()).max() if axis.get_scale() == "linear" else 0
    return np.where(np.abs(values) < least, 0, values)


def _label(artist):
    """An artist's label; empty where matplotlib made one up."""
    label = str(artist.get_label())
    return "" if label.startswith("_") else label


def _names(axis):
    """How a place on an axis with names is written, by the nearest; None where it has numbers."""
    formatter = axis.get_major_formatter()
    if isinstance(formatter, FixedFormatter | FuncFormatter | StrCategoryFormatter):
        places = axis.get_ticklocs()
        names = [str(name).replace("\n", " ") for name in formatter.format_ticks(places)]
        counted = np.array_equal(places, range(len(places))) and names != [*map(number, places)]
        if names and (counted or all(name[:1].isalpha() for name in names)):
            return lambda place: names[np.abs(places - place).argmin()]
    return None


def _spread(keys, most, logarithmic):
    """Which of the points at keys (n,) to list, at most so many, evenly spread over the axis."""
    last = len(keys) - 1
    if logarithmic and last >= most and (np.diff(keys) > 0).all():
        even = np.geomspace(keys[0], keys[-1], most)
        return np.unique(np.abs(keys[:, None] - even).argmin(axis=0))
    return np.unique(np.linspace(0, last, most).round().astype(int))


def _table(panel):
    """A plot's table (HTML): as wide as its series, where that fits, else a row for each point."""
    listed = panel.series[:SERIES]
    points = [[(panel.text(one.keys[i]), one.at(i)) for i in one.listed] for one in listed]
    columns = {one.name: dict(some) for one, some in zip(listed, points, strict=True)}
    keys = list(dict.fromkeys(key for some in points for key, _ in some))
    whole = [len(some) for some in points] == [len(column) for column in columns.values()]
    even = panel.named or all(len(column) == len(keys) for column in columns.values())
    caption = [panel.title]
    if len(panel.series) <= COLUMNS and whole and even:
        heads = [panel.key, *(columns if len(columns) > 1 else [panel.value])]
        rows = [[key, *(column.get(key, "") for column in columns.values())] for key in keys]
        caption += [panel.value] if len(columns) > 1 else columns
    else:
        heads = ["series", panel.key, panel.value]
        rows = [[one.name, *row] for one, some in zip(listed, points, strict=True) for row in some]
        if len(panel.series) > SERIES:
            rows.append([f"and {len(panel.series) - SERIES} more", "", ""])
    caption = ": ".join(dict.fromkeys(part for part in caption if part and part != heads[-1]))
    caption = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    rows = [_row("th", heads), *(_row("td", row) for row in rows)]
    return "\n".join([f"<table>{caption}", *rows, "</table>"])


def _row(cell, texts):
    return "<tr>" + "".join(f"<{cell}>{html.escape(text)}</{cell}>" for text in texts) + "</tr>"
