"""The paper's Tables I and II and Fig. 6, measured: numbers for the chapters and the ledger.

A split is "train" (in-sample), or "validation" or "test" (held out). What every recipe finds in
every photo is stored, by `python -m vmc_lib.where.evaluate`, so that a table costs no search.
"""

from itertools import product

import numpy as np
from scipy.stats import t

from vmc_lib import photos

from .boxes import iou
from .regions import (
    DATA,
    RECIPES,
    Machine,
    RegionFinder,
    best_threshold,
    candidates,
    examples,
    scenes,
    stored,
    training_examples,
)

TABLE_1_KERNELS = {"linear": 0.1, "rbf": 10, "poly": 10, "sigmoid": 0.1}  # with their costs
TABLE_1_RECIPES = ("published", "context")
SEEDED = ("published", "improved")  # trained anew from each of SEEDS seeds
SEEDS = 5


def table_1(level, split="test", name="published"):
    """Table I: precision and recall of the RoI classifier, for each kernel and before suppression.

    As in the paper, over candidates that clearly hold an object or clearly do not; with the
    features and examples of the recipe `name`: "published" or "context".
    """
    rows = stored("found")[f"{level}/{name}/table 1"][photos.SPLITS.index(split)]
    return {
        kernel: tuple(map(float, row)) for kernel, row in zip(TABLE_1_KERNELS, rows, strict=True)
    }


def classify(level, name, kernel):
    """A row of Table I: (precision, recall) of one kernel in each of the SPLITS, (3, 2).

    Beyond the published recipe, whose threshold is 0, the threshold is the validation photos' best.
    """
    recipe, rng = RECIPES[name], np.random.default_rng(0)
    learnt = training_examples(scenes(photos.load(level, "train"), recipe), recipe, rng)
    machine = Machine.fit(*learnt, kernel, TABLE_1_KERNELS[kernel])
    scored = {}
    for split in photos.SPLITS:
        x, truth = examples(photos.load(level, split), recipe)
        scored[split] = machine.score(x), truth
    scores, truth = scored["validation"]
    threshold = 0 if name == "published" else best_threshold(scores, truth, truth.sum())
    rows = []
    for scores, truth in scored.values():
        right = truth[scores > threshold]
        rows.append((right.sum() / max(len(right), 1), right.sum() / truth.sum()))
    return rows


def search(level, split, finder="published"):
    """The Regions that a finder (or the shipped one of that name) sees in each photo of a split."""
    if isinstance(finder, str):
        finder = RegionFinder.load(level, finder)
    for photo in photos.load(level, split):
        yield finder.find(photo.image, candidates(photo, finder.recipe.strategy))


def table_2(level, split="test", overlap=0.8):
    """Table II: precision and recall of the final boxes of each recipe, right at IoU `overlap`."""
    some, rows = photos.load(level, split), {}
    for name in RECIPES:
        kept = [stored("found")[f"{photo.name}/{name}"] for photo in some]
        rows[name] = localisation(some, kept, overlap)
    return rows


def localisation(photos, boxes, overlap=0.8):
    """Precision and recall of a list of boxes a photo: a box is right at IoU `overlap` or more.

    Precision is the share of boxes that are right, recall that of objects with a right box.
    """
    shared = [iou(b, list(p.boxes.values())) >= overlap for p, b in zip(photos, boxes, strict=True)]
    right = np.concatenate([hits.any(1) for hits in shared])
    reached = np.concatenate([hits.any(0) for hits in shared])
    return float(right.sum() / max(right.size, 1)), float(reached.mean())


def spread(level, name):
    """Table II's row of a recipe over SEEDS trainings: means (2,), half 95 % intervals (2,).

    Precision and recall on the test photos at IoU 0.8; the recipe is one of SEEDED.
    """
    rows = stored("found")[f"{level}/{name}/seeds"]
    return rows.mean(0), t.ppf(0.975, len(rows) - 1) * rows.std(0, ddof=1) / len(rows) ** 0.5


def figure_6(level, split="test", name="published"):
    """Fig. 6: the mean number of boxes a photo that each step leaves."""
    counts = [regions.counts for regions in search(level, split, name)]
    return {step: float(np.mean([count[step] for count in counts])) for step in counts[0]}


def trained_anew(level, name):
    """Precision and recall (SEEDS, 2) on the test photos of finders from as many seeds."""
    rows, some = [], photos.load(level, "test")
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        finder = RegionFinder.fit(photos.load(level, "train"), RECIPES[name], rng)
        finder = finder.tuned(photos.load(level, "validation"))
        rows.append(localisation(some, [r.boxes for r in search(level, "test", finder)]))
    return rows


if __name__ == "__main__":
    found = {}
    for level, split, name in product(photos.LEVELS, photos.SPLITS, RECIPES):
        for photo, regions in zip(
            photos.load(level, split), search(level, split, name), strict=True
        ):
            found[f"{photo.name}/{name}"] = regions.boxes.astype(np.float32)
    for level, name in product(photos.LEVELS, TABLE_1_RECIPES):
        rows = [classify(level, name, kernel) for kernel in TABLE_1_KERNELS]
        found[f"{level}/{name}/table 1"] = np.swapaxes(rows, 0, 1)
    for level, name in product(photos.LEVELS, SEEDED):
        found[f"{level}/{name}/seeds"] = np.array(trained_anew(level, name))
    np.savez_compressed(DATA / "found.npz", **found)
