"""The ledger: every table and figure of the paper, what it claims and what we obtained.

`python -m vmc_lib.ledger` measures every row and writes `data/ledger.json`; the book's ledger page
shows that file, and a test measures the rows again and compares. Nothing in it is typed by hand.
"""

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

FILE = Path(__file__).parent / "data" / "ledger.json"


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
    in_sample: float | None = None
    tolerance: float = 0.0
    better: int = 0
    unit: str = ""

    @property
    def agrees(self) -> bool:
        gap = self.obtained - self.claimed
        return (self.better * gap if self.better else -abs(gap)) >= -self.tolerance


@dataclass(frozen=True)
class Row:
    """A table or figure of the paper: what it claims, how we measure it, why we differ if we do."""

    where: str
    claim: str
    chapter: str
    measure: Callable[[], list[Quantity]] | None = None
    differs: str = ""


def state(row: Row, quantities: list[Quantity]) -> str:
    """ "not yet" without a measure, "reproduced" when every quantity agrees, else "differs"."""
    if not quantities:
        return "not yet"
    return "reproduced" if all(quantity.agrees for quantity in quantities) else "differs"


def measure(row: Row) -> dict:
    """One row as plain data: the row's words, its state, and its quantities."""
    quantities = row.measure() if row.measure else []
    return {
        "where": row.where,
        "claim": row.claim,
        "chapter": row.chapter,
        "state": state(row, quantities),
        "because": row.differs,
        "quantities": [asdict(quantity) for quantity in quantities],
    }
