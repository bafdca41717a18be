"""Pictures of regions and boxes, for the chapters on the dorsal pathway."""

import numpy as np

from vmc_lib.where.boxes import iou


def mosaic(image, labels):
    """The image (height, width, 3) with every region of `labels` painted in its mean colour."""
    flat = labels.ravel()
    size = np.maximum(np.bincount(flat), 1)
    means = np.stack([np.bincount(flat, channel) / size for channel in image.reshape(-1, 3).T], 1)
    return np.uint8(means[labels])


def nearest(truth, boxes, colour="green"):
    """For each named true box the nearest of `boxes`, labelled with its IoU, for `photo_view`."""
    marks = []
    for name, true in truth.items():
        overlap = iou(true, boxes)[0]
        marks.append((boxes[overlap.argmax()], f"{name} {overlap.max():.2f}", colour))
    return marks
