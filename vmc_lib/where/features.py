"""Features of boxes: raw pixels (the paper's), with context, and histograms of gradients (HOG)."""

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.boxes import as_boxes, pad_boxes
from vmc_lib.checks import check_count
from vmc_lib.compiled import compiled
from vmc_lib.photos import crops

DIRECTIONS = 8  # orientations of gradients, over 360°


def raw_pixels(image: np.ndarray, boxes: ArrayLike, size: int = 16) -> np.ndarray:
    """Raw-pixel features: size × size RGB pixels of each box, from -1 to 1, (n, 3 size²).

    The paper takes raw RGB pixels and prints no size: 16 is ours. It prints no scale either;
    LibSVM's manual asks for one, from 0 to 1 or, as in its example, from -1 to 1.
    """
    return 2 * crops(image, boxes, size).reshape(-1, 3 * size**2) - 1


def pixels_in_context(image: np.ndarray, boxes: ArrayLike) -> np.ndarray:
    """16 × 16 pixels of each box and a quarter of it around, and its width and height, (n, 770).

    A crop forgets how large its box was. The sides are in octaves, 0 for those of the image; one of
    no length counts as a pixel. Colours are from 0 to 1.
    """
    boxes = as_boxes(boxes)
    sides = np.maximum(boxes[:, 2:] - boxes[:, :2], 1)
    pixels = crops(image, pad_boxes(boxes, 0.25), 16).reshape(-1, 768)
    octaves = np.log2(sides / image.shape[1::-1])
    return np.hstack([pixels, octaves], dtype=np.float32)


def gradients(
    image: np.ndarray, boxes: ArrayLike, cells: int = 10, margin: float = 0.25
) -> np.ndarray:
    """Histograms of oriented gradients in 10 × 10 cells over each box and a margin, (n, 800).

    Each of the 3 × 3 pixels of a cell votes with the gradient of its strongest channel,
    interpolated between the two nearest of 8 orientations. The margin, a share of the box's sides,
    shows whether the object ends where the box does. After Dalal & Triggs (2005), with one
    normalisation for each box.
    """
    check_count("cells", cells, least=1)
    dx, dy = _strongest_gradient(crops(image, pad_boxes(boxes, margin), 3 * cells))
    strength, turns = np.hypot(dx, dy), np.arctan2(dy, dx) / (2 * np.pi)
    angle = (turns - np.floor(turns)) * DIRECTIONS
    low = np.floor(angle)
    share = angle - low
    counts = _count(strength * (1 - share), low, cells)
    counts += _count(strength * share, low + 1, cells)
    shares = counts / (np.linalg.norm(counts, axis=1, keepdims=True) + 1e-3)
    return np.sqrt(shares, dtype=np.float32)


@compiled
def _strongest_gradient(pixels):
    """Gradients along x and y of pixels (n, size, size, c), in the channel where they are largest.

    Central differences; one-sided at the edge.
    """
    n, size, _, channels = pixels.shape
    slopes = np.empty((2, n, size, size), np.float32)
    for box in range(n):
        for y in range(size):
            low, high = max(y - 1, 0), min(y + 1, size - 1)
            above, here, below = pixels[box, low], pixels[box, y], pixels[box, high]
            down = np.float32(1 / (high - low))
            for x in range(size):
                left, right = max(x - 1, 0), min(x + 1, size - 1)
                across = np.float32(1 / (right - left))
                most, most_x, most_y = np.float32(-1), np.float32(0), np.float32(0)
                for c in range(channels):
                    dx = (here[right, c] - here[left, c]) * across
                    dy = (below[x, c] - above[x, c]) * down
                    steep = np.sqrt(dx * dx + dy * dy)
                    if steep > most:
                        most, most_x, most_y = steep, dx, dy
                slopes[0, box, y, x], slopes[1, box, y, x] = most_x, most_y
    return slopes


@compiled
def _count(weights, codes, cells):
    """Histograms (n, cells² DIRECTIONS) of codes (n, 3 cells, 3 cells) with weights like them."""
    counts = np.zeros((len(weights), cells, cells, DIRECTIONS))
    for box in range(len(weights)):
        for y in range(3 * cells):
            for x in range(3 * cells):
                code = int(codes[box, y, x])
                code = code - DIRECTIONS if code >= DIRECTIONS else code
                counts[box, y // 3, x // 3, code] += weights[box, y, x]
    return counts.reshape(len(weights), cells**2 * DIRECTIONS)
