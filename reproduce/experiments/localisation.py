"""The paper's Tables I and II and Fig. 6, measured: numbers for the chapters and the ledger.

A split is "train" (in-sample), "validation" (on which choices were made) or "test" (held out:
nothing was chosen on it). What every recipe finds in every photo is stored, as `make` finds it, so
that a table costs no search.
"""

from collections import ChainMap
from dataclasses import replace
from itertools import chain, product, zip_longest

import numpy as np
from joblib import Parallel, delayed

from reproduce.measures.precision_recall import best_overlaps, precision_recall, rates
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
from vmc_lib.boxes import MIN_IOU, nms
from vmc_lib.statistics import t_interval
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import PUBLISHED, RECIPES
from vmc_lib.where.svm import KernelSVM

COSTS = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)  # the grid of C …
SCALES = (0.03, 0.1, 0.3, 1.0)  # … and of γ, in units of `KernelSVM.fit`
# "linear" has no γ; that of "poly" does what C does
FREE_SCALES = {"linear": (1.0,), "rbf": SCALES, "poly": (1.0,), "sigmoid": SCALES}
CONTEXT_COSTS = {"linear": 0.1, "rbf": 10, "poly": 10, "sigmoid": 0.1}
TABLE_1_KERNELS = tuple(FREE_SCALES)
TABLE_1_RECIPES = ("published", "context")
RETRAINED = ("published", "single", "improved")  # trained anew from TRAININGS seeds
SIZES = {8: "8 pixels", 16: "pixels", 32: "32 pixels"}  # sides of the crops, as features are named
TRAININGS = 6


def table_1(level, split="test", recipe_name="published"):
    """Table I: for each kernel, precision and recall of each training, (TRAININGS, 2).

    Of the RoI classifier, before suppression, with the features and examples of the recipe
    "published" or "context". As in the paper, over candidates that clearly hold an object or
    clearly do not.
    """
    rows = [
        arrays("localisation")[f"{level}/{recipe_name}/table 1/{seed}"] for seed in range(TRAININGS)
    ]
    by_kernel = np.swapaxes(rows, 0, 2)[:, photos.SPLITS.index(split)]
    return dict(zip(TABLE_1_KERNELS, by_kernel, strict=True))


def kernel_settings(recipe_name="published"):
    """C and the scale of γ of each kernel of Table I, as `KernelSVM.fit` takes them.

    Those of the published recipe are as `best_setting` chose; those of "context" were chosen with
    the rest of it.
    """
    if recipe_name == "context":
        return {kernel: (cost, 1.0) for kernel, cost in CONTEXT_COSTS.items()}
    return dict(zip(TABLE_1_KERNELS, arrays("localisation")["published/settings"], strict=True))


def f1_by_setting(kernel, features="pixels", folder=photos.FOLDER):
    """F1 on the rig's validation photos of a kernel at each of COSTS and its FREE_SCALES, (6, s).

    With the published recipe, or with other features in it.
    """
    from sklearn.metrics import f1_score

    recipe, rng = replace(PUBLISHED, features=features), np.random.default_rng(0)
    learnt = svm_training_set(
        training_images(photos.load("rig", "train", folder), recipe), recipe, rng
    )
    x, truth = labelled_candidates(photos.load("rig", "validation", folder), recipe)

    def f1(*setting):
        return f1_score(truth, KernelSVM.fit(*learnt, kernel, *setting).score(x) > 0)

    return np.array([[f1(cost, scale) for scale in FREE_SCALES[kernel]] for cost in COSTS])


def best_setting(kernel, f1):
    """C and the scale of γ of the best of `f1_by_setting`; of equal ones the least C."""
    cost, scale = np.unravel_index(f1.argmax(), f1.shape)
    return COSTS[cost], FREE_SCALES[kernel][scale]


def f1_by_size():
    """The best F1 on the rig's validation photos of the linear kernel, by the crops' side."""
    return dict(zip(SIZES, arrays("localisation")["published/sizes"], strict=True))


def train_classifiers(level, recipe_name, kernels, seed, folder=photos.FOLDER, chosen=None):
    """For each kernel of Table I, a KernelSVM trained with a recipe, and its threshold.

    Beyond the published recipe, whose threshold is 0, the validation photos set the threshold.
    Both kinds of photos lie in `folder`. Settings other than `kernel_settings` may be `chosen`.
    """
    chosen = chosen or kernel_settings(recipe_name)
    recipe, rng = RECIPES[recipe_name], np.random.default_rng(seed)
    images = training_images(photos.load(level, "train", folder), recipe)
    learnt = svm_training_set(images, recipe, rng)
    x, truth = labelled_candidates(photos.load(level, "validation", folder), recipe)
    for kernel in kernels:
        svm = KernelSVM.fit(*learnt, kernel, *chosen[kernel])
        yield svm, 0 if recipe_name == "published" else smoothed_threshold(svm.score(x), truth)


def smoothed_threshold(scores, right):
    """A threshold near the best for scores (n,), which a few odd examples cannot move far.

    What is right, (n,) true or false, is first smoothed into the chance that a score is: a logistic
    curve (Platt 1999).
    """
    from sklearn.linear_model import LogisticRegression

    curve = LogisticRegression(C=1e3).fit(scores[:, None], right)
    chances = curve.predict_proba(scores[:, None])[:, 1]
    return best_threshold(scores, chances, chances.sum())


def measure_table_1(
    level, recipe_name, seed, kernels=TABLE_1_KERNELS, folder=photos.FOLDER, chosen=None
):
    """Table I: (precision, recall) of each kernel in each of the SPLITS, (3, kernels, 2)."""
    trained, rows = list(train_classifiers(level, recipe_name, kernels, seed, folder, chosen)), []
    for split in photos.SPLITS:
        x, truth = labelled_candidates(photos.load(level, split, folder), RECIPES[recipe_name])
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
    return dict(zip(RECIPES, rates(best_by_recipe(level, split), overlap).tolist(), strict=True))


def best_by_recipe(level, split):
    """`best_overlaps` of each recipe's final boxes: (recipes, 2, most), filled up with NaN."""
    some, final = photos.load(level, split), arrays("localisation")
    every = (best_overlaps(some, [final[f"{p.name}/{name}"] for p in some]) for name in RECIPES)
    columns = zip_longest(*chain.from_iterable(every), fillvalue=np.nan)
    return np.array([*columns]).T.reshape(len(RECIPES), 2, -1)


def table_2_interval(level, recipe_name):
    """Table II's row of a recipe over TRAININGS trainings: means (2,), half 95 % intervals (2,).

    Precision and recall on the test photos at IoU 0.8; the recipe is one of RETRAINED.
    """
    return t_interval(arrays("localisation")[f"{level}/{recipe_name}/seeds"])


def figure_6(level, split="test"):
    """Fig. 6: the mean number of boxes a photo that each step leaves."""
    counts = [detections.counts for detections in detect_photos(level, split, "published")]
    return {step: float(np.mean([count[step] for count in counts])) for step in counts[0]}


def make(folder=photos.FOLDER, recipes=RECIPES, trainings=TRAININGS):
    """What `results/localisation.npz` holds, of the photos in `folder`."""
    choices, levels = chosen_settings(folder), photos.LEVELS[::-1]  # the longest first
    chosen = dict(zip(TABLE_1_KERNELS, choices["published/settings"], strict=True))
    jobs = [
        *(
            delayed(retrain_detectors)(level, name, recipes[name], trainings, folder)
            for level, name in product(levels, RETRAINED[::-1])
        ),
        *(
            delayed(table_1_arrays)(*job, folder, chosen if job[1] == "published" else None)
            for job in product(levels, TABLE_1_RECIPES, range(trainings))
        ),
        *(delayed(final_boxes)(*job, folder) for job in product(levels, photos.SPLITS, RECIPES)),
    ]
    return dict(ChainMap(choices, *Parallel()(jobs)))


def chosen_settings(folder=photos.FOLDER):
    """The setting of each kernel (4, 2), and the best F1 (3,) of the linear one at SIZES."""
    jobs = [(kernel, "pixels") for kernel in TABLE_1_KERNELS]
    jobs += [("linear", features) for features in SIZES.values()]
    f1 = Parallel()(delayed(f1_by_setting)(*job, folder) for job in jobs)
    return {
        "published/settings": np.array(list(map(best_setting, TABLE_1_KERNELS, f1))),
        "published/sizes": np.array([rows.max() for rows in f1[len(TABLE_1_KERNELS) :]]),
    }


def final_boxes(level, split, recipe_name, folder):
    """The boxes that the shipped detector of a recipe leaves, by photo."""
    shots = photos.load(level, split, folder)
    pairs = zip(shots, detect_photos(level, split, recipe_name, folder), strict=True)
    return {
        f"{photo.name}/{recipe_name}": detections.boxes.astype(np.float32)
        for photo, detections in pairs
    }


def table_1_arrays(level, recipe_name, seed, folder, chosen):
    """Table I of one training, (3 splits, 4 kernels, 2)."""
    rows = measure_table_1(level, recipe_name, seed, folder=folder, chosen=chosen)
    return {f"{level}/{recipe_name}/table 1/{seed}": rows}


def retrain_detectors(level, recipe_name, recipe, trainings, folder):
    """Precision and recall on the test photos of detectors from many seeds, (trainings, 2)."""
    train, validation, test = (photos.load(level, split, folder) for split in photos.SPLITS)
    rows = []
    for seed in range(trainings):
        detector = with_best_threshold(
            fit_detector(train, recipe, np.random.default_rng(seed)), validation
        )
        searches = detect_photos(level, "test", detector, folder)
        rows.append(precision_recall(test, [detections.boxes for detections in searches]))
    return {f"{level}/{recipe_name}/seeds": np.array(rows)}
