"""Bounding boxes: intersection over union, non-maximum suppression, voting, regression deltas."""

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers, check_rng, is_positive, is_within, shape_of
from vmc_lib.short_repr import short

MIN_IOU = 0.8  # IoU at which a box counts as the object's (Section IV A)
NEGATIVE_IOU = 0.5  # IoU up to which a candidate clearly shows no object (Section III, Block 1-1)
VOTE_IOU = 0.5  # IoU from which on a box votes for another
HIT_IOU = 0.5  # IoU above which a box lies on an object: most of their union is shared


def as_boxes(boxes: ArrayLike) -> np.ndarray:
    """Convert boxes to a float64 array (n, 4) of (x0, y0, x1, y1), x1 and y1 exclusive.

    One box, or an empty list, becomes an array of one row or none. A box may have no area, and
    may lie outside the image. ValueError when a box is inside out or not finite.
    """
    boxes = as_numbers("boxes", boxes)
    if boxes.size == 0:
        return np.empty((0, 4))
    boxes = np.atleast_2d(boxes)
    if boxes.ndim != 2 or boxes.shape[1] != 4:
        raise ValueError(f"boxes must be rows of (x0, y0, x1, y1), not an array {boxes.shape}")
    wrong = ~np.isfinite(boxes).all(1) | (boxes[:, 2:] < boxes[:, :2]).any(1)
    if wrong.any():
        raise ValueError(f"box {boxes[wrong][0]} needs finite x0 <= x1 and y0 <= y1")
    return boxes


def as_box(box: ArrayLike) -> np.ndarray:
    """Convert one box to a float64 array (4,), as `as_boxes` does; ValueError for none, or more."""
    if len(boxes := as_boxes(box)) != 1:
        raise ValueError(f"{len(boxes)} boxes: give one alone, (x0, y0, x1, y1)")
    return boxes[0]


def pixels_inside(box: ArrayLike, image: np.ndarray) -> np.ndarray:
    """The whole pixels (x0, y0, x1, y1) of a box in an image; ValueError for fewer than 2 × 2."""
    if not isinstance(image, np.ndarray) or image.ndim < 2:
        raise ValueError(f"{short(image)} is no image: see photos.read_image")
    height, width = image.shape[:2]
    inside = np.clip(np.round(as_box(box)), 0, [width, height] * 2).astype(int)
    if np.any(inside[2:] - inside[:2] < 2):
        raise ValueError(f"the box {short(box)} holds nothing of a {width}×{height} image")
    return inside


def _check_fours(boxes):
    """Raise ValueError where boxes are no rows of four; their order is not looked at."""
    if shape_of("boxes", boxes)[-1:] != (4,):
        raise ValueError(f"boxes {short(boxes)} must be rows of (x0, y0, x1, y1)")


def area(boxes: ArrayLike) -> np.ndarray:
    """Areas (n,) of boxes (n, 4), in square pixels."""
    _check_fours(boxes)
    x0, y0, x1, y1 = np.moveaxis(np.asarray(boxes), -1, 0)
    return (x1 - x0) * (y1 - y0)


def centres_and_sides(boxes: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and sides (n, 2), along x and y, of boxes (n, 4)."""
    _check_fours(boxes)
    boxes = np.asarray(boxes)
    return (boxes[..., :2] + boxes[..., 2:]) / 2, boxes[..., 2:] - boxes[..., :2]


def iou(a: ArrayLike, b: ArrayLike) -> np.ndarray:
    """Intersection over union (Jaccard index) of boxes, pair by pair.

    Parameters
    ----------
    a, b : (n, 4) and (m, 4) arrays of (x0, y0, x1, y1), pixels

    Returns
    -------
    (n, m) array in 0..1; 0 for two boxes without area, even when they coincide

    Examples
    --------
    >>> iou([0, 0, 2, 2], [[0, 0, 2, 2], [0, 0, 2, 1]]).tolist()
    [[1.0, 0.5]]
    """
    a, b = as_boxes(a)[:, None], as_boxes(b)[None]
    sides = np.minimum(a[..., 2:], b[..., 2:]) - np.maximum(a[..., :2], b[..., :2])
    width, height = np.moveaxis(sides.clip(0), -1, 0)
    shared = width * height
    union = area(a) + area(b) - shared
    return np.divide(shared, union, out=np.zeros_like(shared), where=union > 0)


def nms(boxes: ArrayLike, scores: ArrayLike, overlap: float = 0.3) -> np.ndarray:
    """Greedy non-maximum suppression.

    The best box stays and suppresses every box that overlaps it by more than `overlap`; then the
    best of the rest, and so on. Of equal scores the earlier box goes first.

    Parameters
    ----------
    boxes : (n, 4) array of (x0, y0, x1, y1), pixels
    scores : (n,) array
    overlap : largest IoU that two kept boxes may have

    Returns
    -------
    (k,) int array: indices of the boxes kept, by falling score

    Raises
    ------
    ValueError
        If there is not one finite score for each box, or no such overlap.

    References
    ----------
    Neubeck & Van Gool (2006), Efficient non-maximum suppression (greedy form).

    Examples
    --------
    >>> nms([[0, 0, 9, 9], [0, 0, 9, 8], [20, 0, 29, 9]], [0.6, 0.9, 0.8]).tolist()
    [1, 2]
    """
    boxes, scores = _boxes_and_scores(boxes, scores)
    if not is_within(overlap, 0, 1):
        raise ValueError(f"overlap = {short(overlap)}: an IoU is within 0..1")
    waiting, kept = np.argsort(-scores, kind="stable"), []
    while len(waiting):
        best, rest = waiting[0], waiting[1:]
        kept.append(best)
        waiting = rest[iou(boxes[best], boxes[rest])[0] <= overlap]
    return np.array(kept, int)


def _boxes_and_scores(boxes, scores):
    """Boxes and their scores as arrays; ValueError where one finite score is not there for each."""
    boxes, scores = as_boxes(boxes), as_numbers("scores", scores)
    if scores.shape != (len(boxes),) or not np.isfinite(scores).all():
        got = f"shape {scores.shape}" if scores.shape != (len(boxes),) else scores
        raise ValueError(f"{len(boxes)} boxes need as many finite scores, not {got}")
    return boxes, scores


def vote(
    kept: ArrayLike, boxes: ArrayLike, scores: ArrayLike, temperature: float = 0.1
) -> np.ndarray:
    """Box voting: each of the boxes `kept` becomes a weighted mean of those near it, (k, 4).

    `kept` (k,) are indices of the `boxes` (n, 4), which have `scores` (n,). A box votes for each
    kept one that it overlaps by half or more and does not outscore. A vote weighs
    exp(-lag / temperature), where `lag` is how far its score is below the kept box's (after Gidaris
    & Komodakis 2015). ValueError where `kept` is no list of boxes' indices, or the temperature not
    above 0.
    """
    boxes, scores = _boxes_and_scores(boxes, scores)
    kept = as_numbers("kept", kept)
    if kept.ndim != 1 or not np.isin(kept, np.arange(len(boxes))).all():
        raise ValueError(f"kept {short(kept)}: give indices of the {len(boxes)} boxes, as nms does")
    kept = kept.astype(int)
    if not is_positive(temperature):
        raise ValueError(f"temperature = {short(temperature)}: give a number above 0")
    lag = scores[kept, None] - scores
    votes = (lag >= 0) & (iou(boxes[kept], boxes) >= VOTE_IOU)
    votes[np.arange(len(kept)), kept] = True  # without area, it does not overlap even itself
    weights = votes * np.exp(-lag.clip(0) / temperature)
    return weights @ boxes / weights.sum(1, keepdims=True)


def pad_boxes(boxes: ArrayLike, margin: float) -> np.ndarray:
    """Pad boxes (n, 4) by a margin on each side, given as a share of their sides."""
    boxes = as_boxes(boxes)
    if not is_within(margin, -0.5, np.inf):
        raise ValueError(f"margin {short(margin)}: give one number, above -0.5, as 0.25")
    pad = margin * (boxes[:, 2:] - boxes[:, :2])
    return np.hstack([boxes[:, :2] - pad, boxes[:, 2:] + pad])


def jitter_boxes(boxes: ArrayLike, amount: float, rng: np.random.Generator) -> np.ndarray:
    """Jitter the edges of boxes (..., 4) by Gaussian noise, `amount` in shares of their sides."""
    check_rng(rng)
    boxes = as_numbers("boxes", boxes)
    _, sides = centres_and_sides(boxes)
    amount = as_numbers("amount", amount)
    if amount.ndim or not 0 <= amount < np.inf:
        raise ValueError(f"amount {short(amount)}: give one share of the sides, 0 or more")
    return boxes + rng.normal(0, amount, boxes.shape) * np.tile(sides, 2)


def _one_for_each(boxes, name, rows):
    """Boxes and rows of four; ValueError unless they are as many, or one stands for all."""
    if rows.shape[1:] != (4,) or (len(rows) != len(boxes) and 1 not in (len(rows), len(boxes))):
        raise ValueError(f"{name} {rows.shape} of {len(boxes)} boxes: give a row of 4 for each")
    return boxes, rows


def encode_deltas(boxes: ArrayLike, truth: ArrayLike) -> np.ndarray:
    """Box-regression targets (dx/w, dy/h, log dw, log dh) from boxes to truth, (n, 4) (R-CNN).

    ValueError unless there is one true box for each, or one for all; where one has no area.
    """
    boxes, truth = _one_for_each(as_boxes(boxes), "truth", as_boxes(truth))
    (centres, sides), (true_centres, true_sides) = map(centres_and_sides, (boxes, truth))
    for one, its_sides in ((boxes, sides), (truth, true_sides)):
        if not np.all(its_sides > 0):
            flat = one[(its_sides <= 0).any(1)][0]
            raise ValueError(f"box {flat} has no area, so no deltas: leave it out")
    return np.hstack([(true_centres - centres) / sides, np.log(true_sides / sides)])


def decode_deltas(boxes: ArrayLike, deltas: ArrayLike) -> np.ndarray:
    """Move and stretch boxes (n, 4) by deltas (n, 4) as `encode_deltas` defines them.

    ValueError unless there is one row of deltas for each, or one for all.
    """
    boxes, deltas = _one_for_each(as_boxes(boxes), "deltas", as_numbers("deltas", deltas))
    centres, sides = centres_and_sides(boxes)
    centres = centres + deltas[:, :2] * sides
    half = sides * np.exp(deltas[:, 2:]) / 2
    return np.hstack([centres - half, centres + half])
