"""Selectivity and invariance of the CDBN: preferred patches, receptive fields, shift tolerance."""

import torch
from torch.nn.functional import avg_pool2d

WINDOWS = {"H1": (1, 8), "H2": (2, 23)}  # pixels between neighbours, and that a filter spans


def preferred_patches(cdbn, pictures, count=9):
    """The patches that excite each unit most, one of a picture (n, 1, 200, 200), whitened.

    Layer -> patches (units, count, width, width), and of which pictures they are (units, count).
    """
    found = {}
    for layer, (step, width) in WINDOWS.items():
        maps = torch.cat([cdbn.layers(one)[layer] for one in pictures.split(1)])  # less memory
        strongest, place = maps.flatten(2).max(2)  # (pictures, units)
        best = strongest.argsort(dim=0, descending=True)[:count]
        place, row = place.gather(0, best), maps.shape[3]
        y, x = step * (place // row), step * (place % row)
        windows = pictures[:, 0].unfold(1, width, 1).unfold(2, width, 1)
        found[layer] = windows[best.T, y.T, x.T].numpy(), best.T.numpy()
    return found


def receptive_field(cdbn, layer):
    """Pixels, along a side, that can change the middle unit of a layer."""
    v = torch.zeros(1, 1, 200, 200, requires_grad=True)
    maps = cdbn.layers(v)[layer]
    maps[..., maps.shape[2] // 2, maps.shape[3] // 2].sum().backward()
    return int(v.grad[0, 0].any(0).sum())


def shift_correlations(cdbn, pictures, shifts):
    """How well layers correlate with what they were before a shift (pixels): shift -> layer -> r.

    The layers are those of `CDBN.layers`, and the means of P2 in the four quarters of the crop.
    """
    before = _layers(cdbn, pictures)
    found = {}
    for shift in shifts:
        moved = _layers(cdbn, pictures.roll(shift, -1))
        found[shift] = {name: _correlation(before[name], moved[name]) for name in before}
    return found


def _layers(cdbn, pictures):
    each = [cdbn.layers(one) for one in pictures.split(1)]  # less memory
    layers = {name: torch.cat([one[name] for one in each]) for name in each[0]}
    return layers | {"P2, quarters": avg_pool2d(layers["P2"], 22)}


def _correlation(one, other):
    one, other = (x.flatten().double() for x in (one, other))  # in floats, 1 may come out as 0.998
    one, other = one - one.mean(), other - other.mean()
    return float(one @ other / (one.norm() * other.norm()))
