"""Exercises of the chapter on names."""

import numpy as np

from vmc_lib.grading import Exercise


def precision_and_recall(chances, truth, threshold):
    called = chances > threshold
    right = (called & truth).sum()
    return right / called.sum(), right / truth.sum()


def _named_crops(rng):
    truth = rng.permutation(np.arange(12) < rng.integers(3, 9))
    return (rng.integers(0, 8, 12) + 2 * truth) / 10, truth, rng.choice([0.3, 0.5])


PRECISION_AND_RECALL = Exercise(
    precision_and_recall,
    _named_crops,
    {
        "The two are exchanged: return precision first.": lambda chances, truth, threshold: (
            precision_and_recall(chances, truth, threshold)[::-1]
        ),
        "A crop whose chance is exactly the threshold is not called a shuttlecock.": (
            lambda chances, truth, threshold: precision_and_recall(chances, truth, threshold - 1e-9)
        ),
        "You divided both by the number of all crops. Precision is a share of those *called* so, "
        "recall of those that *are*.": lambda chances, truth, threshold: (
            ((chances > threshold) & truth).mean(),
            ((chances > threshold) & truth).mean(),
        ),
        "The first is the share of crops named right, cups among them. Precision looks only at "
        "those that are called a shuttlecock.": lambda chances, truth, threshold: (
            ((chances > threshold) == truth).mean(),
            precision_and_recall(chances, truth, threshold)[1],
        ),
    },
)


def broken_promise(chances, truth, bins):
    place = np.minimum(chances * bins, bins - 1).astype(int)
    off = 0
    for k in set(place):
        here = place == k
        off += here.mean() * abs(chances[here].mean() - truth[here].mean())
    return off


def _bin_means(chances, truth, bins):
    """For each bin that is not empty: its share, the chance promised, and what came."""
    place = np.minimum(chances * bins, bins - 1).astype(int)
    rows = [(place == k, k) for k in sorted(set(place))]
    return np.array([[h.mean(), chances[h].mean(), truth[h].mean(), k] for h, k in rows]).T


def _signed_gap(chances, truth, bins):
    share, promised, came, _ = _bin_means(chances, truth, bins)
    return share @ (promised - came)


def _unweighted_gap(chances, truth, bins):
    _, promised, came, _ = _bin_means(chances, truth, bins)
    return abs(promised - came).mean()


def _gap_from_middle(chances, truth, bins):
    share, _, came, k = _bin_means(chances, truth, bins)
    return share @ abs((k + 0.5) / bins - came)


def _chances_off_the_edges(rng):
    """On the edge of a bin rounding would decide. Some bins are empty, some promise too much."""
    bins, n = int(rng.integers(3, 7)), rng.integers(4, 16)
    place = rng.choice(rng.permutation(bins)[: rng.integers(2, 5)], n)
    truth = rng.random(n) < rng.choice([0.2, 0.8], bins)[place]
    return ((place + rng.uniform(0.1, 0.9, n)) / bins).round(3), truth, bins


BROKEN_PROMISE = Exercise(
    broken_promise,
    _chances_off_the_edges,
    {
        "Too high in one bin and too low in another cancel now: take each gap's size.": _signed_gap,
        "A bin with few crops counts as much as a full one. Weigh each by its share of the "
        "crops.": _unweighted_gap,
        "You compared with the middle of the bin. What was promised is the mean chance of the "
        "crops in it.": _gap_from_middle,
        "That compares every crop with its own truth, 0 or 1. A chance is a promise about many: "
        "compare means, bin by bin.": lambda chances, truth, bins: abs(chances - truth).mean(),
    },
)


def possible_counts(percents, most):
    counts = []
    for n in range(1, most + 1):
        precisions = 100 * n / (n + np.arange(n + 1))
        off = abs(np.subtract.outer(percents, precisions)).min(axis=1)
        if (off < 0.05 + 1e-9).all():
            counts.append(n)
    return counts


def _draw_percentages(rng):
    """Percentages above 50, some of them exact or without a false alarm.

    They are drawn anew while one could be rounded both ways.
    """
    found, alarms = int(rng.integers(20, 50)), rng.integers(1, 20, 2)
    alarms[0] *= rng.random() < 0.7
    if rng.random() < 0.3:
        found, alarms = 36, rng.choice([4, 9, 12, 14], 2)
    percents, most = (100 * found / (found + alarms)).round(1), found * int(rng.integers(1, 3))
    most -= int(rng.integers(2))
    n, alarms = np.ogrid[1 : most + 1, : most + 1]
    off = abs(np.subtract.outer(percents, 100 * n / (n + alarms)))
    on_edge = np.isclose(off, 0.05, rtol=0, atol=1e-9).any()
    return _draw_percentages(rng) if on_edge else (percents, most)


def _counts(percents, most, shares, half=0.05 + 1e-9, enough=np.all):
    """As `possible_counts`, of other shares(n), another rounding, or where one is enough."""
    off = [abs(np.subtract.outer(percents, 100 * shares(n))).min(1) for n in range(1, most + 1)]
    return [n for n, both in enumerate(off, start=1) if enough(both < half)]


def _precisions(n):
    return n / (n + np.arange(n + 1))


POSSIBLE_COUNTS = Exercise(
    possible_counts,
    _draw_percentages,
    {
        "You kept what explains one of the percentages. The same number of shuttlecocks must "
        "explain both.": lambda percents, most: _counts(percents, most, _precisions, enough=np.any),
        "A printed percentage is rounded: it need not be met exactly.": lambda percents, most: (
            _counts(percents, most, _precisions, half=1e-9)
        ),
        "You cut the digits off; a printed percentage is rounded to the nearest tenth.": (
            lambda percents, most: _counts(
                percents, most, lambda n: np.floor(1000 * _precisions(n)) / 1000, half=1e-9
            )
        ),
        "No false alarm at all is a number too: try zero.": lambda percents, most: _counts(
            percents, most, lambda n: n / (n + np.arange(1, n + 1))
        ),
        "That is a share of the shuttlecocks, as recall is. Precision divides by all that were "
        "*called* one, false alarms among them.": lambda percents, most: _counts(
            percents, most, lambda n: np.arange(n + 1) / n
        ),
    },
)
