"""How much regions on one photo say the same: design effects of Table I's shares.

A photo has several good regions on one object, and a classifier is often right, or wrong, about
all of them. So a share of regions is less sure than if each had its own photo, by the design effect
(its variance over photos, over that of independent regions). The fresh photos' answers are kept as
counts; the effect is measured on the test photos that ship, photo by photo.
"""

from functools import partial

import numpy as np

from reproduce.experiments.localisation import TABLE_1_KERNELS, train_classifiers
from reproduce.results import records
from reproduce.training.detectors import labelled_candidates
from vmc_lib import photos
from vmc_lib.where.recipes import RECIPES

CONTEXT = {"context": ("linear", "rbf")}
KERNELS = {  # by level, and by recipe
    "rig": {"published": TABLE_1_KERNELS} | CONTEXT,
    "free": CONTEXT,
    "varied": CONTEXT,
}


def design_effect(right, total):
    """The variance of Σ right / Σ total over clusters (n,), over the binomial one; at least 1.

    It is 1 where none can be seen: of one cluster, of no regions, or of a share of 0 or 1.
    """
    right, total = np.asarray(right, float), np.asarray(total, float)
    if len(total) < 2 or right.sum() in (0, total.sum()):
        return 1.0
    share, n = right.sum() / total.sum(), len(total)
    variance = n / (n - 1) * ((right - share * total) ** 2).sum() / total.sum() ** 2
    return max(1.0, float(variance * total.sum() / (share * (1 - share))))


def effects(level, recipe_name, kernel_names, folder=photos.FOLDER):
    """Kernel -> the design effects of precision and of recall, on a level, with a recipe."""
    shots, found = photos.load(level, "test", folder), {}
    by_photo = [labelled_candidates([shot], RECIPES[recipe_name]) for shot in shots]
    trained = train_classifiers(level, recipe_name, kernel_names, 0, folder)
    for kernel, (svm, threshold) in zip(kernel_names, trained, strict=True):
        answers = [(svm.score(x) > threshold, truth) for x, truth in by_photo]
        right = [(called & truth).sum() for called, truth in answers]
        totals = [[part.sum() for part in parts] for parts in zip(*answers, strict=True)]
        found[kernel] = [design_effect(right, total) for total in totals]
    return found


def make(folder=photos.FOLDER, kernels=KERNELS):
    """What `results/region_clusters.json` holds: level -> recipe -> `effects`."""
    return {
        level: {name: effects(level, name, some, folder) for name, some in recipes.items()}
        for level, recipes in kernels.items()
    }


load_results = partial(records, "region_clusters")
