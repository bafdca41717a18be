"""On photos that the shipped detector never saw."""

from dataclasses import replace

import numpy as np
import pytest

from reproduce.training import detectors
from reproduce.training.detectors import training_images
from vmc_lib import photos
from vmc_lib.boxes import decode_deltas, iou
from vmc_lib.where import box_regression
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import IMPROVED


@pytest.fixture(scope="module")
def detector():
    return ObjectDetector.load("rig")


def astray(photo, by):
    """A photo's true boxes, and boxes off by so many sides."""
    truth = np.array(list(photo.boxes.values()))
    return truth, decode_deltas(truth, np.tile(by, (len(truth), 1)))


def test_box_regression_brings_a_box_nearer(detector):
    first, rest = [], []
    for photo in photos.load("rig", "validation")[:5]:
        truth, off = astray(photo, [0.2, -0.2, 0.1, 0.1])
        boxes = [detector.regress(photo.image, off, n) for n in (0, 1, 4)]
        before, once, again = (np.diag(iou(b, truth)).mean() for b in boxes)
        first.append(once - before)
        rest.append(again - once)
    assert np.mean(first) > 0.05
    assert np.mean(rest) > 0.05


def test_predicted_iou_is_higher_for_a_fit_than_for_a_near_miss(detector):
    """Boxes off by a sixth score below the true ones, mostly."""
    better = []
    for photo in photos.load("rig", "validation")[:10]:
        boxes = astray(photo, [0.15, 0.1, 0, 0])
        fits, misses = (
            detector.iou_predictor.predict(detector.recipe.describe(photo.image, some))
            for some in boxes
        )
        better += list(fits > misses)
    assert np.mean(better) > 0.9


def test_a_photo_without_objects_trains_the_iou_predictor(detector):
    """Candidates beside no object at all are counter-examples, like others far from one."""
    quick = replace(IMPROVED, mirror=False, boxes=300)
    images = training_images(photos.load("rig", "train")[:3], quick)
    bare = replace(images[0], truth=np.empty((0, 4)))
    iou_predictor = detectors.fit_iou_predictor(
        [*images, bare], quick, detector.svm, detector.regressions, np.random.default_rng(0)
    )
    assert iou_predictor.axes.shape == (800, box_regression.DIRECTIONS)
    rows = (IMPROVED.describe(images[0].pixels, b) for b in (bare.candidates, images[0].truth))
    bared, objects = (iou_predictor.predict(x).mean() for x in rows)
    assert bared < 0.2 < objects
