"""What the seed and the filters' width change: the whole network trained again and again."""

from functools import cache

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.recognition import tally
from reproduce.results import arrays
from reproduce.training.name_classifier import examples, fit_name_classifier
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W, PATCHES, crops_of
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import READ_OUTS, read_outs

VARIATIONS = (N_W, 0), (N_W, 1), (N_W, 2), (6, 0), (10, 0), (12, 0)  # (n_w, seed)
SPLITS = "validation", "test"


def load():
    """What was found for each of VARIATIONS: (n_w, seed) -> (filters, counts), as from `vary`."""
    kept = arrays("variations")
    return {k: (kept[f"{k}/filters"], kept[f"{k}/counts"]) for k in VARIATIONS}


def make(variations=VARIATIONS, folder=photos.FOLDER, patches=PATCHES):
    """What `results/variations.npz` holds: the arrays that `load` reads."""
    learnt = {}
    for variation, (filters, counts) in vary_all(variations, folder, folder, patches).items():
        learnt |= {f"{variation}/filters": filters, f"{variation}/counts": counts}
    return learnt


def vary_all(variations, folder, exam, patches=PATCHES):
    """`vary` each of the variations: variation -> (filters, counts)."""
    found = Parallel()(delayed(vary)(each, folder, exam, patches) for each in variations)
    return dict(zip(variations, found, strict=True))


def vary(variation, folder, exam, patches=PATCHES):
    """For (n_w, seed), the first layer's filters (10, n_w, n_w), and how well the network names.

    That is, counts (levels, read-outs, SPLITS, 4), as from `tally`. It learns from photos in
    `folder`, so many patches of them; the test photos are those in the folder `exam`.
    """
    from vmc_lib.what.learning import train  # here, for torch weighs on who only reads the results

    n_w, seed = variation
    shots = [shot for level in photos.LEVELS for shot in photos.load(level, "train", folder)]
    crops, positive = crops_of(shots)
    cdbn = CDBN.from_arrays(train(whiten(crops), positive, seed, n_w, patches).arrays())
    counts = np.zeros((len(photos.LEVELS), len(READ_OUTS), len(SPLITS), 4), int)
    for i, (level, (jittered, y)) in enumerate(lessons(folder).items()):
        x = read_outs(cdbn, jittered)
        exams = photos.load(level, "validation", folder), photos.load(level, "test", exam)
        seen = [(read_outs(cdbn, crops), truth) for crops, truth in map(crops_of, exams)]
        (checked, checked_truth), _ = seen
        for j, name in enumerate(READ_OUTS):
            linear = fit_name_classifier(x[name], y, checked[name], checked_truth)
            counts[i, j] = [tally(linear.probability(z[name]), truth) for z, truth in seen]
    return cdbn.first.W[:, 0], counts


@cache
def lessons(folder):
    """For each level, the crops (n, 200, 200) to learn names from, and their labels."""
    rng = np.random.default_rng(0)
    return {level: examples(photos.load(level, "train", folder), rng) for level in photos.LEVELS}
