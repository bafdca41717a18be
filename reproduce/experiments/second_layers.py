"""Is the second layer the shuttlecock's own? Second layers taught by shuttlecocks, and by cups.

All learn on the first layer that ships, from as many patches of as many crops, those of every
fourth training photo. A shuttlecock has more edges than a cup, so every second layer answers more
to it, a random one and the first layer too: what counts is the difference that the lesson makes.
"""

from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W, crops_of
from vmc_lib.what.crops import whiten

SEEDS, PATCHES, EVERY = range(6), 5000, 4


def preference(answers, shuttlecock):
    """The mean answer to the shuttlecock over that to the cup of each photo, (photos,).

    Of maps (n, …) of crops, and which of these are shuttlecocks (n,), one of each in a photo.
    """
    means = np.asarray(answers).reshape(len(answers), -1).mean(axis=1)
    return means[shuttlecock] / means[~shuttlecock]


def preferences(seed, folder=photos.FOLDER, patches=PATCHES, every=EVERY):
    """Mean `preference` on the rig's validation photos of P² taught by either thing, (2,)."""
    from reproduce.training.cdbn import SECOND, train_crbm  # with torch, slow to load
    from vmc_lib.what.learning import Learner

    network = CDBN.load(Learner)
    p1, taught = first_maps(network, photos.load_levels("train", folder, every))
    exam, shuttlecock = first_maps(network, photos.load("rig", "validation", folder))
    found = []
    for who in (taught, ~taught):
        second = train_crbm(p1[who], seed, N_W, patches, **SECOND)
        found.append(preference(second.posterior(second.trim(exam))[1], shuttlecock).mean())
    return np.array(found)


def first_maps(network, shots):
    """The second layer's input for the true boxes in photos, and which are shuttlecocks (n,)."""
    crops, shuttlecock = crops_of(shots)
    pooled = np.concatenate([network.first.pooled(_trimmed(network, crop)) for crop in crops])
    return network.first.xp.asarray((pooled - network.mean) / network.spread), shuttlecock


def _trimmed(network, crop):
    return network.first.trim(network.first.xp.asarray(whiten(crop[None])))


def make(folder=photos.FOLDER, seeds=SEEDS, **size):
    """What `results/second_layers.npz` holds: `preferences` for each seed, (seeds, 2)."""
    found = Parallel()(delayed(preferences)(seed, folder=folder, **size) for seed in seeds)
    return {"preferences": np.array(found)}


load_results = partial(arrays, "second_layers")
