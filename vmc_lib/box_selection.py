"""Choose among detections by combining detector score, recogniser log-odds and physical size.

Each is evidence, and evidence adds up as log-odds (Bayes' rule). All constants were set on
validation photos.
"""

from dataclasses import dataclass, replace

import numpy as np

from vmc_lib.boxes import decode_deltas, nms
from vmc_lib.short_repr import short_repr
from vmc_lib.what.recogniser import NameClassifier
from vmc_lib.what.stream import FLIPS, VentralStream

N_FIRST_PASS = 48  # boxes, those of the best scores, that the stream looks at
N_SECOND_PASS = 8  # of them, those that it looks at again, refined
MIN_PROBABILITY = 0.4  # of being a shuttlecock's, above which a box is chosen
SIZES = (0.05, 0.092)  # m: smallest and largest physical size of a shuttlecock in its box
SIZE_LIKELIHOOD_RATIO = 5  # how much more often a shuttlecock's box is of these sizes than another


@dataclass(frozen=True, eq=False)
class BoxSelector:
    """A recogniser for photographs: a deep stream, and a classifier of what both pathways say.

    classifier: of (detector score, log-odds of the stream).
    """

    stream: VentralStream
    classifier: NameClassifier
    min_probability = MIN_PROBABILITY

    __repr__ = short_repr

    @classmethod
    def load(cls):
        """The selector that ships with the book."""
        return cls(VentralStream.load(), NameClassifier.load("photographs", "judge"))

    def box_probability(self, image, boxes):
        """The stream's probability (n,) that each of the boxes (n, 4) shows a shuttlecock."""
        return self.stream.box_probability(image, boxes)

    def select(self, image, detections):
        """The refined `Detections`, the most probable first, and their probabilities (n,)."""
        boxes, evidence = rescore_boxes(self.stream, image, detections)
        probability = self.classifier.probability(evidence)
        order = np.argsort(-probability, kind="stable")
        best = replace(detections, boxes=boxes[order], scores=evidence[order, 0])
        return best, probability[order]


def rescore_boxes(stream, image, detections):
    """Rescore and refine the boxes of an image's `Detections` with a `VentralStream`.

    It looks at the N_FIRST_PASS of the best scores; then at the N_SECOND_PASS most probable of
    them, refined, in all FLIPS. Non-maximum suppression keeps the most probable. Returns boxes
    (n, 4), refined once more, and (n, 2) their detector scores and log-odds.
    """
    boxes, scores = detections.boxes[:N_FIRST_PASS], detections.scores[:N_FIRST_PASS]
    log_odds, deltas = stream.predict(image, boxes)
    best = np.argsort(-log_odds, kind="stable")[:N_SECOND_PASS]
    boxes = decode_deltas(boxes[best], deltas[best])
    log_odds, deltas = stream.predict(image, boxes, FLIPS)
    boxes = decode_deltas(boxes, deltas)
    kept = nms(boxes, log_odds)
    return boxes[kept], np.column_stack([scores[best], log_odds])[kept]


def filter_by_size(detections, camera):
    """The `Detections` whose boxes, seen by a `Camera`, are of a shuttlecock's physical size."""
    smallest, largest = SIZES
    size = camera.sizes(detections.boxes)
    right = (size > smallest) & (size < largest)
    return replace(detections, boxes=detections.boxes[right], scores=detections.scores[right])


def scale_odds(probability, ratio):
    """Multiply the odds of probabilities (n,) by a likelihood ratio (Bayes' rule)."""
    return probability * ratio / (probability * ratio + 1 - probability)
