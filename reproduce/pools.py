"""What names are learnt from: boxes of renders and of photographs, drawn in ever new looks."""

from dataclasses import dataclass
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce.detector_training import candidates
from reproduce.looks import ALL, Looks, look
from vmc_lib import loop, photos
from vmc_lib.boxes import iou

NARROW = 48  # pixels of a crop
SHARES = {"shuttlecock": 0.4, "other": 0.15, "scene": 0.45}  # of what is drawn
REAL = 0.55  # of each, how much comes from photographs
APART = 0.3  # IoU under which a window shows no shuttlecock


@dataclass(frozen=True, eq=False)
class Pool:
    """Boxes to draw from, by kind: lists of (image, boxes (n, 4)), of renders and of photographs.

    A kind is one of `SHARES`; where one sort of picture has none of it, it comes from the other.
    """

    rendered: dict
    real: dict
    looks: Looks = ALL

    def draw(self, rng):
        """An image, a box of it, and whether it shows a shuttlecock."""
        kind = rng.choice(list(SHARES), p=list(SHARES.values()))
        sides = [side[kind] for side in (self.rendered, self.real) if side[kind]]
        side = sides[-1 if rng.random() < REAL else 0]
        image, boxes = side[rng.integers(len(side))]
        return image, boxes[rng.integers(len(boxes))], kind == "shuttlecock"

    def examples(self, count, rng):
        """Crops (count, NARROW, NARROW), each in one of its looks, and their labels (count,)."""
        crops, labels = np.zeros((count, NARROW, NARROW), np.float32), np.zeros(count, bool)
        for i in range(count):
            while crops[i].std() < 0.01:  # a window of nothing teaches nothing
                image, box, labels[i] = self.draw(rng)
                crops[i] = look(image, box, rng, NARROW, self.looks)
        return crops, labels


def pool(shown):
    """The `Pool` of what some levels show: level -> what `seen_in` gives."""
    renders = [photo for level in photos.LEVELS for photo in shown.get(level, [])]
    return Pool(
        *(
            {kind: [photo[kind] for photo in side if kind in photo] for kind in SHARES}
            for side in (renders, shown.get(photos.REAL_LEVEL, []))
        )
    )


def show(splits, rng, folder=photos.FOLDER, everyday=None):
    """What the photos of each level and of each of the `splits` show: level -> a list for each.

    Among the real ones of the first split are those of everyday things, or so many of them.
    """
    shown = {}
    for level, split in product(photos.EVERY_LEVEL, splits):
        shots = photos.load(level, split, folder)
        if (level, split) == (photos.REAL_LEVEL, splits[0]):
            shots += photos.real()[:everyday]
        shown.setdefault(level, []).append(seen_in(shots, rng))
    return shown


def seen_in(shots, rng):
    """What each of some photos shows, `by_kind`.

    In photographs, the windows that teach best are those that look like objects to the detector.
    """
    finder = loop.lenient_detector(loop.PHOTOGRAPHS_AS)
    found = Parallel()(
        delayed(candidates)(shot) if shot.camera else delayed(boxes_of)(finder, shot)
        for shot in shots
    )
    return [by_kind(shot, boxes, rng) for shot, boxes in zip(shots, found, strict=True)]


def boxes_of(finder, shot):
    """The boxes that an object detector keeps of a photo."""
    return finder.detect(shot.image).boxes


def by_kind(photo, proposed, rng):
    """Of a photo and the boxes `proposed` (n, 4): kind -> (image, boxes) of each kind it has."""
    shuttlecocks = photos.all_of(photo, "shuttlecock")
    others = [photos.all_of(photo, name) for name in photo.boxes if name != "shuttlecock"]
    windows = np.vstack([proposed, anywhere(rng)])
    apart = iou(windows, shuttlecocks).max(1, initial=0) < APART
    kinds = shuttlecocks, np.vstack([np.empty((0, 4)), *others]), windows[apart]
    return {k: (photo.image, some) for k, some in zip(SHARES, kinds, strict=True) if len(some)}


def anywhere(rng, count=60):
    """Up to `count` windows (n, 4) of any place and size, at least 30 pixels wide and high."""
    ends = np.sort(rng.random((count, 2, 2)), axis=1) * [photos.WIDTH, photos.HEIGHT]
    return ends[(np.diff(ends, axis=1) >= 30).all((1, 2))].reshape(-1, 4)


def pools(shown):
    """What to train on and what to validate on: two `Pool`s of what `show` gives, level -> pair."""
    return [pool({level: pair[k] for level, pair in shown.items()}) for k in (0, 1)]
