"""Tables of benchmarks, for the page on costs."""

from reproduce import results
from vmc_lib.show import table


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
