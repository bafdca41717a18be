from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from skimage.data import coffee

from tests.where.test_segmentation import blobs
from vmc_lib.boxes import area
from vmc_lib.where import appearance
from vmc_lib.where import selective_search as ss
from vmc_lib.where.segmentation import segment

PHOTO = coffee()[100:300:2, 100:400:2]


@pytest.fixture(scope="module")
def grown():
    return next(ss.hierarchies(PHOTO, ss.Strategy(k=(30,))))


def test_every_merge_unites_two_neighbours(grown):
    for step, pair in enumerate(grown.merges.tolist()):
        before, after = grown.after(step), grown.after(step + 1)
        assert sorted(pair) in ss.adjacent_regions(before).tolist()
        new = len(grown.merges) + 1 + step
        assert ((after == new) == np.isin(before, pair)).all()
        assert (after == before)[after != new].all()


def test_boxes_hold_their_regions(grown):
    for step in range(0, len(grown.merges) + 1, 5):
        labels = grown.after(step)
        for region in np.unique(labels):
            y, x = np.nonzero(labels == region)
            box = x.min(), y.min(), x.max() + 1, y.max() + 1
            assert tuple(grown.boxes[region]) == box


COMPILED = "_count", "_slope_codes", "similarity", "merge_regions", "_merge_all"


def test_compiled_loops_match_their_source(monkeypatch):
    channels = blobs(5)[:25, :25]
    labels = segment(channels, 20)

    def run():
        codes = appearance.colour_codes(channels), appearance.texture_codes(channels)
        look = appearance.describe(labels, *codes)
        return look, ss.grow(labels, look, ss.ALL)

    compiled, tree = run()
    for module, name in product((appearance, ss), COMPILED):
        if hasattr(module, name):
            monkeypatch.setattr(module, name, getattr(module, name).__wrapped__)
    plain, same = run()
    assert len(tree.merges) > 3
    assert (tree.merges == same.merges).all()
    assert plain.texture == pytest.approx(compiled.texture)


def test_without_measures_the_lowest_numbers_merge_first():
    strategies = [ss.Strategy(k=(30,), similarities=(m,)) for m in ((), ("size",))]
    blind, by_size = (next(ss.hierarchies(PHOTO, s)) for s in strategies)
    assert blind.merges[0].tolist() == ss.adjacent_regions(blind.labels)[0].tolist()
    assert (blind.merges[0] != by_size.merges[0]).any()


def test_the_most_similar_pair_merges_first():
    """Two near greys beside each other and a red: the greys go first."""
    image = np.full((60, 90, 3), 0.5, np.float32)
    image[:, 30:60] = 0.55
    image[:, 60:] = [0.9, 0.1, 0.1]
    labels = np.repeat([[0] * 30 + [1] * 30 + [2] * 30], 60, axis=0)
    look = appearance.describe(
        labels, appearance.colour_codes(image), appearance.texture_codes(image)
    )
    assert ss.grow(labels, look, ("colour",)).merges.tolist() == [[0, 1], [2, 3]]


def test_a_strategy_refuses_unknown_names():
    with pytest.raises(ValueError, match="'CMYK' is none of RGB, HSV, Lab, rgI, H, I"):
        ss.Strategy(("HSV", "CMYK"))
    with pytest.raises(ValueError, match="'taste' is none of colour, texture, size, fill"):
        ss.Strategy(similarities=(ss.ALL, ("size", "taste")))


@pytest.mark.parametrize("k", [(0,), (-5,), (np.nan,), (100, np.inf), 100])
def test_a_strategy_refuses_scales_that_are_none(k):
    with pytest.raises(ValueError, match="finite numbers above 0"):
        ss.Strategy(k=k)


@pytest.mark.parametrize("none", ["colours", "k", "similarities"])
def test_a_strategy_needs_one_of_each(none):
    with pytest.raises(ValueError, match="grows no hierarchy"):
        ss.Strategy(**{none: ()})


def test_a_seed_stands_for_its_generator(photo):
    once, again = (ss.propose(photo.image, rng=rng) for rng in (5, np.random.default_rng(5)))
    assert (once == again).all()


def test_a_wider_strategy_contains_a_narrower_one():
    both = ss.Strategy(("HSV", "Lab"))
    single, wide = ({tuple(b) for b in ss.propose(PHOTO, s)} for s in ("single", both))
    assert single < wide


def test_the_order_depends_on_the_generator_alone():
    order = [ss.propose(PHOTO, rng=np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert (order[0] == order[1]).all()
    assert (order[0] != order[2]).any()
    assert {tuple(b) for b in order[0]} == {tuple(b) for b in order[2]}
    assert (ss.propose(PHOTO) == ss.propose(PHOTO)).all()


def test_large_regions_tend_to_come_first():
    trees = list(ss.hierarchies(PHOTO, ss.STRATEGIES["fast"]))
    draws = [ss.rank_boxes(trees, np.random.default_rng(seed)) for seed in range(20)]
    assert (draws[0] == ss.propose(PHOTO, "fast")).all()
    early, late = (np.mean([area(d[part]).mean() for d in draws]) for part in np.s_[:10, -10:])
    assert early > 3 * late


def test_grey_float_and_transparent_images_give_equal_boxes():
    grey = PHOTO[..., 0]
    expected = ss.propose(np.dstack([grey] * 3))
    for image in (grey, grey / 255, np.dstack([grey] * 3 + [np.full_like(grey, 255)])):
        assert (ss.propose(image) == expected).all()


@pytest.mark.parametrize(
    ("shape", "count"), [((1, 1), 0), ((1, 500), 0), ((19, 300), 0), ((20, 20), 1), ((90, 70), 1)]
)
def test_a_blank_image_is_one_box_if_it_is_large_enough(shape, count):
    boxes = ss.propose(np.full((*shape, 3), 128, np.uint8))
    assert boxes.tolist() == [[0, 0, shape[1], shape[0]]] * count


def images():
    """Images of every kind that `hierarchies` takes, one pixel and larger."""
    sides = st.integers(1, 30)
    depth = st.sampled_from([(), (3,), (4,)])
    shape = st.tuples(sides, sides, depth).map(lambda s: (*s[:2], *s[2]))
    floats = st.floats(0, 1, width=32)
    return st.one_of(arrays(np.uint8, shape), arrays(np.float32, shape, elements=floats))


@given(images(), st.integers(1, 12))
@settings(max_examples=60, deadline=None)
def test_any_image_gives_distinct_boxes_inside_it(image, smallest):
    """The whole image is among them, unless it is too small."""
    height, width = image.shape[:2]
    trees = ss.hierarchies(image, ss.STRATEGIES["fast"])
    boxes = ss.rank_boxes(trees, np.random.default_rng(0), smallest)
    assert (boxes[:, :2] >= 0).all()
    assert (boxes[:, 2:] <= [width, height]).all()
    assert (boxes[:, 2:] - boxes[:, :2] >= smallest).all()
    assert len(np.unique(boxes, axis=0)) == len(boxes)
    whole = (boxes == [0, 0, width, height]).all(1).sum()
    assert whole == (min(height, width) >= smallest)


def test_a_huge_image_gives_boxes_everywhere():
    wide = np.tile(PHOTO, (1, 40, 1))
    boxes = ss.propose(wide)
    assert wide.shape == (100, 6000, 3)
    assert len(boxes) > 10 * len(ss.propose(PHOTO))
    assert (boxes[:, 2:] <= [6000, 100]).all()
    assert boxes[:, 0].max() > 5000


@pytest.mark.parametrize(
    ("image", "message"),
    [
        (np.full((30, 30, 3), np.nan), "finite"),
        (np.full((30, 30, 3), np.inf), "finite"),
        (np.full((30, 30, 3), 255.0), "divide"),
        (np.full((30, 30, 3), -0.1), "0..1"),
        (np.zeros((0, 30, 3), np.uint8), "not"),
        (np.zeros((30, 30, 2), np.uint8), "not"),
        (np.zeros(30, np.uint8), "not"),
    ],
)
def test_wrong_arrays_are_refused(image, message):
    with pytest.raises(ValueError, match=message):
        ss.propose(image)


def test_an_unknown_strategy_is_refused():
    with pytest.raises(ValueError, match="single, fast, quality, diverse, finer"):
        ss.propose(PHOTO, "fastest")
