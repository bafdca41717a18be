"""Filters that no CRBM learnt, under the measures of Figs. 7, 8 and of W²: which pass as well?

In the first layer: independent components and k-means of whitened patches (other ways to learn),
and smoothed noise (none). In the second: smoothed noise, and the learnt filters with their maps in
another order, or in the mirror. Each is as strong as the learnt layer, whose biases stay.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from joblib import Parallel, delayed
from scipy.ndimage import gaussian_filter

from reproduce.measures import gabor, texture_tuning
from reproduce.measures.edges import edge_numbers
from reproduce.results import records
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, N_W, K, crops_of
from vmc_lib.what.crops import whiten

SEEDS, PATCHES, EVERY = range(3), 20_000, 8  # as many seeds as trainings in Fig. 7
SMOOTH = 1.0  # standard deviation of the noise's smoothing, in units of the filter's grid


def whitened_patches(rng, folder=photos.FOLDER, count=PATCHES, every=EVERY):
    """Patches (count, N_W²), each less its mean, from all levels' whitened training crops."""
    crops = whiten(crops_of(photos.load_levels("train", folder, every))[0])[:, 0]
    which = rng.integers(len(crops), size=count)
    y, x = rng.integers(crops.shape[-1] - N_W + 1, size=(2, count))
    cut = [crops[i, a : a + N_W, b : b + N_W] for i, a, b in zip(which, y, x, strict=True)]
    flat = np.array(cut).reshape(count, -1)
    return flat - flat.mean(axis=1, keepdims=True)


def independent_components(patches, seed):
    """K filters of independent component analysis (FastICA)."""
    from sklearn.decomposition import FastICA

    return FastICA(K, random_state=seed, max_iter=1000).fit(patches).components_


def cluster_means(patches, seed):
    """K means of patches of unit length, of the stronger half (k-means)."""
    from sklearn.cluster import KMeans

    size = np.linalg.norm(patches, axis=1, keepdims=True)
    strong = (patches / np.maximum(size, 1e-9))[size[:, 0] > np.median(size)]
    return KMeans(K, n_init=3, random_state=seed).fit(strong).cluster_centers_


def smoothed_noise(patches, seed):
    """K filters of Gaussian noise, smoothed."""
    return smooth(np.random.default_rng(seed).normal(size=(K, N_W, N_W)))


def smooth(noise):
    """Noise (…, w, w), smoothed over the last two axes."""
    return gaussian_filter(noise, (0,) * (noise.ndim - 2) + (SMOOTH, SMOOTH))


FIRST = {
    "independent components": independent_components,
    "k-means": cluster_means,
    "smoothed noise": smoothed_noise,
}
SECOND = {
    "smoothed noise": lambda W, rng: smooth(rng.normal(size=W.shape)),
    "maps permuted": lambda W, rng: np.array([each[rng.permutation(len(each))] for each in W]),
    "mirrored": lambda W, rng: W[..., ::-1],
}


def with_scaled_filters(crbm, W):
    """The CRBM with other filters, as strong as its own."""
    W = np.float32(W.reshape(crbm.W.shape) * crbm.W.std() / W.std())
    return crbm.with_filters(W)


def first_layer(name, folder=photos.FOLDER, seeds=SEEDS, **size):
    """What Figs. 7 and 8 and V1 measure of a rival of FIRST: eight numbers.

    The means of `edge_numbers`; how much better hidden and pooled units are tuned than with the
    same filters shuffled; the mean bandwidth, octaves, and the median one of direction, degrees.
    """
    layers = [
        FIRST[name](whitened_patches(np.random.default_rng(seed), folder, **size), seed)
        for seed in seeds
    ]
    shaped = np.reshape(layers, (len(layers), K, N_W, N_W))
    crops, shuttlecock = crops_of(photos.load("rig", "validation", folder))
    other = with_scaled_filters(CDBN.load().first, shaped[0])
    tuned = texture_tuning.over_shuffled(other, whiten(crops[shuttlecock])).mean(axis=1)
    octaves, widths = np.transpose([gabor.bandwidths(W) for W in np.concatenate(shaped)])
    found = *edge_numbers(shaped), *tuned, octaves
    return [*(float(np.mean(values)) for values in found), float(np.median(widths))]


def second_layer(name, seeds=SEEDS):
    """How well Gabor functions fit the projected filters of a rival of SECOND, the mean."""
    network = CDBN.load()
    others = [SECOND[name](network.second.W, np.random.default_rng(seed)) for seed in seeds]
    layers = [replace(network, second=with_scaled_filters(network.second, W)) for W in others]
    fits = [gabor.best_gabor(W)[1] for layer in layers for W in layer.projected_filters()]
    return float(np.mean(fits))


def make(folder=photos.FOLDER, **size):
    """What `results/other_filters.json` holds: "first" and "second" -> rival -> numbers."""
    first = Parallel()(delayed(first_layer)(name, folder, **size) for name in FIRST)
    return {
        "first": dict(zip(FIRST, first, strict=True)),
        "second": {name: second_layer(name) for name in SECOND},
    }


load_results = partial(records, "other_filters")
