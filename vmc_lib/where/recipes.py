"""Detector recipes: the paper's; with a single hierarchy; five that each add an idea to the last.

A further one is for photographs.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.where.features import gradients, pixels_in_context, raw_pixels

FEATURES: dict[str, Callable[..., np.ndarray]] = {
    "pixels": raw_pixels,
    "8 pixels": partial(raw_pixels, size=8),
    "32 pixels": partial(raw_pixels, size=32),
    "context": pixels_in_context,
    "gradients": gradients,
}


@dataclass(frozen=True)
class Recipe:
    """Settings of an object detector; the defaults are our reading of the paper.

    It prints no strategy and no C, nor that crops shrink to 16 × 16 pixels: these are ours.
    """

    strategy: str = "diverse"  # of selective search
    features: str = "pixels"  # one of FEATURES
    kernel: str = "linear"
    cost: float = 0.1  # C of the SVM
    gate: float = 0.0  # candidates that score above it pass
    jittered: int = 0  # more positives for each object: its true box, jittered
    mirror: bool = False  # train on flipped photos too
    regressions: tuple = ()  # rounds of box regression: the jitter, in sides, each is trained for
    boxes: int = 12_800  # that each round is trained on, and the IoU predictor on twice as many
    predicts_iou: bool = False  # regressed boxes score their predicted IoU
    windows: tuple = ()  # sides of sliding windows that pass whatever they score, pixels
    vote: bool = False  # box voting after non-maximum suppression
    overlap: float = 0.3  # that non-maximum suppression allows

    def describe(self, image: np.ndarray, boxes: ArrayLike) -> np.ndarray:
        """The features (n, d) of boxes (n, 4) of an image."""
        if not isinstance(self.features, str) or self.features not in FEATURES:
            raise ValueError(f"features {self.features!r} are none of {', '.join(FEATURES)}")
        return FEATURES[self.features](image, boxes)


PUBLISHED = Recipe()
SINGLE = replace(PUBLISHED, strategy="single", cost=0.025)  # 0.1, were pixels from 0 to 1
CONTEXT = replace(SINGLE, features="context", cost=0.1, jittered=5, mirror=True, gate=-1)
GRADIENTS = replace(CONTEXT, features="gradients")
REGRESSED = replace(GRADIENTS, strategy="finer", regressions=(0.15, 0.1, 0.07, 0.05))
PREDICTED = replace(REGRESSED, predicts_iou=True)
IMPROVED = replace(PREDICTED, vote=True)
# Real things differ more: more candidates, and a stream is still to look at all that pass. Under
# strings no region has a shuttlecock's outline, so windows pass, too (both chosen on validation)
PHOTOGRAPHED = replace(GRADIENTS, strategy="fast", windows=(130, 210, 330), overlap=1.0)
RECIPES = {
    "published": PUBLISHED,
    "single": SINGLE,
    "context": CONTEXT,
    "gradients": GRADIENTS,
    "box regression": REGRESSED,
    "IoU prediction": PREDICTED,
    "improved": IMPROVED,
}
EVERY_RECIPE = RECIPES | {"photographed": PHOTOGRAPHED}  # the last for the level "real" alone
# These do less with the same training
TRAINED_AS = {"box regression": "improved", "IoU prediction": "improved"}
