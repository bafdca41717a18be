import numpy as np
import pytest

from reproduce.experiments import eye_ablation
from vmc_lib import photos

SHOT = photos.load("real", "validation")[0]


def test_what_is_left_of_a_photo_shows_no_shuttlecock():
    marked = np.zeros_like(SHOT.image)
    for x0, y0, x1, y1 in photos.boxes_of(SHOT, "shuttlecock").astype(int):
        marked[y0 : y1 + 1, x0 : x1 + 1] = 255
    photo = type("Shot", (), {"boxes": SHOT.boxes, "more": SHOT.more, "image": marked})
    left = eye_ablation.largest_empty_part(photo)
    assert left.shape == (400, 600, 3)
    assert left.max() <= 128  # black, and the grey around it


def test_stored_counts_are_of_the_eye_that_ships():
    found = eye_ablation.load_results()
    asked = found.pop("asked")
    assert list(found) == list(eye_ablation.WITHOUT)
    assert asked == {"right": 177, "tight": 177, "found": 197, "alarms": 88}
    for counts in found.values():
        assert counts["tight"] <= counts["right"] <= asked["right"]
        assert counts["right"] <= counts["found"] <= asked["found"]
        assert counts["alarms"] <= asked["alarms"]


@pytest.mark.parametrize("name", list(eye_ablation.WITHOUT)[1:])
def test_each_part_earns_its_place(name):
    found = eye_ablation.load_results()
    ours, without = found["nothing"], found[name]
    worse = [ours[key] > without[key] for key in ("right", "tight", "found")]
    assert any(worse) or without["alarms"] > ours["alarms"]


@pytest.mark.audit
def test_a_picture_is_answered_without_each_part():
    found = eye_ablation.make(count=1)
    assert found["asked"] == dict.fromkeys(eye_ablation.COUNTED, 1)
    assert found["nothing"]["right"] == 1
    assert found["refinement"]["tight"] <= found["nothing"]["right"]
