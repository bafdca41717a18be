"""Measure the ledger: `python -m vmc_lib.ledger`."""

import json

from vmc_lib.ledger import FILE, ROWS, whole
from vmc_lib.ledger.entry import measure
from vmc_lib.photos import LEVELS

if __name__ == "__main__":
    rows = [measure(row) for row in ROWS]
    entries = {"rows": rows, "loop": {level: whole.fate(level) for level in LEVELS}}
    FILE.write_text(json.dumps(entries, indent=1, ensure_ascii=False) + "\n")
