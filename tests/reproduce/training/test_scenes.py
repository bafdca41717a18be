"""Pasted scenes: things lie apart in their boxes, of every kind, none that taught in the others."""

import numpy as np
import pytest

from reproduce.render import cutout_atlas
from reproduce.training import scenes
from vmc_lib import photos
from vmc_lib.boxes import area, iou


@pytest.fixture(scope="module")
def pasted():
    """As many photos as there are scenes, twice."""
    shots, twice = photos.load("real", "train"), 2 * len(scenes.SCENES)
    return scenes.paste_photos(shots, "train", twice, np.random.default_rng(0))


def black_cutout():
    """A cut-out with one opaque black block."""
    black = np.zeros((cutout_atlas.WIDTH, cutout_atlas.WIDTH, 4), np.uint8)
    black[30:100, 50:80] = 0, 0, 0, 255
    return black


@pytest.mark.parametrize("seed", range(6))
def test_a_cutout_lies_in_its_box(seed):
    image = np.full((*scenes.PICTURE, 3), 0.5, np.float32)
    rng = np.random.default_rng(seed)
    [box] = scenes.paste_apart(image, black_cutout(), np.empty((0, 4)), rng)
    x0, y0, x1, y1 = box.astype(int)
    assert 0 <= x0 < x1 <= photos.WIDTH
    assert 0 <= y0 < y1 <= photos.HEIGHT
    dark = image.max(2) < 0.05
    rows, columns = np.flatnonzero(dark.any(1)), np.flatnonzero(dark.any(0))
    inner = [columns[0], rows[0], columns[-1] + 1, rows[-1] + 1]
    soft = 3 + 0.04 * max(x1 - x0, y1 - y0)  # a thing out of focus is grey at its edge
    assert np.abs(box - inner).max() < soft


def test_cutouts_are_laid_apart():
    image = np.full((*scenes.PICTURE, 3), 0.5, np.float32)
    rng, boxes = np.random.default_rng(0), np.empty((0, 4))
    for _ in range(3):
        boxes = scenes.paste_apart(image, black_cutout(), boxes, rng)
    assert len(boxes) == 3
    assert iou(boxes, boxes)[~np.eye(3, dtype=bool)].max() == 0


def test_each_scene_has_its_shuttlecocks_and_decoys(pasted):
    for photo, (count, most, _) in zip(pasted, 2 * list(scenes.SCENES.values()), strict=True):
        boxes = photos.boxes_of(photo, "shuttlecock")
        assert photo.image.shape == (*scenes.PICTURE, 3)
        assert len(boxes) == count
        assert min(1, most) <= len(photo.decoys) <= most
        assert (area(np.vstack([boxes, photo.decoys])) > 400).all()


def test_strings_cross_a_picture_in_lines():
    image = np.full((*scenes.PICTURE, 3), 0.5, np.float32)
    scenes.draw_strings(image, np.random.default_rng(0))
    drawn = (np.abs(image - 0.5) > 0.02).any(2)
    assert 0.05 < drawn.mean() < 0.7
    middle = drawn[150:250, 200:400].astype(int)
    assert (np.abs(np.diff(middle, axis=1)).sum(1) > 4).mean() > 0.9


def test_no_cutout_is_in_two_splits(monkeypatch):
    asked = {}
    for split in photos.SPLITS:
        monkeypatch.setattr(
            scenes, "paste_scene", lambda _, *some, split=split: asked.update({split: some[:2]})
        )
        scenes.paste_photos(photos.load("real", split), split, 1, np.random.default_rng(0))
    for k, kind in enumerate(("shuttlecocks", "decoys")):
        parts = [asked[split][k] for split in photos.SPLITS]
        joined = np.concatenate(parts)
        assert (joined == cutout_atlas.load(kind)).all()
        assert len(parts[1]) == len(parts[2]) == cutout_atlas.UNTRAINED_COUNT // 2
