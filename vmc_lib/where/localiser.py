"""Localiser: from a box in the image to a place in the shoulder frame.

A line of sight goes through the middle of a box, but the middle of the shuttlecock need not lie on
it (from above, its far end appears smaller), nor is its height known: a standing shuttlecock is
taller than a lying one. Both are predicted from the features of the box, by regression on training
photos. The paper is silent on this step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.boxes import as_box, centres_and_sides, jitter_boxes
from vmc_lib.camera import Camera
from vmc_lib.checks import cached, check_kind
from vmc_lib.data import arrays, read_only
from vmc_lib.photos import LEVELS, check_photos, crops
from vmc_lib.short_repr import short_repr
from vmc_lib.where.features import gradients
from vmc_lib.where.kernels import rbf

COPIES, JITTER = 12, 0.05  # boxes per training photo, and the noise of their edges, in sides
GAMMA, PENALTY = 0.01, 0.01  # of the kernel regression; chosen on the validation photos
PARTS = ("shown", "shape", "weights", "mean", "spread")  # as they are stored
SIDE = 0.05  # m: makes a height comparable with a share of a box


@dataclass(frozen=True, eq=False)
class Localiser:
    """Kernel ridge regression from a shuttlecock's box to its middle.

    predict(x) = mean + spread · K(support, x) @ weights, K a radial basis function.
    """

    support: np.ndarray  # (n, d) features of the boxes learnt from
    weights: np.ndarray  # (n, 3)
    mean: np.ndarray  # (3,) of what is predicted: right and down in sides, height in SIDE
    spread: np.ndarray  # (3,)

    __repr__ = short_repr

    @classmethod
    def fit(cls, shots: Sequence[Any], rng: np.random.Generator) -> Self:
        """Fit to photos whose shuttlecocks' places are known; `rng` jitters their boxes.

        ValueError for photographs, whose places are not known.
        """
        from sklearn.kernel_ridge import KernelRidge

        check_photos(shots)
        inputs, targets = [], []
        for photo in shots:
            if photo.target is None:
                raise ValueError(
                    f'the place in {photo.name} is not known: give renders, load("rig", "train")'
                )
            box = photo.boxes["shuttlecock"]
            boxes = np.vstack([box, jitter_boxes(np.tile(box, (COPIES, 1)), JITTER, rng)])
            centres, sides = centres_and_sides(boxes)
            offset = (photo.camera.project(photo.target) - centres) / sides
            inputs.append(_describe(photo.image, boxes))
            targets.append(np.column_stack([offset, np.full(len(boxes), photo.target[1] / SIDE)]))
        x, y = np.vstack(inputs), np.vstack(targets)
        x[:, :-2] = np.round(255 * x[:, :-2]) / 255  # as they ship: a byte each
        mean, spread = y.mean(axis=0), y.std(axis=0)
        ridge = KernelRidge(kernel="rbf", gamma=GAMMA, alpha=PENALTY).fit(x, (y - mean) / spread)
        return cls(x, ridge.dual_coef_, mean, spread)

    @classmethod
    @cached
    def load(cls, level: str) -> Self:
        """The shipped localiser of a level of photos, read once; ValueError for an unknown one."""
        learnt = arrays("localisers")
        if f"{level}/mean" not in learnt:
            raise ValueError(f"no localiser for level {level!r}: choose from {LEVELS}")
        shown, shape, *rest = (learnt[f"{level}/{part}"] for part in PARTS)
        return cls(read_only(np.hstack([shown / 255, shape])), *rest)

    def parts(self) -> dict[str, Any]:
        """The arrays that `load` reads, by name; features are stored as bytes."""
        shown, shape = np.uint8(np.round(255 * self.support[:, :-2])), self.support[:, -2:]
        return dict(zip(PARTS, (shown, shape, self.weights, self.mean, self.spread), strict=True))

    def kernel(self, x: np.ndarray) -> np.ndarray:
        """How alike features x (m, d) and those learnt from are, (m, n)."""
        return rbf(x, self.support, GAMMA)

    def locate(self, image: np.ndarray, box: ArrayLike, camera: Camera) -> np.ndarray:
        """The place (3,) in the shoulder frame (m) of a shuttlecock in `box` (4,) of an image.

        `NoReach` when the line of sight does not meet the predicted height.
        """
        check_kind("camera", camera, Camera, "photo.camera")
        boxes = as_box(box)[None]
        centres, sides = centres_and_sides(boxes)
        alike = self.kernel(_describe(image, boxes))
        right, down, height = self.mean + self.spread * (alike @ self.weights)[0]
        return camera.back_project(centres + [right, down] * sides, height * SIDE)[0]


def _describe(image, boxes):
    """Features (n, d) of boxes (n, 4): gradients, coarse and fine, raw pixels, and log sides."""
    _, sides = centres_and_sides(boxes)
    outlines = [
        gradients(image, boxes, cells, margin=margin)
        for cells, margin in ((8, 0.0), (10, 0.25), (14, 0.1))
    ]
    pixels = crops(image, boxes, 16).reshape(len(boxes), -1)
    return np.hstack([*outlines, 0.3 * pixels, np.log(sides)])
