"""Ablation of CRBM training: a first layer's filters without whitening, sparsity or clamping.

Pictures are whitened, units are pulled to be on rarely (by `pressure`), and the outer pixels of a
patch are clamped while the machine dreams.
"""

import numpy as np

from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import N_W, K, crops_of
from vmc_lib.what.crops import whiten

EPOCHS, PATCHES, WIDTH = 6, 2500, 21
RECIPE = {"rate": 0.4, "sparsity": 0.002, "decay": 0.0003, "batch": 25}
CHANGES = {
    "all three": {},
    "no whitening": {},  # of the pictures
    "no sparsity": {"pressure": 0.0},
    "no clamp": {"clamp": False, "rate": 0.1},  # at 0.4 it runs away
}


def filters_over_epochs(crops, name, epochs=EPOCHS, patches=PATCHES):
    """Filters (epochs + 1, K, N_W, N_W), at first and after each epoch, of one of `CHANGES`."""
    import torch

    from vmc_lib.what.learning import Learner, Patches

    pictures = crops[:, None] - crops.mean() if name == "no whitening" else whiten(crops)
    maps, rng = torch.from_numpy(pictures / pictures.std()), torch.Generator().manual_seed(0)
    sample = Patches(maps, WIDTH, patches, rng)
    crbm = Learner.random(K, 1, N_W, torch.Generator().manual_seed(0))
    found = [crbm.W]
    after = {"after": lambda epoch, error: found.append(crbm.W)}
    crbm.fit(sample, range(epochs), seed=0, **after, **RECIPE | CHANGES[name])
    return torch.cat(found, dim=1).transpose(0, 1).numpy()


def make(folder=photos.FOLDER, **size):
    """What `results/tricks.npz` holds: `filters_over_epochs` by what is left out."""
    crops, _ = crops_of(photos.load("rig", "train", folder))
    return {name: np.float16(filters_over_epochs(crops, name, **size)) for name in CHANGES}


def load_results():
    """What `make` found: filters over epochs, by what is left out."""
    return {name: np.float32(filters) for name, filters in arrays("tricks").items()}


def even_tone(filters):
    """Of filters (n, width, width), the median share of strength that is one even tone."""
    return float(np.median(filters.mean((1, 2)) ** 2 / (filters**2).mean((1, 2))))


def corner_share(filters):
    """The median share of strength in four corners of 2 × 2: a quarter of 8 × 8 if even."""
    ends, power = [0, 1, -2, -1], filters**2
    return float(np.median(power[:, ends][:, :, ends].sum((1, 2)) / power.sum((1, 2))))
