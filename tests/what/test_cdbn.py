import numpy as np
import pytest
import torch

from reproduce.measures.gabor import best_gabor
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.learning import Learner


@pytest.fixture(scope="module")
def cdbn():
    return CDBN.load()


def test_layers_have_the_papers_sizes(cdbn, white):
    layers = cdbn.layers(white)
    widths = {"V": (1, 200), "H1": (10, 192), "P1": (10, 96), "H2": (10, 88), "P2": (10, 44)}
    for name, (count, width) in (widths | {"MP2": (1, 44)}).items():
        assert layers[name].shape == (4, count, width, width)
    assert np.array_equal(layers["MP2"][:, 0], layers["P2"].mean(1))
    for name in ("H1", "P1", "H2", "P2"):
        assert 0 <= layers[name].min()
        assert layers[name].max() <= 1


def test_numpy_and_torch_compute_equal_layers(cdbn, white):
    """NumPy's layers beside torch's own convolution and softmax, and beside those of a Learner."""
    F = torch.nn.functional
    learner = CDBN.load(Learner).layers(torch.from_numpy(white))
    ours = cdbn.layers(white)
    for name, maps in ours.items():
        np.testing.assert_allclose(maps, learner[name], atol=5e-5)  # float32, steep
    drive = F.conv2d(
        torch.from_numpy(white)[..., :199, :199], *map(torch.tensor, (cdbn.first.W, cdbn.first.b))
    )
    units = F.pixel_unshuffle(drive, 2).unflatten(1, (10, 4))
    on = torch.softmax(F.pad(units, (0, 0, 0, 0, 0, 1)), 2)
    np.testing.assert_allclose(ours["P1"], 1 - on[:, :, 4], atol=1e-5)
    np.testing.assert_allclose(
        ours["H1"], F.pixel_shuffle(on[:, :, :4].flatten(1, 2), 2), atol=1e-5
    )
    for alone, name in zip(cdbn.pooled(white), ("P1", "P2"), strict=True):
        np.testing.assert_allclose(alone, ours[name], rtol=0, atol=1e-6)


def test_projected_filters_match_one_active_second_layer_unit(cdbn):
    """Moving a picture along a projected filter drives its unit up, as a straight line."""
    projected = cdbn.projected_filters()
    assert projected.shape == (10, 23, 23)
    for k in (0, 7):
        W = torch.tensor(cdbn.second.W[k : k + 1])
        h1 = torch.nn.functional.interpolate(W, scale_factor=2) / 4
        painted = torch.nn.functional.conv_transpose2d(h1, torch.tensor(cdbn.first.W))
        assert projected[k] == pytest.approx(painted[0, 0].numpy(), abs=1e-5)


def test_first_layer_filters_are_gabor_like(cdbn):
    correlations = [best_gabor(W)[1] for W in cdbn.first.W[:, 0]]
    assert sum(r >= 0.75 for r in correlations) >= 8
