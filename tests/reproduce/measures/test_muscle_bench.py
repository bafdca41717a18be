"""A muscle on the bench."""

import numpy as np
import pytest

from book.figures import muscle as figures
from reproduce.measures import muscle_bench
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


@pytest.mark.parametrize(("law", "ends"), [("Thelen 2003", True), ("MuJoCo", False)])
def test_a_fibre_is_drawn_until_it_is_too_short_to_be_real(law, ends):
    left, _ = figures.isotonic((2, 20), 2, *muscle_bench.isotonic(LAWS[law], (2, 20))).axes
    drawn = left.lines[-1].get_ydata()
    assert drawn.min() > figures.SHORTEST
    assert (len(drawn) < 300) == ends


def test_pulses_that_follow_each_other_closer_ripple_less():
    ripples = [
        muscle_bench.ripple(muscle_bench.isometric(muscle.PAPER, n)) for n in (6, 25, 50, 100)
    ]
    assert ripples == sorted(ripples, reverse=True)


def test_a_tendon_stretches_by_a_twentieth_under_the_greatest_force():
    assert muscle_bench.tendon_force(0.049) == pytest.approx(1, abs=0.01)
    strains = np.linspace(-0.001, 0.06, 9)
    forces = muscle_bench.tendon_force(strains)
    np.testing.assert_allclose(muscle_bench.tendon_strain(forces), strains, atol=1e-12)


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_a_tendon_makes_a_twitch_later_and_lower(law):
    times = [muscle_bench.time_to_peak(law, tendon) for tendon in (0, 0.6, 2.4)]
    assert times[0] == 3  # with a rigid tendon, as the pulse ends
    assert times[0] < times[1] < times[2]
    peaks = [muscle_bench.isometric(law, 3, 1.0, tendon).max() for tendon in (0, 0.6, 2.4)]
    assert peaks == sorted(peaks, reverse=True)


def test_on_a_tendon_the_pull_settles_where_fibre_and_tendon_agree():
    """Half active, the fibre shortens by what the tendon gives, whatever the steps."""
    active = np.full(2000, 0.5)
    coarse, fine = (
        muscle_bench._pull_on_tendon(muscle.PAPER, active, np.array(1.0), 2.4, steps=steps)
        for steps in (2, 8)
    )
    np.testing.assert_allclose(coarse, fine, atol=5e-3)
    begun, ended = (muscle_bench.tendon_strain(pull) for pull in coarse[[0, -1]])
    length = 1 - 2.4 * (ended - begun)
    still = muscle_bench.normalised_force(muscle.PAPER, 0.5, length, 0)
    assert coarse[-1] == pytest.approx(still, abs=1e-3)


def test_a_fibre_is_said_to_move_as_it_does_now():
    """Not as it has moved since it was let go; and its length is not taken for a change."""
    there_and_back = np.concatenate([np.linspace(1, 0.9, 101), np.linspace(0.9, 1, 101)])
    said = {0: "1.00 l₀, half on", 50: "0.95 l₀, shortening", 150: "0.95 l₀, lengthening"}
    for time, words in said.items():
        assert f"length {words}" in figures.lift(20, there_and_back, time)
        assert f"length {words}" in figures.lift_in_words(20, there_and_back, time)
