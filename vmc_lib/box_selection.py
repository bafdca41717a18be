"""Choose among detections by physical size, where the camera is known.

Size is evidence, and evidence adds up as log-odds (Bayes' rule). Both constants were set on
validation photos.
"""

from dataclasses import replace

import numpy as np

from vmc_lib.camera import Camera
from vmc_lib.checks import as_numbers, check_kind
from vmc_lib.short_repr import short
from vmc_lib.where.detector import Detections

SIZES = (0.05, 0.092)  # m: smallest and largest physical size of a shuttlecock in its box
SIZE_LIKELIHOOD_RATIO = 5  # how much more often a shuttlecock's box is of these sizes than another


def filter_by_size(detections: Detections, camera: Camera) -> Detections:
    """The `Detections` whose boxes, seen by a `Camera`, are of a shuttlecock's physical size."""
    check_kind("detections", detections, Detections, "what a detector's detect(image) returns")
    check_kind("camera", camera, Camera, "photo.camera")
    smallest, largest = SIZES
    size = camera.sizes(detections.boxes)
    right = (size > smallest) & (size < largest)
    return replace(detections, boxes=detections.boxes[right], scores=detections.scores[right])


def scale_odds(probability: np.ndarray, ratio: float) -> np.ndarray:
    """Multiply the odds of probabilities (n,) by a likelihood ratio (Bayes' rule)."""
    probability, ratio = as_numbers("probability", probability), as_numbers("ratio", ratio)
    if not (
        np.all((probability >= 0) & (probability <= 1)) and np.all((ratio >= 0) & (ratio < np.inf))
    ):
        given = f"{short(probability)}, ratio {short(ratio)}"
        raise ValueError(f"probability {given}: give 0 to 1, and a finite ratio, 0 or more")
    return probability * ratio / (probability * ratio + 1 - probability)
