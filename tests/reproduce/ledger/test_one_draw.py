"""What ships for the ledger is what the code gives: one draw of each, made again."""

import numpy as np
import pytest

from reproduce.experiments import calibration, class_independence, hmax_draws, second_layers
from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.where.selective_search import propose


def test_one_draw_of_movements_is_reproducible():
    """The paper's own reading of where a movement ends; Table VI's first experiment."""
    name = f"{calibration.SCENARIOS[0]}, {calibration.AS_PRINTED}"
    now = calibration.EXPERIMENTS[name](0, experiments=1)
    shipped = {k: values[0] for k, values in calibration.load_results()[name].items()}
    assert {k: round(v, 4) for k, v in now.items()} == pytest.approx(
        {k: shipped[k] for k in now}, abs=2e-4
    )


@pytest.mark.audit
def test_one_pair_of_second_layers_is_reproducible():
    np.testing.assert_allclose(
        second_layers.preferences(0), second_layers.load_preferences()[0], atol=0.005
    )


def test_draws_of_prototypes_say_of_crops_what_is_shipped():
    now = hmax_draws.probabilities(photos.load("rig", "test")[:2])
    np.testing.assert_allclose(now, arrays("hmax_draws")["test"][:, :4], atol=1e-3)


@pytest.mark.parametrize("level", class_independence.WAYS)
def test_what_is_boxed_well_is_reproducible(level):
    some = slice(0, 40, 8)
    shots = photos.load(level, "test")[some]
    for way, boxed in class_independence.load_boxed(level).items():
        if way != "quality":  # ten times as slow
            found = [propose(shot.image, way) for shot in shots]
            now = class_independence.objects_boxed(found, shots)
            assert (now != boxed[some]).sum() <= 1, way
