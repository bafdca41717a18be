"""What the bank's pictures are drawn with: what is told apart differs in more than its colour."""

import numpy as np

DASHES = "-", "--", ":", "-."


def curves(axes, x, named, across, up):
    """Curves {name: heights} over x, with a grid to read them by."""
    for (name, heights), dash in zip(named.items(), DASHES, strict=False):
        axes.plot(x, heights, dash, label=name)
    if len(named) > 1:
        axes.legend()
    _label_axes(axes, across, up)


def bars(axes, named, up, values="{:g}"):
    """Bars {name: height}, each with its value above it; one that is not a number shows a "?"."""
    for place, (name, height) in enumerate(named.items()):
        hidden = np.isnan(height)
        axes.bar(name, 0 if hidden else height, color="C0", width=0.6)
        text = "?" if hidden else values.format(height)
        axes.annotate(text, (place, 0 if hidden else height), ha="center", va="bottom")
    axes.set_ylabel(up)


def intervals(axes, named, across):
    """A line {name: (low, middle, high)} each, from its low to its high end."""
    for place, (low, middle, high) in enumerate(named.values()):
        axes.plot([low, high], [place, place], "C0")
        axes.plot(middle, place, "C0o")
    axes.set_yticks(range(len(named)), named)
    axes.set_ylim(len(named) - 0.5, -0.5)
    _label_axes(axes, across, "")


def points(axes, named, across, up, mark="o"):
    """Points {name: (x, y)} with their names beside them, in true proportion."""
    for name, (x, y) in named.items():
        axes.plot(x, y, f"C0{mark}")
        axes.annotate(name, (x, y), (5, 4), textcoords="offset points")
    axes.set_aspect("equal", "datalim")
    axes.margins(0.2)
    _label_axes(axes, across, up)


def boxes(axes, named):
    """Boxes {name: (x0, y0, x1, y1)} in pixels, y down."""
    for (name, (x0, y0, x1, y1)), dash in zip(named.items(), DASHES, strict=False):
        axes.plot([x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0], dash, label=name)
    axes.set_aspect("equal", "datalim")
    axes.invert_yaxis()
    axes.figure.legend(loc="outside right upper")
    _label_axes(axes, "pixels", "pixels")


def _label_axes(axes, across, up):
    axes.set(xlabel=across, ylabel=up)
    axes.grid(alpha=0.4)
