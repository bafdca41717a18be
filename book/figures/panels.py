"""Subplots in a row, and the curves and marks that several chapters draw in them."""

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.arm.model import MUSCLES
from vmc_lib.show.figures import margins
from vmc_lib.show.palette import COLOURS, css
from vmc_lib.show.svg_renderer import text_width

# What straightens the elbow is blue; what bends it is orange, or red where it spans no shoulder.
STYLES = {
    "TRIlong": ("blue", "-"),
    "TRIlat": ("blue", "--"),
    "TRImed": ("blue", ":"),
    "BIClong": ("orange", "-"),
    "BICshort": ("orange", "--"),
    "BRA": ("red", "-"),
}


def panels(columns=1, size=(6.5, 2.7)):
    """A figure with a row of plots. Its layout is fixed: a demo draws many, and quickly."""
    apart = 0.75  # inches
    room = (size[0] - 0.9 - apart * (columns - 1)) / columns  # for each plot
    grid = {"layout": "none", "gridspec_kw": {"wspace": apart / room}}
    fig, axes = plt.subplots(1, columns, figsize=size, squeeze=False, **grid)
    margins(fig)
    return fig, *axes[0]


def legend_above(fig, room, columns=2):
    """A legend in columns above a figure's plots, which leave it so much room (inches)."""
    fig.legend(loc="upper center", ncols=columns, handlelength=1.2, columnspacing=1)
    margins(fig, top=room)


def muscle_lines(ax, x, values):
    """A line for each muscle: `values` (n, muscles) over `x` (n,)."""
    for name, line in zip(MUSCLES, np.transpose(values), strict=True):
        colour, style = STYLES[name]
        ax.plot(x, line, style, color=COLOURS[colour], label=name)


def muscle_key():
    """The names and lines of `muscle_lines` (HTML), for plots that a phone shows one by one."""
    dashes, wide = {"-": "", "--": "7 3", ":": "2 3"}, 96
    items = (
        f'<svg viewBox="0 0 {wide} 20" width="{wide}" fill="none" font-size="13">'
        f'<path d="M0 10H25" stroke-width="2" stroke-dasharray="{dashes[kind]}" '
        f'style="stroke: {css(colour)}"/>'
        f'<text x="30" y="15" style="fill: {css("ink")}">{name}</text></svg>'
        for name, (colour, kind) in STYLES.items()
    )
    return f'<p class="vmc-strip">{" ".join(items)}</p>'


def curves(ax, x, lines, now):
    """Curves, name -> (n,) over x (n,), with their points; and `mark_now` at `now`."""
    for name, y in lines.items():
        ax.plot(x[: len(y)], y, ".-", label=name)
    mark_now(ax, *now)
    if len(lines) > 1:
        ax.legend()


def mark_now(ax, x, y, colour="red"):
    """A dot where the reader is."""
    ax.plot(x, y, "o", ms=9, color=COLOURS[colour], clip_on=False, gid="now")


def shade(ax, first, last):
    """Grey behind the curves, from `first` to `last`."""
    ax.axvspan(first, last, color=COLOURS["grey"], alpha=0.15, lw=0)


def shade_change(ax, blocks):
    """Grey behind the blocks in a changed world: (before, during, after) it, so many."""
    before, during, _ = blocks
    shade(ax, before - 0.5, before + during - 0.5)


def strip_plot(rows, measure, middle=np.median, xlim=None, text="{:.1f}"):
    """Every value of each row, name -> (n,), as a dot on a logarithmic axis, and their middle.

    A figure; the middle of a row stands as a bar, and as `text` after its name.
    """
    fig, ax = panels(size=(4.3, 0.9 + 0.5 * len(rows)))
    aside = np.random.default_rng(0).uniform(-0.25, 0.25, max(map(len, rows.values())))
    names = [f"{name}: {text.format(middle(values))}" for name, values in rows.items()]
    for row, values in enumerate(rows.values()):
        ax.plot(values, row + aside[: len(values)], "o", ms=4, alpha=0.5)
        ax.plot(middle(values), row, "|", ms=26, mew=3, color=COLOURS["ink"], gid="guide")
    ax.set_yticks(range(len(names)), names)
    ax.set(xscale="log", xlim=xlim, xlabel=measure, ylim=(len(names) - 0.5, -0.5))
    low, high = ax.get_xlim()
    ticks = np.outer(10.0 ** np.arange(-9, 10), [1] if high > 1000 * low else [1, 2, 5]).ravel()
    first, last = np.searchsorted(ticks, low), np.searchsorted(ticks, high, "right")
    few = last - first < 2  # then the axis reaches the round numbers beside it
    ax.set_xticks(ticks[first - few : last + few])
    ax.xaxis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    margins(fig, left=0.15 + max(map(text_width, names)), top=0.12)
    return fig
