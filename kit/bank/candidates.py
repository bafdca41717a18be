"""Questions on candidates: boxes, overlaps, and regions that grow together."""

import numpy as np

from kit.bank.drawing import boxes as draw_boxes
from kit.bank.drawing import curves
from kit.question import choice, count, numeric, picture, steps
from vmc_lib.boxes import area, iou
from vmc_lib.photos import HEIGHT, WIDTH


def boxes(rng, count=2):
    """Boxes (x0, y0, x1, y1) in whole tens of pixels, each side from 40 to 200."""
    sides = 10 * rng.integers(4, 21, (count, 2))
    corners = 10 * rng.integers(0, ([WIDTH, HEIGHT] - sides) // 10 + 1)
    return [tuple(box) for box in np.hstack([corners, corners + sides]).tolist()]


def near_boxes(rng):
    """Two boxes that overlap: one, and the same moved and stretched by tens of pixels."""
    [first] = boxes(rng, 1)
    return first, tuple((first + 10 * rng.integers(-2, 3, 4) + [0, 0, 10, 10]).tolist())


@count("boxes", "Choose two different edges out of width + 1, and two out of height + 1.")
def boxes_in_a_picture(width=steps(2, 9, 1), height=steps(2, 9, 1)):
    """How many different boxes are there in a picture of {width} × {height} pixels, from one pixel
    to the whole?"""
    return width * (width + 1) // 2 * (height * (height + 1) // 2)


@count("square pixels", "Both areas, less what they share.")
def union_of_two(pair=near_boxes):
    """Boxes are (x0, y0, x1, y1). How many square pixels do {pair[0]} and {pair[1]} cover
    together?"""
    return round(area(np.array(pair)).sum() / (1 + iou(*pair).item()))


@numeric(hint="Shared area over the area that either covers.")
def overlap_of_two(pair=near_boxes):
    """What is the IoU of the boxes {pair[0]} and {pair[1]}, each (x0, y0, x1, y1)?"""
    return iou(*pair).item()


@count("square pixels", "The smallest box around both.")
def smallest_box_around(pair=boxes):
    """Two regions have the boxes {pair[0]} and {pair[1]}, each (x0, y0, x1, y1). They merge. How
    large is the new region's box?"""
    return np.prod(np.max(pair, axis=0)[2:] - np.min(pair, axis=0)[:2])


@numeric(hint="The share of things that some candidate covers so well.", tolerance=0.001)
def recall_at(
    best=lambda rng: np.round(rng.uniform(0.5, 1, 10), 2),
    level=(0.6, 0.7, 0.8, 0.9),
):
    """The best overlap that any candidate has with each of ten things: {overlaps}. What is the
    recall at IoU {level}?"""
    return np.mean(best >= level), {"overlaps": ", ".join(f"{x:.2f}" for x in best)}


@numeric(hint="The largest of the three.")
def average_best_overlap(pair=near_boxes):
    """A thing has the box {pair[0]}, as (x0, y0, x1, y1). The candidates are {names}. What is its
    best overlap (IoU), which enters the mean ABO?"""
    candidates = pair[1] + np.array([[0, 0, 0, 0], [10, 0, 10, 0], [0, 20, 0, 20]])
    names = "; ".join(str(tuple(corners)) for corners in candidates.tolist())
    return iou(pair[0], candidates).max(), {"names": names}


@count("", "Each merge takes two regions away and adds one.")
def regions_of_a_hierarchy(n=steps(60, 400, 5)):
    """A picture falls into {n} segments, and pairs of them merge, one pair at a time. How many
    regions have there been in all, from the first segments to the whole picture?"""
    return 2 * n - 1


@choice("yes", "no", hint="It tolerates what is lighter than the edge inside it + k / size.")
def tolerance_of_a_patch(
    k=(50, 100, 150, 300),
    pixels=steps(20, 200, 10),
    inside=steps(2, 12, 0.5),
    more=(-0.4, -0.2, 0.2, 0.4),
):
    """A patch of {pixels} pixels was last joined by an edge of weight {inside}; the scale is k =
    {k}. Does it tolerate an edge of weight {edge:.2f} to its neighbour?"""
    edge = round(inside + k / pixels + more, 2)
    return edge >= inside + k / pixels, {"edge": edge}


def histogram(rng):
    return rng.multinomial(10, [0.25] * 4) / 10


@numeric(hint="Bin by bin the smaller of the two shares, added up.", tolerance=0.001)
def alike_in_colour(first=histogram, second=histogram):
    """Two regions have the colour histograms {first} and {second}. How alike are they in colour?"""
    return np.minimum(first, second).sum()


@numeric(
    hint="1, less the share of the picture that lies in the box around both but in neither.",
    tolerance=1e-4,
)
def fit_together(side=steps(40, 100, 10), gap=steps(10, 50, 10)):
    """Two square regions of {side} × {side} pixels, both full, lie side by side with a gap of {gap}
    pixels in a picture of {WIDTH} × {HEIGHT}. How well do they fit together ('fill'),
    to four digits after the point?"""
    return 1 - gap * side / (WIDTH * HEIGHT)


BOXES = 2 ** np.arange(9)  # so many are tried


def growing_recalls(rng):
    """The recall of two methods after so many boxes, (2, 9), in odd twentieths."""
    return np.sort([rng.choice(np.arange(5, 100, 10), 9, replace=False) for _ in "AB"]) / 100


def recall_curves(axes, recalls):
    """Recall against the number of boxes, from 1 to 256 in powers of two. Method A: {recalls[0]}.
    Method B: {recalls[1]}."""
    curves(axes, BOXES, dict(zip("AB", recalls, strict=True)), "boxes", "recall")
    axes.set_xscale("log", base=2)
    axes.set(xticks=BOXES, xticklabels=BOXES, yticks=np.arange(0, 1.1, 0.1))


@picture(recall_curves)
@count("boxes", "Go along the level to the curve, then down. Only powers of two were tried.")
def boxes_for_a_recall(recalls=growing_recalls, level=(0.5, 0.6, 0.7, 0.8), method=(0, 1)):
    """Of the numbers of boxes that were tried (1, 2, 4, …), which is the smallest with which method
    {name} has a recall of at least {level}?"""
    return BOXES[np.argmax(recalls[method] >= level)], {"name": "AB"[method]}


# From a thing's box: moved a little; inside it; around it
DEVIATIONS = [[0.1, 0.1, 0.1, 0.1], [0.2, 0.15, -0.15, -0.15], [-0.3, -0.3, 0.3, 0.3]]


def three_candidates(size, order):
    """The boxes of a thing and of three candidates around it, (4, 4), in this order."""
    thing = np.array([100, 60, 100 + size[0], 60 + size[1]])
    return np.vstack([thing, thing + np.array(DEVIATIONS)[order] * np.tile(size, 2)])


def candidates(axes, size, order):
    """A thing's box, {size[0]} × {size[1]} pixels, and three candidates: {said}."""
    draw_boxes(axes, dict(zip(("thing", *"ABC"), three_candidates(size, order), strict=True)))


@picture(candidates)
@choice("A", "B", "C", hint="What both share over what either covers: too much costs as well.")
def best_of_three_boxes(
    size=lambda rng: 10 * rng.integers(8, 21, 2), order=lambda rng: rng.permutation(3)
):
    """Which candidate overlaps the thing best, by IoU?"""
    thing, *others = three_candidates(size, order)
    kinds = "of its size, a little beside it", "inside it", "around it"
    said = (f"{name} is {kinds[k]}" for name, k in zip("ABC", order, strict=True))
    return np.argmax(iou(thing, np.array(others))), {"said": "; ".join(said)}
