"""The Gabor fit is as fair to a wide filter as to a narrow one, and blobs have no direction."""

import numpy as np
import pytest

from reproduce.measures import gabor


@pytest.mark.parametrize(("n_w", "least"), [(8, 0.97), (23, 0.99)])
def test_an_ideal_gabor_is_recognised_at_every_width(n_w, least):
    rng = np.random.default_rng(0)
    low, high = np.array(gabor.GABORS.bounds)[:, 1:]
    for _ in range(8):
        shape = rng.uniform(0, np.pi), *rng.uniform(low, high)
        shape = gabor.GABORS.scale_shapes([shape], n_w)[0]
        ideal = (rng.normal(size=2) @ gabor.gabor_pair(n_w, *shape)).reshape(n_w, n_w)
        fit, correlation = gabor.best_gabor(ideal + 3)
        assert correlation > least
        assert np.corrcoef(fit.ravel(), ideal.ravel())[0, 1] == pytest.approx(correlation, abs=1e-3)


@pytest.mark.parametrize(("n_w", "most"), [(8, 0.75), (23, 0.5)])
def test_noise_is_no_gabor(n_w, most):
    for noise in np.random.default_rng(0).normal(size=(5, n_w, n_w)):
        assert gabor.best_gabor(noise)[1] < most


def test_a_round_blob_is_fitted_by_a_blob_and_has_no_direction():
    blob = gabor.blob_pair(8, 1.3, 2, 0.2, -0.3)[0].reshape(8, 8)
    stripes = gabor.gabor_pair(8, np.radians(30), 5, 2, 3, 0, 0)[1].reshape(8, 8)
    assert gabor.best_fit(blob, gabor.BLOBS)[1] > 0.999
    assert gabor.best_fit(stripes, gabor.BLOBS)[1] < 0.8 < gabor.best_gabor(stripes)[1]
    assert abs(gabor.direction_vector(blob)) < 0.1 < 0.4 < abs(gabor.direction_vector(stripes))
    assert np.degrees(np.angle(gabor.direction_vector(stripes))) / 2 == pytest.approx(30, abs=3)


@pytest.mark.audit
def test_bandwidths_are_those_of_a_cell_behind_the_retina():
    """A wide Gabor function's are known: its answers are a Gauss function of the frequency."""
    n_w, wavelength, breadth = 65, 6, 8.0
    stripes = gabor.gabor_pair(n_w, 0, wavelength, breadth, breadth, 0, 0)[0].reshape(n_w, n_w)
    half = np.sqrt(2 * np.log(2)) / (2 * np.pi * breadth)  # of its width in frequency
    octaves = np.log2((1 / wavelength + half) / (1 / wavelength - half))
    found, degrees = gabor.bandwidths(stripes)
    assert found == pytest.approx(octaves, abs=0.06)
    assert degrees == pytest.approx(2 * np.degrees(np.arctan(half * wavelength)), abs=2)


def test_a_blob_wider_than_the_coarsest_stripe_has_no_bandwidth():
    bell = np.exp(-np.square(np.arange(-16, 17) / 6) / 2)
    assert gabor.bandwidths(np.outer(bell, bell))[0] == np.inf
