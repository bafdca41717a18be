import numpy as np
from numpy.lib.stride_tricks import sliding_window_view


def energy_of_by_loops(v, h, W, b, a):
    energy, width = 0, len(W)
    for i in range(len(h)):
        for j in range(len(h)):
            if h[i, j] == 1:
                energy -= np.sum(W * v[i : i + width, j : j + width]) + b
    return energy - a * v.sum() + 0.5 * np.square(v).sum()


def energy_of_by_einsum(v, h, W, b, a):
    fit = np.einsum("ijkl,kl,ij->", sliding_window_view(v, W.shape), W, h)
    return -fit - b * h.sum() - a * np.sum(v) + np.vdot(v, v) / 2


def energy_of_by_shifts(v, h, W, b, a):
    m, width = len(h), len(W)
    places = [(r, c) for r in range(width) for c in range(width)]
    fit = sum(W[r, c] * v[r : r + m, c : c + m] for r, c in places)
    return np.sum(v * (v / 2 - a)) - np.sum(h * fit) - np.sum(h) * b


def unit_on_by_a_loop(drives, die):
    below = 1 + sum(np.exp(drive) for drive in drives)
    for unit, drive in enumerate(drives):
        die -= np.exp(drive) / below
        if die < 0:
            return unit
    return len(drives)


def unit_on_by_count(drives, die):
    shares = np.exp(np.append(drives, 0))
    return int((np.cumsum(shares / shares.sum())[:-1] <= die).sum())


def unit_on_to_the_right(drives, die):
    edges = np.cumsum(np.exp(drives)) / (1 + np.sum(np.exp(drives)))
    return np.searchsorted(edges, die, side="right")


def unit_on_by_argmax(drives, die):
    odds = np.exp([*drives, 0.0])
    return np.argmax(np.cumsum(odds) > die * odds.sum())


def cd_step_by_loops(v, h, dream_v, dream_h):
    width, m = len(v) - len(h) + 1, len(h)
    change = np.zeros((width, width))
    for i in range(width):
        for j in range(width):
            change[i, j] = np.sum(h * v[i : i + m, j : j + m])
            change[i, j] -= np.sum(dream_h * dream_v[i : i + m, j : j + m])
    return change


def cd_step_by_einsum(v, h, dream_v, dream_h):
    data = np.einsum("ijkl,kl", sliding_window_view(v, h.shape), h)
    return data - np.einsum("ijkl,kl->ij", sliding_window_view(dream_v, h.shape), dream_h)


def cd_step_by_units(v, h, dream_v, dream_h):
    width = len(v) - len(h) + 1
    windows = sliding_window_view(v, (width, width))
    dreamt = sliding_window_view(dream_v, (width, width))
    gap = h[..., None, None] * windows - dream_h[..., None, None] * dreamt
    return gap.sum(axis=(0, 1)).tolist()
