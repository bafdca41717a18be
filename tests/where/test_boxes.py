import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vmc_lib.where.boxes import as_boxes, iou, nms

coordinate = st.integers(-50, 700)
box = st.builds(
    lambda x, y, w, h: (x, y, x + w, y + h), coordinate, coordinate, *[st.integers(0, 300)] * 2
)
crowd = st.lists(box, max_size=30).map(as_boxes)


def test_iou_by_hand():
    a = [(0, 0, 10, 10)]
    b = [(0, 0, 10, 10), (5, 0, 15, 10), (20, 20, 30, 30), (10, 0, 20, 10), (0, 0, 10, 5)]
    assert iou(a, b) == pytest.approx(np.array([[1, 1 / 3, 0, 0, 0.5]]))


@given(crowd, crowd)
def test_iou_is_a_symmetric_share(a, b):
    shares = iou(a, b)
    assert shares.shape == (len(a), len(b))
    assert ((shares >= 0) & (shares <= 1)).all()
    assert (shares == iou(b, a).T).all()


@given(box)
def test_a_box_agrees_with_itself_unless_it_is_empty(one):
    has_area = one[2] > one[0] and one[3] > one[1]
    assert iou(one, one) == float(has_area)


@given(crowd, st.floats(0, 1))
def test_nms_keeps_no_overlaps_and_explains_every_loss(boxes, overlap):
    scores = np.random.default_rng(len(boxes)).permutation(len(boxes)).astype(float)
    kept = nms(boxes, scores, overlap)
    assert (np.diff(scores[kept]) < 0).all()
    between = iou(boxes[kept], boxes[kept])
    assert (between[np.triu_indices(len(kept), 1)] <= overlap).all()
    for lost in set(range(len(boxes))) - set(kept):
        better = kept[scores[kept] > scores[lost]]
        assert (iou(boxes[better], boxes[lost]) > overlap).any()


@pytest.mark.parametrize("overlap", [0.1, 0.3, 0.5, 0.8])
def test_nms_agrees_with_opencv(overlap):
    rng = np.random.default_rng(1)
    corner, sides = rng.integers(0, 400, (200, 2)), rng.integers(20, 200, (200, 2))
    scores = rng.permutation(200) / 200 + 0.001
    theirs = cv2.dnn.NMSBoxes(np.hstack([corner, sides]).tolist(), scores.tolist(), 0, overlap)
    assert nms(np.hstack([corner, corner + sides]), scores, overlap).tolist() == list(theirs)


def test_ties_go_to_the_earlier_box():
    assert nms([(0, 0, 9, 9)] * 3, [1, 2, 2]).tolist() == [1]


def test_nothing_in_nothing_out():
    assert nms([], []).shape == (0,)
    assert iou([], [(0, 0, 1, 1)]).shape == (0, 1)


@pytest.mark.parametrize(
    "bad", [(3, 0, 1, 5), (0, 0, np.nan, 1), (0, 0, np.inf, 1), (1, 2, 3), [[[0, 0, 1, 1]]]]
)
def test_boxes_that_are_no_boxes(bad):
    with pytest.raises(ValueError, match="box"):
        iou(bad, [(0, 0, 1, 1)])


@pytest.mark.parametrize("scores", [[1.0], [1.0, 2.0, 3.0], [np.nan, 1.0]])
def test_one_finite_score_a_box(scores):
    with pytest.raises(ValueError, match="scores"):
        nms([(0, 0, 1, 1), (0, 0, 2, 2)], scores)
