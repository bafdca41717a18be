from functools import partial

import numpy as np
import pytest
import torch

from reproduce.training.end_to_end import random_network, train_end_to_end
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import whiten
from vmc_lib.what.recogniser import read_outs


def stripes(n, rng):
    """Upright stripes, which are called shuttlecocks, and level ones."""
    labels = rng.random(n) < 0.5
    phase = rng.random((n, 1, 1)) * 6 + np.arange(48) / 2
    waves = np.broadcast_to(np.sin(phase), (n, 48, 48))
    crops = np.where(labels[:, None, None], waves, waves.swapaxes(1, 2))
    return np.float32((crops + rng.normal(0, 0.2, crops.shape)) / 4 + 0.5), labels


@pytest.mark.audit
def test_back_propagation_separates_the_labels():
    rng = np.random.default_rng(0)
    cdbn = train_end_to_end(
        partial(stripes, rng=rng), np.random.default_rng(0), 48, (4, 4), 60, 64, 0.005
    )
    assert isinstance(cdbn.first.W, np.ndarray)
    crops, labels = stripes(40, rng)
    trained, untrained = (read_outs(c, crops)["P1 + P2"] for c in (cdbn, random()))

    def apart(x):
        return np.abs(x[labels].mean(0) - x[~labels].mean(0)).max()

    assert apart(trained) > 2 * apart(untrained)


def random():
    return CDBN.from_arrays(random_network((4, 4), torch.Generator().manual_seed(0)).arrays())


def test_random_network_is_on_half_the_time():
    layers = random().layers(whiten(stripes(20, np.random.default_rng(0))[0]))
    assert layers["P1"].mean() == pytest.approx(0.5, abs=0.1)
