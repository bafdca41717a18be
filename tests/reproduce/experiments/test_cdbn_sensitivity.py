import numpy as np
import pytest

from reproduce.experiments import cdbn_sensitivity
from reproduce.measures.gabor import best_gabor
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W
from vmc_lib.what.recogniser import READ_OUTS


def test_every_variation_covers_every_photo():
    results = cdbn_sensitivity.load_results()
    assert len({seed for n_w, seed in results if n_w == N_W}) >= 3
    assert len({n_w for n_w, _ in results}) >= 3
    boxes = [2 * len(photos.load("rig", split)) for split in cdbn_sensitivity.SPLITS]
    for (n_w, _), (filters, counts) in results.items():
        assert filters.shape == (10, n_w, n_w)
        assert counts.shape == (len(photos.LEVELS), len(READ_OUTS), len(cdbn_sensitivity.SPLITS), 4)
        assert (counts.sum(3) == boxes).all()


def test_the_network_that_ships_is_the_first_variation():
    filters, _ = cdbn_sensitivity.load_results()[N_W, 0]
    shipped = CDBN.load().first.W[:, 0]
    likeness = [
        np.corrcoef(a.ravel(), b.ravel())[0, 1] for a, b in zip(filters, shipped, strict=True)
    ]
    assert min(likeness) > 0.9  # another machine may round otherwise


@pytest.mark.audit
def test_every_width_finds_edges():
    for variation, (filters, _) in cdbn_sensitivity.load_results().items():
        assert np.median([best_gabor(w)[1] for w in filters]) > 0.75, variation


def test_gain_from_width_by_hand():
    shares = {
        (N_W, 0): {"MP2": 0.8, "P2": 0.5},
        (N_W, 1): {"MP2": 0.9, "P2": 0.5},
        (N_W - 2, 0): {"MP2": 1.0, "P2": 1.0},  # narrower
        (N_W + 2, 0): {"MP2": 0.6, "P2": 0.95},
    }
    assert cdbn_sensitivity.gain_from_width(shares) == pytest.approx((0.95 - 0.85, 0.1))


def test_accuracy_counts_all_levels_together():
    counts = np.zeros((3, 3, 2, 4), int)
    counts[:, :, 1] = [3, 1, 2, 4]
    assert cdbn_sensitivity.accuracy({(N_W, 0): (None, counts)})[N_W, 0] == dict.fromkeys(
        READ_OUTS, 0.7
    )
