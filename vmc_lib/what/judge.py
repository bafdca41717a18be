"""Both pathways weighed: which of the boxes that *where* keeps does *what* take for a shuttlecock?

How well a box fits, what it shows, and how large that is where the camera is known: each is
evidence, and evidence adds up as log-odds (Bayes' rule).
"""

from dataclasses import replace

import numpy as np
from scipy.special import expit, logit

from vmc_lib.boxes import corrected, nms
from vmc_lib.what.stream import MIRRORS

# How many boxes, those that fit best, are looked at, how many of them again, and the chance of
# being a shuttlecock's from which a box is chosen; set on validation photos
GLANCES, WEIGHED, SURE = 48, 8, 0.4
# How large what is in a shuttlecock's box can be (m), and how many times as often as another box
# it is of that size; set on validation photos
SIZES, RIGHT_SIZE = (0.05, 0.092), 5


def weighed(found, stream, image):
    """The boxes of an image's `Detections` to choose from, and what both pathways say of each.

    A `VentralStream` looks at the GLANCES that fit best, and again, in all MIRRORS, at the WEIGHED
    likeliest of them, as it has tightened them. Of those that then lie on each other the likeliest
    is kept. Returns boxes (n, 4), tightened once more; and, (n, 2), how well each fitted, and the
    log-odds of its name.
    """
    boxes, scores = found.boxes[:GLANCES], found.scores[:GLANCES]
    odds, lacks = stream.look(image, boxes)
    best = np.argsort(-odds, kind="stable")[:WEIGHED]
    boxes = corrected(boxes[best], lacks[best])
    odds, lacks = stream.look(image, boxes, MIRRORS)
    boxes = corrected(boxes, lacks)
    kept = nms(boxes, odds)
    return boxes[kept], np.column_stack([scores[best], odds])[kept]


def sized(found, camera):
    """Of `Detections`, the boxes that are of a shuttlecock's size where a `Camera` stands."""
    smallest, largest = SIZES
    size = camera.sizes(found.boxes)
    right = (size > smallest) & (size < largest)
    return replace(found, boxes=found.boxes[right], scores=found.scores[right])


def likelier(chance, times):
    """Chances (n,), their odds so many times as high."""
    return expit(logit(chance) + np.log(times))
