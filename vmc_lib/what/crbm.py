"""Convolutional restricted Boltzmann machine (CRBM): energy and inference.

A visible layer of real-valued units (the picture) and K maps of binary hidden units that see it
through one shared filter each. Hidden units live in blocks of c × c in which at most one may be on:
the block's pooled unit tells whether any is (probabilistic max pooling, Lee et al. 2009).

Shapes: visible v (n, channels, n_v, n_v), hidden h (n, K, n_h, n_h) with n_h = n_v - n_w + 1,
pooled p (n, K, n_h / c, n_h / c). To see, arrays are NumPy's; to learn (`learning`), torch's.
"""

from collections.abc import Mapping
from itertools import product
from typing import Any, Self

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from vmc_lib.checks import check_count
from vmc_lib.short_repr import short


def correlate_valid(v: np.ndarray, W: np.ndarray, padding: int = 0) -> np.ndarray:
    """Valid cross-correlation of maps v with filters W (deep learning's "convolution").

    v: (n, channels, height, width); W: (K, channels, n_w, n_w); `padding`: zeros around v first.
    Returns (n, K, height - n_w + 1, width - n_w + 1). One matrix product correlates every row of a
    filter with every row of the maps; then the rows of a filter are added.
    """
    if np.ndim(v) != 4 or np.ndim(W) != 4 or v.shape[1] != W.shape[1]:
        raise ValueError(
            f"maps {np.shape(v)} and filters {np.shape(W)}: give (n, channels, height, width) and "
            "(K, channels, n_w, n_w)"
        )
    if padding:
        v = np.pad(v, [(0, 0), (0, 0), (padding, padding), (padding, padding)])
    (n, channels, height, width), (K, _, n_w, _) = v.shape, W.shape
    across = np.moveaxis(sliding_window_view(v, n_w, 3), -1, 2).reshape(n, channels * n_w, -1)
    rows = W.transpose(2, 0, 1, 3).reshape(n_w * K, channels * n_w) @ across
    rows = rows.reshape(n, n_w, K, height, width - n_w + 1)
    total = rows[:, 0, :, : height - n_w + 1].copy()
    for i in range(1, n_w):
        total += rows[:, i, :, i : height - n_w + 1 + i]
    return total


class CRBM:
    """Filters W (K, channels, n_w, n_w), hidden biases b (K,), visible biases a (channels,)."""

    xp, _correlate = np, staticmethod(correlate_valid)  # torch's in `learning.Learner`

    def __init__(self, W: np.ndarray, b: np.ndarray, a: np.ndarray, c: int = 2) -> None:
        if not all(hasattr(each, "shape") for each in (W, b, a)):
            raise ValueError(f"W, b and a are {short([W, b, a])}: give arrays, np.array(…)")
        check_count("c", c, least=1)
        if W.ndim != 4 or len(b) != len(W) or len(a) != W.shape[1]:
            raise ValueError(
                f"W {tuple(W.shape)}, b {tuple(b.shape)} and a {tuple(a.shape)} do not belong "
                "together: give (K, channels, n_w, n_w), (K,) and (channels,)"
            )
        self.W, self.b, self.a, self.c = W, b, a, c

    def with_filters(self, W: np.ndarray) -> Self:
        """The same CRBM with other filters, of the shape of its own."""
        return type(self)(W, self.b, self.a, self.c)

    def preactivation(self, v: np.ndarray) -> np.ndarray:
        """Preactivation of each hidden unit, (W̃ᵏ * v)ᵢⱼ + bₖ.

        Convolution turns its filter by 180°, and W̃ is turned already: so it is the
        cross-correlation with W itself. ValueError for a picture whose hidden width is no
        multiple of c (see `trim`), or of other channels.
        """
        if np.ndim(v) != 4 or v.shape[1] != len(self.a):
            raise ValueError(f"v is (n, {len(self.a)}, n_v, n_v), not {tuple(np.shape(v))}")
        for n_v in v.shape[2:]:
            n_h = n_v - self.W.shape[-1] + 1
            if n_h < 1 or n_h % self.c:
                raise ValueError(f"hidden width {n_h} is not in blocks of {self.c}: trim v first")
        return self._correlate(v, self.W) + self.b[:, None, None]

    def trim(self, v: Any) -> np.ndarray:
        """Drop the last rows and columns of v, those that fill no block of hidden units."""
        return v[..., *(slice(n - (n - self.W.shape[-1] + 1) % self.c) for n in v.shape[2:])]

    def energy(self, v: np.ndarray, h: np.ndarray) -> np.ndarray:
        """E(v, h) of Eq. 1: (n,). Low energy means that the two go well together."""
        z = self.preactivation(v)
        if np.shape(h)[1:] != tuple(z.shape[1:]):
            raise ValueError(f"h {np.shape(h)} of v {tuple(v.shape)}: give {tuple(z.shape)}")
        agreement = (h * z).sum((1, 2, 3))
        return -agreement - (self.a[:, None, None] * v - v**2 / 2).sum((1, 2, 3))

    def posterior(self, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Probabilities that hidden and pooled units are on, given v: (h, p).

        In a block, the units and the off state share one softmax of their preactivations.
        """
        z, places = self.preactivation(v), product(range(self.c), repeat=2)
        units = self.xp.stack([z[..., y :: self.c, x :: self.c] for y, x in places])
        largest = self.xp.amax(units, 0).clip(0)  # subtracted, so that nothing overflows
        units, off = self.xp.exp(units - largest), self.xp.exp(-largest)
        total = off + units.sum(0)
        n, K, rows, columns = total.shape
        h = (units / total).reshape(self.c, self.c, n, K, rows, columns)
        h = self.xp.moveaxis(h, (0, 1), (3, 5)).reshape(n, K, rows * self.c, columns * self.c)
        return h, 1 - off / total

    def pooled(self, v: np.ndarray) -> np.ndarray:
        """The probabilities p of `posterior` alone, in a fraction of the time."""
        on = self.xp.exp(self.preactivation(v).clip(max=80))  # p is 1 long before it overflows
        rows = sum(on[..., y :: self.c, :] for y in range(self.c))
        return 1 - 1 / (1 + sum(rows[..., x :: self.c] for x in range(self.c)))

    def visible_mean(self, h: np.ndarray) -> np.ndarray:
        """The mean of v given h, Σₖ hᵏ * Wᵏ + a: each unit that is on paints its filter.

        This convolution does turn W: it is the cross-correlation with W turned by 180°.
        """
        turned = self.xp.flip(self.W, (2, 3)).swapaxes(0, 1)
        painted = self._correlate(h, turned, padding=self.W.shape[-1] - 1)
        return painted + self.a[:, None, None]

    def arrays(self) -> dict[str, Any]:
        """The machine as a dict of arrays, to be saved with `np.savez`."""
        return {name: np.asarray(getattr(self, name)) for name in "Wba"} | {"c": self.c}

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Self:
        """The machine that `arrays` describes (a dict, or an open .npz file)."""
        W, b, a = (arrays[name] for name in "Wba")
        return cls(W, b, a, int(arrays["c"]))
