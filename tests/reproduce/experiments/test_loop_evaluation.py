"""Evaluation of the loop: scores, the first stage that fails, lesions."""

import numpy as np
import pytest

from reproduce import results
from reproduce.experiments import loop_evaluation
from reproduce.pipeline import smoke_run
from vmc_lib import NoReach, loop, photos
from vmc_lib.cerebellum.offline import RULES


@pytest.fixture(scope="module")
def sight(photo):
    return loop.see(loop.VisuomotorModel.load("rig"), photo.image)


def test_scores_count_what_went_wrong(photo, sight):
    failure = loop_evaluation.score(photo, sight, None, {})
    assert failure["found"]
    assert failure["named"]
    assert not failure["cup"]
    assert np.isnan([failure[key] for key in ("target", "planned", *RULES)]).all()
    success = failure | dict.fromkeys(("target", "planned", *RULES), 0.004)
    both = {key: np.array([failure[key], success[key]]) for key in failure}
    summary = loop_evaluation.summary(both)
    assert summary["arrived, own"] == summary["arrived, published"] == summary["close, own"] == 0.5
    assert summary["planned"] == 0.004
    assert list(loop_evaluation.first_failure(both)) == ["place", ""]


def test_unreachable_target_is_a_movement_failure(photo, sight):
    scores = loop_evaluation.score(photo, sight, photo.target, {})
    assert scores["target"] == 0
    assert np.isnan(scores["own"])
    several = {key: np.array([value]) for key, value in scores.items()}
    assert list(loop_evaluation.first_failure(several)) == ["movement"]


def test_reaching_for_the_cup_is_counted(photo, sight):
    cup = photo.boxes["cup"]
    detections = type(sight.detections)(**{**vars(sight.detections), "boxes": cup[None]})
    fooled = loop_evaluation.score(photo, loop.Sight(detections, np.array([0.9])), None, {})
    assert fooled["cup"]
    assert not fooled["named"]
    assert not fooled["found"]


def test_a_failure_is_the_first_stage_that_went_wrong():
    fine = {"proposed": True, "found": True, "named": True, "target": 0.002, "own": 0.05}
    wrong = {"target": 0.02, "named": False, "found": False, "proposed": False}
    cases, now = [fine], fine
    for key, value in wrong.items():
        cases.append(now := now | {key: value})
    scores = {key: np.array([case[key] for case in cases]) for key in fine}
    assert list(loop_evaluation.first_failure(scores)) == list(loop_evaluation.FAILURE_STAGES[::-1])


def test_a_lucky_reach_is_no_failure():
    lucky = {"proposed": False, "found": False, "named": True, "target": 0.004, "own": 0.006}
    assert loop_evaluation.first_failure(
        {key: np.array([value]) for key, value in lucky.items()}
    ) == [""]


def test_reach_after_each_lesion(photo, sight):
    """Without names the best-scored box, without a place the old one, without calibration habit."""
    model = loop.VisuomotorModel.load("rig")
    reaches = {}
    for how in loop_evaluation.LESIONS:
        reaches[how] = loop_evaluation.reach_with_lesion(model, photo, sight.box, how)
    old = photos.load("rig", "train")[-1].target
    np.testing.assert_array_equal(reaches["dorsal"].target, old)
    for how in ("none", "ventral", "cerebellum"):
        np.testing.assert_array_equal(reaches[how].target, reaches["none"].target)
    uncorrected = reaches["cerebellum"]
    assert uncorrected.calibrated is uncorrected.planned
    assert reaches["none"].calibrated is not reaches["none"].planned
    np.testing.assert_array_equal(
        loop_evaluation.target_box(sight, "ventral"), sight.detections.boxes[0]
    )
    np.testing.assert_array_equal(loop_evaluation.target_box(sight, "dorsal"), sight.box)
    blind = loop.Sight(sight.detections, 0 * sight.probability)
    assert loop_evaluation.target_box(blind, "none") is None
    assert loop_evaluation.target_box(blind, "ventral") is not None
    with pytest.raises(NoReach):
        loop_evaluation.reach_with_lesion(model, photo, None, "none")


def test_object_in_box(photo):
    for name, box in photo.boxes.items():
        assert loop_evaluation.object_in_box(photo, box) == name
    assert loop_evaluation.object_in_box(photo, np.array([0.0, 0, 5, 5])) == "neither"
    assert loop_evaluation.object_in_box(photo, None) == "nothing"


def test_generalist_is_evaluated_on_renders(tmp_path):
    smoke_run.copy_photos(tmp_path, {"test": (0, 1)})
    few = loop_evaluation.make_generalist(["varied"], tmp_path)["varied"]
    stored = results.records("generalist")
    assert few.keys() == stored["varied"].keys()
    assert list(stored) == list(photos.LEVELS)
    assert few["named"] == 1
    assert few["own"] < few["planned"]
    assert few["own"] == pytest.approx(few["target"], abs=0.001)  # what the eye misses stays


def test_shipped_lesions_are_reproducible():
    model, shipped = loop.VisuomotorModel.load("rig"), results.records("lesions")["rig"]
    once = loop_evaluation._photo_lesions(model, photos.load("rig", "test")[0])
    for how, lesion in once.items():
        assert lesion["object"] == shipped[how]["object"][0]
        assert lesion["missed"] == pytest.approx(shipped[how]["missed"][0], abs=0.2)
        assert lesion["speed"] == pytest.approx(shipped[how]["speed"][0], abs=0.2)
