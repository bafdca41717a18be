"""The ledger: every table and figure of the paper, and its text's claims, beside what we obtained.

`python -m reproduce.ledger` measures every row and writes `results/ledger.json`; the book's page
shows that file, and a test measures the rows again and compares. Nothing in it is typed by hand.
"""

from reproduce import results
from reproduce.ledger import moving, seeing, whole

ROWS = (*whole.ROWS, *seeing.ROWS, *moving.ROWS)


def load():
    """The ledger as it was last measured: {"rows": [...], "loop": {level: `whole.fate`}}."""
    return results.records("ledger")


def as_markdown(entries):
    """The rows as Markdown: what is claimed and how it stands, then a table of its quantities."""
    lines = []
    for entry in entries:
        why = f": {entry['because']}" if entry["because"] else "."
        place = f"**[{entry['where']}]({entry['chapter']}.ipynb)**"
        lines += [f"{place} · {entry['claim']} *{entry['state'].capitalize()}*{why}", ""]
        lines += ["| quantity | paper | obtained | in sample | tolerance |", "|---" * 5 + "|"]
        for q in entry["quantities"]:
            arrow = {1: " ↑", -1: " ↓", 0: ""}[q["better"]]
            numbers = map(_number, (q["claimed"], q["obtained"], q["in_sample"], q["tolerance"]))
            lines.append("| " + " | ".join([q["name"] + arrow, *numbers]) + " |")
        lines.append("")
    return "\n".join(lines)


def _number(x):
    return "" if x is None else f"{x:.3g}"
