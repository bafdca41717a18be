"""What a box shows, as numbers: the raw pixels of the paper, alone or in context, and gradients."""

import numpy as np

from vmc_lib.boxes import as_boxes, widened


def crops(image, boxes, size):
    """What boxes (n, 4) show of a uint8 image (height, width, c): cells (n, size, size, c) in 0..1.

    A cell is the mean of four samples spread evenly over it. Beyond the image its edge pixels
    repeat; a box without area shows the one pixel, or row of pixels, it lies on. ValueError for
    another kind of image.
    """
    if image.dtype != np.uint8 or image.ndim != 3 or image.size == 0:
        raise ValueError(f"{image.dtype} {image.shape} is no uint8 image: see photos.read_image")
    boxes = as_boxes(boxes)
    height, width, channels = image.shape
    steps = (np.arange(size * 2) + 0.5) / (size * 2)
    x, y = (
        (boxes[:, [low]] + steps * (boxes[:, [low + 2]] - boxes[:, [low]])).clip(0, limit - 1)
        for low, limit in ((0, width), (1, height))
    )
    samples = image[y.astype(int)[:, :, None], x.astype(int)[:, None, :]]
    cells = samples.reshape(len(boxes), size, 2, size, 2, channels)
    return cells.mean((2, 4), dtype=np.float32) / 255


def raw_pixels(image, boxes, margin=0.0):
    """The paper's features: 16 × 16 RGB pixels of each box (and a margin), (n, 768)."""
    return crops(image, widened(boxes, margin), 16).reshape(-1, 768)


def pixels_in_context(image, boxes):
    """Raw pixels of each box and a quarter of it around, and the box's width and height, (n, 770).

    A crop of 16 × 16 forgets how large its box was. The sides are in octaves, 0 for those of the
    image; one of no length counts as a pixel.
    """
    boxes = as_boxes(boxes)
    sides = np.maximum(boxes[:, 2:] - boxes[:, :2], 1)
    octaves = np.log2(sides / image.shape[1::-1])
    return np.hstack([raw_pixels(image, boxes, 0.25), octaves], dtype=np.float32)


def gradients(image, boxes, cells=10, bins=8, margin=0.25):
    """Histograms of oriented gradients in 10 × 10 cells over each box and a margin, (n, 800).

    The margin, a share of the box's sides, shows whether the object ends where the box does. Each
    of the 3 × 3 pixels of a cell counts the steepest of its three colours, for the two nearest of
    eight directions all around. After Dalal & Triggs (2005), with one normalisation a box.
    """
    pixels = crops(image, widened(boxes, margin), 3 * cells)
    slopes = np.stack(np.gradient(pixels, axis=(2, 1)))  # along x and y
    steepest = np.linalg.norm(slopes, axis=0).argmax(-1)[None, ..., None]
    dx, dy = np.take_along_axis(slopes, steepest, -1)[..., 0]
    strength, angle = np.hypot(dx, dy), np.arctan2(dy, dx) / (2 * np.pi) % 1 * bins
    low, share = angle.astype(int) % bins, angle % 1
    row = np.arange(3 * cells) // 3
    cell = np.arange(len(pixels))[:, None, None] * cells**2 + row[:, None] * cells + row
    counts = sum(
        np.bincount((cell * bins + bin_).ravel(), (strength * part).ravel(), cell.size // 9 * bins)
        for bin_, part in ((low, 1 - share), ((low + 1) % bins, share))
    ).reshape(len(pixels), cells**2 * bins)
    shares = counts / (np.linalg.norm(counts, axis=1, keepdims=True) + 1e-3)
    return np.sqrt(shares, dtype=np.float32)
