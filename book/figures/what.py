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
