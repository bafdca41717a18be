"""Measure the ledger: `python -m reproduce.ledger`."""

from reproduce import results
from reproduce.ledger import ROWS, whole
from reproduce.ledger.entry import measure
from vmc_lib.photos import LEVELS

if __name__ == "__main__":
    rows = [measure(row) for row in ROWS]
    results.write("ledger", {"rows": rows, "loop": {level: whole.fate(level) for level in LEVELS}})
