"""Training samples of the ventral stream: boxes of renders and photographs, by source and kind."""

from dataclasses import dataclass

import numpy as np
from joblib import Parallel, delayed

from reproduce.training.augmentation import ALL, Augmentation
from reproduce.training.detectors import candidates
from reproduce.training.photographs import COUNTEREXAMPLES, load_photographs
from reproduce.training.scenes import paste_photos
from vmc_lib import loop, photos
from vmc_lib.boxes import iou, nms
from vmc_lib.what.stream import ALIKE

SHARES = {"shuttlecock": 0.4, "other": 0.15, "scene": 0.45}  # of what is drawn
SOURCES = {"rendered": 0.25, "real": 0.35, "pasted": 0.4}  # of each, as far as a source has it
PASTED, VALIDATION = 1400, 280  # scenes that are pasted on photographs to train, to validate
APART = 0.3  # IoU under which a window shows no shuttlecock


@dataclass(frozen=True, eq=False)
class TrainingSamples:
    """Boxes to sample from: source -> kind -> list of (image, boxes (n, 4)).

    A source is one of `SOURCES`: renders, photographs, photographs on which renders were laid. A
    kind is one of `SHARES`; what one source has none of comes from the others.
    """

    sources: dict
    augmentation: Augmentation = ALL

    def draw(self, rng):
        """An image, a box of it, and whether it shows a shuttlecock."""
        kind = rng.choice(list(SHARES), p=list(SHARES.values()))
        some = {name: share for name, share in SOURCES.items() if self.sources[name].get(kind)}
        source = rng.choice(list(some), p=np.array(list(some.values())) / sum(some.values()))
        some = self.sources[source][kind]
        image, boxes = some[rng.integers(len(some))]
        return image, boxes[rng.integers(len(boxes))], kind == "shuttlecock"


def training_samples(by_level):
    """`TrainingSamples` of photos: a level, or "pasted" -> what `photo_samples` gives."""
    levels = {"rendered": photos.LEVELS, "real": [photos.REAL_LEVEL], "pasted": ["pasted"]}
    sources = {}
    for source, names in levels.items():
        photo_kinds = [photo for name in names for photo in by_level.get(name, [])]
        sources[source] = {
            kind: [one[kind] for one in photo_kinds if kind in one] for kind in SHARES
        }
    return TrainingSamples(sources)


def collect_samples(rng, folder=photos.FOLDER, everyday=None, pasted=PASTED):
    """Collect the samples of all training photos: level -> what `photo_samples` gives.

    Among the real ones are those of everyday things and COUNTEREXAMPLES, or `everyday` of each. On
    real ones without a shuttlecock scenes are pasted, `pasted` of them: the level "pasted".
    """
    shots = {level: photos.load(level, "train", folder) for level in photos.EVERY_LEVEL}
    for some in (photos.everyday(), photos.load(photos.REAL_LEVEL, "train", COUNTEREXAMPLES)):
        shots[photos.REAL_LEVEL] += some[:everyday]
    shots["pasted"] = paste_photos(shots[photos.REAL_LEVEL], "train", pasted, rng)
    return {level: photo_samples(some, rng) for level, some in shots.items()}


def validation_photos(rng, folder=photos.FOLDER, everyday=None, pasted=VALIDATION):
    """Photographs of validation, `everyday` of them, and so many scenes `pasted` on such ones."""
    shots = load_photographs("validation", folder)
    return shots[:everyday] + paste_photos(shots, "validation", pasted, rng)


def photo_samples(shots, rng):
    """The `boxes_by_kind` of each photo, from candidates (renders) or detections (photographs).

    In photographs, the windows that teach best are those at which the stream will have to look.
    """
    finder = loop.high_recall_detector(photos.REAL_LEVEL)
    found = Parallel()(
        delayed(candidates)(shot, "single")
        if shot.camera
        else delayed(detected_boxes)(finder, shot)
        for shot in shots
    )
    return [boxes_by_kind(shot, boxes, rng) for shot, boxes in zip(shots, found, strict=True)]


def detected_boxes(finder, shot):
    """The boxes that an object detector keeps of a photo, but those much like a better one."""
    found = finder.detect(shot.image)
    return found.boxes[nms(found.boxes, found.scores, ALIKE)]


def boxes_by_kind(photo, proposed, rng):
    """Boxes of a photo by kind, background from `proposed` (n, 4): kind -> (image, boxes)."""
    shuttlecocks = photos.boxes_of(photo, "shuttlecock")
    others = [photos.boxes_of(photo, name) for name in photo.boxes if name != "shuttlecock"]
    others.append(getattr(photo, "decoys", np.empty((0, 4))))
    windows = np.vstack([proposed, random_windows(rng)])
    apart = iou(windows, shuttlecocks).max(1, initial=0) < APART
    kinds = shuttlecocks, np.vstack([np.empty((0, 4)), *others]), windows[apart]
    return {k: (photo.image, some) for k, some in zip(SHARES, kinds, strict=True) if len(some)}


def random_windows(rng, count=60):
    """Up to `count` random windows (n, 4), at least 30 pixels wide and high."""
    ends = np.sort(rng.random((count, 2, 2)), axis=1) * [photos.WIDTH, photos.HEIGHT]
    return ends[(np.diff(ends, axis=1) >= 30).all((1, 2))].reshape(-1, 4)
