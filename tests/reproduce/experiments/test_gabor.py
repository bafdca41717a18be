"""The Gabor test is as fair to a wide filter as to a narrow one."""

import numpy as np
import pytest

from reproduce.experiments import gabor


@pytest.mark.parametrize(("n_w", "least"), [(8, 0.97), (23, 0.99)])
def test_an_ideal_gabor_is_recognised_at_every_width(n_w, least):
    rng = np.random.default_rng(0)
    low, high = gabor.BOUNDS[:, 1:]
    for _ in range(8):
        shape = gabor.scale_shapes([[rng.uniform(0, np.pi), *rng.uniform(low, high)]], n_w)[0]
        ideal = rng.normal(size=2) @ gabor.gabor_pair(n_w, *shape)
        assert gabor.best_gabor(ideal.reshape(n_w, n_w))[1] > least


def test_noise_is_no_gabor():
    noise = np.random.default_rng(0).normal(size=(23, 23))
    assert gabor.best_gabor(noise)[1] < 0.5
