"""Kernel support vector machine: a binary classifier."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from vmc_lib.checks import check_features
from vmc_lib.short_repr import short
from vmc_lib.where.kernels import KERNELS

PARTS = ("gamma", "support", "weights", "bias")  # of an SVM, as they are stored


@dataclass(frozen=True, eq=False)
class KernelSVM:
    """A kernel support vector machine: score(x) = Σ weights · K(support, x) + bias."""

    kernel: str
    gamma: float
    support: np.ndarray  # (s, d)
    weights: np.ndarray  # (s,)
    bias: float

    @classmethod
    def fit(
        cls,
        x: np.ndarray,
        y: np.ndarray,
        kernel: str = "linear",
        cost: float = 0.1,
        scale: float = 1.0,
    ) -> Self:
        """Fit to features x (n, d) and labels y (n,), true or false; `cost` is the SVM's C.

        The kernel's γ is `scale` over d times the variance of x.
        ValueError for an unknown kernel, for more labels than two, and where one of the two has no
        example.
        """
        from sklearn.svm import SVC

        if not isinstance(kernel, str) or kernel not in KERNELS:
            raise ValueError(f"kernel {kernel!r} is none of {', '.join(KERNELS)}")
        x = np.asarray(x)
        if x.ndim != 2 or np.shape(y) != x.shape[:1]:
            raise ValueError(f"features {x.shape}, labels {np.shape(y)}: give (n, d), and n labels")
        if len(labels := np.unique(y)) > 2:
            raise ValueError(f"labels {short(labels.tolist())}: give two kinds, true and false")
        if len(labels) < 2:
            raise ValueError("a classifier needs examples and counter-examples: give more photos")
        if not 0 < (spread := x.var()) < np.inf:
            raise ValueError(f"features of variance {spread}: give finite ones that differ")
        gamma = scale / (x.shape[1] * spread)
        svc = SVC(C=cost, kernel=kernel, gamma=gamma, cache_size=500).fit(x, y)
        support, weights = svc.support_vectors_, svc.dual_coef_[0]
        if kernel == "linear":  # then the sum is one term: a weight for each feature
            support, weights = (weights @ support)[None], np.ones(1)
        return cls(kernel, gamma, support, weights, svc.intercept_[0])

    def score(self, x: np.ndarray) -> np.ndarray:
        """Signed decision value (n,) of each row of x (n, d)."""
        if not len(x):
            return np.empty(0)
        check_features(x, self.support.shape[1])
        return KERNELS[self.kernel](x, self.support, self.gamma) @ self.weights + self.bias
