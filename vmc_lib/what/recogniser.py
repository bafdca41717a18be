"""Recogniser: logistic regression on CDBN features, is it a shuttlecock?"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import as_boxes
from vmc_lib.data import arrays
from vmc_lib.short_repr import short, short_repr
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import WIDTH, crop, has_contrast, whiten

READ_OUTS = "MP2", "P2", "P1 + P2"
POOLED_LEVEL = "everywhere"  # all rendered levels together: for a photo of none of them


def readout_features(cdbn: CDBN, v: np.ndarray) -> dict[str, np.ndarray]:
    """Read-out features (n, d) of whitened crops v (n, 1, 200, 200), by the name of the read-out.

    "MP2" is the paper's, the mean map of Eq. 2: where is anything? "P2" keeps the ten maps apart,
    and of each only its means in the four quarters of the crop: how much of what? "P1 + P2" adds
    the first layer's, in sixteen parts.
    """

    def means(maps, parts):
        n, K, width, _ = maps.shape
        part, whole = width // parts, width // parts * parts
        squares = maps[..., :whole, :whole].reshape(n, K, parts, part, parts, part)
        return squares.mean(5).mean(3).reshape(n, -1)

    p1, p2 = cdbn.pooled(v)
    few = 3 * means(p1, 4), means(p2, 2)  # those of P1 are on more rarely
    both = cdbn.first.xp.concatenate(few, 1)
    return {"MP2": p2.mean(1).reshape(len(v), -1), "P2": few[1], "P1 + P2": both}


def read_outs(cdbn: CDBN, crops: np.ndarray) -> dict[str, np.ndarray]:
    """The `readout_features` (n, d) of grey crops (n, 200, 200), by the name of the read-out."""
    one_by_one = (whiten(crop[None]) for crop in crops)  # less memory
    parts = [readout_features(cdbn, v) for v in one_by_one]
    return {name: np.concatenate([part[name] for part in parts]) for name in READ_OUTS}


def logistic(log_odds: float | np.ndarray) -> np.ndarray:
    """The logistic function: the probability that has such log-odds; nothing overflows."""
    return np.exp(-np.logaddexp(0, -log_odds))


def check_detections(detections: object) -> None:
    """Raise ValueError where what should be `Detections` has no boxes."""
    if not hasattr(detections, "boxes"):
        raise ValueError(f"detections {short(detections)}: give what detect(image) returns")


@dataclass(frozen=True, eq=False)
class NameClassifier:
    """Logistic regression: the probability of being a shuttlecock, from weights (d,) and a bias."""

    weights: np.ndarray
    bias: float

    @classmethod
    def load(cls, file: str, key: str) -> Self:
        """The one stored in a data file under `key`/w and `key`/b."""
        return cls.from_arrays(arrays(file), key)

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, np.ndarray], key: str) -> Self:
        """The one in a dict of arrays under `key`/w and `key`/b."""
        return cls(arrays[f"{key}/w"], float(arrays[f"{key}/b"]))

    def arrays(self, key: str) -> dict[str, Any]:
        """The classifier as a dict of arrays, to be saved with `np.savez`."""
        return {f"{key}/w": np.float32(self.weights), f"{key}/b": self.bias}

    def log_odds(self, x: np.ndarray) -> np.ndarray:
        """The log-odds (n,) for features (n, d)."""
        if np.shape(x)[-1:] != self.weights.shape:
            raise ValueError(f"features {np.shape(x)}: give rows of {len(self.weights)}")
        return x @ self.weights + self.bias

    def probability(self, x: np.ndarray) -> np.ndarray:
        """The probability (n,) for features (n, d)."""
        return logistic(self.log_odds(x))


@dataclass(frozen=True, eq=False)
class Recogniser:
    """A CDBN, the name of a read-out, and the classifier on it."""

    cdbn: CDBN
    name: str
    classifier: NameClassifier
    min_probability = 0.5  # above which a box is chosen

    __repr__ = short_repr

    @classmethod
    def load(cls, level: str = POOLED_LEVEL, name: str = "P1 + P2") -> Self:
        """The recogniser that has learnt names from the training photos of a level.

        Its CDBN has learnt from those of all levels. Its read-out "MP2" is the paper's, the default
        the best. ValueError for an unknown one; for photographs there is a `VentralStream`.
        """
        for given, known in ((level, (*photos.LEVELS, POOLED_LEVEL)), (name, READ_OUTS)):
            if given not in known:
                raise ValueError(f"there is no {given!r}: choose from {', '.join(known)}")
        return cls(CDBN.load(), name, NameClassifier.load("recogniser", f"{level}/{name}"))

    def probability(self, crops: np.ndarray) -> np.ndarray:
        """Probability (n,) that each grey crop (n, 200, 200) shows a shuttlecock.

        ValueError for crops of another size.
        """
        if np.ndim(crops) and len(crops) == 0:
            return np.zeros(0)
        if np.shape(crops)[1:] != (WIDTH, WIDTH):
            raise ValueError(
                f"crops of shape {np.shape(crops)}: give grey ones (n, {WIDTH}, {WIDTH}), as "
                "`crop(image, box)` returns them"
            )
        return self.classifier.probability(read_outs(self.cdbn, crops)[self.name])

    def box_probability(self, image: np.ndarray, boxes: np.ndarray) -> np.ndarray:
        """Probability (n,) that each of the boxes (n, 4) of an image shows a shuttlecock.

        It is 0 where a box shows nothing: a grey without any contrast, as of white paper.
        """
        crops = np.reshape([crop(image, box) for box in as_boxes(boxes)], (-1, WIDTH, WIDTH))
        probability, shows = np.zeros(len(crops)), has_contrast(crops)
        probability[shows] = self.probability(crops[shows])
        return probability

    def select(self, image: np.ndarray, detections: Any) -> tuple[Any, np.ndarray]:
        """The `Detections` as they are, and the probabilities (n,) of their boxes."""
        check_detections(detections)
        return detections, self.box_probability(image, detections.boxes)
