import cv2
import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from skimage.segmentation import felzenszwalb

from vmc_lib import photos
from vmc_lib.photos import as_float
from vmc_lib.where import segmentation
from vmc_lib.where.appearance import COLOUR_SPACES
from vmc_lib.where.segmentation import edges_of, lightest_first, segment, segmentations


def blobs(seed, shape=(40, 60)):
    """A smooth random image whose neighbouring pixels never differ by the same amount twice."""
    noise = np.random.default_rng(seed).random((*shape, 3))
    return (gaussian_filter(noise, (2, 2, 0)) * 8 % 1).astype(np.float32)


def felzenszwalb_huttenlocher(image, scale, min_size):
    """The 2004 algorithm, word for word and slow."""
    pixel = np.arange(image[..., 0].size).reshape(image.shape[:2])
    edges = []
    for a, b in [
        (np.s_[:, 1:], np.s_[:, :-1]),
        (np.s_[1:], np.s_[:-1]),
        (np.s_[1:, 1:], np.s_[:-1, :-1]),
        (np.s_[1:, :-1], np.s_[:-1, 1:]),
    ]:
        step = np.linalg.norm(image[a] - image[b], axis=-1)
        edges += zip(step.ravel(), pixel[a].ravel(), pixel[b].ravel(), strict=True)
    edges.sort()
    into, size, inside = pixel.ravel().tolist(), [1] * pixel.size, [0.0] * pixel.size

    def root(p):
        while into[p] != p:
            p = into[p]
        return p

    def sweep(should_join):
        for step, a, b in edges:
            a, b = root(a), root(b)
            if a != b and should_join(step, a, b):
                into[b], inside[a] = a, step
                size[a] += size[b]

    sweep(lambda step, a, b: step < min(inside[r] + scale / 255 / size[r] for r in (a, b)))
    sweep(lambda step, a, b: min(size[a], size[b]) < min_size)
    return np.reshape([root(p) for p in range(pixel.size)], pixel.shape)


def same_partition(a, b):
    pairs = np.unique(np.stack([a.ravel(), b.ravel()]), axis=1).shape[1]
    return pairs == len(np.unique(a)) == len(np.unique(b))


def walked(image, scale, min_size):
    height, width = image.shape[:2]
    patches = segmentation.single_pixels(height * width, scale / 255)
    edges, away = edges_of(image, 0, height), segmentation.to_neighbours(width)
    labels = segmentation.cut_along(edges, away, scale / 255, min_size, patches)
    return labels.reshape(height, width)


@pytest.mark.parametrize(("scale", "min_size"), [(20, 1), (100, 20), (300, 60)])
def test_the_segmentation_is_the_published_algorithm(scale, min_size):
    image = blobs(3)
    ours = walked(image, scale, min_size)
    assert ours.max() > 0
    assert same_partition(ours, felzenszwalb_huttenlocher(image, scale, min_size))
    assert (ours == felzenszwalb(image, scale=scale, sigma=0, min_size=min_size)).all()


@pytest.mark.parametrize("shape", [(1, 1, 3), (1, 9, 1), (9, 1, 2), (12, 17, 3)])
def test_the_compiled_loops_do_what_their_source_does(shape, monkeypatch):
    image = np.random.default_rng(0).integers(0, 4, shape).astype(np.float32) / 4  # many ties
    monkeypatch.setattr(segmentation, "STRIP", 40)
    compiled, in_strips = walked(image, 90, 4), segment(image, 4)
    for loop in ("_edges", "dealt", "join", "labels_of"):
        monkeypatch.setattr(segmentation, loop, getattr(segmentation, loop).__wrapped__)
    assert compiled.shape == shape[:2]
    assert (compiled == walked(image, 90, 4)).all()
    assert (in_strips == segment(image, 4)).all()


@pytest.mark.parametrize("strip", [1, 100, 900])
def test_a_picture_falls_apart_the_same_in_strips_of_any_height(strip, monkeypatch):
    """Ties and textures, patches across many strips, and a scale beside another."""
    grid = np.random.default_rng(1).integers(0, 4, (40, 60, 3)).astype(np.float32) / 4
    photo = as_float(photos.load("real", "validation")[0].image)
    for image in (grid, blobs(4), photo[::4, ::4]):
        whole = list(segmentations(image, (20, 90)))
        monkeypatch.setattr(segmentation, "STRIP", strip)
        for one, other in zip(whole, segmentations(image, (20, 90)), strict=True):
            assert one.max() > 0
            assert (one == other).all()
        monkeypatch.undo()


def test_edges_are_sorted_by_their_weights_and_equal_ones_keep_their_order():
    image = np.random.default_rng(0).integers(0, 4, (12, 17, 3)).astype(np.float32) / 4
    edges = edges_of(image, 0, 12)
    assert len(edges) == 12 * 16 + 11 * 17 + 2 * 11 * 16
    assert (np.diff(edges % 2**32) > 0).all()
    weights = (edges >> 32).astype(np.uint32).view(np.float32)
    below = np.linalg.norm(image[1:] - image[:-1], axis=2)
    assert weights[edges % 4 == 1] == pytest.approx(below.ravel())
    expected = edges[weights.argsort(kind="stable")]
    assert (lightest_first(edges.copy())[0] == expected).all()


@pytest.mark.parametrize("colour", ["HSV", "Lab"])
@pytest.mark.parametrize("shot", ["rig", "varied", "real"])
def test_photos_are_cut_as_scikit_image_cuts_them(shot, colour):
    """To the pixel; where edges of equal weight decide (few), it depends on its machine's sort."""
    some = photos.everyday() if shot == "real" else photos.load(shot, "validation")
    channels = COLOUR_SPACES[colour](as_float(some[1].image))
    smooth = cv2.GaussianBlur(channels, (0, 0), 0.8)
    theirs = felzenszwalb(smooth, scale=100, sigma=0, min_size=100)
    assert (segment(channels) == theirs).all()


def test_scales_share_their_edges_and_nothing_else():
    image = blobs(1)
    for labels, k in zip(segmentations(image, [200, 20, 60]), [200, 20, 60], strict=True):
        assert (labels == segment(image, k)).all()


def test_larger_scale_larger_segments():
    counts = [segment(blobs(2, (100, 150)), k).max() + 1 for k in (20, 60, 200)]
    assert counts[0] > counts[1] > counts[2] > 1
