"""The ledger's numbers, measured again in the page: one more draw, and the mean of several."""

from reproduce.one_draw import DRAWS
from vmc_lib.show.estimate import estimate


def draw(where, seed):
    """The numbers of a row of the ledger, by name, for one more draw."""
    return {name: float(value) for name, value in DRAWS[where](seed).items()}


def summary(draws):
    """By name, the mean over draws with its 95 % interval, as text; of a single draw its number."""
    return {name: str(estimate([one[name] for one in draws])) for name in draws[0]}
