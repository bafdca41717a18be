"""The models that ship: the arrays in `vmc_lib/data`, learnt from the training photos.

`candidates`, `detectors`, `localisers`, `cdbn`, `recogniser` and `templates` return the arrays of
the file of their name, and `reproduce.pipeline.steps` writes them; `photographs` is of
`ventral_stream`.
"""

from collections import ChainMap
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce.training.cdbn import train_cdbn
from reproduce.training.detectors import fit_detector, with_best_threshold, with_recipe
from reproduce.training.name_classifier import fit_name_classifier, labelled_crops
from reproduce.training.reach_templates import find_reach, reachable_grid
from vmc_lib import photos
from vmc_lib.motor.templates import SPACINGS, key
from vmc_lib.what.cdbn import CDBN, PATCHES, crops_of
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import POOLED_LEVEL, READ_OUTS, read_outs
from vmc_lib.where.localiser import Localiser
from vmc_lib.where.recipes import EVERY_RECIPE, RECIPES, TRAINED_AS
from vmc_lib.where.selective_search import propose

BARE = 6  # training crops of the bare scene a photo
WEIGHED = 3  # times that a photograph counts where renders teach too: chosen on validation ones


def candidates(folder=photos.FOLDER, splits=photos.SPLITS):
    """The candidates (n, 4) of every photo in `folder`, by its name and the strategy."""
    kinds = product(photos.LEVELS, splits)
    shots = [photo for kind in kinds for photo in photos.load(*kind, folder)]
    jobs = list(product(shots, ("diverse", "single", "finer")))
    found = Parallel()(delayed(propose)(photo.image, strategy) for photo, strategy in jobs)
    names = (f"{photo.name}/{strategy}" for photo, strategy in jobs)
    return {name: boxes.astype(np.int16) for name, boxes in zip(names, found, strict=True)}


def detectors(folder=photos.FOLDER, recipes=EVERY_RECIPE):
    """Every recipe trained on every level."""
    names = [name for name in RECIPES if name not in TRAINED_AS]
    which = [*product(photos.LEVELS, names), (photos.REAL_LEVEL, "photographed")]
    jobs = [delayed(detector)(*one, recipes[one[1]], folder) for one in which]
    return dict(ChainMap(*Parallel()(jobs)))


def detector(level, name, recipe, folder):
    """What `load` reads of the recipe `name`, and of those that are TRAINED_AS it, on a level.

    Photographs are few: those of the level "real" teach together with renders.
    """
    shots = photos.load(level, "train", folder)
    if level == photos.REAL_LEVEL:
        shots = photos.load("varied", "train", folder) + WEIGHED * shots
    trained = fit_detector(shots, recipe)
    validation, learnt = photos.load(level, "validation", folder), {}
    for part, value in trained.parts().items():
        half = np.size(value) > 10_000
        learnt[f"{level}/{name}/{part}"] = np.array(value, np.float16 if half else np.float32)
    for row in (name, *(row for row, source in TRAINED_AS.items() if source == name)):
        learnt[f"{level}/{row}/threshold"] = with_best_threshold(
            with_recipe(trained, row), validation
        ).threshold
    return learnt


def localisers(folder=photos.FOLDER):
    """A localiser trained on every level."""
    learnt = {}
    for level in photos.LEVELS:
        shots = photos.load(level, "train", folder)
        parts = Localiser.fit(shots, np.random.default_rng(0)).parts()
        learnt |= {f"{level}/{part}": value for part, value in parts.items()}
    return learnt


def cdbn(folder=photos.FOLDER, patches=PATCHES):
    """The CDBN trained on the crops of all levels."""
    crops, positive = crops_of(photos.load_levels("train", folder))
    return train_cdbn(whiten(crops), positive, patches=patches).arrays()


def recogniser(folder=photos.FOLDER):
    """A name classifier for every read-out on every level, and on all together."""
    rng, network, learnt = np.random.default_rng(0), CDBN.load(), {}
    sets = {
        level: [
            readout_training_set(photos.load(level, split, folder), rng, network)
            for split in ("train", "validation")
        ]
        for level in photos.LEVELS
    }
    sets[POOLED_LEVEL] = [merge_sets(split) for split in zip(*sets.values(), strict=True)]
    for level, ((x, y), (x_validation, y_validation)) in sets.items():
        for name in READ_OUTS:
            found = fit_name_classifier(x[name], y, x_validation[name], y_validation)
            learnt |= found.arrays(f"{level}/{name}")
    return learnt


def readout_training_set(shots, rng, network):
    """The read-outs of photos' `labelled_crops`, and their labels."""
    crops, labels = labelled_crops(shots, rng, background=BARE)
    return read_outs(network, crops), labels


def merge_sets(sets):
    """Several training sets as one."""
    found, labels = zip(*sets, strict=True)
    return {name: np.concatenate([x[name] for x in found]) for name in READ_OUTS}, np.hstack(labels)


def templates(spacings=SPACINGS):
    """The spline knots (N, KNOTS, 6) of every template of every set."""
    goals = {key(spacing): reachable_grid(spacing) for spacing in spacings}
    search = delayed(find_reach)
    return {k: np.array(Parallel()(map(search, some)), np.float32) for k, some in goals.items()}
