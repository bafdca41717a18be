"""Ablation of the three tricks of CRBM training: shipped filters are reproducible."""

import numpy as np
import pytest

from reproduce.experiments import crbm_ablation
from vmc_lib import photos
from vmc_lib.what.cdbn import N_W, K, crops_of


@pytest.mark.parametrize("name", crbm_ablation.CHANGES)
def test_first_epoch_is_reproducible(name):
    shipped = crbm_ablation.load_results()[name]
    assert shipped.shape == (crbm_ablation.EPOCHS + 1, K, N_W, N_W)
    crops, _ = crops_of(photos.load("rig", "train"))
    np.testing.assert_allclose(
        crbm_ablation.filters_over_epochs(crops, name, epochs=1), shipped[:2], atol=0.01
    )


def test_without_whitening_filters_are_uniform():
    last = {name: filters[-1] for name, filters in crbm_ablation.load_results().items()}
    even = {k: np.abs(W.mean((1, 2))).sum() / np.abs(W).mean((1, 2)).sum() for k, W in last.items()}
    assert list(last) == list(crbm_ablation.CHANGES)
    assert max(even, key=even.get) == "no whitening"
