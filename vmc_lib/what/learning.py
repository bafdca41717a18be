"""Training CRBMs by contrastive divergence.

What is in `crbm` and `cdbn` computes with NumPy's arrays. Learning takes torch's tensors, which can
be differentiated and moved to a GPU, through the same equations.
"""

from collections.abc import Iterable
from itertools import islice
from math import isfinite

import numpy as np
import torch
from torch.nn import functional as F

from vmc_lib.checks import check_count
from vmc_lib.what.crbm import CRBM

# Its threads meet at thousands of barriers a second, and each waits spinning: with one other busy
# process beside them a layer that learns in 12 s took over 330 s; with one thread, 14 s.
torch.set_num_threads(1)


class Learner(CRBM):
    """A trainable CRBM: its arrays are torch tensors, all on the device of `W`."""

    xp, _correlate = torch, staticmethod(torch.conv2d)

    @classmethod
    def random(cls, K, channels, n_w, rng, c=2, device="cpu"):
        """An untrained machine: small random filters drawn from a torch.Generator.

        ValueError for another source of random numbers, or a count that is no whole number above 0.
        """
        if not isinstance(rng, torch.Generator):
            raise ValueError(f"rng = {rng}: give a torch.Generator().manual_seed(0)")
        for name, count in (("K", K), ("channels", channels), ("n_w", n_w)):
            check_count(name, count, least=1)
        W = 0.01 * torch.randn(K, channels, n_w, n_w, generator=rng)
        return cls(W.to(device), torch.zeros(K, device=device), torch.zeros(channels).to(device), c)

    def sample(self, on, rng):
        """One h, given the probabilities `on` of its units: in each block one is on, or none."""
        share = F.pixel_unshuffle(on, self.c).unflatten(1, (len(self.b), -1)).cumsum(2)
        dice = torch.rand(share[:, :, :1].shape, generator=rng, dtype=on.dtype, device=on.device)
        chosen = (dice < share).to(on.dtype).diff(dim=2, prepend=torch.zeros_like(dice))
        return F.pixel_shuffle(chosen.flatten(1, 2), self.c)

    def gibbs(self, v, rng, noise=True, clamp=False):
        """Gibbs sampling, without end: h given v, then v given h, and again.

        Yields v and the probabilities of its hidden units, first as given, then after each round.
        Without `noise`, v becomes its mean instead of a sample around it. With `clamp`, the outer
        n_w - 1 pixels stay as they are: in a patch cut from a picture they are explained by too few
        of the hidden units that would see them, and learning would make up for it with blobs.
        ValueError where that leaves no pixel free.
        """
        free = self._free(v, clamp)
        while True:
            on, _ = self.posterior(v)
            yield v, on
            new = self.visible_mean(self.sample(on, rng))
            if noise:
                new = new + torch.randn(new.shape, generator=rng, dtype=v.dtype, device=v.device)
            v = v.clone()
            v[free] = new[free]

    def _free(self, v, clamp):
        """Where v may change: everywhere or, with `clamp`, n_w - 1 pixels from its edge."""
        if not clamp:
            return ...
        edge = self.W.shape[-1] - 1
        if min(v.shape[2:]) <= 2 * edge:
            raise ValueError(
                f"patches of {v.shape[2]} × {v.shape[3]} are all edge for filters of {edge + 1}: "
                f"give more than {2 * edge} pixels, or no clamp"
            )
        return ..., *(slice(edge, n - edge) for n in v.shape[2:])

    def statistics(self, v, on):
        """Sufficient statistics, the mean -∂E/∂(W, b, a) given v and probabilities `on` of h."""
        pairs = F.conv2d(v.transpose(0, 1), on.transpose(0, 1)).transpose(0, 1)
        return pairs / len(v), on.sum((2, 3)).mean(0), v.sum((2, 3)).mean(0)

    def gradient(self, v, steps, rng, **how):
        """Contrastive divergence CD-k: an estimate of the gradient of the mean log-likelihood.

        The exact gradient is the `statistics` of the data minus those of the model's own samples.
        CD-k takes for a sample what k rounds of `gibbs` make of the data (Hinton 2002). Returns the
        gradients for W, b and a, the probabilities of the hidden units given the data, and the
        sample. ValueError for fewer than one of `steps`.
        """
        check_count("steps", steps, 1)
        chain = self.gibbs(v, rng, **how)
        _, on = next(chain)
        sample, on_in_sample = next(islice(chain, steps - 1, None))
        pairs = zip(self.statistics(v, on), self.statistics(sample, on_in_sample), strict=True)
        return [data - model for data, model in pairs], on, sample

    def fit(
        self, patches, epochs, seed, steps=1, rate=0.05, batch=100, sparsity=0.02,
        pressure=5.0, decay=0.001, clamp=True, after=None,
    ):  # fmt: skip
        """Train on `patches` (any (n, channels, n_v, n_v) that takes index lists), in place.

        Returns for each of `epochs`, a range, the mean squared reconstruction error of the pixels
        that are not clamped; after each, `after(epoch, error)` is called. Every epoch draws its own
        random numbers from (seed, epoch) and starts without momentum, so a machine saved after
        epoch 3 and trained on range(4, 8) ends as one trained on range(8). `pressure` pulls each
        map's mean activity towards `sparsity` through its bias.
        ValueError for no patches, for NaN in them, for fewer than one of `steps` or in a `batch`,
        and when learning runs away.
        """
        check_count("batch", batch, 1)
        if not isinstance(epochs, Iterable):
            raise ValueError(f"epochs = {epochs}: give a range, range({epochs})")
        if patches is None or isinstance(patches, np.ndarray):
            raise ValueError(f"patches are a {type(patches).__name__}: give a torch.Tensor")
        if len(patches) == 0:
            raise ValueError("there are no patches to learn from")
        history = []
        for epoch in epochs:
            rng = torch.Generator(self.W.device).manual_seed(1000 * seed + epoch)
            order = torch.randperm(len(patches), generator=rng, device=self.W.device).split(batch)
            step, momentum = rate / (1 + rate * epoch), 0.5 if epoch < 2 else 0.9
            speed, errors = torch.zeros_like(self.W), []
            for rows in order:
                v = patches[rows]
                (dW, db, da), on, sample = self.gradient(v, steps, rng, noise=False, clamp=clamp)
                area = on[0, 0].numel()
                speed = momentum * speed + dW / area - decay * self.W
                self.W = self.W + step * speed
                self.b = self.b + step * (db / area + pressure * (sparsity - on.mean((0, 2, 3))))
                self.a = self.a + step * da / area
                errors.append((v - sample)[self._free(v, clamp)].square().mean())
            error = float(torch.stack(errors).mean())
            if not isfinite(error):
                raise ValueError(
                    f"learning ran away in epoch {epoch}: give finite patches or a lower rate "
                    f"than {rate}"
                )
            history.append(error)
            if after:
                after(epoch, error)
        return history

    def arrays(self):
        """The machine as a dict of NumPy's arrays, to be saved with `np.savez`."""
        return {name: getattr(self, name).detach().cpu().numpy() for name in "Wba"} | {"c": self.c}

    @classmethod
    def from_arrays(cls, arrays):
        """The machine that `arrays` describes (a dict, or an open .npz file)."""
        return cls(*(torch.tensor(arrays[name]) for name in "Wba"), int(arrays["c"]))


class Patches:
    """Random windows of maps (n, channels, height, width), cut out when they are indexed.

    50,000 patches of 25 × 25 × 10 would take 1.25 GB; their positions take 1.2 MB.
    """

    def __init__(self, maps, width, count, rng):
        if maps.ndim != 4 or not 1 <= width <= min(maps.shape[2:]):
            raise ValueError(f"no window is {width} wide in maps {tuple(maps.shape)}: give less")
        self.windows = maps.unfold(2, width, 1).unfold(3, width, 1)
        n, _, rows, columns = self.windows.shape[:4]
        draws = torch.rand(3, count, generator=rng)
        self.positions = (draws * torch.tensor([[n], [rows], [columns]])).long().to(maps.device)

    def __len__(self):
        return self.positions.shape[1]

    def __getitem__(self, rows):
        picture, y, x = self.positions[:, rows]
        return self.windows[picture, :, y, x]
