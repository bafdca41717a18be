"""A unit is tuned if it is on where the picture's stripes run as it prefers."""

import numpy as np

from reproduce.measures import gabor, texture_tuning
from vmc_lib.what.crbm import CRBM


def striped_units(directions):
    """A CRBM whose filters are stripes of so many directions (rad)."""
    pairs = [gabor.gabor_pair(8, angle, 5, 2, 3, 0, 0)[0] for angle in directions]
    W = np.array(pairs, np.float32).reshape(-1, 1, 8, 8)
    return CRBM(3 * W, np.full(len(W), -3, np.float32), np.zeros(1, np.float32))


def stripes(angle, width=41):
    """A picture (1, 1, width, width) of stripes that change in one direction (rad)."""
    y, x = np.mgrid[:width, :width]
    wave = np.cos(2 * np.pi / 5 * (x * np.cos(angle) + y * np.sin(angle)))
    return wave.astype(np.float32)[None, None]


def test_local_direction_is_that_of_the_stripes():
    angle = np.radians(35)
    found = texture_tuning.local_direction(stripes(angle)[0, 0], 9)
    np.testing.assert_allclose(np.angle(found[9:-9, 9:-9]), 2 * angle, atol=0.15)


def test_stripes_tune_units_of_different_directions():
    directions = np.radians([0, 60])
    picture, other = map(stripes, directions)
    picture[..., 20:] = other[..., 20:]  # two textures, side by side
    tuned = texture_tuning.tuning_strength(striped_units(directions), picture)
    assert tuned.shape == (2, 1)  # hidden and pooled units, one picture
    assert (tuned > 0.5).all()


def test_units_of_one_direction_are_not_tuned():
    alike = striped_units(np.radians([30, 30]))
    np.testing.assert_allclose(texture_tuning.tuning_strength(alike, stripes(0.3)), 0, atol=1e-6)
