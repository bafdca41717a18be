"""The ledger: every table and figure of the paper, and its text's claims, beside what we obtained.

`make` measures every row, and `results/ledger.json` holds what it found; the book's page shows
that file, and a test measures the rows again and compares. Nothing in it is typed by hand.
"""

import json
import re
from collections import Counter
from dataclasses import fields
from html import escape

from reproduce import one_draw, results
from reproduce.ledger import (
    arm,
    calibration,
    filters,
    loop,
    naming,
    online,
    planning,
    regions,
    search,
)
from reproduce.ledger.entry import NULL_PASSES, VERDICTS, Quantity, measure
from vmc_lib.photos import LEVELS
from vmc_lib.show import table

PARTS = {  # of the paper
    "Loop": loop.ROWS,
    "Where": search.ROWS + regions.ROWS,
    "What": naming.ROWS + filters.ROWS,
    "Moving": arm.ROWS + planning.ROWS,
    "Cerebellum": calibration.ROWS + online.ROWS,
}
ARROWS = {1: " ↑", -1: " ↓", 0: ""}
ROWS = tuple(row for rows in PARTS.values() for row in rows)


def make(rows=ROWS, levels=LEVELS):
    """What `results/ledger.json` holds: the rows measured, and how the loop fares on each level."""
    return {
        "rows": [measure(row) for row in rows],
        "loop": {level: loop.loop_results(level) for level in levels},
    }


def load_results():
    """The ledger as it was last measured: {"rows": [...], "loop": {level: `loop.loop_results`}}."""
    return results.records("ledger")


def value(where, name):
    """The `Quantity` of that name in the row `where`, as it was last measured.

    Chapters ask here, so that a claim has one number. ValueError where there is none.
    """
    entries = _quantities_by_row()
    for q in entries.get(where, ()):
        if q["name"] == name:
            return _quantity(q)
    known = [q["name"] for q in entries.get(where, ())] or list(entries)
    raise ValueError(f"the ledger has no {name!r} of {where!r}; choose from {known}")


def _quantities_by_row():
    return {entry["where"]: entry["quantities"] for entry in load_results()["rows"]}


def _quantity(q):
    """A number as it was stored, as a `Quantity` again."""
    return Quantity(**{field.name: q[field.name] for field in fields(Quantity)})


def verdict_counts(entries):
    """How many rows and quantities have each verdict, as a Markdown table.

    And of how many quantities the paper claims only that they are more, or less, than something.
    """
    rows = Counter(entry["verdict"] for entry in entries)
    counts = rows, numbers_by_verdict(entries), numbers_by_verdict(entries, limits=True)
    lines = [[f"*{v}*", *(count[v] for count in counts)] for v in VERDICTS]
    heads = ["verdict", "rows", "numbers", "of these, only > or <"]
    return table(heads, [*lines, ["together", *map(Counter.total, counts)]])


def numbers_by_verdict(entries, limits=False):
    """How many quantities of entries have each verdict, a Counter; `limits`: those > or < alone."""
    quantities = (q for entry in entries for q in entry["quantities"])
    return Counter(q["verdict"] for q in quantities if q["bound"] or not limits)


def anchor(where):
    """The address of a row's details on the ledger's page."""
    return "row-" + re.sub(r"[^a-z0-9]+", "-", where.lower()).strip("-")


def details(entry):
    """An entry's reasons and all of its numbers, folded, as Markdown."""
    text = " ".join(filter(None, (entry["because"], entry["note"])))
    heads = [
        "number",
        "paper",
        "ours (95 %)",
        "one more draw",
        "measured on",
        "in sample",
        "nulls",
        "verdict",
    ]
    rows = [
        [
            q["name"] + ARROWS[q["better"]],
            claim_text(q),
            result_text(q),
            draw_text(q),
            q["sample"],
            q["in_sample"],
            nulls_text(q),
            q["verdict"],
        ]
        for q in entry["quantities"]
    ]
    place = f'<details id="{anchor(entry["where"])}"><summary>{entry["where"]}'
    title = f"{place}: {entry['claim']} <i>{entry['verdict']}</i></summary>"
    text += f" [The chapter]({entry['chapter']}.ipynb)."
    numbers = f"\n\n{table(heads, rows)}" if rows else ""
    return f"{title}\n\n{text}{numbers}{measure_again(entry['where'])}\n\n</details>\n"


def measure_again(where):
    """Where a row's numbers are measured again in the page, as HTML; nothing if that is slow."""
    if where not in one_draw.DRAWS:
        return ""
    quantities = _quantities_by_row()[where]
    shipped = escape(json.dumps({q["name"]: result_text(q) for q in quantities}))
    given = f'data-where="{where}" data-shipped="{shipped}"'
    return f'\n\n<form class="vmc-measure" hidden {given}></form>'


def claim_text(q):
    """What is claimed, as text: a number, a limit, or nothing."""
    if q["claimed"] is None:
        return ""
    sign = {1: "> ", -1: "< "}[q["better"]] if q["bound"] else ""
    return f"{sign}{q['claimed']:.3g}"


def result_text(q):
    """What was obtained, as text, with its interval or the chance of such a difference."""
    text = f"{q['obtained']:.3g}"
    if q["low"] is not None:
        text += f" ({q['low']:.3g} to {q['high']:.3g})"
    return text if q["p"] is None else f"{text} (p = {q['p']:.2g})"


def nulls_text(q):
    """The nulls, as text; where they decide the verdict, which of them pass."""
    passing = _quantity(q).passing_nulls() if q["verdict"] == NULL_PASSES else []
    return "; ".join(
        f"{name}: {value:.3g}{' (passes)' if name in passing else ''}"
        for name, value in q["nulls"].items()
    )


def draw_text(q):
    """Where one more draw as large as the paper's falls, as text; nothing where it is not known."""
    if q["least"] is None:
        return ""
    above = "" if q["most"] is None else f" to {q['most']:.3g}"
    return f"{'' if above else '≥ '}{q['least']:.3g}{above}"
