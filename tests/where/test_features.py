import numpy as np
import pytest

from vmc_lib.photos import crops
from vmc_lib.where.features import gradients, pixels_in_context, raw_pixels
from vmc_lib.where.recipes import FEATURES

NOISE = np.random.default_rng(0).integers(0, 256, (40, 60, 3), dtype=np.uint8)


def test_a_crop_at_full_size_equals_the_pixels():
    assert crops(NOISE, [(3, 5, 19, 21)], 16) * 255 == pytest.approx(
        NOISE[None, 5:21, 3:19], abs=1e-4
    )


def test_a_shrunk_pixel_is_the_mean_of_its_source():
    fine = NOISE[:32, :32].reshape(16, 2, 16, 2, 3).mean((1, 3))
    assert crops(NOISE, [(0, 0, 32, 32)], 16)[0] * 255 == pytest.approx(fine, abs=1e-4)


def test_edges_repeat_beyond_the_image():
    beyond = crops(NOISE, [(-200, -200, -100, -100), (100, 100, 300, 120)], 16)
    assert (beyond[0] * 255).round() == pytest.approx(np.tile(NOISE[0, 0], (16, 16, 1)))
    assert (beyond[1] * 255).round() == pytest.approx(np.tile(NOISE[-1, -1], (16, 16, 1)))


def test_a_box_without_area_shows_one_pixel():
    assert np.ptp(crops(NOISE, [(7, 9, 7, 9)], 16), axis=(1, 2)).max() == 0


@pytest.mark.parametrize(
    ("features", "length"),
    [
        (raw_pixels, 768),
        (FEATURES["8 pixels"], 192),
        (FEATURES["32 pixels"], 3072),
        (pixels_in_context, 770),
        (gradients, 800),
    ],
)
def test_one_row_a_box(features, length, rng):
    boxes = rng.integers(0, 30, (5, 2))
    rows = features(NOISE, np.hstack([boxes, boxes + 20]))
    assert rows.shape == (5, length)
    assert np.isfinite(rows).all()
    assert np.ptp(rows) > 0
    assert features(NOISE, []).shape == (0, length)


def test_gradients_point_across_the_edge():
    """Brighter to the right, in blue alone: angle 0, the first of eight bins; down: the third."""
    image = np.zeros((60, 60, 3), np.uint8)
    image[..., 2] = np.arange(60) * 4
    for ramp, bin_ in ((image, 0), (image.swapaxes(0, 1), 2), (image[:, ::-1], 4)):
        counts = gradients(ramp, [(15, 15, 45, 45)]).reshape(-1, 8).sum(0)
        assert counts.argmax() == bin_
        assert counts[bin_] > 0.9 * counts.sum()


def test_raw_pixels_lie_between_minus_one_and_one():
    image = np.zeros((8, 8, 3), np.uint8)
    image[..., 1] = 255
    assert (raw_pixels(image, [(0, 0, 8, 8)], 4).reshape(16, 3) == [-1, 1, -1]).all()


def test_context_is_a_margin_and_the_size():
    boxes = [(10, 10, 25, 30), (7, 9, 7, 9)]
    rows = pixels_in_context(NOISE, boxes)
    wider = [(6.25, 5, 28.75, 35), (7, 9, 7, 9)]
    assert rows[:, :-2] == pytest.approx(raw_pixels(NOISE, wider) / 2 + 0.5, abs=1e-6)
    assert rows[:, -2:] == pytest.approx(np.log2([[15 / 60, 20 / 40], [1 / 60, 1 / 40]]))


def test_gradients_do_not_depend_on_brightness():
    dim = (NOISE // 2).astype(np.uint8)
    boxes = [(10, 10, 40, 30)]
    assert gradients(dim, boxes) == pytest.approx(gradients(2 * dim, boxes), abs=0.03)


def test_a_flat_image_has_no_gradient():
    assert (gradients(np.full((40, 60, 3), 99, np.uint8), [(10, 10, 40, 30)]) == 0).all()


def test_compiled_features_equal_those_of_whole_arrays():
    boxes = np.array([(10, 10, 40, 30), (-5, -5, 70, 50), (3.5, 7.2, 3.5, 9)])
    pixels = crops(NOISE, boxes, 30)
    where = (np.arange(60) + 0.5) / 60
    x0, y0, x1, y1 = boxes[1]
    x, y = (x0 + where * (x1 - x0)).clip(0, 59), (y0 + where * (y1 - y0)).clip(0, 39)
    samples = NOISE[np.ix_(y.astype(int), x.astype(int))].reshape(30, 2, 30, 2, 3)
    assert (pixels[1] == samples.mean((1, 3), dtype=np.float32) / 255).all()

    slopes = np.stack(np.gradient(pixels, axis=(2, 1)))
    steepest = np.linalg.norm(slopes, axis=0).argmax(-1)[None, ..., None]
    dx, dy = np.take_along_axis(slopes, steepest, -1)[..., 0]
    angle = np.arctan2(dy, dx) / (2 * np.pi) % 1 * 8
    low, share = angle.astype(int) % 8, angle % 1
    row = np.arange(30) // 3
    cell = np.arange(3)[:, None, None] * 100 + row[:, None] * 10 + row
    parts = (low, 1 - share), ((low + 1) % 8, share)
    counts = sum(
        np.bincount((cell * 8 + bin_).ravel(), (np.hypot(dx, dy) * part).ravel(), 2400)
        for bin_, part in parts
    ).reshape(3, 800)
    shares = counts / (np.linalg.norm(counts, axis=1, keepdims=True) + 1e-3)
    assert (gradients(NOISE, boxes, margin=0) == np.sqrt(shares, dtype=np.float32)).all()
