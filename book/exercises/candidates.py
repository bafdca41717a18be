"""Exercises of the chapter on candidates."""

from types import SimpleNamespace

import numpy as np

from vmc_lib.grading import Exercise


def _boxes(rng, count):
    corner = rng.integers(0, 120, (count, 2))
    return np.hstack([corner, corner + rng.integers(20, 100, (count, 2))])


def similar_fill(box_i, box_j, size_i, size_j, pixels):
    low = np.minimum(box_i[:2], box_j[:2])
    high = np.maximum(box_i[2:], box_j[2:])
    gap = np.prod(high - low) - size_i - size_j
    return 1 - gap / pixels


def _two_regions(rng):
    """Regions that share no pixel: each fills half of its box at most."""
    boxes = _boxes(rng, 2)
    sizes = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1) * rng.uniform(0.2, 0.5, 2)
    return *boxes, *sizes.astype(int).tolist(), int(rng.choice([120_000, 240_000]))


def _area(low, high):
    return np.prod(high - low)


SIMILAR_FILL = Exercise(
    similar_fill,
    _two_regions,
    {
        "That is the gap itself. The smaller it is, the more similar: take it from 1.": (
            lambda a, b, i, j, n: 1 - similar_fill(a, b, i, j, n)
        ),
        "You added the areas of the two boxes. Take the area of *one* box, around both.": (
            lambda a, b, i, j, n: 1 - (_area(a[:2], a[2:]) + _area(b[:2], b[2:]) - i - j) / n
        ),
        "You took the box that both share. The box around both runs from the smaller lower "
        "corner to the larger upper one.": lambda a, b, i, j, n: (
            1 - (_area(np.maximum(a[:2], b[:2]), np.minimum(a[2:], b[2:])) - i - j) / n
        ),
        "The gap is what is left of the box when both regions are taken away.": (
            lambda a, b, i, j, n: similar_fill(a, b, 0, 0, n)
        ),
    },
)


def recall_curve(overlaps, enough):
    so_far = np.maximum.accumulate(overlaps, axis=1)
    return (so_far >= enough).mean(axis=0)


RECALL_CURVE = Exercise(
    recall_curve,
    lambda rng: (rng.integers(0, 11, rng.integers(3, 6, 2)) / 10, rng.choice([0.5, 0.7, 0.8])),
    {
        "Your curve falls here and there. What has been found stays found: take the best "
        "overlap so far.": lambda overlaps, enough: (overlaps >= enough).mean(axis=0),
        "That is the share of *boxes* that are good, for each object. Recall is the share of "
        "objects, for each number of boxes.": lambda overlaps, enough: (
            np.maximum.accumulate(overlaps, axis=1) >= enough
        ).mean(axis=1),
        "An overlap of exactly `enough` is good enough.": lambda overlaps, enough: (
            np.maximum.accumulate(overlaps, axis=1) > enough
        ).mean(axis=0),
        "You counted the objects. Recall is their share.": lambda overlaps, enough: (
            np.maximum.accumulate(overlaps, axis=1) >= enough
        ).sum(axis=0),
    },
)


def engulfed(r, i, j):
    a, b = r.boxes[i], r.boxes[j]
    low = np.maximum(a[:, :2], b[:, :2])
    high = np.minimum(a[:, 2:], b[:, 2:])
    areas = [np.prod(box[:, 2:] - box[:, :2], axis=1) for box in (a, b)]
    return (high - low).clip(0).prod(axis=1) / np.minimum(*areas)


def _pairs(rng):
    count = rng.integers(2, 5)
    return SimpleNamespace(boxes=_boxes(rng, 8)), *rng.permutation(8)[: 2 * count].reshape(2, -1)


def _share_over(over, least=0):
    """`engulfed` with another area below the line, or with sides that may be negative."""

    def wrong(r, i, j):
        a, b = r.boxes[i], r.boxes[j]
        sides = np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2])
        shared = sides.clip(least).prod(axis=1)
        areas = [(box[:, 2:] - box[:, :2]).prod(axis=1) for box in (a, b)]
        return shared / over(*areas, shared)

    return wrong


ENGULFED = Exercise(
    engulfed,
    _pairs,
    {
        "That is the IoU. Divide by the area of the smaller box, not of both together.": (
            _share_over(lambda a, b, shared: a + b - shared)
        ),
        "You divided by the larger box. A hole lies *all* in its plate: divide by the smaller.": (
            _share_over(lambda a, b, shared: np.maximum(a, b))
        ),
        "Either box may be the smaller one: compare the areas, pair by pair.": (
            _share_over(lambda a, b, shared: a)
        ),
        "Boxes that lie apart share nothing. Two negative sides make a positive area: clip each "
        "side at zero first.": _share_over(lambda a, b, shared: np.minimum(a, b), -np.inf),
    },
)
