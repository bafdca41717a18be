"""The ledger as a picture: each claim of the paper a line, each of its numbers a mark."""

from book.figures.forest_plot import RATIO, SIGN, Line, Mark
from reproduce import ledger

ENTRIES = {entry["where"]: entry for entry in ledger.load_results()["rows"]}
ALL = "all"


def claims(verdict, part):
    """The rows of a part of the paper, or of all, with their numbers of a verdict, or of all.

    Part -> `Line`s, for a forest plot.
    """
    found = {}
    for head, rows in ledger.PARTS.items():
        lines = [_line(ENTRIES[row.where], verdict) for row in rows] if part in (ALL, head) else []
        found[head] = [line for line in lines if line]
    return {head: lines for head, lines in found.items() if lines}


def _line(entry, verdict):
    """An entry as a line with its numbers of a verdict; None where it has none."""
    found = [q["verdict"] for q in entry["quantities"]] or [entry["verdict"]]
    if verdict not in (ALL, *found):
        return None
    marks = [
        _mark(q)
        for q in entry["quantities"]
        if q["claimed"] is not None and verdict in (ALL, q["verdict"])
    ]
    tooltip = f"{entry['claim']} {entry['verdict'].capitalize()}."
    return Line(entry["where"], ledger.anchor(entry["where"]), tooltip, marks)


def _mark(q):
    """A quantity over what is claimed; where that is 0, over the largest of its own numbers."""
    ends = [q["obtained"], q["low"], q["high"], q["least"], q["most"]]
    unit = q["claimed"] or max(abs(end) for end in ends if end is not None) or 1
    value, low, high, least, most = (end if end is None else end / unit for end in ends)
    interval = () if low is None else (low, high)
    wider = () if least is None else (least, value if most is None else most)
    axis, side = RATIO if q["claimed"] else SIGN, q["better"] if q["bound"] else 0
    return Mark(q["verdict"], axis, value, interval, wider, side)
