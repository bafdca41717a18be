"""The loop: every stage runs for real, and what goes wrong is said."""

import numpy as np
import pytest

from vmc_lib import loop, photos
from vmc_lib.arm.kinematics import to_world


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
        np.linalg.norm(motion.reached - reach.plan.target)
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


def test_a_place_out_of_reach_is_said(model):
    with pytest.raises(ValueError, match="reach"):
        loop.reach(model, np.array([2.0, -0.4, 0.1]))
