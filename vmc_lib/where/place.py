"""From a box in the picture to a place in the room.

A line of sight goes through the middle of a box, but the middle of the shuttlecock need not lie on
it (seen from above, its far end looks smaller), nor is it known where along the line to stop: a
standing shuttlecock is taller than a lying one. What the box shows tells: `Locator` learns both
corrections from training photos, as `regions` learns to correct boxes. The paper is silent on this
step.
"""

from dataclasses import dataclass

import numpy as np
from sklearn.compose import TransformedTargetRegressor
from sklearn.kernel_ridge import KernelRidge
from sklearn.preprocessing import StandardScaler

from .boxes import as_boxes, centres_and_sides, shaken
from .features import gradients, raw_pixels

COPIES, SHAKE = 12, 0.05  # boxes learnt from per photo, and how far their sides stray
ALIKE, PENALTY = 0.01, 0.01  # of the kernel regression; chosen on the validation photos
SIDE = 0.05  # m: makes a height comparable with a share of a box


@dataclass(frozen=True)
class Locator:
    """Where the middle of a shuttlecock is, given a box around it."""

    model: TransformedTargetRegressor

    @classmethod
    def fit(cls, shots, rng):
        """Learn from photos whose shuttlecocks' places are known; `rng` shakes their boxes."""
        seen, wanted = [], []
        for photo in shots:
            box = photo.boxes["shuttlecock"]
            boxes = np.vstack([box, shaken(np.tile(box, (COPIES, 1)), SHAKE, rng)])
            centres, sides = centres_and_sides(boxes)
            away = (photo.camera.project(photo.target) - centres) / sides
            seen.append(_describe(photo.image, boxes))
            wanted.append(np.column_stack([away, np.full(len(boxes), photo.target[1] / SIDE)]))
        regression = KernelRidge(kernel="rbf", gamma=ALIKE, alpha=PENALTY)
        model = TransformedTargetRegressor(regression, transformer=StandardScaler())
        return cls(model.fit(np.vstack(seen), np.vstack(wanted)))

    def find(self, image, box, camera):
        """The place (3,) in the shoulder frame (m) of a shuttlecock in `box` (4,) of an image.

        ValueError when the line of sight misses the height it should have.
        """
        boxes = as_boxes(box)
        centres, sides = centres_and_sides(boxes)
        right, down, height = self.model.predict(_describe(image, boxes))[0]
        return camera.back_project(centres + [right, down] * sides, height * SIDE)[0]


def _describe(image, boxes):
    """What boxes (n, 4) show, coarse and fine, and their shapes: (n, d)."""
    _, sides = centres_and_sides(boxes)
    outlines = [
        gradients(image, boxes, cells, margin=margin)
        for cells, margin in ((8, 0.0), (10, 0.25), (14, 0.1))
    ]
    return np.hstack([*outlines, 0.3 * raw_pixels(image, boxes), np.log(sides)])
