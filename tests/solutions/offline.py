import numpy as np


def fair_vote_by_least_squares(rates, preferred):
    return np.linalg.lstsq(preferred, rates, rcond=None)[0]


def fair_vote_by_the_inverse(rates, preferred):
    C = sum(np.outer(c, c) for c in preferred)
    return np.linalg.inv(C) @ sum(r * c for r, c in zip(rates, preferred, strict=True))


def fair_vote_by_cramer(rates, preferred):
    (p, q), (_, s) = preferred.T @ preferred
    x, y = rates @ preferred
    return [(s * x - q * y) / (p * s - q * q), (p * y - q * x) / (p * s - q * q)]


def fair_vote_of_two_neurons(rates, preferred):
    return np.linalg.solve(preferred[:2], rates[:2])


def shortened_by_a_loop(changes, longest):
    short = []
    for change in changes:
        length = np.sqrt(change @ change)
        short.append(change * longest / length if length > longest else change)
    return short


def shortened_by_a_mask(changes, longest):
    short, length = changes.copy(), np.linalg.norm(changes, axis=1)
    long = length > longest
    short[long] *= (longest / length[long])[:, None]
    return short


def shortened_by_where(changes, longest):
    length = np.sqrt((changes**2).sum(1, keepdims=True))
    factor = np.where(length >= longest, longest / np.where(length == 0, 1, length), 1)
    return changes * factor


def misfit_by_a_loop(points, targets, weights):
    squares = []
    for column, target in enumerate(targets):
        near = [1 / np.hypot(*(point - target)) for point in points]
        squares += [(n / sum(near) - w) ** 2 for n, w in zip(near, weights[:, column], strict=True)]
    return np.mean(squares) ** 0.5


def misfit_by_transposes(points, targets, weights):
    distance = np.sqrt(np.square(targets[:, None, :] - points[None]).sum(-1))
    shares = (1 / distance) / (1 / distance).sum(axis=1, keepdims=True)
    return np.mean(np.square(shares - weights.T)) ** 0.5


def misfit_by_norm(points, targets, weights):
    near = 1 / np.array([[np.linalg.norm(p - t) for t in targets] for p in points])
    return np.linalg.norm(near / near.sum(0) - weights) / np.sqrt(weights.size)
