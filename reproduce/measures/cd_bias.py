"""Bias of contrastive divergence: CD-k against the true gradient, where that can be computed.

It can where the hidden units have so few states that all can be listed.
"""

import torch

SAMPLES, NOISE = 8_000, 0.3


def exact_samples(crbm, states, n, rng):
    """Samples (n, 1, height, width) of a CRBM's own distribution; `states` are all its h."""
    means = crbm.visible_mean(states)
    weights = means.square().sum((1, 2, 3)) / 2 + states.sum((2, 3)) @ crbm.b
    some = torch.multinomial(torch.softmax(weights, 0), n, replacement=True, generator=rng)
    return means[some] + torch.randn(n, *means.shape[1:], generator=rng)


def distance_and_cosine(crbm, states, pictures, ks):
    """How far CD-k's change of W is from the gradient, in its lengths, and their cosine, by k.

    The data are `pictures` (n, 1, height, width) with NOISE.
    """
    rng = torch.Generator().manual_seed(0)
    dreams = exact_samples(crbm, states, SAMPLES, rng)
    noise = torch.randn(dreams.shape, generator=rng)
    data = pictures.repeat(SAMPLES // len(pictures), 1, 1, 1) + NOISE * noise
    together = [crbm.statistics(v, crbm.posterior(v)[0])[0] for v in (data, dreams)]
    truth = together[0] - together[1]
    steps = [crbm.gradient(data, k, rng)[0][0] for k in ks]
    distances = [float((step - truth).norm() / truth.norm()) for step in steps]
    return distances, [float((step * truth).sum() / step.norm() / truth.norm()) for step in steps]
