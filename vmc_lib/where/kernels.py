"""Kernels of pairs of feature vectors: inner products in a space of many more features."""

import numpy as np


def rbf(x: np.ndarray, centres: np.ndarray, gamma: float) -> np.ndarray:
    """Radial basis functions: exp(-gamma ‖x - c‖²), (n, m), of x (n, d) and centres (m, d)."""
    squares = (x**2).sum(1)[:, None] + (centres**2).sum(1) - 2 * x @ centres.T
    return np.exp(-gamma * squares.clip(0))


KERNELS = {
    "linear": lambda x, y, gamma: x @ y.T,
    "poly": lambda x, y, gamma: (gamma * (x @ y.T)) ** 3,
    "rbf": rbf,
    "sigmoid": lambda x, y, gamma: np.tanh(gamma * (x @ y.T)),
}
