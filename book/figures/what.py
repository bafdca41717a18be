"""Figures of filters and feature maps, for the chapters on the ventral pathway."""

import numpy as np

from vmc_lib.show.figures import photo_view


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


def with_words(picture, words, size=None):
    """A grey picture (height, width) in 0..1 and words below it, as SVG.

    `size` (height, width) gives it more room than it needs: nothing jumps when another follows.
    """
    (height, width), (high, wide) = np.shape(picture), size or np.shape(picture)
    wide = max(wide, 12 * len(words) + 12)  # the words, too, want room
    above, left = (high - height) // 2, (wide - width) // 2
    margins = (above, high - height - above + 30), (left, wide - width - left)
    canvas = np.pad(np.clip(picture, 0, 1), margins, constant_values=0.5)
    return photo_view(np.uint8(255 * canvas), [((6, high + 30, 6, high + 30), words, "ink")])
