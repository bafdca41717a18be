import cv2
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from vmc_lib.boxes import (
    area,
    as_boxes,
    decode_deltas,
    encode_deltas,
    iou,
    jitter_boxes,
    nms,
    pad_boxes,
    vote,
)

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
def test_iou_of_a_box_with_itself_is_1_unless_it_is_empty(one):
    has_area = one[2] > one[0] and one[3] > one[1]
    assert iou(one, one) == float(has_area)


@given(crowd, st.floats(0, 1))
def test_nms_drops_a_box_only_for_a_better_neighbour(boxes, overlap):
    scores = np.random.default_rng(len(boxes)).permutation(len(boxes)).astype(float)
    rows = nms(boxes, scores, overlap)
    assert (np.diff(scores[rows]) < 0).all()
    between = iou(boxes[rows], boxes[rows])
    assert (between[np.triu_indices(len(rows), 1)] <= overlap).all()
    for lost in set(range(len(boxes))) - set(rows):
        better = rows[scores[rows] > scores[lost]]
        assert (iou(boxes[better], boxes[lost]) > overlap).any()


@given(crowd, st.sampled_from([0.1, 0.3, 0.5, 0.8]))
def test_nms_agrees_with_opencv(boxes, overlap):
    """Where nothing hangs on rounding: no two scores alike, no IoU at the very limit."""
    boxes = boxes[area(boxes) > 0]
    assume(len(boxes) and abs(iou(boxes, boxes) - overlap).min() > 1e-4)
    scores = np.random.default_rng(len(boxes)).permutation(len(boxes)) / 100 + 0.01
    corners_and_sides = np.hstack([boxes[:, :2], boxes[:, 2:] - boxes[:, :2]]).astype(int)
    theirs = cv2.dnn.NMSBoxes(corners_and_sides.tolist(), scores.tolist(), 0, overlap)
    assert nms(boxes, scores, overlap).tolist() == list(theirs)


@given(box, box)
def test_iou_agrees_with_opencv(a, b):
    """OpenCV has no IoU, but the shared polygon of two rectangles, and its area."""
    boxes = as_boxes([a, b])
    assume((area(boxes) > 0).all())
    corners = [
        np.float32([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]) for x0, y0, x1, y1 in boxes.tolist()
    ]
    shared, _ = cv2.intersectConvexConvex(*corners)
    assert iou(a, b).item() == pytest.approx(shared / (area(boxes).sum() - shared), abs=1e-4)


def test_nms_keeps_boxes_without_area():
    """They overlap nothing, not even themselves, so that nothing silences them."""
    assert nms([(3, 3, 3, 3)] * 2 + [(0, 0, 9, 0)], [1, 3, 2]).tolist() == [1, 2, 0]


def test_nms_prefers_the_earlier_of_equal_scores():
    assert nms([(0, 0, 9, 9)] * 3, [1, 2, 2]).tolist() == [1]


def test_nms_keeps_a_box_exactly_at_the_limit():
    pair = [(0, 0, 10, 10), (0, 0, 10, 5)]
    assert nms(pair, [2, 1], overlap=0.5).tolist() == [0, 1]
    assert nms(pair, [2, 1], overlap=np.nextafter(0.5, 0)).tolist() == [0]


def test_no_boxes_give_no_boxes():
    assert nms([], []).shape == (0,)
    assert iou([], [(0, 0, 1, 1)]).shape == (0, 1)


@pytest.mark.parametrize(
    "bad", [(3, 0, 1, 5), (0, 0, np.nan, 1), (0, 0, np.inf, 1), (1, 2, 3), [[[0, 0, 1, 1]]]]
)
def test_iou_refuses_wrong_boxes(bad):
    with pytest.raises(ValueError, match="box"):
        iou(bad, [(0, 0, 1, 1)])


@pytest.mark.parametrize("scores", [[1.0], [1.0, 2.0, 3.0], [np.nan, 1.0]])
def test_nms_needs_one_finite_score_a_box(scores):
    with pytest.raises(ValueError, match="scores"):
        nms([(0, 0, 1, 1), (0, 0, 2, 2)], scores)


def test_nms_names_the_value_that_it_cannot_take():
    with pytest.raises(ValueError, match="not \\[nan\\]"):
        nms([(0, 0, 1, 1)], [np.nan])
    for overlap in (np.nan, -0.1, 30):
        with pytest.raises(ValueError, match=f"overlap = {overlap}"):
            nms([(0, 0, 1, 1)], [1], overlap)


def test_vote_moves_a_box_towards_its_neighbours():
    crowd = np.array([[0, 0, 10, 10], [0, 0, 12, 10], [50, 50, 60, 60]], float)
    voted = vote(np.array([0]), crowd, np.array([2.0, 2.0, 3.0]))
    assert voted == pytest.approx(np.array([[0, 0, 11, 10]]))
    lagging = vote(np.array([0]), crowd, np.array([2.0, 0.0, 3.0]))
    assert lagging == pytest.approx(crowd[:1], abs=1e-3)


def test_a_box_votes_from_half_an_overlap_on():
    rows = np.array([[0, 0, 10, 10], [0, 0, 10, 5], [0, 0, 10, 4]], float)
    assert iou(rows[0], rows)[0] == pytest.approx([1, 0.5, 0.4])
    assert vote(np.array([0]), rows, np.ones(3)) == pytest.approx(np.array([[0, 0, 10, 7.5]]))


def test_no_vote_outweighs_the_box_it_is_for():
    """The middle box, silenced by the first, scored higher than the last, and has no vote on it."""
    row = np.array([[0, 0, 10, 10], [3, 0, 13, 10], [6, 0, 16, 10]], float)
    scores = np.array([3.0, 2.9, 1.0])
    rows = nms(row, scores)
    assert rows.tolist() == [0, 2]
    assert iou(row[1], row[rows]).min() > 0.5
    first, last = vote(rows, row, scores, temperature=0.2)
    assert first[0] > 1
    assert (last == row[2]).all()


def test_a_box_without_area_has_its_own_vote():
    point = as_boxes([3, 3, 3, 3])
    assert (vote(np.array([0]), point, np.array([1.0])) == point).all()


solid = st.builds(
    lambda x, y, w, h: np.array([[x, y, x + w, y + h]], float),
    *[st.integers(0, 300)] * 2,
    *[st.integers(5, 200)] * 2,
)


@given(solid, solid)
def test_decode_deltas_inverts_encode_deltas(box, true):
    assert decode_deltas(box, encode_deltas(box, true)) == pytest.approx(true, abs=1e-6)


def test_pad_boxes_by_a_share_of_the_sides():
    assert pad_boxes([(10, 10, 30, 50)], 0.25).tolist() == [[5, 0, 35, 60]]


def test_jitter_is_in_proportion_to_the_sides():
    boxes = np.tile([0.0, 0, 100, 10], (4000, 1))
    strays = jitter_boxes(boxes, 0.08, np.random.default_rng(0)) - boxes
    assert strays.std(0) == pytest.approx([8, 0.8, 8, 0.8], rel=0.05)
    one = jitter_boxes(boxes[0], 0.08, np.random.default_rng(0))
    assert (one == (boxes + strays)[0]).all()
