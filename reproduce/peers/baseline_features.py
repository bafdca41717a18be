"""Baseline features beside the CDBN's: raw pixels, HOG and bags of SIFT words.

Each function takes grey crops (n, 200, 200) in 0..1 and returns features (n, d).
"""

import numpy as np


def grey_pixels(crops, width=32):
    """The pixels themselves, on a coarser grid."""
    import cv2

    small = [cv2.resize(x, (width, width), interpolation=cv2.INTER_AREA).ravel() for x in crops]
    return np.array(small)


def histograms_of_gradients(crops):
    """HOG (Dalal & Triggs 2005): in each cell of 20 × 20 pixels, which way the edges run."""
    from skimage.feature import hog

    return np.array([hog(x, pixels_per_cell=(20, 20), cells_per_block=(2, 2)) for x in crops])


def bag_of_sift(crops, words):
    """How often each of the `words` (m, 128) occurs among a crop's SIFT descriptors (Lowe 1999)."""
    counts = []
    for found in map(sift, crops):
        nearest = ((words**2).sum(1) - 2 * found @ words.T).argmin(1)
        counts.append(np.bincount(nearest, minlength=len(words)) / max(len(found), 1))
    return np.sqrt(counts)


def sift(crop):
    """The SIFT descriptors (m, 128) of a crop, each of length one, on a regular grid of places."""
    import cv2

    grid = [cv2.KeyPoint(x, y, 12.0) for y in range(20, 200, 16) for x in range(20, 200, 16)]
    _, found = cv2.SIFT_create().compute(np.uint8(255 * crop), grid)
    return found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-6)
