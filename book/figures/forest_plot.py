"""Forest plots: a line for each claim, a mark for each of its numbers, and what it is held against.

Lines are HTML, in as many columns as there is room for; each is a link to the table of its numbers.
"""

from collections import Counter
from html import escape
from typing import NamedTuple

import numpy as np

LANE, MARGIN, WIDTH = 7, 4, 200  # px: a number's height, what is above and below, a line's width
DOT, CROSS = "m-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0", "m-3-3l6 6m0-6l-6 6"
SHAPES = {  # of each kind of mark, about its place; `demo.css` has their colours
    "by construction": "m-2-2h4v4h-4z",
    "fitted": "m0-4l4 4l-4 4l-4-4z",
    "reproduced": DOT,
    "beaten": "m0-4l4 7h-8z",
    "null passes too": "m-4-1.5h8m-8 3h8",
    "differs": CROSS,
    "faster": DOT,
    "slower": CROSS,
}


class Axis(NamedTuple):
    """A stretch of a line: from `left` to `right` (px), what its `ends` measure, and its ticks."""

    left: float
    right: float
    ends: tuple
    against: float  # what numbers are held against
    ticks: tuple
    scale: object = np.asarray

    def place(self, value):
        """Where a value stands (px, text); at the nearer end where it lies beyond."""
        low, high, at = map(self.scale, (*self.ends, np.clip(value, *self.ends)))
        return f"{self.left + (self.right - self.left) * (at - low) / (high - low):.4g}"


RATIO = Axis(6, 140, (0, 2), 1, (0, 1, 2))
SIGN = Axis(162, 196, (-1, 1), 0, (0,))
TIMES = Axis(8, 186, (0.1, 1e4), 1, (0.1, 1, 10, 100, 1000), np.log)


class Mark(NamedTuple):
    """A number of a kind on an axis; the ends of its interval (thick), and of a wider one (thin).

    `side` is 1 or -1 where no more is claimed than that it lies on that side.
    """

    kind: str
    axis: Axis
    value: float
    interval: tuple = ()
    wider: tuple = ()
    side: int = 0

    def svg(self, y):
        """The side claimed, the wider interval, and the mark on its interval, at height y."""
        axis, kind = self.axis, self.kind.replace(" ", "-")
        lines = {
            "side": (axis.against, axis.ends[self.side > 0]) if self.side else (),
            "wider": self.wider,
            kind: self.interval,
        }
        paths = {k: "M{} {y}H{}".format(*map(axis.place, e), y=y) for k, e in lines.items() if e}
        mark = f"M{axis.place(self.value)} {y}{SHAPES[self.kind]}"
        mark += f"M{axis.right + 5} {y - 3}l3 3l-3 3" * (self.value > axis.ends[1])  # beyond
        paths[kind] = paths.get(kind, "") + mark
        return "".join(f'<path class="{k}" d="{d}"/>' for k, d in paths.items())


class Line(NamedTuple):
    """A line of the plot: its name, the address it leads to, a tooltip, and its marks."""

    name: str
    address: str
    tooltip: str
    marks: list

    def html(self):
        """The line as a link; with words where it has no marks."""
        height = 2 * MARGIN + LANE * max(1, len(self.marks))
        against = [f"M{axis.place(axis.against)} 0V{height}" for axis in axes([self])]
        drawn = f'<path class="against" d="{"".join(against)}"/>' if against else ""
        drawn += "".join(mark.svg(MARGIN + LANE * i + 4) for i, mark in enumerate(self.marks))
        drawn = drawn or f'<text x="73" y="{height - MARGIN}">nothing to compare</text>'
        inner = f"<span>{escape(self.name)}</span>{svg_view((0, 0, WIDTH, height), drawn)}"
        return f'<a href="#{self.address}" title="{escape(self.tooltip)}">{inner}</a>'


def axes(lines):
    """The axes of the lines' marks, each once."""
    return dict.fromkeys(mark.axis for line in lines for mark in line.marks)


def svg_view(box, inner):
    """SVG that is seen through a box (left, top, width, height)."""
    return f'<svg viewBox="{" ".join(map(str, box))}" aria-hidden="true">{inner}</svg>'


def forest_plot(groups):
    """The plot as HTML, of `groups`: head -> `Line`s; its key says how many marks of each kind."""
    key = [] if groups else [in_words(groups)]
    for kind, text in counts(groups).items():
        path = f'<path class="{kind.replace(" ", "-")}" d="M0 0{SHAPES[kind]}"/>'
        key.append(f"<span>{svg_view((-5, -5, 10, 10), path)} {text}</span>")
    html = [f'<p class="vmc-key">{" ".join(key)}</p>', '<div class="vmc-forest">']
    for head, lines in groups.items():
        ticks = [
            f'<text x="{axis.place(tick)}" y="14">{tick:g}</text>'
            for axis in axes(lines)
            for tick in axis.ticks
        ]
        html.append(f"<div><p>{escape(head)}{svg_view((0, 0, WIDTH, 18), ''.join(ticks))}</p>")
        html += [*(line.html() for line in lines), "</div>"]
    return "\n".join([*html, "</div>"])


def counts(groups):
    """How many marks there are of each kind, as text: kind -> "reproduced: 12"."""
    found = Counter(mark.kind for lines in groups.values() for line in lines for mark in line.marks)
    return {kind: f"{kind}: {found[kind]}" for kind in SHAPES if found[kind]}


def in_words(groups):
    """The plot for those who do not see it: its heads, and how many marks of each kind."""
    if not groups:
        return "There is no such line."
    found = ", ".join(counts(groups).values()) or "nothing to compare"
    return f"{sum(map(len, groups.values()))} lines, {', '.join(groups)}: {found}."
