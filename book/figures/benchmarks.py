"""Tables of benchmarks, and their ratios as a picture, for the page on costs."""

import re

from book.figures.forest_plot import TIMES, Line, Mark
from reproduce import results
from vmc_lib.show import table

# What is compared with which program: the section of the page, the benchmark, its column of ratios,
# and which of its rows are ours
COMPARED = {
    "Arm: OpenSim": ("simulating-the-arm", "simulators", "× OpenSim as exact", "ours, (.*)"),
    "Features: scikit-learn": (
        "learning-features",
        "crbm",
        "times as fast as scikit-learn",
        "(.*)",
    ),
    "Plans: optimal control": (
        "planning-and-calibrating",
        "planning",
        "× faster than optimal control",
        "(?!optimal)(habitual plan|.* one target.*)",
    ),
    "In the page: Python's MuJoCo": ("the-arm-in-the-page", "in_page", "× Python's MuJoCo", "(.*)"),
}


def times_as_fast():
    """How many times as fast as another program ours is: groups of `Line`s for a forest plot."""
    rows = results.records("bench/selective_search")["rows"]
    seconds = {(row["by"], f"{row['strategy']}, {row['photos']}"): row["s"] for row in rows}
    groups = {}
    for (by, task), s in seconds.items():
        if by != "ours":
            line = _line(task, "selective-search", s / seconds["ours", task])
            groups.setdefault(f"Search: {by.removeprefix('PyPI ')}", []).append(line)
    for head, (section, name, column, ours) in COMPARED.items():
        for row in results.records(f"bench/{name}")["rows"]:
            task = re.fullmatch(ours, next(iter(row.values())))
            if task and row[column]:
                many = f", {row['batch']} at once" if row.get("batch", 1) > 1 else ""
                line = _line(f"{task[1]}{many}", section, row[column])
                groups.setdefault(head, []).append(line)
    return groups


def _line(task, section, ratio):
    kind = "faster" if ratio >= 1 else "slower"
    return Line(task, section, f"{ratio:,.3g} times as fast", [Mark(kind, TIMES, ratio)])


def benchmark(name, *columns):
    """Markdown of a benchmark: the table of its records, of all columns or these; the machine."""
    measured = results.records(f"bench/{name}")
    return f"{record_table(measured['rows'], *columns)}\n\n{machine(measured)}"


def record_table(records, *columns):
    """A table of records, of all that they hold or of these columns."""
    heads = columns or list(records[0])
    return table(heads, [[_cell(record[head]) for head in heads] for record in records])


def machine(measured):
    """The machine on which something was measured, as a line in italics."""
    return "*" + ", ".join(f"{key} {value}" for key, value in measured["machine"].items()) + "*"


def _cell(value):
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:,.4g}" if isinstance(value, float) else value
