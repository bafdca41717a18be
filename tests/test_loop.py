"""The loop: every stage runs for real, and what goes wrong is said."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import logit

from vmc_lib import loop, photos
from vmc_lib.arm.kinematics import to_world
from vmc_lib.arm.simulate import simulate
from vmc_lib.boxes import corrected
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.what.judge import GLANCES, RIGHT_SIZE, SURE, WEIGHED, weighed
from vmc_lib.what.recogniser import NameClassifier
from vmc_lib.what.stream import MIRRORS
from vmc_lib.where.detector import Detections


@pytest.fixture(scope="module")
def model():
    return loop.VisuomotorModel.load("rig")


@pytest.fixture(scope="module")
def photo():
    return photos.load("rig", "validation")[0]


@pytest.fixture(scope="module")
def sight(model, photo):
    return loop.see(model, photo.image)


def test_a_photo_becomes_a_reach_that_calibration_improves(model, photo, sight):
    target = loop.locate(model, photo.image, sight.box, photo.camera)
    reach = loop.reach(model, target)
    planned, calibrated = (
        np.linalg.norm(motion.endpoint - reach.plan.target)
        for motion in (reach.planned, reach.calibrated)
    )
    assert calibrated < planned < 0.05
    assert np.linalg.norm(reach.hand(reach.calibrated)[-1] - target) < 0.05


def test_the_hand_is_told_in_the_frame_of_the_trunk_straight(model, photo):
    reach = loop.reach(model, photo.target, calibration=None)
    assert reach.calibrated is reach.planned
    np.testing.assert_array_equal(
        reach.hand(reach.planned), to_world(reach.planned.hand, reach.turn)
    )


def test_nothing_recognised_is_said(model, photo, sight):
    nothing = loop.Sight(sight.detections, np.zeros_like(sight.probability))
    assert nothing.box is None
    with pytest.raises(ValueError, match="no shuttlecock was recognised"):
        loop.locate(model, photo.image, nothing.box, photo.camera)


def test_a_box_without_a_camera_has_no_place(model):
    shot = photos.load("real", "train")[0]
    with pytest.raises(ValueError, match="camera is unknown"):
        loop.locate(model, shot.image, shot.boxes["shuttlecock"], shot.camera)


BOXES = np.array([[0, 0, 50, 50], [100, 0, 150, 50], [200, 0, 250, 50.0]])


JUDGE = NameClassifier(np.array([10.0, 1.0]), -5.0)


def named_at(places, named, lacks=0.0):
    """A stream's `look`: to each box the name of the nearest place; all have the same lacks."""

    def look(image, boxes, ways=None):
        nearest = np.abs(boxes[:, None] - places).sum(2).argmin(1) if len(boxes) else []
        return logit(np.take(named, nearest)), np.full((len(boxes), 4), lacks)

    return look


def looked(scores, named, judge=JUDGE, camera=None):
    """What a model sees that finds BOXES with these scores, and gives them these names."""
    scores = np.array(scores)
    boxes = BOXES[: len(scores)]
    found = Detections(boxes, scores, boxes, boxes, scores)
    detector = SimpleNamespace(detect=lambda image: found)
    recogniser = SimpleNamespace(
        chance=lambda image, boxes: np.array(named)[: len(boxes)], look=named_at(boxes, named)
    )
    image = np.random.default_rng(0).integers(0, 255, (400, 600, 3), dtype=np.uint8)
    return loop.see(loop.VisuomotorModel(detector, recogniser, None, None, judge), image, camera)


def test_where_and_what_are_weighed_together():
    sight = looked([0.9, 0.5, 0.4], [0.001, 0.97, 0.98])
    np.testing.assert_array_equal(sight.shuttlecocks, BOXES[[1, 2]])
    np.testing.assert_array_equal(sight.box, BOXES[1])
    assert sight.detections.scores.tolist() == [0.5, 0.4, 0.9]
    assert sight.told.startswith("2 shuttlecocks")
    alone = looked([0.9, 0.5, 0.4], [0.001, 0.97, 0.98], judge=None)
    np.testing.assert_array_equal(alone.shuttlecocks, BOXES[[1, 2]])


@pytest.mark.parametrize("judge", [JUDGE, None])
def test_where_size_counts_the_wrong_sizes_are_left_out_and_the_right_ones_likelier(judge):
    camera = SimpleNamespace(sizes=lambda boxes: np.array([0.07, 0.2, 0.08])[: len(boxes)])
    before, after = (looked([0.3] * 3, [0.4] * 3, judge, of) for of in (None, camera))
    np.testing.assert_array_equal(after.detections.boxes, BOXES[[0, 2]])
    odds = [one.probability[0] / (1 - one.probability[0]) for one in (before, after)]
    assert odds[1] == pytest.approx(RIGHT_SIZE * odds[0])
    nothing = looked([0.3], [0.9], judge, SimpleNamespace(sizes=lambda boxes: np.full(1, 0.3)))
    assert nothing.box is None


def test_of_many_boxes_those_that_fit_best_are_looked_at_and_the_likeliest_again():
    corners = 60.0 * np.column_stack([np.arange(60) % 10, np.arange(60) // 10])
    many, scores = np.hstack([corners, corners + 50]), np.linspace(0.9, 0.1, 60)
    found = Detections(many, scores, many, many, scores)
    asked = []

    def look(image, boxes, *ways):
        asked.append((boxes, *ways))
        return named_at(many, np.linspace(0.1, 0.5, 60), lacks=0.02)(image, boxes)

    model = loop.VisuomotorModel(
        SimpleNamespace(detect=lambda image: found), SimpleNamespace(look=look), None, None, JUDGE
    )
    sight = loop.see(model, np.zeros((400, 600, 3), np.uint8))
    (first,), (again, ways) = asked
    assert ways == MIRRORS
    np.testing.assert_array_equal(first, many[:GLANCES])
    best = np.arange(GLANCES)[::-1][:WEIGHED]
    step = np.full((WEIGHED, 4), 0.02)
    np.testing.assert_allclose(again, corrected(many[best], step))
    assert (np.diff(sight.probability) <= 0).all()
    rows = [list(scores).index(score) for score in sight.detections.scores]
    assert sorted(rows) == sorted(best)
    np.testing.assert_allclose(sight.detections.boxes, corrected(corrected(many[rows], step), step))


def test_of_boxes_that_come_to_lie_on_each_other_one_is_kept():
    boxes = np.array([[0, 0, 50, 50], [2, 0, 52, 50], [200, 0, 250, 50.0]])
    found = Detections(boxes, np.ones(3), boxes, boxes, np.ones(3))
    stream = SimpleNamespace(look=named_at(boxes, [0.7, 0.9, 0.8]))
    kept, told = weighed(found, stream, None)
    np.testing.assert_array_equal(kept, boxes[[1, 2]])
    np.testing.assert_allclose(told, np.column_stack([[1, 1], logit([0.9, 0.8])]))


def test_a_judge_speaks_up_from_the_chance_that_validation_set():
    [fair] = looked([0.5], [0.45]).probability
    assert SURE < fair < 0.5
    assert looked([0.5], [0.45]).told.startswith("1 shuttlecock")
    assert looked([0.5], [0.45], judge=None).box is None


def test_who_is_unsure_abstains_and_says_what_was_seen():
    unsure = looked([0.3, 0.2], [0.6, 0.5])
    assert unsure.box is None
    assert unsure.told.startswith("no shuttlecock, but 2 things")
    assert looked([0.3], [0.6]).told.startswith("no shuttlecock, but 1 thing;")
    blind = looked(np.empty(0), np.empty(0))
    assert blind.told == "nothing that looks like an object"


def test_a_place_out_of_reach_is_said(model):
    with pytest.raises(ValueError, match="reach"):
        loop.reach(model, np.array([2.0, -0.4, 0.1]))


def test_a_reach_is_simulated_once_a_command(model, photo, monkeypatch):
    """One planned movement and 21 tried off-line; the best of them need not be made again."""
    made = []

    def counted(excitations, *rest, **named):
        made.append(np.prod(excitations.shape[:-2], dtype=int))
        return simulate(excitations, *rest, **named)

    monkeypatch.setattr(templates, "simulate", counted)
    reach = loop.reach(model, photo.target)
    assert sum(made) == 22
    np.testing.assert_array_equal(execute(reach.plan).motion.q, reach.planned.q)
    [best] = execute(reach.plan.with_weights(loop.RULES["published"](reach.plan).best[None])).motion
    np.testing.assert_allclose(best.q, reach.calibrated.q, atol=1e-5)


def test_what_is_shared_cannot_be_written_to(model):
    for array in (model.template_set.points, model.template_set.excitations):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
