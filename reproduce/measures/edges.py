"""How much filters are edges of different directions: what Fig. 7 shows, in four numbers."""

import numpy as np

from reproduce import paper
from reproduce.measures import gabor
from reproduce.measures.texture_tuning import shuffle

SHUFFLES = 3  # orders of a filter's pixels
# Ten directions at random have a mean vector this long once in twenty (Rayleigh's test)
RAYLEIGH = np.sqrt(-np.log(0.05) / paper.MAPS)


def beyond_blobs(filters):
    """How much better a Gabor fits each filter (n, w, w) than the best round blob does, (n,)."""
    return np.array([gabor.best_gabor(W)[1] - gabor.best_fit(W, gabor.BLOBS)[1] for W in filters])


def beyond_shuffled(filters, rng):
    """How much more selective for direction filters (n, w, w) are than their pixels shuffled."""
    mixed = [np.abs(directions(shuffle(filters, rng))) for _ in range(SHUFFLES)]
    return np.abs(directions(filters)) - np.mean(mixed, axis=0)


def share_in_the_middle(filters):
    """The share of each filter's strength in the middle quarter of its window, (n,)."""
    quarter, power = filters.shape[-1] // 4, filters**2
    middle = slice(quarter, -quarter)
    return power[:, middle, middle].sum((1, 2)) / power.sum((1, 2))


def longest_mean(layers):
    """The longest mean vector of preferred directions, of layers (m, K, w, w)."""
    around = (np.exp(1j * np.angle(directions(layer))) for layer in layers)
    return max(np.abs(each.mean()) for each in around)


def directions(filters):
    """The preferred direction of each filter (n, w, w), complex numbers (n,)."""
    return np.array([gabor.direction_vector(W) for W in filters])


def edge_numbers(layers):
    """The four numbers of layers (m, K, w, w): values of each filter, and one of all layers."""
    filters, rng = np.concatenate(layers), np.random.default_rng(0)
    by_filter = beyond_blobs(filters), beyond_shuffled(filters, rng), share_in_the_middle(filters)
    return *by_filter, longest_mean(layers)
