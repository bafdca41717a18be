"""The loop on trial: what went wrong is counted where it went wrong first."""

import numpy as np
import pytest

from reproduce import trial
from vmc_lib import loop, photos


@pytest.fixture(scope="module")
def photo():
    return photos.load("rig", "validation")[0]


@pytest.fixture(scope="module")
def sight(photo):
    return loop.see(loop.VisuomotorModel.load("rig"), photo.image)


def test_scores_count_what_went_wrong(photo, sight):
    missed = trial.score(photo, sight, None, {})
    assert missed["found"] and missed["named"] and not missed["cup"]
    assert np.isnan([missed[key] for key in ("target", "planned", *loop.RULES)]).all()
    arrived = missed | dict.fromkeys(("target", "planned", *loop.RULES), 0.004)
    both = {key: np.array([missed[key], arrived[key]]) for key in missed}
    summary = trial.summary(both)
    assert summary["arrived, own"] == summary["arrived, published"] == summary["close, own"] == 0.5
    assert summary["planned"] == 0.004
    assert list(trial.first_failure(both)) == ["place", ""]


def test_a_right_place_that_cannot_be_reached_for_is_no_wrong_place(photo, sight):
    scores = trial.score(photo, sight, photo.target, {})
    assert scores["target"] == 0 and np.isnan(scores["own"])
    several = {key: np.array([value]) for key, value in scores.items()}
    assert list(trial.first_failure(several)) == ["movement"]


def test_the_cup_is_told_from_the_shuttlecock(photo, sight):
    cup = photo.boxes["cup"]
    detections = type(sight.detections)(**{**vars(sight.detections), "boxes": cup[None]})
    fooled = trial.score(photo, loop.Sight(detections, np.array([0.9])), None, {})
    assert fooled["cup"] and not fooled["named"] and not fooled["found"]


def test_a_failure_is_the_first_stage_that_went_wrong():
    fine = {"proposed": True, "found": True, "named": True, "target": 0.002, "own": 0.05}
    wrong = {"target": 0.02, "named": False, "found": False, "proposed": False}
    cases, now = [fine], fine
    for key, value in wrong.items():
        cases.append(now := now | {key: value})
    scores = {key: np.array([case[key] for case in cases]) for key in fine}
    assert list(trial.first_failure(scores)) == list(trial.FAILURE_STAGES[::-1])


def test_a_lucky_reach_is_no_failure():
    lucky = {"proposed": False, "found": False, "named": True, "target": 0.004, "own": 0.006}
    assert trial.first_failure({key: np.array([value]) for key, value in lucky.items()}) == [""]
