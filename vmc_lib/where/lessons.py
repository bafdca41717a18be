"""What the "where" pathway learns from: photos, their true boxes and their candidates.

Candidates that overlap an object by 0.8 are examples, those that overlap none by more than 0.5 are
counter-examples. A shuttlecock and a cup are the same here: general objects.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from vmc_lib import photos

from ..data import FOLDER, arrays
from .boxes import corrected, iou, mirrored
from .recipes import PUBLISHED
from .selective_search import propose

ROIS = 4700  # counter-examples to learn from, as in the paper; a random draw where there are more
SHAKE = 0.05  # how far, in sides, the shaken examples stray


def candidates(photo, strategy="single"):
    """`propose(photo.image, strategy)`, looked up where the photo ships with its candidates."""
    boxes = arrays("candidates").get(f"{photo.name}/{strategy}")
    return propose(photo.image, strategy) if boxes is None else boxes.astype(float)


def store_candidates():
    """Search every photo for candidates, and store them."""
    found = {
        f"{photo.name}/{strategy}": propose(photo.image, strategy).astype(np.int16)
        for level, split in product(photos.LEVELS, photos.SPLITS)
        for photo in photos.load(level, split)
        for strategy in ("single", "finer")
    }
    np.savez_compressed(FOLDER / "candidates.npz", **found)
    arrays.cache_clear()


@dataclass(frozen=True)
class Lesson:
    """What a photo teaches: an image, its true boxes (m, 4), its candidates (n, 4)."""

    image: np.ndarray
    truth: np.ndarray
    boxes: np.ndarray

    @property
    def overlap(self):
        """How well each candidate fits the object it fits best: (n,)."""
        return iou(self.boxes, self.truth).max(1, initial=0)

    def mirrored(self):
        """The lesson in a mirror."""
        width = self.image.shape[1]
        return Lesson(self.image[:, ::-1], mirrored(self.truth, width), mirrored(self.boxes, width))

    def scattered(self, times, spread, rng):
        """Each true box so many times, and boxes that stray from it by `spread` of its sides."""
        truth = np.repeat(self.truth, times, axis=0)
        return truth, corrected(truth, rng.normal(scale=spread, size=truth.shape))


def lessons(shots, recipe):
    """The Lessons of photos for a recipe: one each, and one more in the mirror if it asks so."""
    plain = [
        Lesson(shot.image, np.array(list(shot.boxes.values())), candidates(shot, recipe.strategy))
        for shot in shots
    ]
    return plain + [lesson.mirrored() for lesson in plain] if recipe.mirror else plain


def examples(shots, recipe=PUBLISHED):
    """What the classifier is to tell apart: features x (n, d), labels y (n,).

    The clear cases among the photos' candidates: IoU of 0.8 and more, 0.5 and less.
    """
    x, y = [], []
    for lesson in lessons(shots, replace(recipe, mirror=False)):
        overlap = lesson.overlap
        clear = (overlap >= 0.8) | (overlap <= 0.5)
        x.append(recipe.describe(lesson.image, lesson.boxes[clear]))
        y.append(overlap[clear] >= 0.8)
    return np.concatenate(x), np.concatenate(y)


def training_examples(seen, recipe, rng):
    """What the classifier learns from: every example, shaken ones too, and ROIS counter-examples.

    Of the Lessons `seen`. Returns features x (n, d), labels y (n,).
    """
    x, y = [], []
    for lesson in seen:
        overlap = lesson.overlap
        good, bad = lesson.boxes[overlap >= 0.8], lesson.boxes[overlap <= 0.5]
        bad = rng.permutation(bad)[: -(-ROIS // len(seen))]
        _, shaken = lesson.scattered(recipe.shaken, SHAKE, rng)
        x.append(recipe.describe(lesson.image, np.vstack([good, shaken, bad])))
        y.append(np.arange(len(x[-1])) < len(good) + len(shaken))
    return np.concatenate(x), np.concatenate(y)
