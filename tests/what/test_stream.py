"""The ventral stream (a convolutional network): its stages, predictions and box refinement."""

import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.boxes import decode_deltas, iou
from vmc_lib.what.stream import BATCH, FLIPS, MARGIN, STAGES, WIDTH, VentralStream, preprocess

STREAM = VentralStream.load()
SHOTS = [shot for shot in photos.load("real", "train") if "shuttlecock" in shot.boxes]


def test_a_stage_is_convolution_max_pooling_and_rectification():
    rng = np.random.default_rng(0)
    x = rng.normal(size=(2, 3, WIDTH, WIDTH)).astype(np.float32)
    first = STREAM.stages(x)[STAGES[0]]
    W, b = STREAM.filters[0], STREAM.biases[0]
    assert first.shape == (2, len(W), WIDTH // 2, WIDTH // 2)
    padded = np.pad(x, [(0, 0), (0, 0), (1, 1), (1, 1)])
    for y, column, k in ((0, 0, 1), (23, 23, 0), (7, 11, 2)):
        drives = [
            (padded[1, :, i : i + 3, j : j + 3] * W[k]).sum() + b[k]
            for i in (2 * y, 2 * y + 1)
            for j in (2 * column, 2 * column + 1)
        ]
        assert first[1, k, y, column] == pytest.approx(max(0, *drives), abs=1e-4)


def test_each_stage_halves_the_maps():
    maps = STREAM.stages(preprocess(SHOTS[0].image, SHOTS[0].boxes["shuttlecock"]))
    assert list(maps) == list(STAGES)
    assert [x.shape[-1] for x in maps.values()] == [24, 12, 6, 3]
    assert all((x >= 0).all() for x in maps.values())


def test_preprocess_adds_a_margin_and_standardises():
    image = np.zeros((400, 600, 3), np.uint8)
    image[100:200, 100:200] = 255, 0, 0
    [crop] = preprocess(image, [100, 100, 200, 200])
    edge = round(WIDTH * MARGIN / (1 + 2 * MARGIN))
    assert crop[0, edge + 1 : -edge - 1, edge + 1 : -edge - 1].min() > 1
    assert crop[0, : edge - 1].max() < 0
    [darker] = preprocess(image // 2, [100, 100, 200, 200])
    np.testing.assert_allclose(darker, crop, atol=0.1)


def test_it_recognises_shuttlecocks_and_refines_boxes():
    chances, before, after = [], [], []
    for shot in SHOTS[::3]:
        true = shot.boxes["shuttlecock"][None]
        chances.append(STREAM.box_probability(shot.image, true)[0])
        astray = decode_deltas(true, np.array([[0.1, -0.1, 0.15, -0.1]]))
        before.append(iou(astray, true)[0, 0])
        after.append(iou(STREAM.refine_boxes(shot.image, astray), true)[0, 0])
    assert np.mean(np.array(chances) > 0.5) > 0.8
    assert np.mean(after) > np.mean(before) + 0.05


def test_many_boxes_are_answered_as_one_by_one(rng):
    ends = np.sort(rng.uniform(0, 400, (BATCH + 5, 2, 2)), axis=1)
    boxes = ends.reshape(-1, 4) + np.array([0, 0, 9, 9])
    log_odds, deltas = STREAM.predict(SHOTS[0].image, boxes)
    alone = [STREAM.predict(SHOTS[0].image, box[None]) for box in boxes[:: BATCH + 4]]
    np.testing.assert_allclose(log_odds[:: BATCH + 4], [one[0][0] for one in alone], atol=1e-4)
    np.testing.assert_allclose(deltas[:: BATCH + 4], [one[1][0] for one in alone], atol=1e-4)
    assert len(log_odds) == len(deltas) == BATCH + 5


@pytest.mark.parametrize(("along", "down"), FLIPS[1:])
def test_flip_average_is_equivariant(along, down):
    image, box = SHOTS[0].image, np.round(SHOTS[0].boxes["shuttlecock"])
    (height, width), (x, y, right, bottom) = image.shape[:2], box
    mirrored = np.array([x, y, right, bottom])
    if along < 0:
        mirrored[[0, 2]] = width - right, width - x
    if down < 0:
        mirrored[[1, 3]] = height - bottom, height - y
    odds, lacks = STREAM.predict(image, box[None], FLIPS)
    same, flipped = STREAM.predict(image[::down, ::along], mirrored[None], FLIPS)
    np.testing.assert_allclose(same, odds, atol=0.01)
    np.testing.assert_allclose(flipped, lacks * [along, down, 1, 1], atol=1e-3)
    alone = STREAM.predict(image[::down, ::along], mirrored[None])[0]
    assert abs(alone - STREAM.predict(image, box[None])[0]) > 0.01


def test_no_boxes_give_empty_predictions():
    odds, lacks = STREAM.predict(SHOTS[0].image, np.empty((0, 4)))
    assert odds.shape == (0,)
    assert lacks.shape == (0, 4)


def test_the_file_is_small_and_holds_the_arrays():
    assert (photos.data.FOLDER / "photographs.npz").stat().st_size < 4e6
    shipped = photos.data.arrays("photographs")
    for name, part in STREAM.arrays().items():
        np.testing.assert_array_equal(np.float16(part), shipped[name])
