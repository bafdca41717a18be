"""The paper's Tables I and II and Fig. 6, measured: numbers for the chapters and the ledger.

A split is "train" (in-sample), or "validation" or "test" (held out). What every recipe finds in
every photo is stored, as `make` finds it, so that a table costs no search.
"""

from collections import ChainMap
from itertools import product

import numpy as np
from joblib import Parallel, delayed
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import f1_score

from reproduce.results import arrays
from reproduce.training.detectors import (
    best_threshold,
    candidates,
    fit_detector,
    labelled_candidates,
    svm_training_set,
    training_images,
    with_best_threshold,
)
from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, iou, nms
from vmc_lib.statistics import student
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import RECIPES
from vmc_lib.where.svm import KernelSVM

GRID = (0.01, 0.1, 1.0, 10.0, 100.0)  # costs (C) from which each kernel gets its own …
CONTEXT_COSTS = {"linear": 0.1, "rbf": 10, "poly": 10, "sigmoid": 0.1}  # … but with context
TABLE_1_KERNELS = tuple(CONTEXT_COSTS)
TABLE_1_RECIPES = ("published", "context")
RETRAINED = ("published", "improved")  # trained anew from TRAININGS seeds
TRAININGS = 6


def table_1(level, split="test", name="published"):
    """Table I: for each kernel, precision and recall of each training, (TRAININGS, 2).

    Of the RoI classifier, before suppression, with the features and examples of the recipe `name`,
    "published" or "context". As in the paper, over candidates that clearly hold an object or
    clearly do not.
    """
    rows = [arrays("localisation")[f"{level}/{name}/table 1/{seed}"] for seed in range(TRAININGS)]
    by_kernel = np.swapaxes(rows, 0, 2)[:, photos.SPLITS.index(split)]
    return dict(zip(TABLE_1_KERNELS, by_kernel, strict=True))


def kernel_costs(name="published"):
    """The cost C of each kernel of Table I: with the published recipe as `choose_costs` chose."""
    if name == "context":
        return CONTEXT_COSTS
    return dict(zip(TABLE_1_KERNELS, arrays("localisation")["published/costs"], strict=True))


def choose_costs(folder=photos.FOLDER, trainings=TRAININGS):
    """For each kernel, the cost of `GRID` with the best F1 on the rig's validation photos, (4,).

    Of equal ones it is the least.
    """
    best = f1_by_cost(folder, trainings).argmax(axis=1)
    return np.array(GRID)[best]


def f1_by_cost(folder=photos.FOLDER, trainings=TRAININGS):
    """F1 on the rig's validation photos of each kernel at each cost of `GRID`, (4, 5).

    Means over the trainings, with the published recipe.
    """
    recipe = RECIPES["published"]
    images = training_images(photos.load("rig", "train", folder), recipe)
    x, truth = labelled_candidates(photos.load("rig", "validation", folder), recipe)
    draws = [svm_training_set(images, recipe, np.random.default_rng(k)) for k in range(trainings)]

    def f1(kernel, cost):
        called = [KernelSVM.fit(*learnt, kernel, cost).score(x) > 0 for learnt in draws]
        return np.mean([f1_score(truth, says) for says in called])

    return np.array([[f1(kernel, cost) for cost in GRID] for kernel in TABLE_1_KERNELS])


def train_classifiers(level, name, kernels, seed, folder=photos.FOLDER, chosen=None):
    """For each kernel of Table I, a KernelSVM trained with the recipe `name`, and its threshold.

    Beyond the published recipe, whose threshold is 0, the validation photos set the threshold.
    Both kinds of photos lie in `folder`. Costs other than `kernel_costs` may be `chosen`.
    """
    chosen = chosen or kernel_costs(name)
    recipe, rng = RECIPES[name], np.random.default_rng(seed)
    images = training_images(photos.load(level, "train", folder), recipe)
    learnt = svm_training_set(images, recipe, rng)
    x, truth = labelled_candidates(photos.load(level, "validation", folder), recipe)
    for kernel in kernels:
        svm = KernelSVM.fit(*learnt, kernel, chosen[kernel])
        yield svm, 0 if name == "published" else smoothed_threshold(svm.score(x), truth)


def smoothed_threshold(scores, right):
    """A threshold near the best for scores (n,), which a few odd examples cannot move far.

    What is right, (n,) true or false, is first smoothed into the chance that a score is: a logistic
    curve (Platt 1999).
    """
    curve = LogisticRegression(C=1e3).fit(scores[:, None], right)
    chances = curve.predict_proba(scores[:, None])[:, 1]
    return best_threshold(scores, chances, chances.sum())


def measure_table_1(level, name, seed, kernels=TABLE_1_KERNELS, folder=photos.FOLDER, chosen=None):
    """Table I: (precision, recall) of each kernel in each of the SPLITS, (3, kernels, 2)."""
    trained, rows = list(train_classifiers(level, name, kernels, seed, folder, chosen)), []
    for split in photos.SPLITS:
        x, truth = labelled_candidates(photos.load(level, split, folder), RECIPES[name])
        called = [truth[svm.score(x) > threshold] for svm, threshold in trained]
        rows.append([(r.sum() / max(len(r), 1), r.sum() / truth.sum()) for r in called])
    return np.array(rows)


def detect_photos(level, split, detector="published", folder=photos.FOLDER):
    """The Detections of a detector (or the shipped one of that name) in each photo of a split."""
    if isinstance(detector, str):
        detector = ObjectDetector.load(level, detector)
    for photo in photos.load(level, split, folder):
        yield detector.detect(photo.image, candidates(photo, detector.recipe.strategy))


def keep_boxes(detections, threshold, overlap):
    """The candidates (n, 4) with a score above a threshold that suppression keeps."""
    good = detections.candidate_scores > threshold
    boxes = detections.candidates[good]
    return boxes[nms(boxes, detections.candidate_scores[good], overlap)]


def table_2(level, split="test", overlap=MIN_IOU):
    """Table II: precision and recall of the final boxes of each recipe, right at IoU `overlap`."""
    some, rows = photos.load(level, split), {}
    for name in RECIPES:
        kept = [arrays("localisation")[f"{photo.name}/{name}"] for photo in some]
        rows[name] = precision_recall(some, kept, overlap)
    return rows


def precision_recall(shots, boxes, overlap=MIN_IOU):
    """Precision and recall of a list of boxes a photo: a box is right at IoU `overlap` or more.

    Precision is the share of boxes that are right, recall that of objects with a right box.
    """
    right, reached = true_positives(shots, boxes, overlap)
    return float(right.sum() / max(right.size, 1)), float(reached.mean())


def true_positives(shots, boxes, overlap=MIN_IOU):
    """Of a list of boxes a photo, which boxes are right, and which objects have a right box.

    Truth values for all boxes of all photos in turn, and for all objects.
    """
    shared = [iou(b, list(p.boxes.values())) >= overlap for p, b in zip(shots, boxes, strict=True)]
    return tuple(np.concatenate([pairs.any(axis) for pairs in shared]) for axis in (1, 0))


def table_2_interval(level, name):
    """Table II's row of a recipe over TRAININGS trainings: means (2,), half 95 % intervals (2,).

    Precision and recall on the test photos at IoU 0.8; the recipe is one of RETRAINED.
    """
    return student(arrays("localisation")[f"{level}/{name}/seeds"])


def figure_6(level, split="test"):
    """Fig. 6: the mean number of boxes a photo that each step leaves."""
    counts = [detections.counts for detections in detect_photos(level, split, "published")]
    return {step: float(np.mean([count[step] for count in counts])) for step in counts[0]}


# ---------------------------------------------------------------- measured once, and stored


def make(folder=photos.FOLDER, recipes=RECIPES, trainings=TRAININGS):
    """What `results/localisation.npz` holds, of the photos in `folder`."""
    levels, costs = photos.LEVELS[::-1], choose_costs(folder, trainings)  # the longest first
    chosen = {"published": dict(zip(TABLE_1_KERNELS, costs, strict=True)), "context": CONTEXT_COSTS}
    jobs = [
        *(
            delayed(retrain_detectors)(level, name, recipes[name], trainings, folder)
            for level, name in product(levels, RETRAINED[::-1])
        ),
        *(
            delayed(table_1_arrays)(*job, folder, chosen[job[1]])
            for job in product(levels, TABLE_1_RECIPES, range(trainings))
        ),
        *(delayed(final_boxes)(*job, folder) for job in product(levels, photos.SPLITS, RECIPES)),
    ]
    return dict(ChainMap({"published/costs": costs}, *Parallel()(jobs)))


def final_boxes(level, split, name, folder):
    """The boxes that the shipped detector `name` leaves, by photo."""
    shots = photos.load(level, split, folder)
    pairs = zip(shots, detect_photos(level, split, name, folder), strict=True)
    return {
        f"{photo.name}/{name}": detections.boxes.astype(np.float32) for photo, detections in pairs
    }


def table_1_arrays(level, name, seed, folder, chosen):
    """Table I of one training, (3 splits, 4 kernels, 2)."""
    rows = measure_table_1(level, name, seed, folder=folder, chosen=chosen)
    return {f"{level}/{name}/table 1/{seed}": rows}


def retrain_detectors(level, name, recipe, trainings, folder):
    """Precision and recall on the test photos of detectors from many seeds, (trainings, 2)."""
    train, held_out, test = (photos.load(level, split, folder) for split in photos.SPLITS)
    rows = []
    for seed in range(trainings):
        detector = with_best_threshold(
            fit_detector(train, recipe, np.random.default_rng(seed)), held_out
        )
        searches = detect_photos(level, "test", detector, folder)
        rows.append(precision_recall(test, [detections.boxes for detections in searches]))
    return {f"{level}/{name}/seeds": np.array(rows)}
