"""Data augmentation by pasted cut-outs: they lie in their boxes, and nothing else changes."""

import numpy as np
import pytest

from reproduce.render import cutout_atlas
from reproduce.training.pasting import paste_cutout, paste_cutouts
from vmc_lib import photos
from vmc_lib.boxes import area

GROUND = next(shot for shot in photos.load("real", "train") if not shot.boxes)


def test_stored_cutouts_load_again(tmp_path, monkeypatch):
    rng = np.random.default_rng(0)
    some = np.zeros((cutout_atlas.COLUMNS, cutout_atlas.WIDTH, cutout_atlas.WIDTH, 4), np.uint8)
    some[:, 32:96, 32:96, :3] = rng.integers(0, 255, (cutout_atlas.COLUMNS, 1, 1, 3))
    some[:, 32:96, 32:96, 3] = 255
    monkeypatch.setitem(cutout_atlas.FILES, "some", tmp_path / "some.webp")
    cutout_atlas.store(some, "some")
    read = cutout_atlas.load("some")
    assert read.shape == some.shape
    assert np.abs(read[:, 40:88, 40:88].astype(int) - some[:, 40:88, 40:88]).mean() < 4


@pytest.mark.parametrize(("kind", "count"), [("shuttlecocks", 480), ("decoys", 320)])
def test_shipped_cutouts_are_whole(kind, count):
    some = cutout_atlas.load(kind)
    assert some.shape == (count, cutout_atlas.WIDTH, cutout_atlas.WIDTH, 4)
    edges = [some[:, k, :, 3].max() for k in (0, -1)] + [some[:, :, k, 3].max() for k in (0, -1)]
    assert max(edges) < 60
    covered = (some[..., 3] > 128).mean((1, 2))
    assert covered.min() > (0.02 if kind == "shuttlecocks" else 0.005)  # a pen is thin
    assert covered.max() < 0.8


@pytest.mark.parametrize("seed", range(6))
def test_a_shuttlecock_lies_in_its_box(seed):
    class Grey:
        image = np.full((400, 600, 3), 120, np.uint8)

    black = np.zeros((cutout_atlas.WIDTH, cutout_atlas.WIDTH, 4), np.uint8)
    black[30:100, 50:80] = 0, 0, 0, 255  # and opaque
    photo = paste_cutout(Grey, black, np.random.default_rng(seed))
    x0, y0, x1, y1 = photo.boxes["shuttlecock"].astype(int)
    assert 0 <= x0 < x1 <= photos.WIDTH
    assert 0 <= y0 < y1 <= photos.HEIGHT
    dark = photo.image.max(2) < 12
    rows, columns = np.flatnonzero(dark.any(1)), np.flatnonzero(dark.any(0))
    inner = [columns[0], rows[0], columns[-1] + 1, rows[-1] + 1]
    soft = 3 + 0.04 * max(x1 - x0, y1 - y0)  # a thing out of focus is grey at its edge
    assert np.abs(photo.boxes["shuttlecock"] - inner).max() < soft


def test_validation_cutouts_are_not_used_for_training():
    shots = photos.load("real", "train")
    some = paste_cutouts(shots, "train", 6, np.random.default_rng(0))
    assert len(some) == 6
    assert all(one.image.shape == GROUND.image.shape for one in some)
    assert all(area(one.boxes["shuttlecock"]) > 400 for one in some)
    ranges = []
    for split in ("train", "validation"):

        class Told:
            def integers(self, high):
                ranges.append(high)
                raise StopIteration

        with pytest.raises(StopIteration):
            paste_cutouts(shots, split, 1, Told())
    assert ranges == [480 - cutout_atlas.HELD_OUT, cutout_atlas.HELD_OUT]
