"""What an entry of the ledger is: a claim of the paper, the numbers that test it, and a verdict."""

from collections.abc import Callable
from dataclasses import KW_ONLY, asdict, dataclass

import numpy as np

from vmc_lib.statistics import student, wilson

BY_CONSTRUCTION, REPRODUCED, BEATEN, DIFFERS = VERDICTS = (
    "by construction",
    "reproduced",
    "beaten",
    "differs",
)


@dataclass(frozen=True)
class Quantity:
    """One number of a row: claimed by the paper, obtained by us; its verdict follows.

    What is claimed is a number, or where `bound` a limit that all of the interval must be beyond.
    `obtained` is held-out wherever something was learned, and `in_sample` stands beside it then.
    """

    name: str
    claimed: float
    obtained: float
    _: KW_ONLY
    low: float | None = None  # the ends of the 95 % interval of what was obtained …
    high: float | None = None
    p: float | None = None  # … or the chance of such a difference, corrected for their number
    rounding: float = 0.0  # half a unit of the claim's last digit
    better: int = 0  # +1 where more is better, -1 where less is, 0 where neither
    bound: bool = False
    in_sample: float | None = None
    trivial: bool = False  # it cannot fail, short of a bug
    clock: bool = False  # read from a clock: no two runs give the same

    @property
    def verdict(self) -> str:
        """One of VERDICTS; "beaten" is a number outside the interval, on its worse side."""
        low, high = (self.obtained if end is None else float(end) for end in (self.low, self.high))
        if self.bound:
            beyond = low > self.claimed if self.better > 0 else high < self.claimed
            agrees = beyond and (self.p is None or self.p < 0.05)
        else:
            slack = self.rounding + 1e-9
            agrees = low - slack <= self.claimed <= high + slack
        if agrees:
            return BY_CONSTRUCTION if self.trivial else REPRODUCED
        ahead = self.better * (self.obtained - self.claimed) > 0
        return BEATEN if ahead and not self.bound else DIFFERS


def mean(name, claimed, values, **rest):
    """A `Quantity` that is the mean of draws (n,), with Student's interval."""
    middle, half = student(values)
    return Quantity(name, claimed, middle, low=middle - half, high=middle + half, **rest)


def share(name, claimed, right, n, **rest):
    """A `Quantity` that is a share, `right` of `n`, with Wilson's interval."""
    low, high = wilson(right, n)
    return Quantity(name, claimed, right / n, low=low, high=high, **rest)


def mean_of_trainings(name, claimed, shares, n, **rest):
    """A `Quantity` that is the mean of the shares of `n` that several trainings gave.

    Its interval is the wider of two: Student's, for another training, and Wilson's, for others of
    what was counted (if anything was).
    """
    middle, half = student(shares)
    low, high = wilson(middle * n, n) if n else (middle, middle)
    low, high = min(low, middle - half), max(high, middle + half)
    return Quantity(name, claimed, middle, low=low, high=high, **rest)


def trivial_quantity(name, claimed, obtained, **rest):
    """A `Quantity` that cannot differ, short of a bug."""
    return Quantity(name, claimed, obtained, trivial=True, **rest)


@dataclass(frozen=True)
class Row:
    """A table, figure or sentence of the paper: what it claims, and how we measure it.

    Why we differ, and what else to know, may name quantities `q`, as `str.format` puts them in.
    """

    where: str
    claim: str
    chapter: str
    measure: Callable[[], list[Quantity]]
    differs: str = ""
    note: str = ""


def verdict(quantities):
    """A row's verdict follows from those of its quantities that can fail.

    If none can, it is "by construction"; if one differs, it "differs"; else, if one is beaten, it
    is "beaten"; else it is "reproduced". What is trivial differs only by a bug, but then it does.
    """
    found = {q.verdict for q in quantities}
    return next(v for v in (DIFFERS, BEATEN, REPRODUCED, BY_CONSTRUCTION) if v in found)


def measure(row):
    """One row as plain data: its words, its verdict, its quantities and theirs."""
    quantities = row.measure()
    by_name = {q.name: q for q in quantities}
    return {
        "where": row.where,
        "claim": row.claim,
        "chapter": row.chapter,
        "verdict": verdict(quantities),
        "because": row.differs.format(q=by_name),
        "note": row.note.format(q=by_name),
        "quantities": [_plain(asdict(q) | {"verdict": q.verdict}) for q in quantities],
    }


def _plain(quantity):
    return {k: v.item() if isinstance(v, np.generic) else v for k, v in quantity.items()}
