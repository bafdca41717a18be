"""What was measured: tables, experiments, trainings, the ledger and the benchmarks.

`python -m reproduce --list` names the step that remakes each.
"""

import json
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from vmc_lib import data

FOLDER = Path(__file__).parent
arrays = partial(data.arrays, folder=FOLDER)


def records(name, folder=FOLDER):
    """The JSON file `name`.json of a folder; ValueError where it is damaged."""
    path = Path(folder) / f"{name}.json"
    try:
        return json.loads(data.read(path))
    except json.JSONDecodeError as error:
        raise data.DamagedFile(path, error) from None


def write(name, content, folder=FOLDER):
    """Write what `records` reads."""
    text = json.dumps(content, indent=1, ensure_ascii=False)
    with replacement(Path(folder) / f"{name}.json") as new:
        new.write_text(text + "\n", encoding="utf-8", newline="\n")


@contextmanager
def replacement(file):
    """A path to write to: when all is written, what lies there takes the place of `file`."""
    new = file.with_name(f"new-{file.name}")
    try:
        yield new
        new.replace(file)
    finally:
        new.unlink(missing_ok=True)
