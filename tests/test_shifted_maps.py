"""A crop that is shifted under its maps."""

import re

import numpy as np

from book.figures.hierarchy import under_shift


def test_a_shifted_crop_comes_in_at_the_other_side_and_its_maps_are_compared(rng):
    crop, near = rng.normal(size=(200, 200)), rng.random((1, 3, 44, 44))
    layers = {
        shift: {"P2": np.roll(near, shift, (-1, -2)), "MP2": np.roll(near, shift, (-1, -2))[:, :1]}
        for shift in ((0, 0), (5, -3))
    }
    there = [
        [(5, 197), (5, -3), (-195, 197), (-195, -3)],
        [(0, 0), (0, -200), (-200, 0), (-200, -200)],
    ]
    for shift, places in zip(((5, -3), (0, 0)), there, strict=True):
        picture, maps = under_shift(crop, layers, shift)
        seen = re.findall(r'<use [^>]*x="(-?\d+)" y="(-?\d+)"', picture)
        assert [tuple(map(int, place)) for place in seen] == places
        alike = re.search(r"P2 (-?[\d.]+), MP2 (-?[\d.]+) alike", maps).groups()
        assert (alike == ("1.00", "1.00")) == (shift == (0, 0))
