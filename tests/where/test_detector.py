import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vmc_lib.boxes import area, as_boxes, iou
from vmc_lib.where.detector import ObjectDetector, window_grid
from vmc_lib.where.recipes import PHOTOGRAPHED, RECIPES


def test_each_step_leaves_fewer_boxes(photo):
    detector = ObjectDetector.load("rig", "published")
    detections = detector.detect(photo.image)
    counts = list(detections.counts.values())
    assert counts[0] > counts[1] >= counts[2] > 0
    assert (detector.score(photo.image, detections.passed) > 0).all()
    assert (np.diff(detections.scores) <= 0).all()
    between = iou(detections.boxes, detections.boxes)
    assert between[np.triu_indices(len(detections.boxes), 1)].max(initial=0) <= 0.3
    assert detector.score(photo.image, detections.boxes) == pytest.approx(detections.scores)


def test_candidates_may_be_a_list(photo):
    detector, box = ObjectDetector.load("rig", "published"), [300, 200, 360, 280]
    assert detector.detect(photo.image, [box]).candidates.tolist() == [box]
    with pytest.raises(ValueError, match="box"):
        detector.detect(photo.image, [[0, 0, np.nan, 1]])


@pytest.mark.parametrize("name", RECIPES)
def test_nothing_is_detected_in_blank_images(name):
    detector = ObjectDetector.load("rig", name)
    blank = np.full((400, 600, 3), 128, np.uint8)
    for boxes in (None, np.empty((0, 4)), []):
        detections = detector.detect(blank, boxes)
        assert detections.boxes.shape == (0, 4)
        assert detections.scores.shape == (0,)


anywhere = st.builds(
    lambda x, y, w, h: (x, y, x + w, y + h),
    *[st.integers(-300, 900)] * 2,
    *[st.sampled_from([0, 1, 60, 700])] * 2,
)


@settings(max_examples=15, deadline=None)
@given(st.lists(anywhere, max_size=8).map(as_boxes), st.sampled_from(["published", "improved"]))
def test_candidates_of_no_area_or_beyond_the_image(photo, boxes, name):
    """Whatever the candidates, what is kept are boxes: finite, none inside out."""
    detections = ObjectDetector.load("rig", name).detect(photo.image, boxes)
    assert len(detections.candidate_scores) == len(boxes)
    assert as_boxes(detections.boxes).shape == (len(detections.scores), 4)
    assert np.isfinite(detections.scores).all()


@pytest.mark.parametrize("image", [np.zeros((40, 60)), np.zeros((40, 60, 3)), np.uint8([[1, 2]])])
def test_images_of_other_types_are_refused(image):
    with pytest.raises(ValueError, match="read_image"):
        ObjectDetector.load("rig").score(image, [(0, 0, 30, 30)])


def test_unknown_detectors_are_refused():
    recipes = "published, single, context, gradients, box regression, IoU prediction, improved$"
    for level, name, remedy in (
        ("rig", "best", recipes),
        ("real", "published", "from photographed$"),
        ("attic", "published", "rig, free, varied, real$"),
    ):
        with pytest.raises(ValueError, match=remedy):
            ObjectDetector.load(level, name)


def test_windows_cover_an_image_and_pass_whatever_they_score():
    windows = window_grid(400, 600, (130, 330))
    assert windows.min() == 0
    np.testing.assert_array_equal(windows.max(0)[2:], [600, 400])
    assert (area(windows) <= 330**2).all()
    for side, box in ((130, [411, 222, 541, 352]), (330, [270, 70, 600, 400])):
        assert iou(np.array([box]), windows).max() > 0.5, side
    blank = np.zeros((400, 600, 3), np.uint8)
    found = ObjectDetector.load("real", "photographed").detect(blank)
    np.testing.assert_array_equal(found.passed, window_grid(400, 600, PHOTOGRAPHED.windows))
