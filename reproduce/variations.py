"""What the seed and the filters' width change: the whole network trained again and again.

Remake what it finds, `data/variations.npz`, with `python -m reproduce.variations`.
"""

from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial

import numpy as np
import torch

from reproduce.name_examples import examples
from reproduce.recognition import tally
from reproduce.results import FOLDER, arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import N_W, crops_of, train
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import READ_OUTS, fit, read_outs

VARIATIONS = (N_W, 0), (N_W, 1), (N_W, 2), (6, 0), (10, 0), (12, 0)  # (n_w, seed)
SPLITS = "validation", "test"


def load():
    """What was found for each of VARIATIONS: (n_w, seed) -> (filters, counts), as from `vary`."""
    kept = arrays("variations")
    return {k: (kept[f"{k}/filters"], kept[f"{k}/counts"]) for k in VARIATIONS}


@cache
def lessons():
    """For each level, the crops (n, 200, 200) to learn names from, and their labels."""
    rng = np.random.default_rng(0)
    return {level: examples(photos.load(level, "train"), rng) for level in photos.LEVELS}


def vary(variation, folder=photos.FOLDER):
    """For (n_w, seed), the first layer's filters (10, n_w, n_w), and how well the network names.

    That is, counts (levels, read-outs, SPLITS, 4), as from `tally`. The test photos are those in
    `folder`.
    """
    n_w, seed = variation
    shots = [shot for level in photos.LEVELS for shot in photos.load(level, "train")]
    crops, positive = crops_of(shots)
    cdbn = train(whiten(crops), positive, seed, n_w)
    counts = np.zeros((len(photos.LEVELS), len(READ_OUTS), len(SPLITS), 4), int)
    for i, (level, (jittered, y)) in enumerate(lessons().items()):
        x = read_outs(cdbn, jittered)
        exams = photos.load(level, "validation"), photos.load(level, "test", folder)
        seen = [(read_outs(cdbn, crops), truth) for crops, truth in map(crops_of, exams)]
        (checked, checked_truth), _ = seen
        for j, name in enumerate(READ_OUTS):
            linear = fit(x[name], y, checked[name], checked_truth)
            counts[i, j] = [tally(linear.probability(z[name]), truth) for z, truth in seen]
    print(f"filters of width {n_w}, seed {seed}: done")
    return cdbn.first.W[:, 0].numpy(), counts


def vary_all(variations, folder=photos.FOLDER):
    """`vary` each of the variations, on a core each: variation -> (filters, counts)."""
    with ProcessPoolExecutor(2, initializer=torch.set_num_threads, initargs=(1,)) as pool:
        found = pool.map(partial(vary, folder=folder), variations)
        return dict(zip(variations, found, strict=True))


if __name__ == "__main__":
    learnt = {}
    for variation, (filters, counts) in vary_all(VARIATIONS).items():
        learnt |= {f"{variation}/filters": filters, f"{variation}/counts": counts}
    np.savez_compressed(FOLDER / "variations.npz", **learnt)
