import numpy as np


def near_weights_by_a_loop(target, points):
    distances = [np.hypot(*(point - target)) for point in points]
    if 0 in distances:
        return [float(d == 0) for d in distances]
    total = sum(1 / d for d in distances)
    return [1 / d / total for d in distances]


def near_weights_by_products(target, points):
    d = np.sqrt(((points - target) ** 2).sum(axis=1))
    others = np.array([np.delete(d, k).prod() for k in range(len(d))])
    return others / others.sum()


def near_weights_where_close(target, points):
    d = np.linalg.norm(np.subtract(points, target), axis=-1)
    weights = np.zeros(len(points))
    if np.isclose(d, 0).any():
        weights[d.argmin()] = 1
    else:
        weights[:] = 1 / d / np.sum(1 / d)
    return weights


def near_weights_by_identity(target, points):
    on = (points == target).all(axis=1)
    d = np.linalg.norm(points - target, axis=1)
    return on * 1.0 if on.any() else d**-1 / sum(d**-1)


def two_arrows_by_a_sum(target, weights, points, reached):
    mixed = sum(w * p for w, p in zip(weights, points, strict=True))
    return target - mixed, mixed - reached


def two_arrows_stacked(target, weights, points, reached):
    mixed = (weights[:, None] * points).sum(0)
    return np.stack([target, mixed]) - np.stack([mixed, reached])


def two_arrows_from_the_miss(target, weights, points, reached):
    first = target - np.average(points, axis=0, weights=weights)
    return [list(first), list(target - reached - first)]
