"""The loop: every stage runs for real, and what goes wrong is said."""

import numpy as np
import pytest

from vmc_lib import loop, photos
from vmc_lib.arm.posture import to_world


@pytest.fixture(scope="module")
def brain():
    return loop.Brain.load("rig")


@pytest.fixture(scope="module")
def photo():
    return photos.load("rig", "validation")[0]


@pytest.fixture(scope="module")
def sight(brain, photo):
    return loop.see(brain, photo.image)


def test_a_photo_becomes_a_reach_that_calibration_improves(brain, photo, sight):
    target = loop.locate(brain, photo.image, sight.box, photo.camera)
    reach = loop.reach(brain, target)
    planned, calibrated = (
        np.linalg.norm(motion.reached - reach.plan.target)
        for motion in (reach.planned, reach.calibrated)
    )
    assert calibrated < planned < 0.05
    assert np.linalg.norm(reach.hand(reach.calibrated)[-1] - target) < 0.05


def test_the_hand_is_told_in_the_frame_of_the_trunk_straight(brain, photo):
    reach = loop.reach(brain, photo.target, calibration=None)
    assert reach.calibrated is reach.planned
    np.testing.assert_array_equal(
        reach.hand(reach.planned), to_world(reach.planned.hand, reach.turn)
    )


def test_nothing_recognised_is_said(brain, photo, sight):
    nothing = loop.Sight(sight.regions, np.zeros_like(sight.probability))
    assert nothing.box is None
    with pytest.raises(ValueError, match="no shuttlecock was recognised"):
        loop.locate(brain, photo.image, nothing.box, photo.camera)


def test_a_place_out_of_reach_is_said(brain):
    with pytest.raises(ValueError, match="reach"):
        loop.reach(brain, np.array([2.0, -0.4, 0.1]))


def test_scores_count_what_went_wrong(photo, sight):
    missed = loop.score(photo, sight, None, {})
    assert missed["found"] and missed["named"] and not missed["cup"]
    assert np.isnan([missed[key] for key in ("target", "planned", *loop.RULES)]).all()
    arrived = missed | dict.fromkeys(("target", "planned", *loop.RULES), 0.004)
    both = {key: np.array([missed[key], arrived[key]]) for key in missed}
    summary = loop.summary(both)
    assert summary["arrived, own"] == summary["arrived, published"] == summary["close, own"] == 0.5
    assert summary["planned"] == 0.004
    assert list(loop.first_failure(both)) == ["place", ""]


def test_a_right_place_that_cannot_be_reached_for_is_no_wrong_place(photo, sight):
    scores = loop.score(photo, sight, photo.target, {})
    assert scores["target"] == 0 and np.isnan(scores["own"])
    several = {key: np.array([value]) for key, value in scores.items()}
    assert list(loop.first_failure(several)) == ["movement"]


def test_the_cup_is_told_from_the_shuttlecock(photo, sight):
    cup = photo.boxes["cup"]
    regions = type(sight.regions)(**{**vars(sight.regions), "boxes": cup[None]})
    fooled = loop.score(photo, loop.Sight(regions, np.array([0.9])), None, {})
    assert fooled["cup"] and not fooled["named"] and not fooled["found"]


def test_a_failure_is_the_first_stage_that_went_wrong():
    fine = {"proposed": True, "found": True, "named": True, "target": 0.002, "own": 0.05}
    wrong = {"target": 0.02, "named": False, "found": False, "proposed": False}
    cases, now = [fine], fine
    for key, value in wrong.items():
        cases.append(now := now | {key: value})
    scores = {key: np.array([case[key] for case in cases]) for key in fine}
    assert list(loop.first_failure(scores)) == list(loop.STAGES[::-1])


def test_a_lucky_reach_is_no_failure():
    lucky = {"proposed": False, "found": False, "named": True, "target": 0.004, "own": 0.006}
    assert loop.first_failure({key: np.array([value]) for key, value in lucky.items()}) == [""]
