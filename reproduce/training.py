"""What training has learnt and the model reads: everything in `vmc_lib/data` but the photos."""

from collections import ChainMap
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce import template_making
from reproduce.name_examples import examples
from vmc_lib import photos
from vmc_lib.data import FOLDER, arrays
from vmc_lib.motor import templates
from vmc_lib.what.cdbn import CDBN, crops_of, train
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import ALL_LEVELS, READ_OUTS, fit, read_outs
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.localiser import Localiser
from vmc_lib.where.recipes import RECIPES, TRAINED_AS
from vmc_lib.where.selective_search import propose

BARE = 6  # training crops of the bare scene a photo


def store_candidates():
    """Search every photo for candidates, and store them."""
    found = {
        f"{photo.name}/{strategy}": propose(photo.image, strategy).astype(np.int16)
        for level, split in product(photos.LEVELS, photos.SPLITS)
        for photo in photos.load(level, split)
        for strategy in ("single", "finer")
    }
    np.savez_compressed(FOLDER / "candidates.npz", **found)
    arrays.cache_clear()


def trained(level, name):
    """What `load` reads of the recipe `name`, and of those that are TRAINED_AS it, on a level."""
    detector = ObjectDetector.fit(photos.load(level, "train"), RECIPES[name])
    held_out, learnt = photos.load(level, "validation"), {}
    for part, value in detector.parts().items():
        half = np.size(value) > 10_000
        learnt[f"{level}/{name}/{part}"] = np.array(value, np.float16 if half else np.float32)
    for row in (name, *(row for row, source in TRAINED_AS.items() if source == name)):
        learnt[f"{level}/{row}/threshold"] = detector.used_as(row).tuned(held_out).threshold
    return learnt


def store_detectors():
    """Train every recipe on every level, tune all but the published one, store what they learnt."""
    names = [name for name in RECIPES if name not in TRAINED_AS]
    jobs = [delayed(trained)(level, name) for level, name in product(photos.LEVELS, names)]
    np.savez_compressed(FOLDER / "detectors.npz", **ChainMap(*Parallel(n_jobs=-1)(jobs)))


def store_localisers():
    """Train a localiser on every level."""
    learnt = {}
    for level in photos.LEVELS:
        localiser = Localiser.fit(photos.load(level, "train"), np.random.default_rng(0))
        learnt |= {f"{level}/{part}": value for part, value in localiser.parts().items()}
    np.savez_compressed(FOLDER / "localisers.npz", **learnt)


def store_cdbn():
    """Train the CDBN on the crops of all levels."""
    shots = [shot for level in photos.LEVELS for shot in photos.load(level, "train")]
    crops, positive = crops_of(shots)
    np.savez_compressed(FOLDER / "cdbn.npz", **train(whiten(crops), positive).arrays())


def training_set(level, split, rng, cdbn):
    """The read-outs of a level's `examples`, bare scene among them, and their labels."""
    crops, labels = examples(photos.load(level, split), rng, background=BARE)
    return read_outs(cdbn, crops), labels


def merged(sets):
    """Several training sets as one."""
    found, labels = zip(*sets, strict=True)
    return {name: np.concatenate([x[name] for x in found]) for name in READ_OUTS}, np.hstack(labels)


def store_recognisers():
    """Fit a name classifier to every read-out on every level, and on all together."""
    rng, cdbn, classifier = np.random.default_rng(0), CDBN.load(), {}
    sets = {
        level: [training_set(level, split, rng, cdbn) for split in ("train", "validation")]
        for level in photos.LEVELS
    }
    sets[ALL_LEVELS] = [merged(split) for split in zip(*sets.values(), strict=True)]
    for level, ((x, y), (x_validation, y_validation)) in sets.items():
        for name in READ_OUTS:
            found = fit(x[name], y, x_validation[name], y_validation)
            right = (found.probability(x_validation[name]) > 0.5) == y_validation
            print(f"{level}, {name}: {right.mean():.4f} of {len(right)} validation crops right")
            classifier[f"{level}/{name}/w"] = np.float32(found.weights)
            classifier[f"{level}/{name}/b"] = found.bias
    np.savez_compressed(FOLDER / "recogniser.npz", **classifier)


def store_templates():
    """Make every template of every set."""
    knots = {
        templates.key(spacing): np.array(
            [template_making.make(goal) for goal in template_making.grid(spacing)], np.float32
        )
        for spacing in templates.SPACINGS
    }
    np.savez_compressed(FOLDER / "templates.npz", **knots)
