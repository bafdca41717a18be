import torch

from reproduce.measures.cd_bias import distance_and_cosine, exact_samples
from vmc_lib.what.learning import Learner

BAR = torch.tensor([[[[-1.0, 2.0, -1.0]] * 3]]) / 2
STATES = torch.eye(5)[:, :4].reshape(5, 1, 2, 2)


def test_exact_samples_are_explained_as_they_were_drawn():
    """The mean of p(h | v) over a model's own samples is p(h), listed state by state."""
    crbm = Learner(BAR, torch.tensor([-2.0]), torch.zeros(1))
    v = exact_samples(crbm, STATES, 20_000, torch.Generator().manual_seed(0))
    on, _ = crbm.posterior(v)
    energy = [-(crbm.visible_mean(h[None]) ** 2).sum() / 2 - crbm.b * h.sum() for h in STATES]
    expected = torch.softmax(-torch.stack(energy).flatten(), 0)[:4]
    torch.testing.assert_close(on.mean((0, 1)).flatten(), expected, atol=0.01, rtol=0)


def test_more_rounds_come_nearer_to_the_gradient():
    crbm = Learner(1.5 * BAR, torch.tensor([-5.0]), torch.zeros(1))  # its dreams change slowly
    bars = torch.zeros(1, 1, 4, 4)
    bars[..., 2] = 1
    distances, cosines = distance_and_cosine(crbm, STATES, bars, [1, 8])
    assert distances[1] < distances[0] / 2
    assert cosines[1] > 0.99
