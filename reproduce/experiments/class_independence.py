"""Which objects the strategies of selective search box well: is it independent of their class?

The more ways of grouping, the less should it matter what the object is.
"""

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, iou
from vmc_lib.where.recipes import PUBLISHED
from vmc_lib.where.selective_search import propose

# 1, 4, 8 and 80 hierarchies
WAYS = {"rig": ("fast",), "varied": ("single", PUBLISHED.strategy, "fast", "quality")}


def boxed_well(boxes, photo):
    """Whether some box (n, 4) overlaps each of photos.CLASSES by 0.8, (2,)."""
    return iou(boxes, [photo.boxes[name] for name in photos.CLASSES]).max(axis=0) >= MIN_IOU


def objects_boxed(strategy, shots):
    """`boxed_well` by what a strategy proposes, (photos, 2)."""
    found = Parallel()(delayed(_proposed)(strategy, shot) for shot in shots)
    return np.array(found)


def _proposed(strategy, shot):
    return boxed_well(propose(shot.image, strategy), shot)


def make(folder=photos.FOLDER, ways=WAYS):
    """What `results/class_independence.npz` holds: `objects_boxed` by level and strategy."""
    shots = {level: photos.load(level, "test", folder) for level in ways}
    return {
        f"{level}/{way}": objects_boxed(way, shots[level]) for level in ways for way in ways[level]
    }


def load_boxed(level):
    """What `make` found of a level's test photos: strategy -> (photos, 2), shuttlecock and cup."""
    return {way: arrays("class_independence")[f"{level}/{way}"] for way in WAYS[level]}
