"""Marks: which exercises are right in notebooks that were handed in.

`python -m kit.marks FOLDER` runs each of them, so do it where a stranger's code can do no harm.
Whoever wants to can fool it: a mark says where to look, and the lecturer looks.
"""

import sys
from pathlib import Path

import nbformat
from jupyter_cache.executors.utils import single_nb_execution

from kit.__main__ import ROOT
from kit.student import student
from vmc_lib.show.questions import RIGHT

TIMEOUT = 600  # s a cell


def marks(chapter, handed_in, folder):
    """Whether each exercise of a chapter's notebook is right, {label: bool}, in what was handed in.

    Runs that in `folder`, with our own checks in place of the student's; answers in words are left
    to the lecturer.
    """
    code = [cell for cell in student(chapter).cells if cell.cell_type == "code"]
    checks = {cell.id: cell for cell in code if "exercise" in cell.metadata}
    handed_in.cells = [checks.get(cell.id, cell) for cell in handed_in.cells]
    single_nb_execution(handed_in, folder, TIMEOUT, allow_errors=True)
    return {cell.metadata.exercise: _right(cell) for cell in checks.values()}


def _right(cell):
    return any(RIGHT in output.get("data", {}).get("text/html", "") for output in cell.outputs)


if __name__ == "__main__":
    for path in sorted(Path(sys.argv[1]).rglob("*.ipynb")):
        chapter, handed_in = (
            nbformat.read(file, as_version=4) for file in (ROOT / "book" / path.name, path)
        )
        print(path, marks(chapter, handed_in, path.parent))
