"""Is the second layer the shuttlecock's own? Second layers taught by shuttlecocks, and by cups.

All learn on the first layer that ships, from as many patches of as many crops, those of every
fourth training photo. Almost any filters answer more to a shuttlecock, which has more edges than a
cup: so two more layers are asked, which did not learn how a shuttlecock looks.
"""

from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W, crops_of
from vmc_lib.what.crops import WIDTH, whiten

SEEDS, PATCHES, EVERY = range(6), 5000, 4
KINDS = ("taught by shuttlecocks", "taught by cups", "mirrored", "noise")


def preference(answers, rest, shuttlecock):
    """The mean evoked response to the shuttlecock over that to the cup of each photo, (photos,).

    Of maps (n, …) of crops, and which of these are shuttlecocks (n,), one of each in a photo. An
    evoked response is what is above `rest`, the maps of an empty picture.
    """
    evoked = np.asarray(answers).reshape(len(answers), -1).mean(axis=1) - float(rest.mean())
    return evoked[shuttlecock] / evoked[~shuttlecock]


def preferences(seed, folder=photos.FOLDER, patches=PATCHES, every=EVERY):
    """Mean `preference` on the rig's validation photos of the P² of each of KINDS, (4,).

    Taught by either thing; the first of these with its filters in the mirror; and Gaussian noise as
    strong as these, with their biases.
    """
    from reproduce.training.cdbn import SECOND, train_crbm  # with torch, slow to load
    from vmc_lib.what.learning import Learner

    def evoked_preference(layer):
        second = Learner.from_arrays(layer)
        maps, rest = (second.pooled(second.trim(p1)) for p1 in (exam, blank))
        return preference(maps, rest, shuttlecock).mean()

    network = CDBN.load(Learner)
    lessons, taught = first_maps(network, photos.load_levels("train", folder, every))
    exam, shuttlecock = first_maps(network, photos.load("rig", "validation", folder))
    blank = second_input(network, np.zeros((1, 1, WIDTH, WIDTH), np.float32))
    own, other = (
        train_crbm(lessons[who], seed, N_W, patches, **SECOND).arrays() for who in (taught, ~taught)
    )
    W = own["W"]
    noise = np.random.default_rng(seed).normal(scale=W.std(), size=W.shape)
    unlearnt = [own | {"W": filters.astype(W.dtype)} for filters in (W[..., ::-1], noise)]
    return np.array([evoked_preference(layer) for layer in (own, other, *unlearnt)])


def first_maps(network, shots):
    """The `second_input` of the true boxes in photos, and which are shuttlecocks (n,)."""
    crops, shuttlecock = crops_of(shots)
    maps = [second_input(network, whiten(crop[None])) for crop in crops]
    return network.first.xp.concatenate(maps), shuttlecock


def second_input(network, pictures):
    """The standardised P1 of whitened pictures (n, 1, 200, 200), not yet trimmed."""
    first = network.first
    p1 = first.pooled(first.trim(first.xp.asarray(pictures)))
    return (p1 - network.mean) / network.spread


def make(folder=photos.FOLDER, seeds=SEEDS, **size):
    """What `results/second_layers.npz` holds: `preferences` for each seed, (seeds, kinds)."""
    found = Parallel()(delayed(preferences)(seed, folder=folder, **size) for seed in seeds)
    return {"preferences": np.array(found)}


load_results = partial(arrays, "second_layers")
