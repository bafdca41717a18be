"""Cut-outs to paste: what is stored loads again, and what ships is whole."""

import numpy as np
import pytest

from reproduce.render import cutout_atlas


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
