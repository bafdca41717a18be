"""What was measured: tables, experiments, trainings, the ledger and the benchmarks.

`python -m reproduce --list` names the step that remakes each.
"""

import json
from functools import partial
from pathlib import Path

from vmc_lib import data

FOLDER = Path(__file__).parent
arrays = partial(data.arrays, folder=FOLDER)


def records(name, folder=FOLDER):
    """The JSON file `name`.json of a folder."""
    return json.loads((Path(folder) / f"{name}.json").read_text())


def write(name, content, folder=FOLDER):
    """Write what `records` reads."""
    text = json.dumps(content, indent=1, ensure_ascii=False)
    (Path(folder) / f"{name}.json").write_text(text + "\n")
