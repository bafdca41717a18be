import cv2
import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from skimage.segmentation import felzenszwalb

from vmc_lib import photos
from vmc_lib.photos import as_float
from vmc_lib.where import segmentation
from vmc_lib.where.appearance import COLOUR_SPACES
from vmc_lib.where.segmentation import segment, segmentations


def blobs(seed, shape=(40, 60)):
    """A smooth random image whose neighbouring pixels never differ by the same amount twice."""
    noise = np.random.default_rng(seed).random((*shape, 3))
    return (gaussian_filter(noise, (2, 2, 0)) * 8 % 1).astype(np.float32)


def published_segmentation(image, scale, min_size):
    """The 2004 algorithm, word for word, slowly."""
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


def segment_unblurred(image, scale, min_size):
    height, width = image.shape[:2]
    edges = segmentation.sort_by_weight(segmentation.pixel_edges(image))
    offsets = segmentation.pixel_offsets(width)
    labels = segmentation.merge_segments(edges, offsets, height * width, scale / 255, min_size)
    return labels.reshape(height, width)


@pytest.mark.parametrize(("scale", "min_size"), [(20, 1), (100, 20), (300, 60)])
def test_segments_match_the_published_algorithm(scale, min_size):
    image = blobs(3)
    ours = segment_unblurred(image, scale, min_size)
    assert ours.max() > 0
    assert same_partition(ours, published_segmentation(image, scale, min_size))
    assert (ours == felzenszwalb(image, scale=scale, sigma=0, min_size=min_size)).all()


@pytest.mark.parametrize("shape", [(1, 1, 3), (1, 9, 1), (9, 1, 2), (12, 17, 3)])
def test_compiled_loops_match_their_source(shape, monkeypatch):
    image = np.random.default_rng(0).integers(0, 4, shape).astype(np.float32) / 4  # many ties
    compiled = segment_unblurred(image, 90, 4)
    for loop in ("pixel_edges", "sort_by_weight", "merge_segments"):
        monkeypatch.setattr(segmentation, loop, getattr(segmentation, loop).__wrapped__)
    assert compiled.shape == shape[:2]
    assert (compiled == segment_unblurred(image, 90, 4)).all()


def test_edges_are_sorted_stably_by_weight():
    image = np.random.default_rng(0).integers(0, 4, (12, 17, 3)).astype(np.float32) / 4
    edges = segmentation.pixel_edges(image)
    assert len(edges) == 12 * 16 + 11 * 17 + 2 * 11 * 16
    assert (np.diff(edges % 2**32) > 0).all()
    weights = (edges >> 32).astype(np.uint32).view(np.float32)
    below = np.linalg.norm(image[1:] - image[:-1], axis=2)
    assert weights[edges % 4 == 1] == pytest.approx(below.ravel())
    expected = edges[weights.argsort(kind="stable")]
    assert (segmentation.sort_by_weight(edges.copy()) == expected).all()


@pytest.mark.parametrize("colour", ["HSV", "Lab"])
@pytest.mark.parametrize("shot", ["rig", "varied", "real"])
def test_segments_of_photos_match_scikit_image(shot, colour):
    """To the pixel; where edges of equal weight decide (few), it depends on its machine's sort."""
    some = photos.everyday() if shot == "real" else photos.load(shot, "validation")
    channels = COLOUR_SPACES[colour](as_float(some[1].image))
    smooth = cv2.GaussianBlur(channels, (0, 0), 0.8)
    theirs = felzenszwalb(smooth, scale=100, sigma=0, min_size=100)
    assert (segment(channels) == theirs).all()


def test_segmentations_at_several_scales_are_independent():
    image = blobs(1)
    for labels, k in zip(segmentations(image, [200, 20, 60]), [200, 20, 60], strict=True):
        assert (labels == segment(image, k)).all()


def test_a_larger_scale_gives_fewer_segments():
    counts = [segment(blobs(2, (100, 150)), k).max() + 1 for k in (20, 60, 200)]
    assert counts[0] > counts[1] > counts[2] > 1
