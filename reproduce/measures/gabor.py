"""Gabor fits: how well a filter matches a Gabor function, the model of a simple cell in V1.

And what a Gabor function must be held against: the best round blob, and the filter's own pixels in
another order.
"""

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from vmc_lib.what.crops import whitening_gain

EIGHT = 8  # pixels: the width of a filter for which shapes are given; with it, all lengths grow
PATIENCE = {"maxiter": 400}


@dataclass(frozen=True, eq=False)
class Family:
    """Pairs of functions whose mixtures are to match a filter, by their shapes (m, parameters)."""

    pair: Callable  # n_w, *shape -> (2, n_w²)
    bounds: tuple  # the least and the greatest shape
    coarse: tuple  # the values of each parameter on a coarse grid
    is_length: tuple  # of each parameter

    def scale_shapes(self, shapes, n_w):
        """Shapes (m, parameters) for filters EIGHT pixels wide, as shapes for `n_w` wide ones."""
        return np.asarray(shapes, float) * np.where(self.is_length, n_w / EIGHT, 1)


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


def blob_pair(n_w, width, ratio, x0, y0):
    """Two round Gaussians (2, n_w²) at the same place, the second `ratio` times as wide; mean 0.

    Their mixtures are the blob and the difference of Gaussians.
    """
    x, y = np.arange(n_w) - (n_w - 1) / 2 - x0, np.arange(n_w)[:, None] - (n_w - 1) / 2 - y0
    square = (x**2 + y**2).ravel()
    pair = np.exp(-square / (2 * np.array([[width], [ratio * width]]) ** 2))
    return pair - pair.mean(1, keepdims=True)


GABORS = Family(  # angle (rad), wavelength, breadth across and along the stripes, centre x and y
    gabor_pair,
    ((-np.inf, 3, 1, 1, -2.5, -2.5), (np.inf, 12, 4, 5, 2.5, 2.5)),
    (np.arange(12) * np.pi / 12, (4, 6, 9), (1.5, 2.5), (2, 4), (-1, 1), (-1, 1)),
    (False, True, True, True, True, True),
)
BLOBS = Family(  # width, ratio of the widths, centre x and y
    blob_pair,
    ((0.5, 1.2, -3.5, -3.5), (5, 4, 3.5, 3.5)),
    ((0.8, 1.5, 3), (1.5, 3), (-3, -1.5, 0, 1.5, 3), (-3, -1.5, 0, 1.5, 3)),
    (True, False, True, True),
)


@cache
def coarse_grid(family, n_w):
    """Shapes on a coarse grid (m, …), and an orthonormal basis of each one's pair (m, 2, n_w²)."""
    shapes = family.scale_shapes(list(itertools.product(*family.coarse)), n_w)
    pairs = [np.linalg.qr(family.pair(n_w, *shape).T)[0].T for shape in shapes]
    return shapes, np.array(pairs)


def best_fit(W, family):
    """The mixture of a `Family` closest to a filter W (n_w, n_w), and their correlation (0 to 1).

    Every shape on a coarse grid is tried, the best two refined.
    """
    from scipy.optimize import minimize

    W = np.asarray(W, float)
    n_w = len(W)
    bounds = family.scale_shapes(family.bounds, n_w)

    def pair(shape):
        return family.pair(n_w, *np.clip(shape, *bounds))

    shapes, pairs = coarse_grid(family, n_w)
    fits = np.square(pairs @ (W - W.mean()).ravel()).sum(1)
    starts = shapes[fits.argsort()[-2:]]
    ends = [
        minimize(lambda x: -fit_pair(W, pair(x))[1], start, method="Nelder-Mead", options=PATIENCE)
        for start in starts
    ]
    mixture, correlation = fit_pair(W, pair(min(ends, key=lambda end: end.fun).x))
    return mixture.reshape(n_w, n_w), float(correlation)


def best_gabor(W):
    """`best_fit` of the Gabor functions: those of every angle, wavelength, breadth and place."""
    return best_fit(W, GABORS)


def grating_answers(W, step=0.05):
    """Answers (frequencies, 180) of a filter W (n_w, n_w) to gratings, each at its best phase.

    Frequencies are `_frequencies`, `step` octaves apart, directions 1° apart.
    """
    return abs(_gratings(len(W), step) @ np.ravel(W))


def _frequencies(step):
    """Of gratings, in cycles a pixel: up to one stripe in two pixels."""
    return 2 ** np.arange(-4.5, -1, step)


@cache
def _gratings(n_w, step):
    angles = np.radians(np.arange(180))
    y, x = np.mgrid[:n_w, :n_w].reshape(2, -1)
    across = np.multiply.outer(np.cos(angles), x) + np.multiply.outer(np.sin(angles), y)
    return np.exp(2j * np.pi * np.multiply.outer(_frequencies(step), across))


def bandwidths(W, step=0.05):
    """How sharply a filter W (n_w, n_w) is tuned to stripes: octaves, and degrees of direction.

    Both are full widths at half height of its answers to gratings, each at its best phase. As a
    cell is, it is asked through the retina: W sees a grating that was whitened. The octaves are
    infinite where its answers stay above half down to the coarsest grating, or up to the finest.
    """
    answers = grating_answers(W, step) * whitening_gain(_frequencies(step))[:, None]
    best, direction = np.unravel_index(answers.argmax(), answers.shape)
    enough = answers >= answers.max() / 2
    below = np.flatnonzero(~enough[:, direction])
    k = np.searchsorted(below, best)  # of the first below half that is finer
    octaves = (below[k] - below[k - 1] - 1) * step if 0 < k < len(below) else np.inf
    return octaves, enough[best].sum()


def direction_vector(W):
    """How a filter W is tuned to direction, as a complex number, at its best frequency.

    Its length is the selectivity (1 − circular variance: 0 for a round filter, 1 for one that
    answers to a single direction), its angle twice the preferred direction.
    """
    answers = grating_answers(W)
    best = answers[answers.max(1).argmax()]
    return best @ np.exp(2j * np.radians(np.arange(180))) / best.sum()
