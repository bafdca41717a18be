"""A picture falls into segments: the graph-based method of Felzenszwalb & Huttenlocher (2004).

Every pixel is joined to its eight neighbours by edges that weigh as much as the two differ. Two
neighbouring patches stay apart where the step between them is large beside the steps inside them.
"""

import cv2
import numpy as np

from vmc_lib.compiled import compiled

WAYS = (0, 1), (1, 0), (1, 1), (1, -1)  # from a pixel down or to the right; the rest come back
EDGE = np.dtype([("which", "<u4"), ("weight", "<f4")])  # one number, whose highest bits are weight
BLOCK = 1024  # edges looked at side by side: what they need of a large picture then comes at once


def segment(channels, k=100, sigma=0.8):
    """Segments of an image (height, width, c) with values in 0..1: labels (height, width).

    A larger scale `k` lets patches grow larger, and none stays under k pixels. Labels count from
    the top left. Edges of equal weight go row by row, on every machine alike.
    """
    return next(segmentations(channels, [k], sigma))


def segmentations(channels, scales, sigma=0.8):
    """The labels of `segment` at one scale k after another; the edges are sorted once for all."""
    weights = edge_weights(cv2.GaussianBlur(channels, (0, 0), sigma).reshape(channels.shape))
    weights, edges = lightest_first(weights)
    inside = np.searchsorted(weights, np.inf)
    for k in scales:
        yield join(weights[:inside], edges[:inside], *channels.shape[:2], k / 255, k)


@compiled
def edge_weights(channels):
    """How far each pixel differs from its neighbours in the four WAYS, from (height, width, c).

    (4 height width,) float32, for the first pixel's ways first; infinite off the picture.
    """
    height, width, depth = channels.shape
    weights = np.full((height, width, 4), np.inf, np.float32)
    for y in range(height):
        for x in range(width):
            for way, (dy, dx) in enumerate(WAYS):
                if y + dy < height and 0 <= x + dx < width:
                    square = np.float32(0)
                    for c in range(depth):
                        step = channels[y, x, c] - channels[y + dy, x + dx, c]
                        square += step * step
                    weights[y, x, way] = np.sqrt(square)
    return weights.ravel()


def lightest_first(weights):
    """Weights (n,), float32 from 0 up, sorted, and which they are, (n,): equal ones in order.

    The bits of such numbers sort as they do. Radix sort: by the lowest eleven bits, then by the
    next, then by the highest; so the time grows as n, not as n log n.
    """
    edges = np.empty(len(weights), EDGE)
    edges["which"], edges["weight"] = np.arange(len(weights), dtype=np.uint32), weights
    numbers, room = edges.view("<u8"), np.empty(len(weights), "<u8")
    for lowest in (32, 43, 54):
        numbers, room = dealt(numbers, room, lowest), numbers
    edges = numbers.view(EDGE)
    return edges["weight"], edges["which"]


@compiled
def dealt(numbers, room, lowest):
    """Numbers (n,), uint64, sorted by eleven of their bits by counting them, equal ones in order.

    They are put into `room` (n,).
    """
    lowest, digits = np.uint64(lowest), np.uint64(2047)
    place = np.zeros(2049, np.int64)  # where a digit's next number goes
    for number in numbers:
        place[np.int64(number >> lowest & digits) + 1] += 1
    place = np.cumsum(place)
    for number in numbers:
        digit = np.int64(number >> lowest & digits)
        room[place[digit]] = number
        place[digit] += 1
    return room


@compiled
def join(weights, edges, height, width, k, smallest):
    """Labels (height, width) after a walk along the sorted edges, and one for small segments.

    An edge joins two patches that both tolerate its weight: the weight of the last edge inside
    each, and k / size. At the second walk it joins any two if one has under `smallest` pixels.
    """
    n = height * width
    root, size = np.arange(n).astype(np.uint32), np.ones(n, np.int32)
    tolerance = np.full(n, k, np.float32)
    neighbour = np.array([1, width, width + 1, width - 1]).astype(np.uint32)

    def ends(edge):
        pixel = edge >> np.uint32(2)
        return pixel, pixel + neighbour[edge & np.uint32(3)]

    def find(pixel):
        while root[pixel] != pixel:
            root[pixel] = root[root[pixel]]  # half as far for who asks next
            pixel = root[pixel]
        return pixel

    def unite(a, b):
        a, b = (b, a) if size[a] < size[b] else (a, b)
        root[b], size[a] = a, size[a] + size[b]
        return a

    apart, waiting, left = np.empty(BLOCK, np.int64), np.empty_like(edges), 0
    for start in range(0, len(edges), BLOCK):
        count = 0
        for e in range(start, min(start + BLOCK, len(edges))):
            one, other = ends(edges[e])
            apart[count] = e
            count += root[root[one]] != root[root[other]]  # or else of one patch already
        for e in apart[:count]:
            one, other = ends(edges[e])
            a, b = find(one), find(other)
            if a != b and weights[e] < min(tolerance[a], tolerance[b]):
                a = unite(a, b)
                tolerance[a] = weights[e] + k / size[a]
            elif a != b:
                waiting[left], left = edges[e], left + 1
    for edge in waiting[:left]:
        one, other = ends(edge)
        a, b = find(one), find(other)
        if a != b and min(size[a], size[b]) < smallest:
            unite(a, b)

    labels, count, number = np.empty(n, np.int64), 0, np.full(n, -1, np.int32)
    for pixel in range(n):
        patch = find(np.uint32(pixel))
        if number[patch] < 0:
            number[patch], count = count, count + 1
        labels[pixel] = number[patch]
    return labels.reshape(height, width)
