"""Region descriptors: merged as measured from pixels, similarity as published."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from skimage.data import coffee

from tests.where.test_segmentation import blobs
from vmc_lib.photos import as_float
from vmc_lib.where import appearance
from vmc_lib.where import selective_search as ss
from vmc_lib.where.segmentation import segment

PHOTO = coffee()[100:300:2, 100:400:2]


def test_merged_descriptors_match_those_of_the_pixels():
    """A merged region's row equals the one its own pixels would give."""
    channels = as_float(PHOTO)
    codes = appearance.colour_codes(channels), appearance.texture_codes(channels)
    labels = segment(channels, 30)
    look = appearance.describe(labels, *codes)
    tree = ss.grow(labels, look, ss.ALL)
    top = look.colour[-1], look.texture[-1], look.size[-1]
    whole = appearance.describe(np.zeros_like(labels), *codes)
    assert len(tree.merges) > 10
    for merged, direct in zip(top, (whole.colour[0], whole.texture[0], whole.size[0]), strict=True):
        assert merged == pytest.approx(direct, abs=1e-5)


def union_area(r, i, j):
    """The areas of the boxes around both of two regions."""
    low = np.minimum(r.boxes[i, :2], r.boxes[j, :2])
    return (np.maximum(r.boxes[i, 2:], r.boxes[j, 2:]) - low).prod(-1)


MEASURED = {  # Uijlings et al. (2013), section 3.2, in whole arrays
    "colour": lambda r, i, j: np.minimum(r.colour[i], r.colour[j]).sum(-1),
    "texture": lambda r, i, j: np.minimum(r.texture[i], r.texture[j]).sum(-1),
    "size": lambda r, i, j: 1 - (r.size[i] + r.size[j]) / r.pixels,
    "fill": lambda r, i, j: 1 - (union_area(r, i, j) - r.size[i] - r.size[j]) / r.pixels,
}


@given(st.integers(0, 99))
@settings(max_examples=10, deadline=None)
def test_similarity_matches_the_published_measures(seed):
    channels = blobs(seed)
    look = appearance.describe(
        labels := segment(channels, 30),
        appearance.colour_codes(channels),
        appearance.texture_codes(channels),
    )
    pairs = ss.adjacent_regions(labels)
    for name, measure in MEASURED.items():
        flags = tuple(name == one for one in appearance.MEASURES)
        value = appearance.similarity(look, pairs, flags)
        assert (value == appearance.similarity(look, np.flip(pairs, 1), flags)).all()
        assert ((value >= -1e-6) & (value <= 1 + 1e-6)).all()
        assert value == pytest.approx(measure(look, *pairs.T), abs=1e-6)
    together = sum(measure(look, *pairs.T) for measure in MEASURED.values())
    assert appearance.similarity(look, pairs) == pytest.approx(together, abs=1e-6)


@pytest.mark.parametrize("name", appearance.COLOUR_SPACES)
def test_colour_spaces_fill_the_unit_range(name):
    """Each channel, on all eight corners of the colour cube."""
    chart = np.array(list(product((0, 255), repeat=3)), np.uint8)[None]
    channels = appearance.COLOUR_SPACES[name](as_float(chart))
    assert channels.ndim == 3
    assert channels.dtype == np.float32
    assert channels.min() >= 0
    assert channels.max() <= 1
    assert (np.ptp(channels, axis=(0, 1)) > 0.6).all()
