import numpy as np
import pytest
import torch

from reproduce.training.cdbn import train_cdbn
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.learning import Learner


def test_training_is_repeatable_and_saves_whole(white, tmp_path):
    positive = np.array([True, False, True, False])
    one, two = (train_cdbn(white, positive, 1, patches=200) for _ in range(2))
    np.savez(tmp_path / "one.npz", **one.arrays())
    with np.load(tmp_path / "one.npz") as file:
        loaded = CDBN.from_arrays(file, Learner)
    white = torch.from_numpy(white)
    p2 = [net.layers(white)["P2"] for net in (one, two, loaded)]
    assert torch.equal(p2[0], p2[1])
    assert torch.equal(p2[0], p2[2])
    other = train_cdbn(white, positive, 2, patches=200)
    assert not torch.equal(p2[0], other.layers(white)["P2"])


def test_training_needs_a_positive_picture(white):
    with pytest.raises(ValueError, match="at least one"):
        train_cdbn(white, np.zeros(4, bool), patches=100)


@pytest.mark.skipif(not torch.cuda.is_available(), reason="no GPU here")
def test_training_runs_on_the_gpu(white):
    there = train_cdbn(white, np.ones(4, bool), patches=200, device="cuda")
    assert there.first.W.is_cuda
    assert there.second.W.is_cuda
    here = CDBN.from_arrays(there.arrays())
    on_gpu = there.layers(torch.from_numpy(white).cuda())["P2"].cpu().numpy()
    assert on_gpu == pytest.approx(here.layers(white)["P2"], abs=1e-3)


@pytest.mark.parametrize("n_w", [7, 10, 11])
def test_other_filter_widths_are_trimmed_to_whole_blocks(white, n_w):
    net = train_cdbn(white, np.ones(4, bool), n_w=n_w, patches=100)
    for layer in ("H1", "H2"):
        assert net.layers(torch.from_numpy(white))[layer].shape[-1] % 2 == 0
