"""A crop that is shifted under its maps."""

import re

import numpy as np

from book.figures.hierarchy import correlations, under_shift


def test_a_shifted_crop_comes_in_at_the_other_side_beside_its_maps(rng):
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
        said = re.search(r">([^<]*P2[^<]*)<", maps)[1]
        assert not re.search(r"\d\.\d", said)  # how alike they are is asked below the figure


def test_bars_lie_so_that_a_phone_shows_all_of_them():
    """And a guess on their axis; a plot for a phone is 4.3 inches wide."""
    fig = correlations({"V": 0.2, "P2, quarters": 0.9}, "shifted")
    [(bars,)] = [ax.containers for ax in fig.axes]
    assert bars.orientation == "horizontal"
    assert fig.get_size_inches()[0] <= 4.3
