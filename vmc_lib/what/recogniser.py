"""Is it a shuttlecock? A linear classifier on what the CDBN sees, with a calibrated probability.

Remake the weights that ship, `data/recogniser.npz`, with `python -m vmc_lib.what.recogniser`.
"""

from dataclasses import dataclass

import numpy as np
import torch
from scipy.special import expit
from sklearn.calibration import CalibratedClassifierCV
from sklearn.frozen import FrozenEstimator
from sklearn.linear_model import LogisticRegression
from torch.nn import functional as F

from vmc_lib import photos
from vmc_lib.data import FOLDER, arrays
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import crop, whiten
from vmc_lib.where.boxes import iou, shaken

STRENGTHS = 10.0 ** np.arange(-1, 5)
COPIES, SHAKE = 4, 0.08  # training boxes: copies of each, and how far their sides stray

BARE = 6  # training crops of the bare scene a photo

READ_OUTS = "MP2", "P2", "P1 + P2"
EVERYWHERE = "everywhere"  # all levels together: for a photo of none of them


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


@dataclass(frozen=True)
class Linear:
    """The probability of being a shuttlecock, from features: a weight each, (d,), and a bias."""

    weights: np.ndarray
    bias: float

    def probability(self, x):
        """For features (n, d): (n,)."""
        return expit(x @ self.weights + self.bias)


def fit(x, y, x_validation, y_validation):
    """A Linear classifier of features x (n, d) with labels y (n,), True for a shuttlecock.

    Logistic regression; of the STRENGTHS (inverse of the regularisation) the one with the best
    likelihood on the validation set is kept, and its probabilities are calibrated there with
    Platt's sigmoid (1999). ValueError for an empty set, NaN, or labels of one class only.
    """
    for use, features, labels in (("train", x, y), ("validate", x_validation, y_validation)):
        if len(features) == 0 or len(np.unique(labels)) < 2 or not np.isfinite(features).all():
            raise ValueError(f"to {use}, give finite features of both classes")
    centre = x.mean(0)
    size = np.sqrt(np.square(x - centre).sum(1).mean())
    x, x_validation = (x - centre) / size, (x_validation - centre) / size

    def calibrated(strength):
        model = LogisticRegression(C=strength, max_iter=2000).fit(x, y)
        sigmoid = CalibratedClassifierCV(FrozenEstimator(model), method="sigmoid")
        sigmoid.fit(x_validation, y_validation)
        platt = sigmoid.calibrated_classifiers_[0].calibrators[0]
        weights = -platt.a_ * model.coef_[0] / size
        bias = -platt.a_ * model.intercept_[0] - platt.b_ - weights @ centre
        return Linear(weights, float(bias))

    def likelihood(linear):
        logit = (x_validation * size + centre) @ linear.weights + linear.bias
        return -np.logaddexp(0, np.where(y_validation, -logit, logit)).sum()

    return max(map(calibrated, STRENGTHS), key=likelihood)


# ---------------------------------------------------------------- crops to learn from


def elsewhere(shot, rng):
    """A box of a likely size that overlaps with no object (IoU below 0.3)."""
    objects = np.array(list(shot.boxes.values()))
    while True:
        width, height = rng.uniform(50, 180, 2)
        x, y = rng.uniform(0, photos.WIDTH - width), rng.uniform(0, photos.HEIGHT - height)
        if (iou([(x, y, x + width, y + height)], objects) < 0.3).all():
            return np.array([x, y, x + width, y + height])


def examples(shots, rng, copies=COPIES, background=0):
    """Crops (n, 200, 200) and labels (n,) from photos: each object `copies` times, shaken and
    half of them mirrored; and so many crops of `background` a photo."""
    crops, labels = [], []
    for shot in shots:
        boxes = [(box, name == "shuttlecock") for name, box in shot.boxes.items()] * copies
        boxes = [(shaken(box, SHAKE, rng), label) for box, label in boxes]
        boxes += [(elsewhere(shot, rng), False) for _ in range(background)]
        for box, label in boxes:
            picture = crop(shot.image, box)
            crops.append(picture[:, ::-1] if rng.random() < 0.5 else picture)
            labels.append(label)
    return np.array(crops), np.array(labels)


# ---------------------------------------------------------------- the recogniser


@dataclass(frozen=True)
class Recogniser:
    """A CDBN, the name of a read-out, and the classifier on it."""

    cdbn: CDBN
    name: str
    linear: Linear

    @classmethod
    def load(cls, level=EVERYWHERE, name="P1 + P2"):
        """The recogniser that has learnt names from the training photos of a level.

        Its read-out "MP2" is the paper's, the default the best. ValueError for an unknown one.
        """
        for given, known in ((level, (*photos.LEVELS, EVERYWHERE)), (name, READ_OUTS)):
            if given not in known:
                raise ValueError(f"there is no {given!r}: choose from {', '.join(known)}")
        weights, bias = (arrays("recogniser")[f"{level}/{name}/{part}"] for part in "wb")
        return cls(CDBN.load(), name, Linear(weights, float(bias)))

    def probability(self, crops):
        """The chance (n,) that each grey crop (n, 200, 200) shows a shuttlecock."""
        if len(crops) == 0:
            return np.zeros(0)
        return self.linear.probability(read_outs(self.cdbn, crops)[self.name])


def lesson(level, split, rng, cdbn):
    """The read-outs of a level's `examples`, bare scene among them, and their labels."""
    crops, labels = examples(photos.load(level, split), rng, background=BARE)
    return read_outs(cdbn, crops), labels


def together(lessons):
    """Several lessons as one."""
    found, labels = zip(*lessons, strict=True)
    return {name: np.concatenate([x[name] for x in found]) for name in READ_OUTS}, np.hstack(labels)


if __name__ == "__main__":
    rng, cdbn, linear = np.random.default_rng(0), CDBN.load(), {}
    lessons = {
        level: [lesson(level, split, rng, cdbn) for split in ("train", "validation")]
        for level in photos.LEVELS
    }
    lessons[EVERYWHERE] = [together(split) for split in zip(*lessons.values(), strict=True)]
    for level, ((x, y), (x_validation, y_validation)) in lessons.items():
        for name in READ_OUTS:
            found = fit(x[name], y, x_validation[name], y_validation)
            right = (found.probability(x_validation[name]) > 0.5) == y_validation
            print(f"{level}, {name}: {right.mean():.4f} of {len(right)} validation crops right")
            linear[f"{level}/{name}/w"] = np.float32(found.weights)
            linear[f"{level}/{name}/b"] = found.bias
    np.savez_compressed(FOLDER / "recogniser.npz", **linear)
