"""Region descriptors for selective search: size, box, colour and texture histograms.

A merged region inherits all of them from its two parts (Uijlings et al. 2013).
"""

from typing import NamedTuple

import numpy as np

from vmc_lib.compiled import compiled

LAB_LOWEST, LAB_RANGE = np.array([[0, -128, -128], [100, 255, 255]], np.float32)  # L, a and b


def _hsv(rgb):
    import cv2

    return cv2.cvtColor(rgb, cv2.COLOR_RGB2HSV) / np.float32([360, 1, 1])


def _lab(rgb):
    import cv2

    return (cv2.cvtColor(rgb, cv2.COLOR_RGB2Lab) - LAB_LOWEST) / LAB_RANGE


COLOUR_SPACES = {  # float RGB in 0..1 -> channels in about 0..1
    "RGB": lambda rgb: rgb,
    "HSV": _hsv,
    "Lab": _lab,
    "rgI": lambda rgb: np.dstack([rgb[..., :2] / (rgb.sum(2, keepdims=True) + 1e-6), rgb.mean(2)]),
    "H": lambda rgb: COLOUR_SPACES["HSV"](rgb)[..., :1],
    "I": lambda rgb: rgb.mean(2, keepdims=True),
}
MEASURES = "colour", "texture", "size", "fill"  # of similarity
COLOUR_BINS, SLOPE_BINS = 25, 10  # of a channel; of a channel's slope in one direction


class Appearance(NamedTuple):
    """Descriptors of each region: rows for segments, then for merged regions."""

    size: np.ndarray  # (n,) pixels
    boxes: np.ndarray  # (n, 4)
    colour: np.ndarray  # (n, 25 c) histogram of each channel, sums to 1
    texture: np.ndarray  # (n, 80 c) histogram of each channel's slopes, sums to 1
    pixels: int  # in the whole image


@compiled
def merge_regions(regions: Appearance, i: int, j: int, new: int) -> None:
    """Write into row `new` of an Appearance the union of regions i and j, from their rows alone."""
    size, boxes = regions.size, regions.boxes
    size[new] = size[i] + size[j]
    for low, high in ((0, 2), (1, 3)):
        boxes[new, low] = min(boxes[i, low], boxes[j, low])
        boxes[new, high] = max(boxes[i, high], boxes[j, high])
    for histogram in (regions.colour, regions.texture):
        for x in range(histogram.shape[1]):
            both = size[i] * histogram[i, x] + size[j] * histogram[j, x]
            histogram[new, x] = both / size[new]


@compiled
def similarity(
    regions: Appearance, pairs: np.ndarray, measures: tuple[bool, ...] = (True, True, True, True)
) -> np.ndarray:
    """Similarity of pairs (m, 2) of regions, (m,): the sum of those MEASURES that are True.

    Each is at most 1, for regions that are most alike (Uijlings et al. 2013, section 3.2).
    """
    by_colour, by_texture, by_size, by_fill = measures
    size, boxes, colour, texture, pixels = regions
    total = np.zeros(len(pairs))
    for n, (i, j) in enumerate(pairs):
        both = size[i] + size[j]
        if by_colour:  # histogram intersection: 1 when equal, 0 when disjoint
            for x in range(colour.shape[1]):
                total[n] += min(colour[i, x], colour[j, x])
        if by_texture:
            for x in range(texture.shape[1]):
                total[n] += min(texture[i, x], texture[j, x])
        if by_size:  # near 1 for two small regions, so that the small ones merge first
            total[n] += 1 - both / pixels
        if by_fill:  # 1 when they fill the box around both, less for every pixel of neither's
            width = max(boxes[i, 2], boxes[j, 2]) - min(boxes[i, 0], boxes[j, 0])
            height = max(boxes[i, 3], boxes[j, 3]) - min(boxes[i, 1], boxes[j, 1])
            total[n] += 1 - (width * height - both) / pixels
    return total


def colour_codes(channels: np.ndarray) -> tuple[np.ndarray, int]:
    """Colour bin of each pixel in each channel: codes (c, pixels), and how many bins there are."""
    bins = np.clip(channels * COLOUR_BINS, 0, COLOUR_BINS - 1).astype(np.uint8)
    return np.moveaxis(bins, 2, 0).reshape(channels.shape[2], -1), COLOUR_BINS


def texture_codes(channels: np.ndarray) -> tuple[np.ndarray, int]:
    """Quantised directional derivatives: 4 orientations × 2 signs × 10 bins per channel.

    Returns the codes (4c, pixels), and how many bins there are.
    """
    import cv2

    angles = np.arange(4) * np.pi / 4
    smooth = [cv2.GaussianBlur(channel, (0, 0), 1) for channel in np.moveaxis(channels, 2, 0)]
    codes = [_slope_codes(cv2.Sobel(x, -1, 1, 0), cv2.Sobel(x, -1, 0, 1), angles) for x in smooth]
    return np.concatenate(codes).reshape(4 * len(smooth), -1), 2 * SLOPE_BINS


@compiled
def _slope_codes(dx, dy, angles):
    """Codes (angles, height, width) of the derivatives of an image along each angle."""
    height, width = dx.shape
    codes = np.empty((len(angles), height, width), np.uint8)
    for line, angle in enumerate(angles):
        across, down = np.cos(angle), np.sin(angle)
        for y in range(height):
            for x in range(width):
                slope = across * dx[y, x] + down * dy[y, x]
                code = min(SLOPE_BINS * abs(slope), SLOPE_BINS - 1)
                codes[line, y, x] = int(code) + SLOPE_BINS * (slope < 0)
    return codes


@compiled
def _count(labels, codes, regions, bins):
    """Counts (regions, rows, bins) of codes (rows, pixels) in regions labelled (pixels,)."""
    counts = np.zeros((regions, len(codes), bins), np.int32)
    for row in range(len(codes)):
        for pixel in range(len(labels)):
            counts[labels[pixel], row, codes[row, pixel]] += 1
    return counts


def histograms(counts: np.ndarray) -> np.ndarray:
    """Counts (regions, ...) normalised to sum to 1 in each region: (regions, bins), float32."""
    counts = counts.reshape(len(counts), -1).astype(np.float32)
    return counts / counts.sum(1, keepdims=True)


def describe(
    labels: np.ndarray, colours: tuple[np.ndarray, int], textures: tuple[np.ndarray, int]
) -> Appearance:
    """The Appearance of n labelled segments, with room for every merge: 2n - 1 rows."""
    from scipy.ndimage import find_objects

    places = find_objects(labels + 1)
    colour, texture = (
        _count(labels.ravel(), codes, len(places), bins) for codes, bins in (colours, textures)
    )
    texture = texture.reshape(len(places), -1, 2, textures[1] // 2)
    texture[..., 0] += texture.sum(3)[..., ::-1]  # falling one way is rising the other
    rows = {
        "size": np.bincount(labels.ravel()),
        "boxes": np.array([(x.start, y.start, x.stop, y.stop) for y, x in places], float),
        "colour": histograms(colour),
        "texture": histograms(texture),
    }
    room = {name: np.concatenate([row, np.zeros_like(row[1:])]) for name, row in rows.items()}
    return Appearance(**room, pixels=labels.size)
