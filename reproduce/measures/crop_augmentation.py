"""Data augmentation of few crops: what names learnt from ten photos gain by each change."""

from functools import partial

import cv2
import numpy as np

from reproduce.training.name_classifier import fit_name_classifier
from vmc_lib import photos
from vmc_lib.boxes import centres_and_sides, jitter_boxes
from vmc_lib.statistics import wilson
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import read_outs

SINGLE = {
    "light": {"light": 0.3},
    "jittered": {"jitter": 0.08},
    "mirror": {"mirror": True},
    "tilted": {"tilt": 15.0},
}
AUGMENTATIONS = (
    {"none": {}}
    | SINGLE
    | {"all four": {name: strength for how in SINGLE.values() for name, strength in how.items()}}
)
SHOTS, COPIES = 10, 2  # photos to learn from, and crops of each box


def augmented_crop(photo, box, rng, jitter=0, mirror=False, tilt=0, light=0):
    """A crop (200, 200) of a box: edges jittered, picture tilted, in other light, mirrored.

    `jitter` in sides, `tilt` in degrees, `light` as a logarithm, all standard deviations.
    """
    box = jitter_boxes(box, jitter, rng)
    centre, _ = centres_and_sides(box)
    turn = cv2.getRotationMatrix2D(tuple(centre), rng.normal(0, tilt), 1)
    size = photos.WIDTH, photos.HEIGHT
    image = cv2.warpAffine(photo.image, turn, size, borderMode=cv2.BORDER_REFLECT)
    picture = crop(image, box) * np.exp(rng.normal(0, light))
    return picture[:, ::-1] if mirror and rng.random() < 0.5 else picture


def labelled_features(cdbn, shots, copies, rng, **how):
    """Features (n, d) and labels (n,) of augmented crops of all objects, `copies` of each."""
    boxes = [(photo, *pair) for photo in shots for pair in photo.boxes.items()] * copies
    crops = (augmented_crop(photo, box, rng, **how) for photo, _, box in boxes)
    return read_outs(cdbn, crops)["P1 + P2"], np.array([k == "shuttlecock" for _, k, _ in boxes])


def accuracies():
    """Named right after each of the AUGMENTATIONS, and how it changes what the network sees.

    Two dicts: (share, low, high) of half the other training photos, Wilson's 95 %; and the largest
    change of a feature. The test photos are kept for the numbers on record.
    """
    rng, shots = np.random.default_rng(0), photos.load("varied", "train")
    features = partial(labelled_features, CDBN.load(), rng=rng)
    exam, truth = features(shots[SHOTS::2], 1)
    validation = features(photos.load("varied", "validation"), 1)
    plain, _ = features(shots[:SHOTS], COPIES)
    named, change = {}, {}
    for name, how in AUGMENTATIONS.items():
        x, y = features(shots[:SHOTS], COPIES if how else 1, **how)
        chances = fit_name_classifier(x, y, *validation).probability(exam)
        right = ((chances > 0.5) == truth).sum()
        named[name] = right / len(truth), *wilson(right, len(truth))
        change[name] = abs(x - plain[: len(x)]).max()
    return named, change
