"""One convolutional restricted Boltzmann machine (CRBM): its energy, its inference, its learning.

A visible layer of real-valued units (the picture) and K maps of binary hidden units that see it
through one shared filter each. Hidden units live in blocks of c × c in which at most one may be on:
the block's pooled unit tells whether any is (probabilistic max pooling, Lee et al. 2009).

Shapes: visible v (n, channels, n_v, n_v), hidden h (n, K, n_h, n_h) with n_h = n_v - n_w + 1,
pooled p (n, K, n_h / c, n_h / c). Everything here is a torch tensor, on the device of `W`.
"""

from itertools import islice
from math import isfinite

import torch
from torch.nn import functional as F


class CRBM:
    """Filters W (K, channels, n_w, n_w), hidden biases b (K,), visible biases a (channels,)."""

    def __init__(self, W, b, a, c=2):
        if W.ndim != 4 or len(b) != len(W) or len(a) != W.shape[1]:
            raise ValueError(
                f"W {tuple(W.shape)}, b {tuple(b.shape)} and a {tuple(a.shape)} do not belong "
                "together: give (K, channels, n_w, n_w), (K,) and (channels,)"
            )
        self.W, self.b, self.a, self.c = W, b, a, c

    @classmethod
    def random(cls, K, channels, n_w, rng, c=2, device="cpu"):
        """A machine that knows nothing yet: small random filters drawn from a torch.Generator."""
        W = 0.01 * torch.randn(K, channels, n_w, n_w, generator=rng)
        return cls(W.to(device), torch.zeros(K, device=device), torch.zeros(channels).to(device), c)

    # ------------------------------------------------------------ the energy and what follows

    def drive(self, v):
        """What each hidden unit receives, (W̃ᵏ * v)ᵢⱼ + bₖ.

        Convolution turns its filter by 180°, and W̃ is turned already: what is left is to lay W
        itself on the picture, multiply and add. This is what torch calls `conv2d`. ValueError for
        a picture whose hidden width is no multiple of c (see `trim`), or of other channels.
        """
        if v.ndim != 4 or v.shape[1] != len(self.a):
            raise ValueError(f"v is (n, {len(self.a)}, n_v, n_v), not {tuple(v.shape)}")
        for n_v in v.shape[2:]:
            n_h = n_v - self.W.shape[-1] + 1
            if n_h < 1 or n_h % self.c:
                raise ValueError(f"hidden width {n_h} is not in blocks of {self.c}: trim v first")
        return F.conv2d(v, self.W, self.b)

    def trim(self, v):
        """Drop the last rows and columns of v, those that fill no block of hidden units."""
        return v[..., *(slice(n - (n - self.W.shape[-1] + 1) % self.c) for n in v.shape[2:])]

    def energy(self, v, h):
        """E(v, h) of Eq. 1: (n,). Low energy means that the two go well together."""
        agreement = (h * self.drive(v)).sum((1, 2, 3))
        return -agreement - (self.a[:, None, None] * v - v**2 / 2).sum((1, 2, 3))

    def free_energy(self, v):
        """-log of the sum of exp(-E(v, h)) over every allowed h: (n,).

        Blocks do not speak to each other, so the sum is a product over them, each with c² + 1
        terms: one unit on, or none.
        """
        pooled = torch.logsumexp(self._with_off(self.drive(v)), 2).sum((1, 2, 3))
        return -pooled - (self.a[:, None, None] * v - v**2 / 2).sum((1, 2, 3))

    def _with_off(self, drive):
        """Drives as (n, K, c² + 1, n_p, n_p): each block's units, and last its off state, 0."""
        blocks = F.pixel_unshuffle(drive, self.c).unflatten(1, (len(self.b), -1))
        return F.pad(blocks, (0, 0, 0, 0, 0, 1))

    def posterior(self, v):
        """Probabilities that hidden and pooled units are on, given v: (h, p).

        In a block, the units and the off state share one softmax of their drives.
        """
        on = torch.softmax(self._with_off(self.drive(v)), 2)
        return F.pixel_shuffle(on[:, :, :-1].flatten(1, 2), self.c), 1 - on[:, :, -1]

    def sample(self, on, rng):
        """One h, given the probabilities `on` of its units: in each block one is on, or none."""
        share = F.pixel_unshuffle(on, self.c).unflatten(1, (len(self.b), -1)).cumsum(2)
        dice = torch.rand(share[:, :, :1].shape, generator=rng, dtype=on.dtype, device=on.device)
        chosen = (dice < share).to(on.dtype).diff(dim=2, prepend=torch.zeros_like(dice))
        return F.pixel_shuffle(chosen.flatten(1, 2), self.c)

    def visible_mean(self, h):
        """The mean of v given h, Σₖ hᵏ * Wᵏ + a: each unit that is on paints its filter.

        This time the convolution does turn W, and torch's `conv2d` has to be handed it turned.
        """
        turned = self.W.flip(2, 3).transpose(0, 1)
        return F.conv2d(h, turned, self.a, padding=self.W.shape[-1] - 1)

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

    # ------------------------------------------------------------ learning

    def statistics(self, v, on):
        """How v and its hidden units, on with chances `on`, go together: mean -∂E/∂(W, b, a)."""
        pairs = F.conv2d(v.transpose(0, 1), on.transpose(0, 1)).transpose(0, 1)
        return pairs / len(v), on.sum((2, 3)).mean(0), v.sum((2, 3)).mean(0)

    def gradient(self, v, steps, rng, **how):
        """Contrastive divergence CD-k: an estimate of the gradient of the mean log-likelihood.

        The exact gradient is what goes together in the data minus what goes together in the
        machine's own dreams. CD-k takes for a dream what is left of the data after k rounds of
        `gibbs` (Hinton 2002). Returns the gradients for W, b and a, the probabilities of the
        hidden units given the data, and the dream.
        """
        chain = self.gibbs(v, rng, **how)
        _, on = next(chain)
        dream, on_in_dream = next(islice(chain, steps - 1, None))
        pairs = zip(self.statistics(v, on), self.statistics(dream, on_in_dream), strict=True)
        return [data - model for data, model in pairs], on, dream

    def fit(
        self, patches, epochs, seed, steps=1, rate=0.05, batch=100, sparsity=0.02,
        pressure=5.0, decay=0.001, clamp=True, after=None,
    ):  # fmt: skip
        """Learn from `patches` (any (n, channels, n_v, n_v) that takes index lists), in place.

        Returns for each of `epochs`, a range, the mean squared reconstruction error of the pixels
        that are not clamped; after each, `after(epoch, error)` is called. Every epoch draws its own
        random numbers from (seed, epoch) and starts without momentum, so a machine saved after
        epoch 3 and trained on range(4, 8) ends as one trained on range(8). `pressure` pulls each
        map's mean activity towards `sparsity` through its bias.
        ValueError for no patches, for NaN in them, and when learning runs away.
        """
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
                (dW, db, da), on, dream = self.gradient(v, steps, rng, noise=False, clamp=clamp)
                area = on[0, 0].numel()
                speed = momentum * speed + dW / area - decay * self.W
                self.W = self.W + step * speed
                self.b = self.b + step * (db / area + pressure * (sparsity - on.mean((0, 2, 3))))
                self.a = self.a + step * da / area
                errors.append((v - dream)[self._free(v, clamp)].square().mean())
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

    # ------------------------------------------------------------ keeping

    def arrays(self):
        """The machine as a dict of arrays, to be saved with `np.savez`."""
        return {name: getattr(self, name).cpu().numpy() for name in "Wba"} | {"c": self.c}

    @classmethod
    def from_arrays(cls, arrays, device="cpu"):
        """The machine that `arrays` describes (a dict, or an open .npz file)."""
        W, b, a = (torch.tensor(arrays[name], device=device) for name in "Wba")
        return cls(W, b, a, int(arrays["c"]))
