import numpy as np
import pytest

from reproduce.training.augmentation import (
    ALL,
    Augmentation,
    augment,
    compress_jpeg,
    draw_grid,
    occlude,
    quarter_turn,
)
from vmc_lib import photos
from vmc_lib.boxes import decode_deltas
from vmc_lib.what.stream import WIDTH, preprocess, standardise

STILL = Augmentation(**dict.fromkeys(vars(ALL), 0))
SHOT = photos.load("real", "train")[0]
BOX = SHOT.boxes["shuttlecock"]


def test_unaugmented_crop_equals_the_streams_input():
    crop, fit, lack = augment(SHOT.image, BOX, False, np.random.default_rng(0), STILL)
    [expected] = preprocess(SHOT.image, BOX)
    [standard] = standardise(np.moveaxis(crop, 2, 0)[None])
    np.testing.assert_allclose(standard, expected, atol=0.002)  # its maximum is 1
    assert fit == 0
    assert not lack.any()


def test_augmented_crops_differ_within_the_unit_range():
    rng = np.random.default_rng(0)
    crops = np.array([augment(SHOT.image, BOX, True, rng)[0] for _ in range(20)])
    assert crops.shape == (20, WIDTH, WIDTH, 3)
    assert crops.dtype == np.float32
    assert crops.min() >= 0
    assert crops.max() <= 1
    assert crops.std(0).mean() > 0.05


def test_jitter_lowers_iou_and_deltas_undo_it():
    rng = np.random.default_rng(0)
    fits, lacks = zip(*(augment(SHOT.image, BOX, True, rng)[1:] for _ in range(40)), strict=True)
    assert 0.1 < min(fits) < max(fits) < 1
    size = np.abs(lacks).sum(1)
    assert np.corrcoef(size, fits)[0, 1] < -0.8


@pytest.mark.parametrize("seed", range(8))
def test_quarter_turn_rotates_the_deltas(seed):
    """The mark that the corrected box surrounds is still surrounded after the turn."""
    lack = np.array([0.2, -0.1, -0.5, -0.9])
    x = np.zeros((100, 100, 3))
    x0, y0, x1, y1 = (
        decode_deltas(np.array([[0, 0, 100, 100.0]]), lack[None])[0].round().astype(int)
    )
    x[y0:y1, x0:x1] = 1
    crop, lack = quarter_turn(x, lack, np.random.default_rng(seed))
    x0, y0, x1, y1 = decode_deltas(np.array([[0, 0, 100, 100.0]]), lack[None])[0]
    rows, columns = np.flatnonzero(crop.any((1, 2))), np.flatnonzero(crop.any((0, 2)))
    corners = [columns[0], rows[0], columns[-1] + 1, rows[-1] + 1]
    np.testing.assert_allclose([x0, y0, x1, y1], corners, atol=1)


def test_occlusion_hides_at_most_a_third_of_a_copy():
    rng, x = np.random.default_rng(0), np.full((40, 40, 3), -1.0)
    for _ in range(20):
        assert 0 < (occlude(x, rng) != -1).mean() <= 0.35
    assert (x == -1).all()


def test_a_grid_of_strings_covers_a_part_of_a_copy():
    rng, x = np.random.default_rng(0), np.full((48, 48, 3), -1.0)
    covered = [(draw_grid(x, rng) != -1).any(2).mean() for _ in range(40)]
    assert 0.05 < min(covered) < np.mean(covered) < 0.5
    assert (x == -1).all()


def test_a_poorer_jpeg_keeps_less():
    x = np.random.default_rng(0).random((40, 40, 3))
    lost = [np.abs(compress_jpeg(x, quality) - x).mean() for quality in (95, 20)]
    assert lost[0] < lost[1]
