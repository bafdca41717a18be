"""HMAX with ten prototypes, drawn again and again: how well it names depends on the draw.

The 250 prototypes that ship, in tens: 25 draws, a classifier each, all on the rig. Only the draw
differs; the photos are the same.
"""

import numpy as np

from reproduce.experiments.recognition import load_probabilities
from reproduce.results import arrays
from reproduce.training.name_classifier import fit_name_classifier, labelled_crops
from vmc_lib import photos
from vmc_lib.what.cdbn import crops_of
from vmc_lib.what.recogniser import NameClassifier

SIZE, DRAWS = 10, 25  # prototypes of a draw, as in the paper; all draws


def draws_of(features):
    """Features (n, prototypes) cut into draws, (draws, n, SIZE)."""
    return np.moveaxis(features.reshape(len(features), -1, SIZE), 1, 0)


def make(folder=photos.FOLDER, draws=DRAWS):
    """What `results/hmax_draws.npz` holds: classifiers, and what each says of the true boxes.

    "w" (draws, SIZE), "b" (draws,); by split, the probabilities (draws, n) of being a shuttlecock.
    """
    from reproduce.peers.hmax import hmax  # here, for torch weighs on who only reads the results

    prototypes = arrays("recognition")["prototypes"][: draws * SIZE]
    crops, y = labelled_crops(photos.load("rig", "train", folder), np.random.default_rng(0))
    exams = {split: crops_of(photos.load("rig", split, folder)) for split in photos.SPLITS}
    found = {split: draws_of(hmax(crops, prototypes)) for split, (crops, _) in exams.items()}
    checked, truth = found["validation"], exams["validation"][1]
    linear = [
        fit_name_classifier(x, y, x_checked, truth)
        for x, x_checked in zip(draws_of(hmax(crops, prototypes)), checked, strict=True)
    ]
    weights = {"w": np.array([c.weights for c in linear]), "b": np.array([c.bias for c in linear])}
    return weights | {
        split: np.array([c.probability(x) for c, x in zip(linear, draws, strict=True)])
        for split, draws in found.items()
    }


def probabilities(shots):
    """What each draw's classifier, as it ships, says of the true boxes in photos, (draws, n)."""
    from reproduce.peers.hmax import hmax  # as `make` does

    kept, (crops, _) = arrays("hmax_draws"), crops_of(shots)
    draws = draws_of(hmax(crops, arrays("recognition")["prototypes"]))
    linear = zip(kept["w"], kept["b"], draws, strict=True)
    return np.array([NameClassifier(w, b).probability(x) for w, b, x in linear])


def called_by_draw(split):
    """Which true boxes of a split each draw calls shuttlecocks, (draws, n).

    The split "fresh" is of the rig's photos that were rendered when all was settled.
    """
    fresh = split == "fresh"
    kept = arrays("fresh_names")["rig/HMAX draws/fresh"] if fresh else arrays("hmax_draws")[split]
    return kept > 0.5


def error_counts(split):
    """How many true boxes of a split each draw names wrong, (draws,)."""
    _, truth = load_probabilities("rig", split)
    return (called_by_draw(split) != truth).sum(axis=1)
