"""What names are learnt from: boxes of renders and of photographs, drawn in ever new looks."""

from dataclasses import dataclass

import numpy as np
from joblib import Parallel, delayed

from reproduce.training import pasting
from reproduce.training.augmentation import ALL, Looks
from reproduce.training.detectors import candidates
from vmc_lib import loop, photos
from vmc_lib.boxes import iou

SHARES = {"shuttlecock": 0.4, "other": 0.15, "scene": 0.45}  # of what is drawn
SOURCES = {"rendered": 0.3, "real": 0.4, "pasted": 0.3}  # of each, as far as a source has it
PASTED = 500  # photographs on which a shuttlecock is laid
APART = 0.3  # IoU under which a window shows no shuttlecock


@dataclass(frozen=True, eq=False)
class Pool:
    """Boxes to draw from: a source -> a kind -> a list of (image, boxes (n, 4)).

    A source is one of `SOURCES`: renders, photographs, photographs on which renders were laid. A
    kind is one of `SHARES`; what one source has none of comes from the others.
    """

    sources: dict
    looks: Looks = ALL

    def draw(self, rng):
        """An image, a box of it, and whether it shows a shuttlecock."""
        kind = rng.choice(list(SHARES), p=list(SHARES.values()))
        some = {name: share for name, share in SOURCES.items() if self.sources[name].get(kind)}
        source = rng.choice(list(some), p=np.array(list(some.values())) / sum(some.values()))
        shown = self.sources[source][kind]
        image, boxes = shown[rng.integers(len(shown))]
        return image, boxes[rng.integers(len(boxes))], kind == "shuttlecock"


def pool(shown):
    """The `Pool` of what photos show: where they are from (a level, or "pasted") -> `seen_in`."""
    levels = {"rendered": photos.LEVELS, "real": [photos.REAL_LEVEL], "pasted": ["pasted"]}
    sources = {}
    for source, names in levels.items():
        seen = [photo for name in names for photo in shown.get(name, [])]
        sources[source] = {kind: [one[kind] for one in seen if kind in one] for kind in SHARES}
    return Pool(sources)


def show(rng, folder=photos.FOLDER, everyday=None, pasted=PASTED):
    """What the training photos of each level show: level -> what `seen_in` gives.

    Among the real ones are those of everyday things, or so many of them. On real ones without a
    shuttlecock one is laid, as often as `pasted` says: the level "pasted".
    """
    shots = {level: photos.load(level, "train", folder) for level in photos.EVERY_LEVEL}
    shots[photos.REAL_LEVEL] += photos.everyday()[:everyday]
    shots["pasted"] = pasting.pasted(shots[photos.REAL_LEVEL], "train", pasted, rng)
    return {level: seen_in(some, rng) for level, some in shots.items()}


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
