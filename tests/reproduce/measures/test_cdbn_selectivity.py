import numpy as np
import pytest
import torch

from reproduce.measures import cdbn_selectivity
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, crops_of
from vmc_lib.what.crops import whiten
from vmc_lib.what.learning import Learner


@pytest.fixture(scope="module")
def network():
    crops, _ = crops_of(photos.load("rig", "validation")[:2])
    return CDBN.load(Learner), torch.from_numpy(whiten(crops))


@pytest.mark.parametrize(("layer", "step", "width"), [("H1", 1, 8), ("H2", 2, 23)])
def test_a_preferred_patch_is_what_its_unit_sees_where_it_answers_most(network, layer, step, width):
    cdbn, pictures = network
    patches, of = cdbn_selectivity.preferred_patches(cdbn, pictures, count=2)[layer]
    maps = np.array(cdbn.layers(pictures)[layer])
    assert patches.shape == (10, 2, width, width)
    for unit in range(10):
        peaks = maps[of[unit], unit].max(axis=(1, 2))
        assert peaks[0] >= peaks[1]
        y, x = np.unravel_index(maps[of[unit, 0], unit].argmax(), maps.shape[2:])
        window = pictures[of[unit, 0], 0, step * y :, step * x :][:width, :width]
        np.testing.assert_array_equal(patches[unit, 0], window)


def test_no_shift_changes_nothing_and_a_shift_does(network):
    cdbn, pictures = network
    found = cdbn_selectivity.shift_correlations(cdbn, pictures, [0, 4])
    assert min(found[0].values()) == pytest.approx(1)
    assert max(found[4].values()) < 0.999
    assert found[4]["P2, quarters"] == max(found[4].values())
