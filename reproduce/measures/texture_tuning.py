"""Are units tuned to textures: is each on where the picture's stripes run as it prefers?"""

import numpy as np
from scipy.ndimage import uniform_filter

from reproduce.measures.gabor import direction_vector

ORDERS = 8  # of a filter's numbers


def shuffle(filters, rng):
    """The same filters (K, …), the numbers of each in another order."""
    return rng.permuted(filters.reshape(len(filters), -1), axis=1).reshape(filters.shape)


def local_direction(picture, width):
    """Which way a picture (height, width) changes around each pixel: unit complex numbers.

    Their angle is twice that of the gradient, averaged by power over windows (structure tensor).
    """
    dy, dx = np.gradient(picture)
    power = (dx + 1j * dy) ** 2
    vector = uniform_filter(power.real, width) + 1j * uniform_filter(power.imag, width)
    return vector / np.maximum(np.abs(vector), 1e-12)


def tuning_strength(crbm, pictures):
    """How much better units agree with the directions under them than each other's would.

    For whitened pictures (n, 1, …): the mean cosine of twice the angle between a unit's preferred
    direction and the local one, weighted by how much the unit is on, less the same with every other
    unit's maps in its place. Of hidden and pooled units, (2, n); 0 for units that are not tuned.
    """
    width = crbm.W.shape[-1]
    prefers = np.array([direction_vector(W) for W in crbm.W[:, 0]])
    prefers /= np.abs(prefers)
    maps, found = crbm.posterior(pictures := crbm.trim(pictures)), []
    for n, picture in enumerate(pictures[:, 0]):
        inside = slice(width // 2, width // 2 + maps[0].shape[-1])
        there = local_direction(picture, width)[inside, inside]
        pooled = there.reshape(-1, crbm.c, there.shape[1] // crbm.c, crbm.c).mean((1, 3))
        found.append(
            [_excess(on[n], at, prefers) for on, at in zip(maps, (there, pooled), strict=True)]
        )
    return np.array(found).T


def over_shuffled(crbm, pictures):
    """The mean `tuning_strength` less that with shuffled filters: hidden, pooled units (2, ORDERS).

    Filters in any order are tuned a little, for each has some direction.
    """
    rng = np.random.default_rng(0)
    others = (crbm.with_filters(shuffle(crbm.W, rng)) for _ in range(ORDERS))
    theirs = np.array([tuning_strength(other, pictures).mean(axis=1) for other in others])
    return tuning_strength(crbm, pictures).mean(axis=1)[:, None] - theirs.T


def _excess(on, there, prefers):
    """Of maps (K, rows, columns): how much more they agree with their own preferences."""
    under = (on * there).sum((1, 2)) / on.sum((1, 2))  # the mean direction under each unit
    cosines = np.real(under[:, None] * prefers.conj())
    own = np.trace(cosines)
    return own / len(on) - (cosines.sum() - own) / (len(on) * (len(on) - 1))
