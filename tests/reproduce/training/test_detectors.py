from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from reproduce import paper
from reproduce.training.detectors import (
    best_threshold,
    candidates,
    fit_detector,
    labelled_candidates,
    svm_training_set,
    training_images,
    with_best_threshold,
)
from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.data import arrays
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import IMPROVED, PUBLISHED, RECIPES
from vmc_lib.where.selective_search import propose


@pytest.mark.parametrize("strategy", ["diverse", "single", "finer"])
def test_shipped_candidates_are_proposed_again(photo, strategy):
    """Most of them: another processor may round a pixel differently."""
    stored, boxes = candidates(photo, strategy), propose(photo.image, strategy)
    assert arrays("candidates")[f"{photo.name}/{strategy}"].dtype == np.int16
    shipped, again = ({tuple(box) for box in boxes} for boxes in (stored, boxes))
    assert len(shipped & again) > 0.9 * len(shipped | again)
    assert (candidates(replace(photo, name="mine"), strategy) == boxes).all()


def test_candidates_of_another_folders_photo_are_its_own(photo, tmp_path):
    """Even where a photo of that name ships."""
    Image.new("RGB", (600, 400)).save(blank := tmp_path / "000.png")
    assert candidates(replace(photo, file=blank)).tolist() == [[0, 0, 600, 400]]


def test_a_photo_is_searched_once(photo):
    assert candidates(photo) is candidates(photo)


def test_diverse_grouping_is_fitted_to_the_papers_number_of_boxes():
    counts = [len(candidates(photo, "diverse")) for photo in photos.load("rig", "train")]
    assert np.mean(counts) == pytest.approx(paper.BOXES_PER_PHOTO, abs=1)


def test_examples_are_clear_cases(photo):
    x, y = labelled_candidates([photo])
    overlap = iou(candidates(photo), list(photo.boxes.values())).max(1)
    assert x.shape == (len(y), 768)
    assert y.sum() == (overlap >= 0.8).sum() > 0
    assert (~y).sum() == (overlap <= 0.5).sum() > 50


def test_training_set_sizes(photo):
    """Every example, so many shaken boxes an object, and no more counter-examples than asked."""
    recipe = replace(PUBLISHED, jittered=5, mirror=True)
    images = training_images([photo] * 30, recipe)
    x, y = svm_training_set(images, recipe, np.random.default_rng(0))
    good = (images[0].overlap >= 0.8).sum()
    assert x.shape == (len(y), 768)
    assert y.sum() == 60 * (good + 10)
    assert (~y).sum() == 60 * min(79, (images[0].overlap <= 0.5).sum())


def test_mirrored_image_has_equal_overlaps(photo):
    images = training_images([photo], replace(PUBLISHED, mirror=True))
    assert len(images) == 2
    assert (images[0].overlap == images[1].overlap).all()
    assert (images[1].pixels[:, 0] == photo.image[:, -1]).all()
    again = images[1].mirror()
    assert (again.truth == images[0].truth).all()
    assert (again.candidates == images[0].candidates).all()


@pytest.mark.parametrize("name", ["published", "single", "context"])
def test_training_again_gives_the_detector_that_ships(name):
    few = photos.load("rig", "train")
    trained, shipped = (fit_detector(few, RECIPES[name]), ObjectDetector.load("rig", name))
    assert trained.svm.support == pytest.approx(shipped.svm.support, abs=1e-3)
    assert trained.svm.bias == pytest.approx(shipped.svm.bias, abs=1e-3)


def test_fit_is_repeatable():
    small = replace(IMPROVED, strategy="single", boxes=200)
    few = photos.load("rig", "train")[:4]
    once, again, other = (
        fit_detector(few, small, np.random.default_rng(seed)).parts() for seed in (1, 1, 2)
    )
    for part, value in once.items():
        np.testing.assert_array_equal(value, again[part])
    for part in ("regression 0/weights", "iou predictor/weights"):
        assert not np.array_equal(once[part], other[part])


def test_tuning_moves_the_threshold_alone(photo):
    detector = ObjectDetector.load("rig", "gradients")
    again = with_best_threshold(detector, [photo])
    assert replace(again, threshold=detector.threshold) == detector
    published = ObjectDetector.load("rig", "published")
    assert with_best_threshold(published, [photo]) is published
    assert published.threshold == 0


def test_the_best_threshold_by_hand():
    scores, right = np.array([0.0, 3, 1, 2]), np.array([True, True, False, True])
    assert best_threshold(scores, right, 2) == 1.5  # 2 of 2, none wrong
    assert best_threshold(scores, right, 9) == -np.inf  # the more the better
    with pytest.raises(ValueError, match="found"):
        best_threshold(np.empty(0), np.empty(0, bool), 2)


def test_equal_scores_are_taken_together():
    scores, right = np.array([2.0, 2, 1]), np.array([True, True, False])
    assert best_threshold(scores, right, 2) == 1.5
    assert best_threshold(scores, right[::-1], 2) == -np.inf


@given(st.lists(st.tuples(st.integers(-9, 9), st.booleans()), min_size=1))
def test_no_threshold_is_better_than_the_best(pairs):
    scores, right = map(np.array, zip(*pairs, strict=True))

    def f1(threshold):
        taken = scores > threshold
        return 2 * (right & taken).sum() / (taken.sum() + right.sum() + 1)

    best = best_threshold(scores.astype(float), right, right.sum() + 1)
    assert f1(best) >= max(f1(s - 0.5) for s in scores) - 1e-9
