"""Sensitivity of the CDBN to seed and filter width: the whole network, trained anew for each."""

from functools import cache
from itertools import starmap

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.recognition import confusion_counts
from reproduce.results import arrays
from reproduce.training.name_classifier import fit_name_classifier, labelled_crops
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W, PATCHES, crops_of
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import READ_OUTS, read_outs

VARIATIONS = (N_W, 0), (N_W, 1), (N_W, 2), (6, 0), (10, 0), (12, 0)  # (n_w, seed)
SPLITS = "validation", "test"


def load_results():
    """Results by VARIATION: (n_w, seed) -> (filters, counts), as from `train_variation`."""
    kept = arrays("variations")
    return {k: (kept[f"{k}/filters"], kept[f"{k}/counts"]) for k in VARIATIONS}


def accuracy(results):
    """Named right in test photos, all levels together: (n_w, seed) -> read-out -> share."""
    shares = {}
    for variation, (_, counts) in results.items():
        of = counts[:, :, SPLITS.index("test")].sum(0)
        right = (of[:, 0] + of[:, 3]) / of.sum(1)
        shares[variation] = dict(zip(READ_OUTS, right.tolist(), strict=True))
    return shares


def gain_from_width(shares):
    """What the best wider network gains over those of width N_W, and the range of these.

    Of an `accuracy`, by the best read-out: the first of means over seeds, the second over seeds.
    """
    by_width = {}
    for (n_w, _), row in shares.items():
        by_width.setdefault(n_w, []).append(list(row.values()))
    best = {n_w: np.mean(rows, axis=0).max() for n_w, rows in by_width.items()}
    wider = max(share for n_w, share in best.items() if n_w > N_W)
    return wider - best[N_W], np.ptp(np.max(by_width[N_W], axis=1))


def make(variations=VARIATIONS, folder=photos.FOLDER, patches=PATCHES):
    """What `results/variations.npz` holds: the arrays that `load_results` reads."""
    trained = train_variations(variations, folder, folder, patches)
    parts = {k: zip(("filters", "counts"), learnt, strict=True) for k, learnt in trained.items()}
    return {f"{variation}/{name}": part for variation in parts for name, part in parts[variation]}


def train_variations(variations, folder, exam, patches=PATCHES):
    """`train_variation` each of the variations: variation -> (filters, counts)."""
    found = Parallel()(delayed(train_variation)(each, folder, exam, patches) for each in variations)
    return dict(zip(variations, found, strict=True))


def train_variation(variation, folder, exam, patches=PATCHES):
    """For (n_w, seed), the first layer's filters (10, n_w, n_w), and how well the network names.

    That is, `confusion_counts` (levels, read-outs, SPLITS, 4). It learns from photos in `folder`,
    so many patches of them; the test photos are those in the folder `exam`.
    """
    from reproduce.training.cdbn import train_cdbn  # with torch, slow to load

    n_w, seed = variation
    crops, positive = crops_of(photos.load_levels("train", folder))
    cdbn = CDBN.from_arrays(train_cdbn(whiten(crops), positive, seed, n_w, patches).arrays())
    counts = np.zeros((len(photos.LEVELS), len(READ_OUTS), len(SPLITS), 4), int)
    for i, level in enumerate(photos.LEVELS):
        for j, answers in enumerate(answer_crops(cdbn, level, folder, exam).values()):
            counts[i, j] = list(starmap(confusion_counts, answers))
    return cdbn.first.W[:, 0], counts


def answer_crops(network, level, folder, exam, names=READ_OUTS):
    """Answers by a network's read-outs: name -> (probabilities, truth), (n,), on each of SPLITS.

    The classifiers learn from training photos of a level in `folder`, their cost is chosen on those
    of validation; the test photos are those in the folder `exam`.
    """
    jittered, y = training_crops(folder)[level]
    x = read_outs(network, jittered)
    exams = photos.load(level, "validation", folder), photos.load(level, "test", exam)
    sets = [(read_outs(network, crops), truth) for crops, truth in map(crops_of, exams)]
    (checked, checked_truth), _ = sets
    answers = {}
    for name in names:
        linear = fit_name_classifier(x[name], y, checked[name], checked_truth)
        answers[name] = [(linear.probability(z[name]), truth) for z, truth in sets]
    return answers


@cache
def training_crops(folder):
    """For each level, the crops (n, 200, 200) to learn names from, and their labels."""
    rng = np.random.default_rng(0)
    return {
        level: labelled_crops(photos.load(level, "train", folder), rng) for level in photos.LEVELS
    }
