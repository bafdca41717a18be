"""Training the CDBN, greedily: a CRBM on the pictures, a second on its pooled maps."""

import numpy as np
import torch

from vmc_lib.what.cdbn import CDBN, N_W, PATCHES, C, K
from vmc_lib.what.learning import Learner, Patches

FIRST = {"epochs": 4, "width": 21, "sparsity": 0.002, "rate": 0.2, "decay": 0.0003}
SECOND = {"epochs": 2, "width": 25, "sparsity": 0.1, "rate": 0.2, "decay": 0.0003}


def train_crbm(maps, seed, n_w, patches, *, epochs, width, **how):
    """Train a Learner on patches of maps (n, channels, height, width), on their device.

    `width` is that of the patches for filters of N_W pixels; wider filters get wider patches, so
    that as much of their middle is free to be sampled anew.
    """
    rng = torch.Generator().manual_seed(seed)
    width += 2 * (n_w - N_W)
    width -= (width - n_w + 1) % C  # whole blocks only
    sample = Patches(maps, width, patches, rng)
    crbm = Learner.random(K, maps.shape[1], n_w, rng, C, maps.device)
    crbm.fit(sample, range(epochs), seed, **how)
    return crbm


def train_cdbn(pictures, positive, seed=0, n_w=N_W, patches=PATCHES, device="cpu", second=SECOND):
    """Train a CDBN of Learners, layer by layer, on whitened pictures (n, 1, 200, 200).

    The first layer learns from all pictures, the second, as in the paper, only from the positive
    ones (`positive` (n,) bool), the shuttlecocks. `device`: "cpu" or "cuda"; `second`: how the
    second layer is trained. ValueError for no positive one.
    """
    if not np.any(positive):
        raise ValueError("the second layer learns from the positive pictures: give at least one")
    pictures = torch.as_tensor(pictures, device=device)
    first = train_crbm(pictures, seed, n_w, patches, **FIRST)
    _, p1 = first.posterior(first.trim(pictures[torch.as_tensor(positive)]))
    mean, spread = float(p1.mean()), float(p1.std())
    crbm = train_crbm((p1 - mean) / spread, seed, n_w, patches, **second)
    return CDBN(first, crbm, mean, spread)
