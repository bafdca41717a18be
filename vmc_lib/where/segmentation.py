"""Graph-based image segmentation (Felzenszwalb & Huttenlocher 2004).

Pixels are the nodes of a graph; edges join each to its eight neighbours and weigh the difference in
colour. Edges are visited in order of weight, and one merges two segments if its weight is below the
tolerance of both: the largest weight inside a segment plus k / size.

An edge is packed into one uint64: the bits of its float32 weight, then its index 4 * pixel +
direction. So edges sort by weight, and equal ones by position, on every machine alike.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from vmc_lib.checks import is_positive
from vmc_lib.compiled import compiled
from vmc_lib.short_repr import short

BLUR = 0.8  # pixels: the standard deviation of the Gaussian blur that comes first
NEIGHBOUR_OFFSETS = (0, 1), (1, 0), (1, 1), (1, -1)  # (dy, dx); the other four mirror these


def segment(channels: np.ndarray, k: float = 100) -> np.ndarray:
    """Graph-based segmentation of an image.

    Parameters
    ----------
    channels : (height, width, c) float32 array in 0..1
    k : scale; a larger one gives larger segments, and none is smaller than k pixels

    Returns
    -------
    (height, width) int array: labels 0, 1, …, in the order of each segment's first pixel

    References
    ----------
    Felzenszwalb & Huttenlocher (2004), Efficient graph-based image segmentation.

    Examples
    --------
    >>> black_and_white = np.repeat(np.float32([[[0], [1]]]), 20, axis=1).repeat(40, axis=0)
    >>> np.unique(segment(black_and_white)).tolist()
    [0, 1]
    """
    return next(segmentations(channels, [k]))


def segmentations(channels: np.ndarray, scales: Sequence[float]) -> Iterator[np.ndarray]:
    """The labels of `segment` at each scale k in turn; the edges are sorted once for all."""
    import cv2

    if not isinstance(channels, np.ndarray):
        raise ValueError(f"{short(channels)} is no array: see photos.as_float")
    if channels.ndim != 3 or 0 in channels.shape or not np.all(np.isfinite(channels)):
        raise ValueError(f"channels {channels.shape} must be finite, (height, width, c), not empty")
    if channels.dtype.kind != "f":
        raise ValueError(f"channels of {channels.dtype} are not in 0..1: see photos.as_float")
    if not np.iterable(scales) or not len(scales):
        raise ValueError(f"scales {short(scales)}: give a list of one k or more")
    if not all(map(is_positive, scales)):
        raise ValueError(f"scales k = {scales}: give finite numbers above 0")
    smooth = cv2.GaussianBlur(channels, (0, 0), BLUR).reshape(channels.shape)
    height, width = smooth.shape[:2]
    pixels, offsets = height * width, pixel_offsets(width)
    edges = sort_by_weight(pixel_edges(smooth))
    for k in scales:  # the published k is for grey values in 0..255
        labels = merge_segments(edges, offsets, pixels, k / 255, min(k, pixels))
        yield labels.reshape(height, width)


def pixel_offsets(width):
    """How far ahead, in row-major pixel indices, each of the four neighbours lies."""
    return np.uint32(np.dot(NEIGHBOUR_OFFSETS, [width, 1]))


@compiled
def pixel_edges(channels):
    """All edges (m,) of an image (height, width, c), by position."""
    height, width, depth = channels.shape
    edges, count = np.empty(4 * height * width, np.uint64), 0
    for y in range(height):
        for x in range(width):
            for direction, (dy, dx) in enumerate(NEIGHBOUR_OFFSETS):
                if y + dy < height and 0 <= x + dx < width:
                    square = np.float32(0)
                    for c in range(depth):
                        step = channels[y, x, c] - channels[y + dy, x + dx, c]
                        square += step * step
                    weight = np.float32(np.sqrt(square)).view(np.uint32)
                    index = 4 * (y * width + x) + direction
                    edges[count] = np.uint64(weight) << np.uint64(32) | np.uint64(index)
                    count += 1
    return edges[:count]


@compiled
def sort_by_weight(edges):
    """Edges (m,) sorted by weight, equal ones in the order given; overwrites its input.

    A radix sort: the bits of non-negative floats sort like the floats, eleven of them at a time.
    Where we measured, `np.sort` took three times as long.
    """
    buffer, digits = np.empty_like(edges), np.uint64(2047)
    for shift in (np.uint64(32), np.uint64(43), np.uint64(54)):
        position = np.zeros(2049, np.int64)  # where the next edge with a digit goes
        for edge in edges:
            position[np.int64(edge >> shift & digits) + 1] += 1
        position = np.cumsum(position)
        for edge in edges:
            digit = np.int64(edge >> shift & digits)
            buffer[position[digit]] = edge
            position[digit] += 1
        edges, buffer = buffer, edges
    return edges


@compiled
def merge_segments(edges, offsets, pixels, k, min_size):
    """Labels (pixels,) of the segments that sorted edges (m,) merge, none under `min_size`."""
    parent, size = np.arange(pixels).astype(np.uint32), np.ones(pixels, np.int32)
    tolerance = np.full(pixels, k, np.float32)
    rejected, count = np.empty_like(edges), 0
    for edge in edges:
        a, b = edge_pixels(edge, offsets)
        a, b = find(parent, a), find(parent, b)
        weight = np.uint32(edge >> np.uint64(32)).view(np.float32)
        if a != b and weight < min(tolerance[a], tolerance[b]):
            root = unite(parent, size, a, b)
            tolerance[root] = weight + k / size[root]
        elif a != b:
            rejected[count] = edge
            count += 1
    for edge in rejected[:count]:
        a, b = edge_pixels(edge, offsets)
        a, b = find(parent, a), find(parent, b)
        if a != b and min(size[a], size[b]) < min_size:
            unite(parent, size, a, b)
    labels, label_of, count = np.empty(pixels, np.int64), np.full(pixels, -1, np.int32), 0
    for pixel in range(pixels):
        root = find(parent, np.uint32(pixel))
        if label_of[root] < 0:
            label_of[root], count = count, count + 1
        labels[pixel] = label_of[root]
    return labels


def edge_pixels(edge, offsets):
    """The two pixels of an edge."""
    index = np.uint32(edge & np.uint64(0xFFFFFFFF))
    pixel, direction = index >> np.uint32(2), index & np.uint32(3)
    return pixel, pixel + offsets[direction]


def find(parent, node):
    """Union-find: the root of a pixel's segment, or of a region."""
    while parent[node] != node:
        parent[node] = parent[parent[node]]  # path halving
        node = parent[node]
    return node


def unite(parent, size, a, b):
    """Make the larger of two segments' roots the root of both, and return it."""
    a, b = (b, a) if size[a] < size[b] else (a, b)
    parent[b], size[a] = a, size[a] + size[b]
    return a
