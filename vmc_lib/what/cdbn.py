"""Convolutional deep belief network (CDBN): a CRBM on the picture, a second on its pooled maps."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from vmc_lib.data import arrays
from vmc_lib.photos import Photo, check_photos
from vmc_lib.short_repr import short
from vmc_lib.what.crbm import CRBM
from vmc_lib.what.crops import crop

K, C, N_W, PATCHES = 10, 2, 8, 50_000  # as in the paper


@dataclass(frozen=True)
class CDBN:
    """Two CRBMs. The second sees the first one's pooled maps, less `mean` and over `spread`."""

    first: CRBM
    second: CRBM
    mean: float
    spread: float

    def layers(self, v: np.ndarray) -> dict[str, np.ndarray]:
        """Every layer's maps (n, maps, height, width) for whitened pictures v (n, 1, 200, 200).

        Hidden layers lose a last row and column where their width is odd, so that blocks fit:
        200 → H1 193, trimmed to 192 → P1 96 → H2 89, trimmed to 88 → P2 44 → MP2 44, the mean of
        the P2 maps (Eq. 2).
        """
        h1, p1 = self.first.posterior(self.first.trim(v))
        h2, p2 = self.second.posterior(self.standardised_p1(p1))
        return {"V": v, "H1": h1, "P1": p1, "H2": h2, "P2": p2, "MP2": p2.mean(1, keepdims=True)}

    def standardised_p1(self, p1: np.ndarray) -> np.ndarray:
        """The first CRBM's pooled maps as input of the second: standardised and trimmed."""
        return self.second.trim((p1 - self.mean) / self.spread)

    def pooled(self, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """P1 and P2 of `layers` alone."""
        p1 = self.first.pooled(self.first.trim(v))
        return p1, self.second.pooled(self.standardised_p1(p1))

    def projected_filters(self) -> np.ndarray:
        """The second layer's filters projected into the picture: (K, 23, 23) for width 8.

        Each of its weights paints, in the blocks of c × c hidden units that it sees through
        pooling, the filters of the first layer.
        """
        c = self.first.c
        spread_out = np.kron(self.second.W, np.ones((c, c), np.float32) / c**2)
        return self.first.visible_mean(spread_out)[:, 0] - self.first.a

    def arrays(self) -> dict[str, Any]:
        """The network as a dict of arrays, to be saved with `np.savez`."""
        machines = {"first": self.first, "second": self.second}
        parts = {f"{m}.{k}": x for m, crbm in machines.items() for k, x in crbm.arrays().items()}
        return parts | {"mean": self.mean, "spread": self.spread}

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, np.ndarray], kind: type[CRBM] = CRBM) -> Self:
        """The network that `arrays` describes (a dict, or an open .npz file).

        Its machines are of a `kind`: a CRBM sees, a `learning.Learner` goes on learning.
        """
        first, second = (
            kind.from_arrays({k: arrays[f"{m}.{k}"] for k in ("W", "b", "a", "c")})
            for m in ("first", "second")
        )
        return cls(first, second, float(arrays["mean"]), float(arrays["spread"]))

    @classmethod
    def load(cls, kind: type[CRBM] = CRBM) -> Self:
        """The network that ships with the book."""
        if not (isinstance(kind, type) and issubclass(kind, CRBM)):
            raise ValueError(
                f"no network of {short(kind)}: there is one for all levels; write CDBN.load(), or "
                "CDBN.load(Learner)"
            )
        return cls.from_arrays(arrays("cdbn"), kind)


def crops_of(shots: Sequence[Photo]) -> tuple[np.ndarray, np.ndarray]:
    """The crops (n, 200, 200) in the true boxes of photos, and which are shuttlecocks (n,)."""
    check_photos(shots)
    named = [(crop(shot.image, box), name) for shot in shots for name, box in shot.boxes.items()]
    return np.array([x for x, _ in named]), np.array([name == "shuttlecock" for _, name in named])
