"""A deeper ventral stream: four stages of small filters, learnt end to end, for photographs.

The paper's hierarchy has two stages, with filters eight pixels wide. Here every unit sees 3 × 3
places of the stage before; of 2 × 2 neighbours only the strongest goes on (max pooling), and it is
silent below its threshold (rectification). So a unit of the last stage sees 46 pixels. Its
read-out answers two questions about a box: is it a shuttlecock, and where are its true edges?
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import expit

from vmc_lib.boxes import as_boxes, corrected, widened
from vmc_lib.data import arrays
from vmc_lib.photos import crops
from vmc_lib.what.crbm import laid_on

STAGES = "V1", "V2", "V4", "IT"  # what stands there in the brain
WIDTH, MARGIN = 48, 0.25  # of a crop, in pixels; what it shows around the box, in sides
# How a crop is read, along x and along y: as it is, in a mirror beside it, below it, and in both
MIRRORS = (1, 1), (-1, 1), (1, -1), (-1, -1)


@dataclass(frozen=True, eq=False)
class VentralStream:
    """Filters (K, channels, 3, 3) and biases (K,) of each stage, and a linear read-out of five."""

    filters: tuple
    biases: tuple
    readout: np.ndarray  # (5, d): log-odds of being a shuttlecock, and four corrections of the box
    offsets: np.ndarray  # (5,)

    def stages(self, x):
        """What each of STAGES makes of what is `shown`, (n, 3, 48, 48): maps (n, K, size, size)."""
        maps = {}
        for name, W, b in zip(STAGES, self.filters, self.biases, strict=False):
            drive = laid_on(x, W, padding=1)
            rows = np.maximum(drive[:, :, ::2], drive[:, :, 1::2])
            strongest = np.maximum(rows[..., ::2], rows[..., 1::2])
            maps[name] = x = (strongest + b[:, None, None]).clip(0)
        return maps

    def look(self, image, boxes, ways=MIRRORS[:1]):
        """Log-odds (n,) that boxes (n, 4) of an image hold a shuttlecock, and how to correct them.

        Each crop is read in all `ways`, such as MIRRORS, and what is told is the mean. The
        corrections (n, 4) are those of `boxes.corrected`.
        """
        if not len(boxes):
            return np.zeros(0), np.zeros((0, 4))
        x, told = shown(image, boxes), 0
        for along, down in ways:
            *_, last = self.stages(x[:, :, ::down, ::along]).values()
            seen = last.reshape(len(last), -1) @ self.readout.T + self.offsets
            told = told + seen * np.array([1, along, down, 1, 1]) / len(ways)
        return told[:, 0], told[:, 1:]

    def chance(self, image, boxes):
        """The chance (n,) that each of the boxes (n, 4) of an image shows a shuttlecock."""
        return expit(self.look(image, boxes)[0])

    def tightened(self, image, boxes):
        """The boxes (n, 4), each corrected by what it shows."""
        return corrected(as_boxes(boxes), self.look(image, boxes)[1])

    def arrays(self):
        """The stream as a dict of arrays, to be saved with `np.savez`."""
        parts = {"readout": self.readout, "offsets": self.offsets}
        for name, W, b in zip(STAGES, self.filters, self.biases, strict=True):
            parts |= {f"{name}/W": W, f"{name}/b": b}
        return parts

    @classmethod
    def load(cls):
        """The stream that ships with the book."""
        learnt = {k: np.float32(part) for k, part in arrays("photographs").items()}
        W, b = (tuple(learnt[f"{name}/{part}"] for name in STAGES) for part in "Wb")
        return cls(W, b, learnt["readout"], learnt["offsets"])


def shown(image, boxes):
    """What a stream is given of boxes (n, 4) of a uint8 image: (n, 3, WIDTH, WIDTH), float32.

    Each in colour with a margin around it, less its mean and over its standard deviation, as an eye
    adapts to the light.
    """
    return adapted(np.moveaxis(crops(image, widened(boxes, MARGIN), WIDTH), 3, 1))


def adapted(x):
    """Crops (n, 3, height, width) less their mean and over their standard deviation."""
    x = x - x.mean((1, 2, 3), keepdims=True)
    return x / (x.std((1, 2, 3), keepdims=True) + 0.01)
