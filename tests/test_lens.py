"""The magnifier in a photo: its lengths are those of the reach, on the scale of its bar."""

import re

import numpy as np
import pytest

from book.figures.lens import RADIUS, lens
from vmc_lib import loop
from vmc_lib.show.palette import ON_PHOTO


def drawn(svg, colour):
    """The lengths of the lines in a colour, from their first point to their last."""
    lines = re.findall(rf'<polyline points="([^"]+)" stroke="{ON_PHOTO[colour]}"', svg)
    points = [np.array([pair.split(",") for pair in line.split()], float) for line in lines]
    return [np.linalg.norm(line[-1] - line[0]) for line in points]


@pytest.mark.parametrize("aside", [0, 0.07])
def test_a_miss_is_as_long_as_the_bar_says(photo, aside):
    """Also where the true place is so far from the one seen that a bar of 5 cm is drawn."""
    model, box = loop.VisuomotorModel.load("rig"), photo.boxes["shuttlecock"]
    reach = loop.reach(model, photo.target + np.array([aside, 0, 0]))
    svg = lens(photo, box, reach, reach.calibrated)
    bar, mm = drawn(svg, "ink")[-1], 10 * int(re.search(r">(\d) cm<", svg)[1])
    assert mm == (50 if aside else 10)
    for colour, motion in (("grey", reach.planned), ("red", reach.calibrated)):
        off = 1000 * np.linalg.norm(reach.endpoint(motion) - reach.target)
        assert drawn(svg, colour)[0] / bar * mm == pytest.approx(off, abs=1)
    assert max(drawn(svg, "red")) < RADIUS
    x, y = map(float, re.search(r"translate\((\d+) (\d+)\)", svg).groups())
    apart = np.abs(np.subtract((x, y), (box[:2] + box[2:]) / 2))
    assert np.linalg.norm(apart) > RADIUS
    assert not drawn(lens(photo, box, reach), "red")
