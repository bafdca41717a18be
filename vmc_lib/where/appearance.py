"""What selective search sees: a picture in several colour spaces, and how its segments look.

A segment is described by its size, its box, and histograms of its colours and of its texture, all
of which a merged region inherits from its two parts (Uijlings et al. 2013).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from scipy.ndimage import find_objects

from vmc_lib.compiled import compiled
from vmc_lib.where.segmentation import strips

LAB_LOWEST, LAB_RANGE = np.float32([[0, -128, -128], [100, 255, 255]])  # L, a and b


def _hsv(rgb):
    channels = cv2.cvtColor(rgb, cv2.COLOR_RGB2HSV)
    channels[..., 0] /= 360
    return channels


COLOUR_SPACES = {  # float RGB in 0..1 -> channels in about 0..1
    "RGB": lambda rgb: rgb,
    "HSV": _hsv,
    "Lab": lambda rgb: (cv2.cvtColor(rgb, cv2.COLOR_RGB2Lab) - LAB_LOWEST) / LAB_RANGE,
    "rgI": lambda rgb: np.dstack([rgb[..., :2] / (rgb.sum(2, keepdims=True) + 1e-6), rgb.mean(2)]),
    "H": lambda rgb: COLOUR_SPACES["HSV"](rgb)[..., :1],
    "I": lambda rgb: rgb.mean(2, keepdims=True),
}
MEASURES = "colour", "texture", "size", "fill"  # of how alike two regions are
COLOUR_BINS, SLOPE_BINS = 25, 10  # of a channel; of a channel along one way of a line
REACH = 5  # pixels that a pixel's slope depends on, each way: four to smooth, one to see it rise


@dataclass
class Appearance:
    """What selective search knows of each region: rows for segments, then for merged regions."""

    size: np.ndarray  # (n,) pixels
    boxes: np.ndarray  # (n, 4)
    colour: np.ndarray  # (n, 25 c) histogram of each channel, sums to 1
    texture: np.ndarray  # (n, 80 c) histogram of each channel's slopes, sums to 1
    pixels: int  # in the whole image

    @property
    def rows(self):
        """All that is known of the regions, as the compiled loops take it."""
        return self.size, self.boxes, self.colour, self.texture

    def merge(self, i, j, new):
        """Write into row `new` the union of regions i and j, from their rows alone."""
        union(*self.rows, i, j, new)

    def likeness(self, pairs, counts):
        """How alike pairs (m, 2) of regions are, (m,): the sum of those MEASURES that count.

        Each is 1 at most, and the more, the more alike. `counts`: a truth value for each measure.
        """
        return likeness(*self.rows, self.pixels, pairs, counts)


@compiled
def union(size, boxes, colour, texture, i, j, new):
    """What `Appearance.merge` does, for a compiled loop to call."""
    size[new] = size[i] + size[j]
    for low, high in ((0, 2), (1, 3)):
        boxes[new, low] = min(boxes[i, low], boxes[j, low])
        boxes[new, high] = max(boxes[i, high], boxes[j, high])
    for histogram in (colour, texture):
        for x in range(histogram.shape[1]):
            both = size[i] * histogram[i, x] + size[j] * histogram[j, x]
            histogram[new, x] = both / size[new]


@compiled
def likeness(size, boxes, colour, texture, pixels, pairs, counts):
    """What `Appearance.likeness` returns, for a compiled loop to call."""
    by_colour, by_texture, by_size, by_fill = counts
    total = np.zeros(len(pairs))
    for n, (i, j) in enumerate(pairs):
        both = size[i] + size[j]
        if by_colour:  # how much of their histograms the two share: 1 when equal, 0 when nothing
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


def colour_codes(channels):
    """For each channel, which of 25 bins each pixel's value falls into.

    Returns the codes (c, pixels), and how many there are.
    """
    height, width, depth = channels.shape
    codes = np.empty((depth, height, width), np.uint8)
    for top, bottom in strips(height, width):
        bins = np.clip(channels[top:bottom] * COLOUR_BINS, 0, COLOUR_BINS - 1)
        codes[:, top:bottom] = np.moveaxis(bins, 2, 0)
    return codes.reshape(depth, -1), COLOUR_BINS


def texture_codes(channels):
    """For each channel and four lines through a pixel, how steeply it rises, and which way.

    Returns the codes (4c rows of pixels), and how many there are: ten of slopes up one way of
    the line, then as many up the other.
    """
    height, width, depth = channels.shape
    lines = np.arange(4) * np.pi / 4
    codes = np.empty((depth * len(lines), height, width), np.uint8)
    for top, bottom in strips(height, width):
        first = max(top - REACH, 0)
        inside = slice(top - first, bottom - first)
        seen = np.moveaxis(channels[first : bottom + REACH], 2, 0)
        smooth = [cv2.GaussianBlur(channel, (0, 0), 1) for channel in seen]
        slopes = [cv2.Sobel(x, -1, *way)[inside] for x in smooth for way in ((1, 0), (0, 1))]
        codes[:, top:bottom] = _rises(np.array(slopes), lines, SLOPE_BINS)
    return codes.reshape(len(codes), -1), 2 * SLOPE_BINS


@compiled
def _rises(slopes, angles, bins):
    """Codes of the slopes (2c, height, width), right and down, along a line at each angle."""
    channels, lines, (height, width) = len(slopes) // 2, len(angles), slopes.shape[1:]
    codes = np.empty((channels * lines, height, width), np.uint8)
    for c in range(channels):
        for line in range(lines):
            across, down = np.cos(angles[line]), np.sin(angles[line])
            for y in range(height):
                for x in range(width):
                    slope = across * slopes[2 * c, y, x] + down * slopes[2 * c + 1, y, x]
                    code = min(bins * abs(slope), bins - 1)
                    codes[c * lines + line, y, x] = int(code) + bins * (slope < 0)
    return codes


@compiled
def _count(labels, codes, regions, bins):
    counts = np.zeros((regions, len(codes), bins), np.int32)
    for row in range(len(codes)):
        for pixel in range(len(labels)):
            counts[labels[pixel], row, codes[row, pixel]] += 1
    return counts


def histograms(counts):
    """Counts (regions, ...) as shares of all of a region's: (regions, bins), float32."""
    counts = counts.reshape(len(counts), -1).astype(np.float32)
    return counts / counts.sum(1, keepdims=True)


def describe(labels, colours, textures):
    """The Appearance of a segmentation, with room for every merge: 2n - 1 rows for n segments."""
    places = find_objects(labels + 1)
    colour, texture = (
        _count(labels.ravel(), codes, len(places), bins) for codes, bins in (colours, textures)
    )
    texture = texture.reshape(len(places), -1, 2, textures[1] // 2)
    texture[..., 0] += texture.sum(3)[..., ::-1]  # what rises one way does not rise the other
    rows = {
        "size": np.bincount(labels.ravel()),
        "boxes": np.array([(x.start, y.start, x.stop, y.stop) for y, x in places], float),
        "colour": histograms(colour),
        "texture": histograms(texture),
    }
    room = {name: np.concatenate([row, np.zeros_like(row[1:])]) for name, row in rows.items()}
    return Appearance(**room, pixels=labels.size)
