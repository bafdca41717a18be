"""Is it a shuttlecock? A linear classifier on what the CDBN sees, with a calibrated probability."""

from dataclasses import dataclass

import numpy as np
import torch
from scipy.special import expit
from torch.nn import functional as F

from vmc_lib import photos
from vmc_lib.data import arrays
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import whiten

READ_OUTS = "MP2", "P2", "P1 + P2"
ALL_LEVELS = "everywhere"  # all levels together: for a photo of none of them


def read_outs(cdbn, crops):
    """Features (n, d) of grey crops (n, 200, 200), by the name of the read-out.

    "MP2" is the paper's, the mean map of Eq. 2: where is anything? "P2" keeps the ten maps apart,
    and of each only its means in the four quarters of the crop: how much of what? "P1 + P2" adds
    the first layer's, in sixteen parts.
    """

    def means(maps, parts):
        return F.avg_pool2d(maps, maps.shape[-1] // parts).flatten(1)

    seen = {name: [] for name in READ_OUTS}
    for layers in (cdbn.layers(part) for part in whiten(crops).split(20)):
        seen["MP2"].append(layers["MP2"].flatten(1))
        seen["P2"].append(means(layers["P2"], 2))
        p1 = 3 * means(layers["P1"], 4)  # its units are on more rarely: weighed up
        seen["P1 + P2"].append(torch.cat([p1, seen["P2"][-1]], 1))
    return {name: torch.cat(parts).numpy() for name, parts in seen.items()}


# ---------------------------------------------------------------- the classifier


@dataclass(frozen=True, eq=False)
class NameClassifier:
    """The probability of being a shuttlecock, from features: a weight each, (d,), and a bias."""

    weights: np.ndarray
    bias: float

    def probability(self, x):
        """For features (n, d): (n,)."""
        return expit(x @ self.weights + self.bias)


# ---------------------------------------------------------------- the recogniser


@dataclass(frozen=True, eq=False)
class Recogniser:
    """A CDBN, the name of a read-out, and the classifier on it."""

    cdbn: CDBN
    name: str
    classifier: NameClassifier

    @classmethod
    def load(cls, level=ALL_LEVELS, name="P1 + P2"):
        """The recogniser that has learnt names from the training photos of a level.

        Its CDBN has learnt from those of all levels. Its read-out "MP2" is the paper's, the default
        the best. ValueError for an unknown one.
        """
        for given, known in ((level, (*photos.LEVELS, ALL_LEVELS)), (name, READ_OUTS)):
            if given not in known:
                raise ValueError(f"there is no {given!r}: choose from {', '.join(known)}")
        weights, bias = (arrays("recogniser")[f"{level}/{name}/{part}"] for part in "wb")
        return cls(CDBN.load(), name, NameClassifier(weights, float(bias)))

    def probability(self, crops):
        """The chance (n,) that each grey crop (n, 200, 200) shows a shuttlecock."""
        if len(crops) == 0:
            return np.zeros(0)
        return self.classifier.probability(read_outs(self.cdbn, crops)[self.name])
