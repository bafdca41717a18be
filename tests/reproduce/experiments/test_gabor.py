"""The Gabor fit is as fair to a wide filter as to a narrow one."""

import numpy as np
import pytest

from reproduce.experiments import gabor


@pytest.mark.parametrize(("n_w", "least"), [(8, 0.97), (23, 0.99)])
def test_an_ideal_gabor_is_recognised_at_every_width(n_w, least):
    rng = np.random.default_rng(0)
    low, high = gabor.BOUNDS[:, 1:]
    for _ in range(8):
        shape = gabor.scale_shapes([[rng.uniform(0, np.pi), *rng.uniform(low, high)]], n_w)[0]
        ideal = (rng.normal(size=2) @ gabor.gabor_pair(n_w, *shape)).reshape(n_w, n_w)
        fit, correlation = gabor.best_gabor(ideal + 3)
        assert correlation > least
        assert np.corrcoef(fit.ravel(), ideal.ravel())[0, 1] == pytest.approx(correlation, abs=1e-3)


@pytest.mark.parametrize(("n_w", "most"), [(8, 0.75), (23, 0.5)])
def test_noise_is_no_gabor(n_w, most):
    for noise in np.random.default_rng(0).normal(size=(5, n_w, n_w)):
        assert gabor.best_gabor(noise)[1] < most
