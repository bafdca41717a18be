"""A turn between directions takes the short way round."""

import numpy as np
import pytest

from reproduce.measures.changed_worlds import turn_between


@pytest.mark.parametrize("middle", np.radians([-180, -90, 0, 170, 180]))
def test_a_turn_takes_the_short_way_round(middle):
    targets, points = (
        2 * np.stack([np.cos(middle + turn), np.sin(middle + turn)], axis=-1) + [1, -3]
        for turn in (np.array([0.1, -0.1]), np.array([-0.1, 0.3]))
    )
    np.testing.assert_allclose(turn_between(points, targets, np.array([1, -3])), [-0.2, 0.4])
