"""Rewrites numbers in prose as the run has them: python -m tools.prose book/03_regions.ipynb."""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell

from vmc_lib.show.prose import NUMBER

CHECK = "import vmc_lib.show.prose as _prose\n_prose.check_numbers({!r}, globals())"
UPDATE = "import vmc_lib.show.prose as _prose\nprint(_prose.update({!r}, globals()), end='')"


def with_code(cells, line):
    """A notebook's cells, each with numbers in its prose replaced by code: a `line` of its text."""
    return [_code(cell, line) if _has_numbers(cell) else cell for cell in cells]


def _has_numbers(cell):
    return cell.cell_type == "markdown" and NUMBER.search(cell.source)


def _code(cell, line):
    first, *_ = cell.source.splitlines()
    return new_code_cell(f"# {first}\n{line.format(cell.source)}", id=cell.id)


def update(path):
    """Run a notebook, and write it again where the run has other numbers in its prose."""
    notebook, run = (nbformat.read(path, as_version=4) for _ in range(2))
    run.cells = with_code(run.cells, UPDATE)
    NotebookClient(run, resources={"metadata": {"path": path.parent}}).execute()
    for cell, after in zip(notebook.cells, run.cells, strict=True):
        if cell.cell_type != after.cell_type:
            cell.source = after.outputs[0].text
    nbformat.write(notebook, path)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        update(Path(name))
