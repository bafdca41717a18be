"""Convolutional network of four stages, trained end to end on photographs: a deeper ventral stream.

The paper's hierarchy has two stages, with filters eight pixels wide. Here every unit sees 3 × 3
places of the stage before; of 2 × 2 neighbours only the strongest goes on (max pooling), and it is
silent below its threshold (rectification). So a unit of the last stage sees 46 pixels. Its
read-out answers two questions about a box: is it a shuttlecock, and where are its true edges?
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from vmc_lib.boxes import as_boxes, decode_deltas, nms, pad_boxes
from vmc_lib.checks import check_count
from vmc_lib.data import arrays
from vmc_lib.photos import crops
from vmc_lib.short_repr import short, short_repr
from vmc_lib.what.crbm import correlate_valid
from vmc_lib.what.recogniser import check_detections, logistic

STAGES = "V1", "V2", "V4", "IT"  # what stands there in the brain
WIDTH, MARGIN = 48, 0.25  # of a crop, in pixels; what it shows around the box, in sides
BATCH = 64  # crops at a time: more leave the processor's cache
# Test-time augmentation, along x and along y: as it is, flipped left-right, up-down, and both
FLIPS = (1, 1), (-1, 1), (1, -1), (-1, -1)
# How it chooses among boxes, set on validation photos (reproduce.experiments.eye_ablation)
ALIKE = 0.7  # IoU above which two boxes show the same: the likelier alone is looked at again
N_REFINED = 4  # boxes, the likeliest, that it refines and looks at again, in all FLIPS
N_LOOKS = 3  # at all boxes, and at these, each time refined (iterative box regression)
MIN_PROBABILITY = 1 / 3  # above which one is chosen: a miss counts twice as much as a false alarm


@dataclass(frozen=True, eq=False)
class VentralStream:
    """Filters (K, channels, 3, 3) and biases (K,) of each stage, and a linear read-out of five."""

    filters: tuple
    biases: tuple
    readout: np.ndarray  # (5, d): log-odds of being a shuttlecock, and four deltas of the box
    offsets: np.ndarray  # (5,)
    sigmoid: Any = (1.0, 0.0)  # slope and offset of the chosen boxes' log-odds (Platt 1999)
    min_probability = MIN_PROBABILITY

    __repr__ = short_repr

    def stages(self, x: np.ndarray) -> dict[str, np.ndarray]:
        """Activation maps (n, K, size, size) of each of STAGES, for inputs x (n, 3, 48, 48)."""
        maps = {}
        for name, W, b in zip(STAGES, self.filters, self.biases, strict=False):
            z = correlate_valid(x, W, padding=1)
            rows = np.maximum(z[:, :, ::2], z[:, :, 1::2])
            strongest = np.maximum(rows[..., ::2], rows[..., 1::2])
            maps[name] = x = (strongest + b[:, None, None]).clip(0)
        return maps

    def predict(
        self, image: np.ndarray, boxes: np.ndarray, flips: Sequence[Any] = FLIPS[:1]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Log-odds and box deltas, averaged over flips (test-time augmentation).

        Parameters
        ----------
        image : (height, width, 3) uint8 array
        boxes : (n, 4) array of (x0, y0, x1, y1), pixels
        flips : which of FLIPS each crop is read in

        Returns
        -------
        log_odds : (n,), that a box holds a shuttlecock
        deltas : (n, 4), from each box to the shuttlecock's, as `boxes.decode_deltas` takes them

        Raises
        ------
        ValueError
            For no flips, and for any that is none of FLIPS.
        """
        if np.ndim(flips) != 2 or any(tuple(flip) not in FLIPS for flip in flips):
            raise ValueError(f"flips {short(flips)}: give one or more of {FLIPS}")
        if not len(boxes := as_boxes(boxes)):
            return np.zeros(0), np.zeros((0, 4))
        if len(boxes) > BATCH:
            parts = [boxes[at : at + BATCH] for at in range(0, len(boxes), BATCH)]
            outputs = zip(*(self.predict(image, part, flips) for part in parts), strict=True)
            log_odds, deltas = map(np.concatenate, outputs)
            return log_odds, deltas
        x, mean = preprocess(image, boxes), np.zeros(5)
        for along, down in flips:
            *_, last = self.stages(x[:, :, ::down, ::along]).values()
            outputs = last.reshape(len(last), -1) @ self.readout.T + self.offsets
            mean = mean + outputs * np.array([1, along, down, 1, 1]) / len(flips)
        return mean[:, 0], mean[:, 1:]

    def box_probability(self, image: np.ndarray, boxes: np.ndarray) -> np.ndarray:
        """Probability (n,) that each of the boxes (n, 4) of an image shows a shuttlecock."""
        return logistic(self.predict(image, boxes)[0])

    def refine_boxes(self, image: np.ndarray, boxes: np.ndarray) -> np.ndarray:
        """The boxes (n, 4), moved and stretched to what they show (box refinement)."""
        return decode_deltas(as_boxes(boxes), self.predict(image, boxes)[1])

    def select(
        self,
        image: np.ndarray,
        detections: Any,
        alike: float = ALIKE,
        refined: int = N_REFINED,
        looks: int = N_LOOKS,
        flips: Sequence[Any] = FLIPS,
    ) -> tuple[Any, np.ndarray]:
        """Choose among an image's `Detections`: look, refine the likeliest, look again, refine.

        It looks at all, then at the `refined` likeliest of which no two overlap by more than
        `alike`, in all `flips`, `looks` times in all; non-maximum suppression keeps the likeliest
        of those that overlap. Returns their `Detections`, the likeliest first, scored by their
        log-odds, and their probabilities (n,), both calibrated by `sigmoid`: of the likeliest of
        many boxes fewer are right than of boxes as they come.
        """
        check_detections(detections)
        check_count("refined", refined)
        check_count("looks", looks, 1)
        log_odds, deltas = self.predict(image, detections.boxes)
        boxes = decode_deltas(detections.boxes, deltas)
        best = nms(boxes, log_odds, alike)[:refined]
        boxes, log_odds = boxes[best], log_odds[best]
        for _ in range(1, looks):
            log_odds, deltas = self.predict(image, boxes, flips)
            boxes = decode_deltas(boxes, deltas)
        log_odds = np.polyval(self.sigmoid, log_odds)
        kept = nms(boxes, log_odds)
        chosen = replace(detections, boxes=boxes[kept], scores=log_odds[kept])
        return chosen, logistic(chosen.scores)

    def arrays(self) -> dict[str, np.ndarray]:
        """The stream as a dict of arrays, to be saved with `np.savez`."""
        parts = {name: np.array(getattr(self, name)) for name in ("readout", "offsets", "sigmoid")}
        for name, W, b in zip(STAGES, self.filters, self.biases, strict=True):
            parts |= {f"{name}/W": W, f"{name}/b": b}
        return parts

    @classmethod
    def load(cls) -> Self:
        """The stream that ships with the book."""
        learnt = {k: part.astype(np.float32) for k, part in arrays("photographs").items()}
        W, b = (tuple(learnt[f"{name}/{part}"] for name in STAGES) for part in "Wb")
        return cls(W, b, learnt["readout"], learnt["offsets"], learnt["sigmoid"])


def preprocess(image: np.ndarray, boxes: np.ndarray) -> np.ndarray:
    """Crops of boxes in colour, standardised one by one: the network's input.

    boxes: (n, 4) of a uint8 image; each is cut out with a MARGIN. Returns (n, 3, WIDTH, WIDTH)
    float32.
    """
    return standardise(np.moveaxis(crops(image, pad_boxes(boxes, MARGIN), WIDTH), 3, 1))


def standardise(x: np.ndarray) -> np.ndarray:
    """Standardise crops (n, 3, height, width): each less its mean, over its standard deviation.

    So does an eye adapt to the light.
    """
    x = x - x.mean((1, 2, 3), keepdims=True)
    return x / (x.std((1, 2, 3), keepdims=True) + 0.01)
