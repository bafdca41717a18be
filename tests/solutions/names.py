from itertools import pairwise

import numpy as np


def precision_and_recall_by_a_loop(chances, truth, threshold):
    right = called = 0
    for chance, is_one in zip(chances, truth, strict=True):
        called += chance > threshold
        right += chance > threshold and is_one
    return [right / called, right / sum(truth)]


def precision_and_recall_by_masks(chances, truth, threshold):
    return np.array([truth[chances > threshold].mean(), (chances[truth] > threshold).mean()])


def precision_and_recall_by_counts(chances, truth, threshold):
    found = np.count_nonzero(truth[chances > threshold])
    missed = np.count_nonzero(truth[chances <= threshold])
    alarms = np.count_nonzero(~truth & (chances > threshold))
    return found / (found + alarms), found / (found + missed)


def broken_promise_by_left_closed_edges(chances, truth, bins):
    edges, off = np.linspace(0, 1, bins + 1), 0
    for low, high in pairwise(edges):
        here = (chances >= low) & (chances < high)
        if here.any():
            off += here.sum() / len(chances) * abs(chances[here].mean() - truth[here].mean())
    return off


def broken_promise_by_right_closed_edges(chances, truth, bins):
    off = 0
    for k in range(bins):
        here = (chances > k / bins) & (chances <= (k + 1) / bins)
        off += abs(chances[here].sum() - truth[here].sum()) / len(chances)
    return off


def broken_promise_by_digitize(chances, truth, bins):
    place = np.digitize(chances, np.linspace(0, 1, bins + 1)[1:-1], right=True)
    gaps = [abs(chances[place == k].mean() - truth[place == k].mean()) for k in np.unique(place)]
    return np.average(gaps, weights=np.unique(place, return_counts=True)[1])


def broken_promise_by_bincount(chances, truth, bins):
    place = np.floor(chances * bins).astype(int)
    return abs(np.bincount(place, chances - truth)).sum() / chances.size


def broken_promise_by_histogram(chances, truth, bins):
    promised, _ = np.histogram(chances, bins, (0, 1), weights=chances)
    came, _ = np.histogram(chances, bins, (0, 1), weights=truth.astype(float))
    return np.abs(promised - came).sum() / len(truth)


def possible_counts_by_rounding(percents, most):
    def explains(n, percent):
        return any(round(100 * n / (n + alarms), 1) == percent for alarms in range(most + 1))

    return [n for n in range(1, most + 1) if all(explains(n, percent) for percent in percents)]


def possible_counts_by_sets(percents, most):
    counts = []
    for n in range(1, most + 1):
        printed = {f"{n / called:.1%}" for called in range(n, 3 * n + 1)}
        if {f"{percent}%" for percent in percents} <= printed:
            counts.append(n)
    return counts


def possible_counts_by_solving(percents, most):
    n = np.arange(1, most + 1)[:, None]
    called = np.round(100 * n / percents)
    off = abs(100 * n / called - percents)
    return n[(off <= 0.05).all(axis=1), 0]
