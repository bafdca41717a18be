"""Pictures of filters and feature maps, for the chapters on the ventral pathway."""

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.show.figures import photo_view
from vmc_lib.show.palette import COLOURS


def grey(v, reach=3.0, zoom=1):
    """A whitened picture (height, width) as grey in 0..1: zero is the middle."""
    return np.kron(np.clip(0.5 + np.asarray(v) / (2 * reach), 0, 1), np.ones((zoom, zoom)))


def tiles(stack, columns=5, zoom=1):
    """Filters or maps (n, height, width) in a grid of up to `columns`, as one grey picture.

    Each has its own contrast, up to its strongest value. Zero is middle grey, or black where
    nothing is negative.
    """
    stack = np.asarray(stack, float)
    stack = stack / np.maximum(np.abs(stack).max((1, 2), keepdims=True), 1e-9)
    if stack.min() < 0:
        stack = (1 + stack) / 2
    stack = np.kron(stack, np.ones((1, zoom, zoom)))
    columns = min(columns, len(stack))
    rows = -(-len(stack) // columns)
    stack = np.pad(stack, [(0, rows * columns - len(stack)), (2, 2), (2, 2)], constant_values=0.5)
    _, height, width = stack.shape
    grid = stack.reshape(rows, columns, height, width).swapaxes(1, 2)
    return grid.reshape(rows * height, columns * width)


def lettered(picture, words, size=None):
    """A grey picture (height, width) in 0..1 and words below it, as SVG.

    `size` (height, width) gives it more room than it needs: nothing jumps when another follows.
    """
    (height, width), (high, wide) = np.shape(picture), size or np.shape(picture)
    wide = max(wide, 12 * len(words) + 12)  # the words, too, want room
    above, left = (high - height) // 2, (wide - width) // 2
    margins = (above, high - height - above + 30), (left, wide - width - left)
    canvas = np.pad(np.clip(picture, 0, 1), margins, constant_values=0.5)
    return photo_view(np.uint8(255 * canvas), [((6, high + 30, 6, high + 30), words, "ink")])


def units(stack, column, row, zoom):
    """Ten filters in two rows of five, one of them marked; its axes count columns and rows.

    A `Pad` over columns 1 to 5 and rows 1 to 2 makes them answer to a click.
    """
    image = np.uint8(255 * tiles(stack, 5, zoom))
    height, width = image.shape
    high, wide = height / 2, width / 5
    box = (column - 1) * wide, (row - 1) * high, column * wide, row * high
    return photo_view(image, [(box, "", "orange")], axes=(0.5, 5.5, 2.5, 0.5))


def explanations_of(v, energies, chances, names):
    """A small picture v (height, width), and the energy and chance of each explanation of it."""
    shape = {"width_ratios": [1, 1.2, 1.2], "layout": "none"}
    fig, (left, middle, right) = plt.subplots(1, 3, figsize=(6.8, 2.3), **shape)
    fig.subplots_adjust(left=0.01, right=0.98, bottom=0.13, top=0.88, wspace=0.72)
    left.pcolormesh(v, vmin=-2, vmax=2, edgecolor=COLOURS["grey"], cmap="gray")
    left.set(title="v", xticks=[], yticks=[], aspect="equal")
    bars = middle.barh(names, energies, color=COLOURS["orange"])
    middle.bar_label(bars, fmt="{:z.1f}", padding=2)  # no minus zero
    middle.set(title="energy E(v, h)", xlim=(0, 45))
    bars = right.barh(names, chances, color=COLOURS["blue"])
    right.bar_label(bars, fmt="%.2f", padding=2)
    right.set(title="p(h | v)", xlim=(0, 1.25), yticks=[])
    for ax in (left, middle, right):
        ax.invert_yaxis()
    return fig


def block(on, pooled):
    """The chances of a pooling block's units and of its off state, as bars."""
    names = [*(f"unit {i + 1}" for i in range(len(on))), "all off"]
    colours = [COLOURS["blue"]] * len(on) + [COLOURS["grey"]]
    fig, ax = plt.subplots(figsize=(6.2, 2.6))
    ax.bar_label(ax.bar(names, [*on, 1 - pooled], color=colours), fmt="%.2f")
    ax.set(ylim=(0, 1.12), ylabel="probability", title=f"pooled unit on: {pooled:.3f}")
    return fig


def over_time(answers, kind, title):
    """A unit's answers (n, steps) to n things on the move, in blue where `kind`, else in orange."""
    fig, ax = plt.subplots(figsize=(5.6, 2.6))
    for here, colour in ((kind, "blue"), (~kind, "orange")):
        ax.plot(range(1, answers.shape[1] + 1), answers[here].T, lw=1, color=COLOURS[colour])
    ax.axhline(0, color=COLOURS["ink"])
    ax.set(xlabel="view", ylabel="answer", ylim=(-3.2, 3.2), title=title)
    ax.set_xticks(range(1, answers.shape[1] + 1))
    return fig


def likeness(shares, title):
    """How alike each layer's maps still are (layer -> correlation), as bars."""
    fig, ax = plt.subplots(figsize=(5.6, 2.4))
    bars = ax.bar(list(shares), list(shares.values()), color=COLOURS["blue"])
    ax.bar_label(bars, fmt="%.2f")
    ax.set(ylim=(min(0, *shares.values()) - 0.05, 1.15), ylabel="correlation", title=title)
    return fig
