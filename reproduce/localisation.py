"""The paper's Tables I and II and Fig. 6, measured: numbers for the chapters and the ledger.

A split is "train" (in-sample), or "validation" or "test" (held out). What every recipe finds in
every photo is stored, by `python -m reproduce.localisation`, so that a table costs no search.
"""

from collections import ChainMap
from itertools import product

import numpy as np
from joblib import Parallel, delayed
from sklearn.linear_model import LogisticRegression

from reproduce.intervals import student
from reproduce.results import FOLDER, arrays
from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import RECIPES
from vmc_lib.where.svm import KernelSVM, best_threshold
from vmc_lib.where.training import candidates, examples, training_examples, training_images

COSTS = {"rbf": 10, "poly": 10, "sigmoid": 0.1}  # of the kernels that no recipe uses
TABLE_1_KERNELS = ("linear", *COSTS)
TABLE_1_RECIPES = ("published", "context")
RETRAINED = ("published", "improved")  # trained anew from each of SEEDS seeds
TRAININGS = 5


def table_1(level, split="test", name="published"):
    """Table I: precision and recall of the RoI classifier, for each kernel and before suppression.

    Means over SEEDS trainings with the features and examples of the recipe `name`, "published" or
    "context". As in the paper, over candidates that clearly hold an object or clearly do not.
    """
    return {kernel: row.mean(0) for kernel, row in trainings(level, split, name).items()}


def trainings(level, split="test", name="published"):
    """For each kernel of Table I, precision and recall of each of SEEDS trainings, (SEEDS, 2)."""
    rows = [arrays("localisation")[f"{level}/{name}/table 1/{seed}"] for seed in range(TRAININGS)]
    by_kernel = np.swapaxes(rows, 0, 2)[:, photos.SPLITS.index(split)]
    return dict(zip(TABLE_1_KERNELS, by_kernel, strict=True))


def classifiers(level, name, kernels, seed):
    """For each kernel of Table I, a Machine trained with the recipe `name`, and its threshold.

    Beyond the published recipe, whose threshold is 0, the validation photos set the threshold.
    """
    recipe, rng = RECIPES[name], np.random.default_rng(seed)
    learnt = training_examples(training_images(photos.load(level, "train"), recipe), recipe, rng)
    x, truth = examples(photos.load(level, "validation"), recipe)
    for kernel in kernels:
        svm = KernelSVM.fit(*learnt, kernel, COSTS.get(kernel, recipe.cost))
        yield svm, 0 if name == "published" else steady_threshold(svm.score(x), truth)


def steady_threshold(scores, right):
    """A threshold near the best for scores (n,), which a few odd examples cannot move far.

    What is right, (n,) true or false, is first smoothed into the chance that a score is: a logistic
    curve (Platt 1999).
    """
    curve = LogisticRegression(C=1e3).fit(scores[:, None], right)
    chances = curve.predict_proba(scores[:, None])[:, 1]
    return best_threshold(scores, chances, chances.sum())


def classify(level, name, seed, kernels=TABLE_1_KERNELS):
    """Table I: (precision, recall) of each kernel in each of the SPLITS, (3, kernels, 2)."""
    trained, rows = list(classifiers(level, name, kernels, seed)), []
    for split in photos.SPLITS:
        x, truth = examples(photos.load(level, split), RECIPES[name])
        called = [truth[svm.score(x) > threshold] for svm, threshold in trained]
        rows.append([(r.sum() / max(len(r), 1), r.sum() / truth.sum()) for r in called])
    return np.array(rows)


def search(level, split, detector="published"):
    """The Regions that a finder (or the shipped one of that name) sees in each photo of a split."""
    if isinstance(detector, str):
        detector = ObjectDetector.load(level, detector)
    for photo in photos.load(level, split):
        yield detector.detect(photo.image, candidates(photo, detector.recipe.strategy))


def table_2(level, split="test", overlap=0.8):
    """Table II: precision and recall of the final boxes of each recipe, right at IoU `overlap`."""
    some, rows = photos.load(level, split), {}
    for name in RECIPES:
        kept = [arrays("localisation")[f"{photo.name}/{name}"] for photo in some]
        rows[name] = precision_recall(some, kept, overlap)
    return rows


def precision_recall(shots, boxes, overlap=0.8):
    """Precision and recall of a list of boxes a photo: a box is right at IoU `overlap` or more.

    Precision is the share of boxes that are right, recall that of objects with a right box.
    """
    right, reached = hits(shots, boxes, overlap)
    return float(right.sum() / max(right.size, 1)), float(reached.mean())


def hits(shots, boxes, overlap=0.8):
    """Of a list of boxes a photo, which boxes are right, and which objects have a right box.

    Truth values for all boxes of all photos in turn, and for all objects.
    """
    shared = [iou(b, list(p.boxes.values())) >= overlap for p, b in zip(shots, boxes, strict=True)]
    return tuple(np.concatenate([pairs.any(axis) for pairs in shared]) for axis in (1, 0))


def spread(level, name):
    """Table II's row of a recipe over SEEDS trainings: means (2,), half 95 % intervals (2,).

    Precision and recall on the test photos at IoU 0.8; the recipe is one of SEEDED.
    """
    return student(arrays("localisation")[f"{level}/{name}/seeds"])


def figure_6(level, split="test", name="published"):
    """Fig. 6: the mean number of boxes a photo that each step leaves."""
    counts = [regions.counts for regions in search(level, split, name)]
    return {step: float(np.mean([count[step] for count in counts])) for step in counts[0]}


# ---------------------------------------------------------------- measured once, and stored


def found(level, split, name):
    """The boxes that the shipped finder `name` leaves, by photo."""
    pairs = zip(photos.load(level, split), search(level, split, name), strict=True)
    return {f"{photo.name}/{name}": regions.boxes.astype(np.float32) for photo, regions in pairs}


def classified(level, name, seed):
    """Table I of one training, (3 splits, 4 kernels, 2)."""
    return {f"{level}/{name}/table 1/{seed}": classify(level, name, seed)}


def trained_anew(level, name):
    """Precision and recall on the test photos of finders from SEEDS seeds, (SEEDS, 2)."""
    rows, some = [], photos.load(level, "test")
    for seed in range(TRAININGS):
        rng = np.random.default_rng(seed)
        detector = ObjectDetector.fit(photos.load(level, "train"), RECIPES[name], rng)
        detector = detector.tuned(photos.load(level, "validation"))
        rows.append(precision_recall(some, [r.boxes for r in search(level, "test", detector)]))
    return {f"{level}/{name}/seeds": np.array(rows)}


if __name__ == "__main__":
    levels = photos.LEVELS[::-1]  # the longest first
    jobs = [
        *(delayed(trained_anew)(*job) for job in product(levels, RETRAINED[::-1])),
        *(delayed(classified)(*job) for job in product(levels, TABLE_1_RECIPES, range(TRAININGS))),
        *(delayed(found)(*job) for job in product(levels, photos.SPLITS, RECIPES)),
    ]
    np.savez_compressed(FOLDER / "localisation.npz", **ChainMap(*Parallel(n_jobs=-1)(jobs)))
