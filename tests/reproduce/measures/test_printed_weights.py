"""Can the reaches of Table IV share four templates?"""

import numpy as np
import pytest

from reproduce import paper
from reproduce.measures.printed_weights import best_points, least_misfits
from vmc_lib.motor.planning import habitual_weights

RIGHT = [0, 3, 4]  # the columns that sum to one, as they are printed


@pytest.mark.parametrize("seed", range(3))
def test_templates_are_found_where_there_are_four(seed):
    """Also from weights that are rounded as the paper's are."""
    rng = np.random.default_rng(seed)
    points = paper.TARGETS.mean(axis=0) + rng.uniform(-0.1, 0.1, (4, 2))
    weights = habitual_weights(paper.TARGETS, points).T
    found, off = best_points(paper.TARGETS, weights.round(4), rng)
    assert off < paper.LENGTH
    assert np.allclose(found, points, atol=0.01)


def test_no_four_templates_explain_table_4():
    misfits = least_misfits(range(5), RIGHT)
    assert list(misfits) == [5, 3]
    assert min(misfits.values()) > 10 * paper.LENGTH
