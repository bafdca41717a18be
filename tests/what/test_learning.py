"""Training a CRBM: repeatable, resumable, sparse; and what it refuses."""

from itertools import islice

import numpy as np
import pytest
import torch

from vmc_lib.what.learning import Learner


def rng(seed=0):
    return torch.Generator().manual_seed(seed)


def noise(n=300):
    return torch.randn(n, 1, 9, 9, generator=rng(3))


def trained(epochs, seed=0, start=None):
    machine = start or Learner.random(3, 1, 4, rng(seed))
    machine.fit(noise(), epochs, seed)
    return machine


def test_fit_is_repeatable_and_can_be_resumed(tmp_path):
    whole = trained(range(4))
    np.savez(tmp_path / "half.npz", **trained(range(2)).arrays())
    with np.load(tmp_path / "half.npz", allow_pickle=False) as half:
        resumed = trained(range(2, 4), start=Learner.from_arrays(half))
    for name in "Wba":
        assert torch.equal(getattr(whole, name), getattr(resumed, name))
    assert not torch.equal(whole.W, trained(range(4), seed=1).W)


def test_the_callback_receives_each_error_and_changes_nothing():
    silent, watched = (Learner.random(3, 1, 4, rng()) for _ in range(2))
    calls = []
    errors = silent.fit(noise(), range(2), 0)
    watched.fit(noise(), range(2), 0, after=lambda epoch, error: calls.append((epoch, error)))
    assert torch.equal(silent.W, watched.W)
    assert calls == list(enumerate(errors))


def test_sparsity_is_reached():
    machine = Learner.random(3, 1, 4, rng())
    machine.fit(noise(2000), range(8), 0, sparsity=0.05, rate=0.2)
    assert machine.posterior(noise())[0].mean((0, 2, 3)).numpy() == pytest.approx(0.05, abs=0.005)


def test_the_clamp_keeps_the_edge_of_a_patch():
    machine, v = Learner.random(3, 1, 4, rng()), noise(5)
    *_, (sample, _) = islice(machine.gibbs(v, rng(), clamp=True), 3)
    changed = (sample != v).any(0)[0]
    assert changed[3:-3, 3:-3].all()
    assert changed.sum() == 9


@pytest.mark.parametrize(
    ("patches", "message"),
    [
        (torch.zeros(0, 1, 9, 9), "no patches"),
        (torch.full((5, 1, 9, 9), torch.nan), "finite"),
        (torch.zeros(10, 1, 6, 6), "6 × 6 are all edge for filters of 4"),
    ],
)
def test_fit_refuses_patches_it_cannot_learn_from(patches, message):
    with pytest.raises(ValueError, match=message):
        Learner.random(2, 1, 4, rng()).fit(patches, range(1), 0)
