"""The Kalman filter: its gains in the limits; no other belief about the senses errs less."""

from functools import cache

import numpy as np
import pytest

from reproduce.peers import minimum_variance
from reproduce.peers import state_estimation as estimation
from reproduce.peers.lqr_tracking import feedback_law

SHARE = 0.2


@cache
def law():
    return feedback_law(minimum_variance.least_variance_excitations()[:1])


@cache
def gains(error):
    noise = estimation.command_noise(law(), SHARE)
    return estimation.kalman_gains(law().A[0], slopes(), noise, error)


@cache
def slopes():
    return estimation.place_slopes(law())


@cache
def deviations():
    commands = law().commands[0].mean(axis=1)
    rng = np.random.default_rng(3)
    return estimation.deviate(law().A[0], law().B[0], commands, SHARE, 400, rng)


def places(states):
    return np.einsum("tij,rtj->rti", slopes(), states)


def error_of(believed, true, rng):
    """The mean square error (m²) of the place by a filter with a belief about the senses."""
    truth = places(deviations())
    reports = truth + true * rng.standard_normal(truth.shape)
    estimates = estimation.estimate(law().A[0], slopes(), gains(believed), reports)
    return np.square(places(estimates) - truth)[:, 70:].mean()


def test_noise_of_the_commands_is_what_the_filter_reckons_with():
    """The spread of simulated reaches is that of its own prediction."""
    P = np.zeros((10, 10))
    for a, noise in zip(law().A[0], estimation.command_noise(law(), SHARE), strict=True):
        P = a @ P @ a.T + noise
    found = np.cov(deviations()[:, -1].T)
    np.testing.assert_allclose(np.diag(found), np.diag(P), rtol=0.25)


def test_exact_senses_are_believed_and_useless_ones_are_not():
    believed = np.einsum("tij,tjk->tik", slopes(), gains(1e-7))[20:]
    np.testing.assert_allclose(believed, np.broadcast_to(np.eye(2), believed.shape), atol=1e-3)
    assert np.abs(gains(1e3)).max() < 1e-3


@pytest.mark.parametrize("true", [0.002, 0.01])
def test_no_other_belief_about_the_senses_errs_less(true):
    best = error_of(true, true, np.random.default_rng(1))
    for factor in (0.1, 0.3, 3, 10):
        assert error_of(factor * true, true, np.random.default_rng(1)) > best
    assert best < true**2
    assert best < np.square(places(deviations()))[:, 70:].mean()  # by the model alone
