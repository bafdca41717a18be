"""Precision and recall of boxes: which are right, and which objects have a right box."""

import numpy as np

from vmc_lib.boxes import MIN_IOU, iou


def precision_recall(shots, boxes):
    """Precision and recall of a list of boxes a photo: a box is right at an IoU of MIN_IOU or more.

    Precision is the share of boxes that are right, recall that of objects with a right box.
    """
    return tuple(float(rates(best, MIN_IOU)) for best in best_overlaps(shots, boxes))


def best_overlaps(shots, boxes):
    """The best IoU of each box with an object of its photo, and of each object with a box."""
    shared = [iou(b, list(p.boxes.values())) for p, b in zip(shots, boxes, strict=True)]
    return tuple(
        np.concatenate([pairs.max(axis, initial=0) for pairs in shared]) for axis in (1, 0)
    )


def rates(best, overlap):
    """Precision and recall (…, 2) at IoU `overlap`, of `best_overlaps` (…, 2, most)."""
    return (best >= overlap).sum(-1) / np.maximum(np.isfinite(best).sum(-1), 1)
