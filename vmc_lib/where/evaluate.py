"""The paper's Tables I and II and Fig. 6, measured: numbers for the chapters and the ledger.

A split is "train" (in-sample), or "validation" or "test" (held out). What every recipe finds in
every photo is stored, by `python -m vmc_lib.where.evaluate`, so that a table costs no search.
"""

from functools import cache
from itertools import product

import numpy as np

from vmc_lib import photos

from .boxes import iou
from .regions import DATA, RECIPES, Machine, RegionFinder, candidates, examples, stored

TABLE_1_KERNELS = {"linear": 0.1, "rbf": 10, "poly": 10, "sigmoid": 0.1}  # with their costs


@cache
def _examples(level, split):
    return examples(photos.load(level, split))


@cache
def _machine(level, kernel):
    return Machine.fit(*_examples(level, "train"), kernel, TABLE_1_KERNELS[kernel])


def table_1(level, split="test"):
    """Table I: precision and recall of the RoI classifier, for each kernel and before suppression.

    As in the paper, over candidates that clearly hold an object or clearly do not.
    """
    x, truth = _examples(level, split)
    rows = {}
    for kernel in TABLE_1_KERNELS:
        says = _machine(level, kernel).score(x) > 0
        right = (says & truth).sum()
        rows[kernel] = float(right / max(says.sum(), 1)), float(right / truth.sum())
    return rows


def search(level, split, name="published"):
    """The Regions that the finder `name` of a level sees in each photo of a split."""
    finder = RegionFinder.load(level, name)
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


def figure_6(level, split="test", name="published"):
    """Fig. 6: the mean number of boxes a photo that each step leaves."""
    counts = [regions.counts for regions in search(level, split, name)]
    return {step: float(np.mean([count[step] for count in counts])) for step in counts[0]}


if __name__ == "__main__":
    found = {}
    for level, split, name in product(photos.LEVELS, photos.SPLITS, RECIPES):
        for photo, regions in zip(
            photos.load(level, split), search(level, split, name), strict=True
        ):
            found[f"{photo.name}/{name}"] = regions.boxes.astype(np.float32)
    np.savez_compressed(DATA / "found.npz", **found)
