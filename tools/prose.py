"""Rewrites numbers in prose as the run has them: python -m tools.prose book/03_regions.ipynb."""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

from vmc_lib.show.prose import UPDATE, with_code


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
