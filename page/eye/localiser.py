"""The shipped localiser of photographs, made compact for the page.

What it compares a box with, 2080 boxes of 3648 numbers each, is kept in its main directions alone,
in whole numbers of 8 bits: an eighth of the size. The page tells by how much its places differ.
"""

from functools import cache

import numpy as np
from scipy.sparse.linalg import eigsh

from vmc_lib.loop import PHOTOGRAPHS_AS
from vmc_lib.where.localiser import GAMMA, SIDE, Localiser

DIRECTIONS = 128
LARGEST = 127  # of 8 bits with a sign


@cache
def localiser():
    """What `locate` needs of the `Localiser` of `VisuomotorModel.load("real")`."""
    learnt = Localiser.load(PHOTOGRAPHS_AS)
    middle = learnt.support.mean(axis=0)
    x = learnt.support - middle
    variances, places = eigsh(x @ x.T, DIRECTIONS, v0=np.ones(len(x)))
    places = places * np.sqrt(variances)
    axes, axis_units = whole_numbers(x.T @ places / variances)
    centres, centre_units = whole_numbers(places)
    return {
        "axes": axes.T,  # rows, as the page multiplies them
        "centres": centres,
        "unit": axis_units * centre_units,
        "middle": np.float32(middle),
        "squares": np.float32((x**2).sum(axis=1)),
        "weights": np.float32(learnt.weights),
        "mean": learnt.mean,
        "spread": learnt.spread,
        "gamma": GAMMA,
        "side": SIDE,
    }


def whole_numbers(columns):
    """Columns (n, k) as int8, and the unit (k,) of each."""
    units = np.abs(columns).max(axis=0) / LARGEST
    return np.round(columns / units).astype(np.int8), units


class CompactLocaliser(Localiser):
    """The localiser as the page has it; `support` is not used."""

    @classmethod
    @cache
    def load(cls):
        """That of photographs."""
        parts = localiser()
        return cls(None, *(parts[name] for name in ("weights", "mean", "spread")))

    def kernel(self, x):
        """As in `Localiser`, but the product in ‖a - b‖² = ‖a‖² + ‖b‖² - 2 a·b is compact."""
        parts = localiser()
        x = x - parts["middle"]
        along = x @ parts["axes"].T * parts["unit"]
        squares = (x**2).sum(axis=1, keepdims=True) + parts["squares"]
        return np.exp(-GAMMA * (squares - 2 * along @ parts["centres"].T))


def shift_mm(shots):
    """How far each place of the page is from Python's (n,), in mm: of the true boxes in photos."""
    places = [
        [
            kind.locate(photo.image, photo.boxes["shuttlecock"], photo.camera)
            for kind in (Localiser.load(PHOTOGRAPHS_AS), CompactLocaliser.load())
        ]
        for photo in shots
    ]
    return 1000 * np.linalg.norm(np.diff(places, axis=1)[:, 0], axis=-1)
