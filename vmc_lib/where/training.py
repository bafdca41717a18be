"""What the "where" pathway learns from: photos, their true boxes and their candidates.

Candidates that overlap an object by 0.8 are examples, those that overlap none by more than 0.5 are
counter-examples. A shuttlecock and a cup are the same here: general objects.
"""

from dataclasses import dataclass, replace

import numpy as np

from vmc_lib.boxes import corrected, iou, mirrored
from vmc_lib.data import arrays
from vmc_lib.where.recipes import PUBLISHED
from vmc_lib.where.selective_search import propose

ROIS = 4700  # counter-examples to learn from, as in the paper; a random draw where there are more
JITTER = 0.05  # how far, in sides, the examples are jittered


def candidates(photo, strategy="single"):
    """`propose(photo.image, strategy)`, looked up where the photo ships with its candidates."""
    boxes = arrays("candidates").get(f"{photo.name}/{strategy}")
    return propose(photo.image, strategy) if boxes is None else boxes.astype(float)


@dataclass(frozen=True, eq=False)
class TrainingImage:
    """A photo to learn from: its pixels, true boxes and candidates."""

    pixels: np.ndarray  # (height, width, 3)
    truth: np.ndarray  # (m, 4) true boxes
    candidates: np.ndarray  # (n, 4)

    @property
    def overlap(self):
        """How well each candidate fits the object it fits best: (n,)."""
        return iou(self.candidates, self.truth).max(1, initial=0)

    def mirrored(self):
        """The same image in a mirror."""
        width = self.pixels.shape[1]
        boxes = (mirrored(some, width) for some in (self.truth, self.candidates))
        return TrainingImage(self.pixels[:, ::-1], *boxes)

    def jittered(self, times, spread, rng):
        """Each true box so many times, and boxes moved and stretched from it by about `spread`."""
        truth = np.repeat(self.truth, times, axis=0)
        return truth, corrected(truth, rng.normal(scale=spread, size=truth.shape))


def training_images(shots, recipe):
    """The `TrainingImage`s of photos for a recipe: one each, one more mirrored if it asks so."""
    plain = [
        TrainingImage(
            shot.image, np.array(list(shot.boxes.values())), candidates(shot, recipe.strategy)
        )
        for shot in shots
    ]
    return plain + [image.mirrored() for image in plain] if recipe.mirror else plain


def examples(shots, recipe=PUBLISHED):
    """What the classifier is to tell apart: features x (n, d), labels y (n,).

    The clear cases among the photos' candidates: IoU of 0.8 and more, 0.5 and less.
    """
    x, y = [], []
    for image in training_images(shots, replace(recipe, mirror=False)):
        overlap = image.overlap
        clear = (overlap >= 0.8) | (overlap <= 0.5)
        x.append(recipe.describe(image.pixels, image.candidates[clear]))
        y.append(overlap[clear] >= 0.8)
    return np.concatenate(x), np.concatenate(y)


def training_examples(images, recipe, rng):
    """What the classifier learns from: every example, jittered ones too, ROIS counter-examples.

    Of `TrainingImage`s. Returns features x (n, d), labels y (n,).
    """
    x, y = [], []
    for image in images:
        overlap = image.overlap
        good, bad = image.candidates[overlap >= 0.8], image.candidates[overlap <= 0.5]
        bad = rng.permutation(bad)[: -(-ROIS // len(images))]
        _, jittered = image.jittered(recipe.jittered, JITTER, rng)
        x.append(recipe.describe(image.pixels, np.vstack([good, jittered, bad])))
        y.append(np.arange(len(x[-1])) < len(good) + len(jittered))
    return np.concatenate(x), np.concatenate(y)
