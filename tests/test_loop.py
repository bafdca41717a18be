"""The loop: every stage runs for real, and what goes wrong is said."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import logit

from book.figures.loop import describe_end, meets_cup
from vmc_lib import loop, photos
from vmc_lib.arm.arm26 import geometry
from vmc_lib.arm.kinematics import to_world
from vmc_lib.arm.simulate import simulate
from vmc_lib.box_selection import SIZE_LIKELIHOOD_RATIO
from vmc_lib.boxes import decode_deltas
from vmc_lib.camera import TABLE, Camera
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.show import props
from vmc_lib.show.arm import beyond_wrist
from vmc_lib.what.recogniser import Recogniser
from vmc_lib.what.stream import (
    FLIPS,
    MIN_PROBABILITY,
    N_LOOKS,
    N_REFINED,
    VentralStream,
)
from vmc_lib.where.detector import Detections


@pytest.fixture(scope="module")
def model():
    return loop.VisuomotorModel.load("rig")


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
    assert np.linalg.norm(reach.endpoint(reach.calibrated) - target) < 0.05


def test_the_hand_path_is_in_the_frame_of_the_straight_trunk(model, photo):
    reach = loop.reach(model, photo.target, calibration=None)
    assert reach.calibrated is reach.planned
    np.testing.assert_array_equal(
        reach.hand(reach.planned), to_world(reach.planned.hand, reach.turn)
    )


def test_a_forearm_that_passes_through_the_cup_is_told(model, photo):
    """The scene shows both a palm's length from where they are; its cup stands where we put it."""
    reach = loop.reach(model, photo.target)
    motion, there = reach.calibrated, beyond_wrist(reach.turn)
    elbow, wrist = to_world(geometry(motion.q[700]).joints[1:], reach.turn)
    for share, aside, meets in ((0.7, 0.0, True), (0.7, 0.2, False)):
        foot = elbow + share * (wrist - elbow) - there + [0, 0, aside]
        foot[1] = TABLE + props.MUG[1] / 2
        [pixel] = photo.camera.project(foot[None])
        box = np.concatenate([pixel - 20, pixel + 20])
        moved = replace(photo, boxes=photo.boxes | {"cup": box})
        assert np.abs(props.cup_foot(moved) - foot)[[0, 2]].max() < 0.002
        assert meets_cup(moved, reach, motion) == meets
        assert ("through the cup" in describe_end(moved, reach, motion)) == meets


def test_no_box_has_no_place(model, photo, sight):
    nothing = loop.Sight(sight.detections, np.zeros_like(sight.probability))
    assert nothing.box is None
    with pytest.raises(ValueError, match="no shuttlecock was recognised"):
        loop.locate(model, photo.image, nothing.box, photo.camera)


def test_a_box_without_a_camera_has_no_place(model):
    shot = photos.load("real", "train")[0]
    with pytest.raises(ValueError, match="camera is unknown"):
        loop.locate(model, shot.image, shot.boxes["shuttlecock"], shot.camera)


BOXES = np.array([[0, 0, 50, 50], [100, 0, 150, 50], [200, 0, 250, 50.0]])


class Told(VentralStream):
    """A stream that gives each box the probability of the nearest place, and all one delta."""

    def __init__(self, places, probability, delta=0.0):
        object.__setattr__(self, "told", (places, probability, delta))

    def predict(self, image, boxes, flips=None):
        places, probability, delta = self.told
        nearest = np.abs(boxes[:, None] - places).sum(2).argmin(1) if len(boxes) else []
        return logit(np.take(probability, nearest)), np.full((len(boxes), 4), delta)


class Fixed(Recogniser):
    """A recogniser that gives the boxes of any image these probabilities."""

    def __init__(self, probability):
        object.__setattr__(self, "fixed", np.array(probability))

    def box_probability(self, image, boxes):
        return self.fixed[: len(boxes)]


class Sizing(Camera):
    """A camera by which the boxes of any image are of these sizes, in m."""

    def __init__(self, *known):
        object.__setattr__(self, "known", np.array(known))

    def sizes(self, boxes):
        return self.known[: len(boxes)]


def sight_of(scores, probability, camera=None, selects=True):
    """The Sight of a model that detects BOXES with these scores and recognises them so."""
    scores = np.array(scores)
    boxes = BOXES[: len(scores)]
    detections = Detections(boxes, scores, boxes, boxes, scores)
    detector = SimpleNamespace(detect=lambda image: detections)
    recogniser = Told(boxes, probability) if selects else Fixed(probability)
    image = np.zeros((400, 600, 3), np.uint8)
    return loop.see(loop.VisuomotorModel(detector, recogniser, None, None), image, camera)


def test_the_likeliest_box_is_chosen():
    for selects in (True, False):
        sight = sight_of([0.9, 0.5, 0.4], [0.001, 0.97, 0.98], selects=selects)
        assert sorted(sight.shuttlecocks.tolist()) == BOXES[[1, 2]].tolist()
        assert sight.summary.startswith("2 shuttlecocks")
    best = sight_of([0.9, 0.5, 0.4], [0.001, 0.97, 0.98])
    np.testing.assert_array_equal(best.box, BOXES[2])
    np.testing.assert_allclose(best.detections.scores, logit([0.98, 0.97, 0.001]))


@pytest.mark.parametrize("selects", [True, False])
def test_a_camera_filters_boxes_by_size_and_scales_the_odds(selects):
    cameras = None, Sizing(0.07, 0.2, 0.08)
    before, after = (sight_of([0.3] * 3, [0.4] * 3, camera, selects) for camera in cameras)
    np.testing.assert_array_equal(after.detections.boxes, BOXES[[0, 2]])
    odds = [one.probability[0] / (1 - one.probability[0]) for one in (before, after)]
    assert odds[1] == pytest.approx(SIZE_LIKELIHOOD_RATIO * odds[0])
    assert sight_of([0.3], [0.9], Sizing(0.3), selects).box is None


def test_the_best_boxes_are_refined_and_looked_at_again():
    corners = 60.0 * np.column_stack([np.arange(130) % 13, np.arange(130) // 13])
    many, scores = np.hstack([corners, corners + 50]), np.linspace(0.9, 0.1, 130)
    calls = []

    class Watched(Told):
        def predict(self, image, boxes, *flips):
            calls.append((boxes, *flips))
            return super().predict(image, boxes)

    stream = Watched(many, np.linspace(0.1, 0.5, 130), delta=0.02)
    selected, probability = stream.select(None, Detections(many, scores, many, many, scores))
    (first,), *further = calls
    np.testing.assert_array_equal(first, many)
    boxes, step = many[::-1][:N_REFINED], np.full((N_REFINED, 4), 0.02)
    assert len(further) == N_LOOKS - 1
    for again, flips in further:
        assert flips == FLIPS
        boxes = decode_deltas(boxes, step)
        np.testing.assert_allclose(again, boxes)
    np.testing.assert_allclose(selected.boxes, decode_deltas(boxes, step))
    assert (np.diff(probability) < 0).all()
    np.testing.assert_allclose(selected.scores, logit(probability))


def test_of_overlapping_boxes_the_most_probable_is_kept():
    boxes = np.array([[0, 0, 50, 50], [2, 0, 52, 50], [200, 0, 250, 50.0]])
    detections = Detections(boxes, np.ones(3), boxes, boxes, np.ones(3))
    selected, probability = Told(boxes, [0.7, 0.9, 0.8]).select(None, detections)
    np.testing.assert_array_equal(selected.boxes, boxes[[1, 2]])
    np.testing.assert_allclose(probability, [0.9, 0.8])


def test_many_boxes_of_one_shuttlecock_leave_room_for_another():
    boxes = np.array([*([k, k, k + 100, k + 100] for k in range(2 * N_REFINED)), [300, 0, 400, 99]])
    chances, ones = np.linspace(0.9, 0.5, len(boxes)), np.ones(len(boxes))
    selected, _ = Told(boxes, chances).select(None, Detections(boxes, ones, boxes, boxes, ones))
    np.testing.assert_array_equal(selected.boxes, boxes[[0, -1]])


def test_the_probabilities_of_chosen_boxes_are_calibrated():
    boxes = BOXES[:2]
    stream = Told(boxes, [0.7, 0.9])
    object.__setattr__(stream, "sigmoid", (0.5, -1.0))
    selected, probability = stream.select(
        None, Detections(boxes, np.ones(2), boxes, boxes, np.ones(2))
    )
    np.testing.assert_allclose(selected.scores, 0.5 * logit(np.array([0.9, 0.7])) - 1)
    np.testing.assert_allclose(logit(probability), selected.scores)


def test_a_stream_has_a_lower_threshold_than_a_recogniser():
    assert MIN_PROBABILITY < 0.4 < 0.5
    assert sight_of([0.5], [0.4]).summary.startswith("a shuttlecock,")
    assert sight_of([0.5], [0.4], selects=False).box is None


def test_without_a_probable_box_the_summary_counts_boxes():
    unsure = sight_of([0.3, 0.2], [0.3, 0.2])
    assert unsure.box is None
    assert unsure.summary.startswith("no shuttlecock; likeliest of 2 boxes: 30 %")
    assert sight_of([0.3], [0.3]).summary.startswith("no shuttlecock; likeliest of 1 box:")
    nothing = sight_of(np.empty(0), np.empty(0))
    assert nothing.summary == "nothing that looks like an object"


def test_a_target_out_of_reach_is_an_error(model):
    with pytest.raises(ValueError, match="reach"):
        loop.reach(model, np.array([2.0, -0.4, 0.1]))


def test_each_command_is_simulated_once(model, photo, monkeypatch):
    """One planned movement and 21 tried off-line; the best of them need not be made again."""
    counts = []

    def counted(excitations, *rest, **named):
        counts.append(np.prod(excitations.shape[:-2], dtype=int))
        return simulate(excitations, *rest, **named)

    monkeypatch.setattr(templates, "simulate", counted)
    reach = loop.reach(model, photo.target)
    assert sum(counts) == 22
    np.testing.assert_array_equal(execute(reach.plan).motion.q, reach.planned.q)
    [best] = execute(reach.plan.with_weights(algorithm_1(reach.plan).best_weights[None])).motion
    np.testing.assert_allclose(best.q, reach.calibrated.q, atol=1e-5)


def test_shared_arrays_are_read_only(model):
    for array in (model.template_set.points, model.template_set.excitations):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_a_rule_of_calibration_may_be_given_by_its_name(model, photo):
    reach = loop.reach(model, photo.target, "published")
    own = loop.recalibrate(reach, "own")
    for one, rule in ((reach, algorithm_1), (own, broyden_calibration)):
        expected = loop.reach(model, photo.target, rule).calibrated
        np.testing.assert_array_equal(one.calibrated.q, expected.q)


def test_what_the_loop_returns_has_a_repr_of_a_line(model, photo, sight):
    reach = loop.reach(model, photo.target)
    parts = reach.plan, reach.planned, execute(reach.plan), sight.detections, model.template_set
    for shown in (model, model.detector, model.localiser, sight, reach, *parts):
        assert re.fullmatch(r"\w+\(.{9,200}\)", repr(shown))
    assert sight.summary in repr(sight)
    assert repr(reach.planned) == (
        "HeldMotion(q=array(1501, 2), velocity=array(1501, 2), activation=array(1501, 6), held=500)"
    )


def test_of_two_shuttlecocks_the_one_in_reach_is_reached_for(model, photo, monkeypatch):
    """The best box stays the best; where none can be reached, there is no reach."""
    near = photo.boxes["shuttlecock"]
    far = np.array([0.0, 0.0, 40.0, 40.0])  # a corner of the table, out of reach
    for boxes, reached in (([far, near], True), ([near, far], True), ([far], False)):
        found = Detections(None, None, None, np.array(boxes), None)
        sight = loop.Sight(found, np.full(len(boxes), 0.9))
        monkeypatch.setattr(loop, "see", lambda *_, sight=sight: sight)
        seen, made = loop.see_and_reach(model, photo.image, photo.camera)
        assert seen is sight
        assert (made is not None) == reached
        if made:
            there = loop.locate(model, photo.image, near, photo.camera)
            assert made.target == pytest.approx(there)
