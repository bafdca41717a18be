"""The convolutional deep belief network (CDBN): one CRBM learns the picture, a second the first."""

from dataclasses import dataclass

import numpy as np
import torch
from torch.nn import functional as F

from vmc_lib.data import arrays
from vmc_lib.what.crbm import CRBM
from vmc_lib.what.crops import Patches, crop

K, C, N_W, PATCHES = 10, 2, 8, 50_000  # as in the paper
FIRST = {"epochs": 4, "width": 21, "sparsity": 0.002, "rate": 0.2, "decay": 0.0003}
SECOND = {"epochs": 2, "width": 25, "sparsity": 0.1, "rate": 0.2, "decay": 0.0003}


@dataclass(frozen=True)
class CDBN:
    """Two CRBMs. The second sees the first one's pooled maps, less `mean` and over `spread`."""

    first: CRBM
    second: CRBM
    mean: float
    spread: float

    def layers(self, v):
        """Every layer's maps (n, maps, height, width) for whitened pictures v (n, 1, 200, 200).

        Hidden layers lose a last row and column where their width is odd, so that blocks fit:
        200 → H1 193, trimmed to 192 → P1 96 → H2 89, trimmed to 88 → P2 44 → MP2 44, the mean of
        the P2 maps (Eq. 2).
        """
        h1, p1 = self.first.posterior(self.first.trim(v))
        h2, p2 = self.second.posterior(self.second.trim((p1 - self.mean) / self.spread))
        return {"V": v, "H1": h1, "P1": p1, "H2": h2, "P2": p2, "MP2": p2.mean(1, keepdim=True)}

    def projected(self):
        """The second layer's filters seen in the picture: (K, 23, 23) for two filters of width 8.

        Each of its weights paints, in the blocks of c × c hidden units that it sees through
        pooling, the filters of the first layer.
        """
        c = self.first.c
        spread_out = F.interpolate(self.second.W, scale_factor=c) / c**2
        return F.conv_transpose2d(spread_out, self.first.W)[:, 0]

    def arrays(self):
        """The network as a dict of arrays, to be saved with `np.savez`."""
        machines = {"first": self.first, "second": self.second}
        parts = {f"{m}.{k}": x for m, crbm in machines.items() for k, x in crbm.arrays().items()}
        return parts | {"mean": self.mean, "spread": self.spread}

    @classmethod
    def from_arrays(cls, arrays, device="cpu"):
        """The network that `arrays` describes (a dict, or an open .npz file)."""
        machines = (
            CRBM.from_arrays({k: arrays[f"{m}.{k}"] for k in ("W", "b", "a", "c")}, device)
            for m in ("first", "second")
        )
        return cls(*machines, float(arrays["mean"]), float(arrays["spread"]))

    @classmethod
    def load(cls, device="cpu"):
        """The network that ships with the book."""
        return cls.from_arrays(arrays("cdbn"), device)


def learn(maps, seed, n_w, patches, *, epochs, width, **how):
    """One CRBM trained on patches of maps (n, channels, height, width), on their device.

    The patches are so wide for filters of the usual width, and wider for wider ones, so that as
    much of their middle is free to be dreamt anew.
    """
    rng = torch.Generator().manual_seed(seed)
    width += 2 * (n_w - N_W)
    width -= (width - n_w + 1) % C  # whole blocks only
    sample = Patches(maps, width, patches, rng)
    crbm = CRBM.random(K, maps.shape[1], n_w, rng, C, maps.device)
    crbm.fit(sample, range(epochs), seed, **how)
    return crbm


def train(pictures, positive, seed=0, n_w=N_W, patches=PATCHES, device="cpu"):
    """A CDBN learnt from whitened pictures (n, 1, 200, 200).

    No target is learnt, but a label chooses: the first layer learns from all pictures, the second,
    as in the paper, only from the positive ones (`positive` (n,) bool), the shuttlecocks. `device`
    says where: "cpu" or "cuda". ValueError for no positive.
    """
    if not np.any(positive):
        raise ValueError("the second layer learns from the positive pictures: give at least one")
    pictures = pictures.to(device)
    first = learn(pictures, seed, n_w, patches, **FIRST)
    _, p1 = first.posterior(first.trim(pictures[torch.as_tensor(positive)]))
    mean, spread = float(p1.mean()), float(p1.std())
    second = learn((p1 - mean) / spread, seed, n_w, patches, **SECOND)
    return CDBN(first, second, mean, spread)


def crops_of(shots):
    """The crops (n, 200, 200) in the true boxes of photos, and which are shuttlecocks (n,)."""
    named = [(crop(shot.image, box), name) for shot in shots for name, box in shot.boxes.items()]
    return np.array([x for x, _ in named]), np.array([name == "shuttlecock" for _, name in named])
