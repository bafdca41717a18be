"""The crops from which names are learnt: objects, jittered and mirrored, and the bare scene."""

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import iou, jittered
from vmc_lib.what.crops import crop

COPIES, JITTER = 4, 0.08  # training boxes: copies of each, and how far their sides stray


def background_box(shot, rng):
    """A box of a likely size that overlaps with no object (IoU below 0.3)."""
    objects = np.array(list(shot.boxes.values()))
    while True:
        width, height = rng.uniform(50, 180, 2)
        x, y = rng.uniform(0, photos.WIDTH - width), rng.uniform(0, photos.HEIGHT - height)
        if (iou([(x, y, x + width, y + height)], objects) < 0.3).all():
            return np.array([x, y, x + width, y + height])


def examples(shots, rng, copies=COPIES, background=0):
    """Crops (n, 200, 200) and labels (n,) from photos: each object `copies` times, jittered
    and half of them mirrored; and so many crops of `background` a photo."""
    crops, labels = [], []
    for shot in shots:
        boxes = [(box, name == "shuttlecock") for name, box in shot.boxes.items()] * copies
        boxes = [(jittered(box, JITTER, rng), label) for box, label in boxes]
        boxes += [(background_box(shot, rng), False) for _ in range(background)]
        for box, label in boxes:
            picture = crop(shot.image, box)
            crops.append(picture[:, ::-1] if rng.random() < 0.5 else picture)
            labels.append(label)
    return np.array(crops), np.array(labels)
