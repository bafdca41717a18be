"""Pictures of filters and feature maps, for the chapters on the ventral pathway."""

import numpy as np


def grey(v, reach=3.0):
    """A whitened picture (height, width) as grey in 0..1: zero is the middle."""
    return np.clip(0.5 + np.asarray(v) / (2 * reach), 0, 1)


def tiles(stack, columns=5, zoom=1):
    """Filters or maps (n, height, width) in a grid, as one grey picture.

    Each has its own contrast, up to its strongest value. Zero is middle grey, or black where
    nothing is negative.
    """
    stack = np.asarray(stack, float)
    stack = stack / np.maximum(np.abs(stack).max((1, 2), keepdims=True), 1e-9)
    if stack.min() < 0:
        stack = (1 + stack) / 2
    stack = np.kron(stack, np.ones((1, zoom, zoom)))
    rows = -(-len(stack) // columns)
    stack = np.pad(stack, [(0, rows * columns - len(stack)), (2, 2), (2, 2)], constant_values=0.5)
    _, height, width = stack.shape
    grid = stack.reshape(rows, columns, height, width).swapaxes(1, 2)
    return grid.reshape(rows * height, columns * width)
