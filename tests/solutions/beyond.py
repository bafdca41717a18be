import numpy as np


def tenfold_by_logarithms(sizes, errors):
    slope = np.log(errors[0] / errors[-1]) / np.log(sizes[-1] / sizes[0])
    return np.exp(slope * np.log(10))


def tenfold_by_a_line(sizes, errors):
    slope, _ = np.polyfit(np.log10(sizes[[0, -1]]), np.log10(errors[[0, -1]]), 1)
    return 10**-slope


def tenfold_by_differences(sizes, errors):
    rise = np.log10(errors[0]) - np.log10(errors[-1])
    return 10 ** (rise / (np.log10(sizes[-1]) - np.log10(sizes[0])))


def cube_weights_by_a_sum(place, corners):
    return np.prod(corners * place + (1 - corners) * (1 - place), axis=1)


def cube_weights_by_loops(place, corners):
    weights = []
    for corner in corners:
        weight = 1
        for at, x in zip(corner, place, strict=True):
            weight *= x if at else 1 - x
        weights.append(weight)
    return weights


def cube_weights_by_distance(place, corners):
    return (1 - abs(corners - place)).prod(-1)


def cube_weights_by_powers(place, corners):
    x, y, z = (place**corners * (1 - place) ** (1 - corners)).T
    return x * y * z
