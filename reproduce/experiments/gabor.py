"""Gabor fits: how well a filter matches a Gabor function, the model of a simple cell in V1."""

import itertools
from functools import cache

import numpy as np

# angle (rad), wavelength, breadth across and along the stripes, centre x and y: pixels of a filter
# that is EIGHT wide; for a wider one, all lengths grow with it
BOUNDS = np.array([(-np.inf, 3, 1, 1, -2.5, -2.5), (np.inf, 12, 4, 5, 2.5, 2.5)])
EIGHT = 8
PATIENCE = {"maxiter": 400}


def gabor_pair(n_w, angle, wavelength, across, along, x0, y0):
    """Cosine and sine Gabor (2, n_w²) at the same place, each with mean 0."""
    x, y = np.arange(n_w) - (n_w - 1) / 2 - x0, np.arange(n_w)[:, None] - (n_w - 1) / 2 - y0
    c, s = np.cos(angle), np.sin(angle)
    u, w = x * c + y * s, y * c - x * s
    window = np.exp(-((u / across) ** 2 + (w / along) ** 2) / 2)
    phase = 2 * np.pi / wavelength * u
    pair = np.array([window * np.cos(phase), window * np.sin(phase)]).reshape(2, -1)
    return pair - pair.mean(1, keepdims=True)


def fit_pair(W, pair):
    """The best mixture of a pair (any phase and contrast) for filter W, and its correlation."""
    target = W.ravel() - W.mean()
    mixture = np.linalg.solve(pair @ pair.T, pair @ target) @ pair
    return mixture, np.linalg.norm(mixture) / np.linalg.norm(target)


def scale_shapes(shapes, n_w):
    """Shapes (m, 6) for filters EIGHT pixels wide, as shapes for filters `n_w` wide."""
    return np.asarray(shapes, float) * [1, *[n_w / EIGHT] * 5]


@cache
def coarse_grid(n_w):
    """Shapes on a coarse grid (m, 6), and an orthonormal basis of each one's pair (m, 2, n_w²)."""
    angles = np.arange(12) * np.pi / 12
    shapes = scale_shapes(
        list(itertools.product(angles, (4, 6, 9), (1.5, 2.5), (2, 4), (-1, 1), (-1, 1))), n_w
    )
    pairs = [np.linalg.qr(gabor_pair(n_w, *shape).T)[0].T for shape in shapes]
    return shapes, np.array(pairs)


def best_gabor(W):
    """The Gabor function closest to a filter W (n_w, n_w), and their correlation (0 to 1).

    Every angle, wavelength, breadth and place on a coarse grid is tried, the best two refined.
    """
    from scipy.optimize import minimize

    W = np.asarray(W, float)
    n_w = len(W)
    bounds = scale_shapes(BOUNDS, n_w)

    def miss(shape):
        return -fit_pair(W, gabor_pair(n_w, *np.clip(shape, *bounds)))[1]

    shapes, pairs = coarse_grid(n_w)
    fits = np.square(pairs @ (W - W.mean()).ravel()).sum(1)
    starts = shapes[fits.argsort()[-2:]]
    ends = [minimize(miss, start, method="Nelder-Mead", options=PATIENCE) for start in starts]
    shape = min(ends, key=lambda end: end.fun).x
    mixture, correlation = fit_pair(W, gabor_pair(n_w, *np.clip(shape, *bounds)))
    return mixture.reshape(n_w, n_w), float(correlation)


def bandwidths(W, step=0.05):
    """How sharply a filter W (n_w, n_w) is tuned to stripes: octaves, and degrees of direction.

    Both are full widths at half height of its answers to gratings, each at its best phase.
    """
    octaves, angles = np.arange(-4.5, -1, step), np.radians(np.arange(180))
    y, x = np.mgrid[: len(W), : len(W)]
    across = np.multiply.outer(np.cos(angles), x) + np.multiply.outer(np.sin(angles), y)
    gratings = np.exp(2j * np.pi * np.multiply.outer(2**octaves, across))
    answers = abs((gratings * W).sum((-2, -1)))  # (frequencies, directions)
    best, direction = np.unravel_index(answers.argmax(), answers.shape)
    enough = answers >= answers.max() / 2
    return enough[:, direction].sum() * step, enough[best].sum()
