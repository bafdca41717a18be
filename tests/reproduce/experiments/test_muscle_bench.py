"""A muscle on the bench."""

import numpy as np
import pytest

from reproduce.experiments import muscle_bench
from reproduce.peers.muscle_models import LAWS
from vmc_lib.arm import muscle


def test_the_papers_muscle_has_no_force_left_where_f2_is_zero():
    speed = -muscle.VELOCITY_RANGE[0] * muscle.MAX_VELOCITY
    assert muscle_bench.fastest_shortening(muscle.PAPER) == pytest.approx(speed, abs=1e-3)


@pytest.mark.parametrize(("law", "speed"), [("Thelen 2003", 10), ("MuJoCo", 1.5)])
def test_the_other_laws_have_no_force_left_at_their_own_greatest_speed(law, speed):
    assert muscle_bench.fastest_shortening(LAWS[law]) == pytest.approx(speed, abs=0.01)


@pytest.mark.parametrize("law", LAWS)
def test_a_load_as_heavy_as_the_pull_stays_where_it_is_released(law):
    pull = LAWS[law].force(0.5, 1.0, 0.0, muscle_bench.STRENGTH)
    lengths, speeds = muscle_bench.isotonic(LAWS[law], [pull / 9.81, 2.0], duration=50)
    np.testing.assert_allclose(lengths[:, 0], 1)
    assert (speeds[1:, 1] < 0).all()  # a light load is lifted


def test_pulses_that_follow_each_other_closer_ripple_less():
    ripples = [
        muscle_bench.ripple(muscle_bench.isometric(muscle.PAPER, n)) for n in (6, 25, 50, 100)
    ]
    assert ripples == sorted(ripples, reverse=True)
