"""A picture falls into segments: the graph-based method of Felzenszwalb & Huttenlocher (2004).

Every pixel is joined to its eight neighbours by edges that weigh as much as the two differ. Two
neighbouring patches stay apart where the step between them is large beside the steps inside them.

An edge is one number (uint64): its weight's bits, then which it is, four to a pixel, row by row.
So edges sort as numbers do, the lightest first, and equal ones as they lie.
"""

import cv2
import numpy as np

from vmc_lib.compiled import compiled

WAYS = (0, 1), (1, 0), (1, 1), (1, -1)  # from a pixel down or to the right; the rest come back
STRIP = 250_000  # pixels: what is known of so many stays near the processor
BLOCK = 1024  # edges looked at side by side: what they need of a large picture then comes at once


def segment(channels, k=100, sigma=0.8):
    """Segments of an image (height, width, c) with values in 0..1: labels (height, width).

    A larger scale `k` lets patches grow larger, and none stays under k pixels. Labels count from
    the top left. Edges of equal weight go row by row, on every machine alike.
    """
    return next(segmentations(channels, [k], sigma))


def segmentations(channels, scales, sigma=0.8):
    """The labels of `segment` at one scale k after another; the edges are sorted once for all.

    A large picture is joined strip by strip first, as far as no other strip has a say in it.
    """
    smooth = cv2.GaussianBlur(channels, (0, 0), sigma).reshape(channels.shape)
    height, width = smooth.shape[:2]
    pixels, away = height * width, to_neighbours(width)
    patches = [single_pixels(pixels, k / 255) for k in scales]
    left, many = np.empty((len(scales), 4 * pixels), np.uint64), [0] * len(scales)
    for top, bottom in strips(height, width):
        edges, _ = lightest_first(edges_of(smooth, top, bottom))
        for i, k in enumerate(scales):
            free, first, last = left[i, many[i] :], top * width, bottom * width
            many[i] += len(join(edges, free, first, last, away, k / 255, *patches[i]))
    for i, k in enumerate(scales):
        labels = cut_along(left[i, : many[i]], away, k / 255, k, patches[i])
        yield labels.reshape(height, width)


def cut_along(edges, away, k, smallest, patches):
    """Labels (pixels,) once edges (m,), in any order, have joined `patches`; the edges are lost."""
    edges, room = lightest_first(edges)
    edges = join(edges, room, 0, len(patches[0]), away, k, *patches)
    return labels_of(edges, away, smallest, *patches[:2])


def strips(height, width):
    """The rows of a picture, some at a time, from top to bottom: (top, bottom) of each strip."""
    rows = -(-height // max(1, round(height * width / STRIP)))
    for top in range(0, height, rows):
        yield top, min(top + rows, height)


def to_neighbours(width):
    """How much further a neighbour is counted, for each of the WAYS, in a picture so wide."""
    return np.uint32(np.dot(WAYS, [width, 1]))


def edges_of(channels, top, bottom):
    """All edges (m,) with an end in the rows from top to bottom of channels (height, width, c)."""
    room = np.empty((bottom - top + 1) * channels.shape[1] * len(WAYS), np.uint64)
    return room[: _edges(channels, top, bottom, room)]


@compiled
def _edges(channels, top, bottom, edges):
    height, width, depth = channels.shape
    count = 0
    for y in range(max(top - 1, 0), bottom):
        for x in range(width):
            for way, (dy, dx) in enumerate(WAYS):
                if top <= y + dy < height and 0 <= x + dx < width:
                    square = np.float32(0)
                    for c in range(depth):
                        step = channels[y, x, c] - channels[y + dy, x + dx, c]
                        square += step * step
                    weight = np.float32(np.sqrt(square)).view(np.uint32)
                    which = 4 * (y * width + x) + way
                    edges[count] = np.uint64(weight) << np.uint64(32) | np.uint64(which)
                    count += 1
    return count


def lightest_first(edges):
    """Edges (m,) sorted by their weights, equal ones in the order given; and free room, (m,).

    What was given is lost. The bits of floats from 0 up sort as they do. Radix sort: by the lowest
    eleven bits, then by the next, then by the highest; so the time grows as m, not as m log m.
    """
    room = np.empty_like(edges)
    for lowest in (32, 43, 54):
        edges, room = dealt(edges, room, lowest), edges
    return edges, room


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


def single_pixels(count, k):
    """Patches of one pixel each: root, size and tolerance, (count,) each.

    A patch is a tree of pixels. The root stands for it, and knows its size and the weight that it
    tolerates: that of the last edge inside it, and k / size.
    """
    root, size = np.arange(count, dtype=np.uint32), np.ones(count, np.int32)
    return root, size, np.full(count, k, np.float32)


@compiled
def join(edges, left, first, last, away, k, root, size, tolerance):
    """Join the patches of the pixels from first to last along sorted edges; the edges left (m,).

    An edge joins two patches that both tolerate its weight; one too heavy is left. All pixels
    outside are one patch of which nothing is known: an edge to there is left, and so is whatever
    its patch meets afterwards. `left` is room for the edges left.
    """
    unsure, outside, many = np.zeros(last - first + 1, np.bool_), np.uint32(last), 0
    unsure[-1] = True
    apart = np.empty(BLOCK, np.uint64)
    for start in range(0, len(edges), BLOCK):
        count = 0
        for edge in edges[start : start + BLOCK]:
            one, other = ends(edge, away)
            apart[count] = edge
            count += root[root[one]] != root[root[other]]  # or else of one patch already
        for edge in apart[:count]:
            one, other = ends(edge, away)
            a = find(root, one) if one >= first else outside
            b = find(root, other) if other < last else outside
            weight = np.uint32(edge >> np.uint64(32)).view(np.float32)
            if a == b:
                continue
            if unsure[a - first] or unsure[b - first]:
                unsure[a - first] = unsure[b - first] = True
            elif weight < min(tolerance[a], tolerance[b]):
                a = unite(root, size, a, b)
                tolerance[a] = weight + k / size[a]
                continue
            if one >= first:  # or else it was left before
                left[many], many = edge, many + 1
    return left[:many]


@compiled
def labels_of(edges, away, smallest, root, size):
    """Labels (pixels,) of patches, once a walk along the edges left has joined the small ones.

    It joins any two patches if one has under `smallest` pixels.
    """
    for edge in edges:
        one, other = ends(edge, away)
        a, b = find(root, one), find(root, other)
        if a != b and min(size[a], size[b]) < smallest:
            unite(root, size, a, b)
    labels, count, number = np.empty(len(root), np.int64), 0, np.full(len(root), -1, np.int32)
    for pixel in range(len(root)):
        patch = find(root, np.uint32(pixel))
        if number[patch] < 0:
            number[patch], count = count, count + 1
        labels[pixel] = number[patch]
    return labels


def ends(edge, away):
    """The two pixels of an edge."""
    which = np.uint32(edge & np.uint64(0xFFFFFFFF))
    one, way = which >> np.uint32(2), which & np.uint32(3)
    return one, one + away[way]


def find(root, pixel):
    """The root of a pixel's patch."""
    while root[pixel] != pixel:
        root[pixel] = root[root[pixel]]  # half as far for who asks next
        pixel = root[pixel]
    return pixel


def unite(root, size, a, b):
    """Hang the smaller of two patches below the other; the root of both."""
    a, b = (b, a) if size[a] < size[b] else (a, b)
    root[b], size[a] = a, size[a] + size[b]
    return a
