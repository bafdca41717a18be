"""What was measured: tables, experiments, trainings, the ledger and the benchmarks.

`python -m reproduce --list` names the step that remakes each.
"""

import json
from functools import partial
from pathlib import Path

from vmc_lib import data

FOLDER = Path(__file__).parent
arrays = partial(data.arrays, folder=FOLDER)


def records(name):
    """The JSON file `name`.json of this folder."""
    return json.loads((FOLDER / f"{name}.json").read_text())


def write(name, content):
    """Write what `records` reads."""
    text = json.dumps(content, indent=1, ensure_ascii=False)
    (FOLDER / f"{name}.json").write_text(text + "\n")
