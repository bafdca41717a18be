"""Sliding windows and edge density: baselines for selective search."""

import numpy as np

from vmc_lib.boxes import area, pad_boxes
from vmc_lib.photos import as_float


def sliding_windows(shape, rng, sides=(40, 60, 90, 135, 200), ratios=(0.67, 1, 1.5), step=0.2):
    """Windows (n, 4) of fixed sizes and shapes, stepped over an image (height, width), shuffled.

    `sides` are square roots of areas, `ratios` widths over heights, `step` is a share of a side.
    A window that is larger than the image is left out.
    """
    height, width = shape
    windows = []
    for side in sides:
        for ratio in ratios:
            w, h = side * ratio**0.5, side / ratio**0.5
            x, y = np.meshgrid(
                np.arange(0, width - w, w * step), np.arange(0, height - h, h * step)
            )
            corner = np.stack([x.ravel(), y.ravel()], 1)
            windows.append(np.hstack([corner, corner + np.array([w, h])]))
    return rng.permutation(np.concatenate(windows))


def exhaustive(shape):
    """Windows (n, 4) dense enough that one overlaps any box of a likely shape by 0.8 (IoU).

    From 30 to 220 pixels, 1.2 apart; shapes from 1 : 2 to 2 : 1, 1.25 apart; steps of 0.12 sides.
    """
    sides, ratios = 30 * 1.2 ** np.arange(12), 1.25 ** np.arange(-3.0, 4)
    return sliding_windows(shape, np.random.default_rng(0), sides, ratios, step=0.12)


def edge_density(image, windows, rim=0.15):
    """How much more edge there is in a window than in a rim around it, per pixel: (n,).

    An object has its outline inside its box and little just outside.
    """
    import cv2  # not in the page

    grey = cv2.GaussianBlur(as_float(image).mean(2), (0, 0), 1)
    edges = np.hypot(cv2.Sobel(grey, -1, 1, 0), cv2.Sobel(grey, -1, 0, 1))
    summed = cv2.integral(edges, sdepth=cv2.CV_64F)

    def inside(boxes):
        x0, y0, x1, y1 = boxes.T
        return summed[y1, x1] - summed[y0, x1] - summed[y1, x0] + summed[y0, x0]

    height, width = grey.shape
    inner, outer = (
        np.clip(boxes.round().astype(int), 0, [width, height, width, height])
        for boxes in (windows, pad_boxes(windows, rim))
    )
    rim_area = np.maximum(area(outer) - area(inner), 1)
    return inside(inner) / np.maximum(area(inner), 1) - (inside(outer) - inside(inner)) / rim_area
