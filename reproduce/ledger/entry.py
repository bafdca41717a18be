"""What an entry of the ledger is: a claim of the paper, and the numbers that test it."""

from collections.abc import Callable
from dataclasses import KW_ONLY, asdict, dataclass

import numpy as np

SHARE = 0.05  # how far a share of photos or RoIs may stray: two of forty photos
RATIO = 0.10  # the same for a ratio of errors, whose movements are random


@dataclass(frozen=True)
class Quantity:
    """One number of a row: claimed by the paper, obtained by us, and when the two agree.

    `obtained` is held-out wherever something was learned, and `in_sample` stands beside it then.
    `better` is +1 where more is better (agrees when obtained >= claimed - tolerance), -1 where less
    is, 0 where the two must match within the tolerance.
    """

    name: str
    claimed: float
    obtained: float
    _: KW_ONLY
    in_sample: float | None = None
    tolerance: float = 0.0
    better: int = 0

    @property
    def agrees(self) -> bool:
        """Whether `obtained` bears out what is `claimed`."""
        gap = self.obtained - self.claimed
        short = -self.better * gap if self.better else abs(gap)
        return short <= self.tolerance + 1e-9


@dataclass(frozen=True)
class Row:
    """A table or figure of the paper: what it claims, how we measure it, why we differ if we do."""

    where: str
    claim: str
    chapter: str
    measure: Callable[[], list[Quantity]]
    differs: str = ""


def measure(row):
    """One row as plain data: its words, its quantities, and "reproduced" or "differs"."""
    quantities = row.measure()
    return {
        "where": row.where,
        "claim": row.claim,
        "chapter": row.chapter,
        "state": "reproduced" if all(q.agrees for q in quantities) else "differs",
        "because": row.differs,
        "quantities": [_plain(asdict(q) | {"agrees": q.agrees}) for q in quantities],
    }


def _plain(quantity):
    return {k: v.item() if isinstance(v, np.generic) else v for k, v in quantity.items()}
