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


def has_good_box(boxes, photo):
    """Whether some box (n, 4) overlaps each of photos.CLASSES by 0.8, (2,)."""
    return iou(boxes, [photo.boxes[name] for name in photos.CLASSES]).max(axis=0) >= MIN_IOU


def has_good_boxes(found, shots):
    """`has_good_box` of each photo's boxes, (photos, 2)."""
    return np.array(list(map(has_good_box, found, shots)))


def make(folder=photos.FOLDER, ways=WAYS):
    """What `results/class_independence.npz` holds: `has_good_boxes` by level and strategy."""
    found = {}
    for level, strategies in ways.items():
        shots = photos.load(level, "test", folder)
        for way in strategies:
            boxes = Parallel()(delayed(propose)(shot.image, way) for shot in shots)
            found[f"{level}/{way}"] = has_good_boxes(boxes, shots)
    return found


def load_results(level):
    """What `make` found of a level's test photos: strategy -> (photos, 2), shuttlecock and cup."""
    return {way: arrays("class_independence")[f"{level}/{way}"] for way in WAYS[level]}
