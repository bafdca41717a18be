import numpy as np
import pytest
import torch

from reproduce import wide_training
from reproduce.pools import by_kind, pool
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import Recogniser, read_outs

RNG = np.random.default_rng(0)
SOME = [
    pool({"rig": [by_kind(shot, np.empty((0, 4)), RNG) for shot in photos.load("rig", split)[:8]]})
    for split in ("train", "validation")
]


def stripes(n):
    """Upright stripes, which are called shuttlecocks, and level ones."""
    labels = RNG.random(n) < 0.5
    phase = RNG.random((n, 1, 1)) * 6 + np.arange(48) / 2
    waves = np.broadcast_to(np.sin(phase), (n, 48, 48))
    crops = np.where(labels[:, None, None], waves, waves.swapaxes(1, 2))
    return np.float32((crops + RNG.normal(0, 0.2, crops.shape)) / 4 + 0.5), labels


def test_back_propagation_learns_what_labels_tell():
    cdbn = wide_training.end_to_end(stripes, np.random.default_rng(0), maps=(4, 4), steps=30)
    assert isinstance(cdbn.first.W, np.ndarray)
    crops, labels = stripes(40)
    learnt, blank = (read_outs(c, crops)["P1 + P2"] for c in (cdbn, untaught()))

    def apart(x):
        return np.abs(x[labels].mean(0) - x[~labels].mean(0)).max()

    assert apart(learnt) > 2 * apart(blank)


def untaught():
    blank = wide_training.blank((4, 4), torch.Generator().manual_seed(0))
    return CDBN.from_arrays(blank.arrays())


def test_a_blank_network_is_on_half_the_time():
    layers = untaught().layers(whiten(stripes(20)[0]))
    assert layers["P1"].mean() == pytest.approx(0.5, abs=0.1)


def test_a_read_out_is_learnt_from_examples():
    recogniser = wide_training.named(untaught(), SOME, RNG, count=80)
    assert recogniser.width == 48
    crops, labels = SOME[1].examples(60, RNG)
    chance = recogniser.probability(crops)
    assert chance[labels].mean() > chance[~labels].mean()


def test_what_ships_is_small_and_knows_real_shuttlecocks():
    recogniser = Recogniser.load("real")
    assert recogniser.cdbn.second.W.shape[:2] == wide_training.MAPS[::-1]
    shots = [shot for shot in photos.load("real", "train") if "shuttlecock" in shot.boxes]
    crops = np.array([wide_training.loop.crop(s.image, s.boxes["shuttlecock"]) for s in shots])
    assert (recogniser.probability(crops) > 0.5).mean() > 0.8
    file = photos.data.FOLDER / "photographs.npz"
    assert file.stat().st_size < 4e6
