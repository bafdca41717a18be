"""What an entry of the ledger is: a claim of the paper, the numbers that test it, and a verdict."""

from collections.abc import Callable
from dataclasses import KW_ONLY, asdict, dataclass, field, replace

import numpy as np

from vmc_lib.statistics import t_interval, wilson

NOT_COMPARED, BY_CONSTRUCTION, FITTED, REPRODUCED, BEATEN, NULL_PASSES, DIFFERS = VERDICTS = (
    "not compared",
    "by construction",
    "fitted",
    "reproduced",
    "beaten",
    "null passes too",
    "differs",
)
HELD = "over the hold"  # names what is not read where the command ends
BELOW, ABOVE = ({"better": sign, "bound": True} for sign in (-1, 1))  # a limit's claim


@dataclass(frozen=True)
class Quantity:
    """One number of a row: claimed by the paper, obtained by us; its verdict follows.

    What is claimed is a number, or where `bound` a limit that all of the interval must be beyond,
    or None where the paper prints nothing to compare. `obtained` is held-out wherever something was
    learned, and `in_sample` stands beside it then. `nulls` are what other mechanisms obtain at the
    same cost, among them luck: where one would hold as well, and is not clearly worse, the verdict
    is "null passes too".
    """

    name: str
    claimed: float | None
    obtained: float
    _: KW_ONLY
    low: float | None = None  # the ends of the 95 % interval of what was obtained …
    high: float | None = None
    least: float | None = None  # … of one more draw as large as the paper's (prediction) …
    most: float | None = None
    p: float | None = None  # … or the chance of such a difference, corrected for their number
    rounding: float = 0.0  # half a unit of the claim's last digit
    better: int = 0  # +1 where more is better, -1 where less is, 0 where neither
    bound: bool = False
    in_sample: float | None = None
    fitted: bool = False  # a setting or a reading was chosen to come near what is claimed
    trivial: bool = False  # it cannot fail, short of a bug
    clock: bool = False  # read from a clock: no two runs give the same
    sample: str = ""  # how many of what it was measured on, such as "20 draws"
    nulls: dict = field(default_factory=dict)  # by name: what luck, or another mechanism, obtains

    @property
    def verdict(self) -> str:
        """One of VERDICTS; "beaten" is a number outside every interval, on its worse side."""
        own = self._own_verdict()
        undecided = own in (NOT_COMPARED, DIFFERS)
        return own if undecided or not self.passing_nulls() else NULL_PASSES

    def passing_nulls(self):
        """The nulls, by name, that would hold in place of ours, and are not clearly worse."""
        return [name for name, x in self.nulls.items() if self._holds(x) and not self._is_worse(x)]

    def _is_worse(self, null):
        """Whether a null lies outside all our intervals, on their worse side."""
        ends = self.obtained, self.low, self.high, self.least, self.most
        signed = [self.better * float(end) for end in ends if end is not None]
        return bool(self.better) and self.better * null < min(signed)

    def _holds(self, null):
        """In the place of ours, as uncertain; an end at 0 or 1, a share's edge, stays there."""
        away = null - self.obtained
        ends = {
            end: known if (known := getattr(self, end)) in (None, 0, 1) else known + away
            for end in ("low", "high", "least", "most")
        }
        return replace(self, obtained=null, p=None, **ends)._own_verdict() != DIFFERS

    def _own_verdict(self):
        if self.claimed is None:
            return NOT_COMPARED
        ends = [self.obtained, self.low, self.high]
        ends += [] if self.bound else [self.least, self.most]
        known = [float(end) for end in ends if end is not None]
        if self.bound:
            beyond = min(known) > self.claimed if self.better > 0 else max(known) < self.claimed
            agrees = beyond and (self.p is None or self.p < 0.05)
        else:
            slack = self.rounding + 1e-9
            agrees = min(known) - slack <= self.claimed <= max(known) + slack
        ahead = not self.bound and self.better * (self.obtained - self.claimed) > 0
        if not (agrees or ahead):
            return DIFFERS
        if self.fitted:
            return FITTED
        return BEATEN if not agrees else BY_CONSTRUCTION if self.trivial else REPRODUCED


def mean(name, claimed, values, unit="draws", of=None, **rest):
    """A `Quantity` that is the mean of `values` (n,), one of each `unit`, with Student's interval.

    Where the paper's number is itself a mean over `of` so many: also where one more mean of that
    size falls, t s √(1/n + 1/of).
    """
    (middle, half), n = t_interval(values), len(values)
    ends = {"low": middle - half, "high": middle + half}
    if of:
        one = half * np.sqrt(1 + n / of)
        ends |= {"least": middle - one, "most": middle + one}
    return Quantity(name, claimed, middle, sample=f"{n} {unit}", **ends, **rest)


def mean_of_draws(name, claimed, values, unit="draws", **rest):
    """A `Quantity` that is the mean of ratios (n,), each of a draw as the paper's one is.

    Both intervals are worked out on logarithms, so that none reaches below 0 and one odd draw
    widens the side on which it lies: Student's of the mean (by the delta method: s / mean), and
    that of one more draw, t s √(1 + 1/n) of the logarithms. ValueError for a draw that is not
    positive.
    """
    if min(values) <= 0:
        raise ValueError(f"{name}: a ratio of {min(values)} has no logarithm; take `mean` instead")
    middle, half = t_interval(values)
    logs, spread = t_interval(np.log(values))
    one = spread * np.sqrt(len(values) + 1)
    low, high = middle * np.exp([-half / middle, half / middle])
    least, most = np.exp([logs - one, logs + one])
    ends = {"low": low, "high": high, "least": least, "most": most}
    return Quantity(name, claimed, middle, sample=f"{len(values)} {unit}", **ends, **rest)


def share(name, claimed, right, n, of=None, unit="cases", effect=1.0, **rest):
    """A `Quantity` that is a share, `right` of `n`, with Wilson's interval.

    Where the paper counted `of` so many: also where one more count of that size falls, for only
    what is beyond that too is beaten or differs. Where several of a `unit` belong together, as
    regions on one object do, all are worth fewer: counts are divided by the design `effect`.
    """
    ends = dict(zip(("low", "high"), wilson(right / effect, n / effect), strict=True))
    if of:
        ends |= dict(zip(("least", "most"), _one_more_share(right, n, of, effect), strict=True))
    return Quantity(name, claimed, right / n, sample=_counted(n, unit, effect), **ends, **rest)


def mean_of_trainings(name, claimed, shares, n, of=None, unit="cases", effect=1.0, **rest):
    """A `Quantity` that is the mean of the shares of `n` that several trainings gave.

    Each of its intervals is the wider of two: Student's, for another training, and that of a
    `share`, for others of what was counted (if anything was).
    """
    middle, half = t_interval(shares)
    one = half * np.sqrt(len(shares) + 1)
    counted = share(name, claimed, middle * n, n, of, unit, effect) if n else None
    ends = {"low": middle - half, "high": middle + half}
    ends |= {"least": middle - one, "most": middle + one} if of else {}
    for end in ends if counted else ():
        wider = min if end in ("low", "least") else max
        ends[end] = wider(ends[end], getattr(counted, end))
    ends = {end: float(np.clip(x, 0, 1)) for end, x in ends.items()}
    sample = f"{len(shares)} trainings, {_counted(n, unit, effect)}"
    return Quantity(name, claimed, middle, sample=sample, **ends, **rest)


def _counted(n, unit, effect):
    """How many of what a share was counted on, and their design effect if they are clustered."""
    return f"{round(n)} {unit}" + (f" (design effect {effect:.1f})" if effect > 1 else "")


def _one_more_share(right, n, of, effect):
    """The 95 % interval of one more share, of so many (posterior predictive, Jeffreys' prior)."""
    from scipy.stats import betabinom

    right, n, of = right / effect, n / effect, max(1, round(of / effect))
    return betabinom.ppf((0.025, 0.975), of, right + 0.5, n - right + 0.5) / of


def wider_of(quantity, interval):
    """A `Quantity` whose interval is the wider of its own and another (low, high), end by end."""
    low, high = map(float, interval)
    return replace(quantity, low=min(quantity.low, low), high=max(quantity.high, high))


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
    """A row's verdict: the first of these that one of its quantities has.

    "differs", "null passes too", "beaten", "reproduced", "fitted", "by construction". So what was
    fitted, or cannot fail, decides only where nothing else does. A row without numbers is "not
    compared".
    """
    found = {q.verdict for q in quantities}
    return next((v for v in reversed(VERDICTS) if v in found), NOT_COMPARED)


def measure(row):
    """One row as plain data: its words, its verdict, its quantities and theirs."""
    quantities = row.measure()
    by_name, found = {q.name: q for q in quantities}, verdict(quantities)
    return {
        "where": row.where,
        "claim": row.claim,
        "chapter": row.chapter,
        "verdict": found,
        "because": row.differs.format(q=by_name) if found == DIFFERS else "",
        "note": row.note.format(q=by_name),
        "quantities": [_plain(asdict(q) | {"verdict": q.verdict}) for q in quantities],
    }


def _plain(value):
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    return value.item() if isinstance(value, np.generic) else value
