"""End-to-end training of the paper's hierarchy: all weights at once, by back-propagation."""

import numpy as np
import torch
from torch.nn import functional as F

from vmc_lib.what.cdbn import CDBN, N_W, C
from vmc_lib.what.crops import whiten
from vmc_lib.what.learning import Learner
from vmc_lib.what.recogniser import readout_features

READ_OUT = "P1 + P2"


def train_end_to_end(draw, rng, width, maps, steps, batch, rate):
    """A CDBN whose every weight learns at once, from random ones, what tells the labels apart.

    draw: gives so many crops (n, width, width) and labels (n,). A linear read-out learns along,
    of features that are brought to one scale, and is dropped. By torch's AdamW, whose rate rises
    and falls once (OneCycleLR).
    """
    torch_rng = torch.Generator().manual_seed(int(rng.integers(2**31)))
    cdbn = random_network(maps, torch_rng)
    weights = [getattr(crbm, part) for crbm in (cdbn.first, cdbn.second) for part in "Wb"]

    def features(v):
        return readout_features(cdbn, v)[READ_OUT]

    size = features(torch.randn(1, 1, width, width, generator=torch_rng)).shape[1]
    scale = torch.nn.BatchNorm1d(size, affine=False)
    readout, bias = torch.zeros(size, requires_grad=True), torch.zeros(1, requires_grad=True)
    learner = torch.optim.AdamW([*weights, readout, bias], lr=rate, weight_decay=0.01)
    rise_and_fall = torch.optim.lr_scheduler.OneCycleLR(learner, rate, steps, pct_start=0.15)
    for _ in range(steps):
        crops, labels = draw(batch)
        logit = scale(features(torch.from_numpy(whiten(crops)))) @ readout + bias
        loss = F.binary_cross_entropy_with_logits(logit, torch.tensor(labels, dtype=torch.float))
        learner.zero_grad()
        loss.backward()
        learner.step()
        rise_and_fall.step()
    return CDBN.from_arrays(cdbn.arrays())


def random_network(maps, rng):
    """A CDBN of Learners that know nothing: random filters, hidden units on half the time."""
    layers, channels = [], 1
    for count in maps:
        W = torch.randn(count, channels, N_W, N_W, generator=rng) / (N_W * channels**0.5)
        b = torch.full((count,), -float(np.log(C**2)))
        layers.append(Learner(W.requires_grad_(), b.requires_grad_(), torch.zeros(channels), C))
        channels = count
    return CDBN(*layers, mean=0.5, spread=0.2)
