"""The chapters as the Colab button opens them: a first, folded cell fetches the rest of the book.

`python -m tools.colab FOLDER ADDRESS` writes them; ADDRESS is the repository's. The workflow `book`
puts that folder on the branch `colab` of the repository, to which the button leads.
"""

import sys
from pathlib import Path

import nbformat

ROOT = Path(__file__).parents[1]
SETUP = """#@title Run this first: it fetches the book and what it needs, in a few minutes
import sys
if "google.colab" in sys.modules:
    !git clone --quiet --depth 1 {address} sees_and_reaches
    %cd -q sees_and_reaches
    %pip install --quiet -e ".[chapters]"
    from google.colab import output
    output.enable_custom_widget_manager()"""


def with_setup(notebook, address):
    """The notebook behind a cell that sets it up in Colab, and does nothing elsewhere."""
    cell = nbformat.v4.new_code_cell(SETUP.format(address=address), id="set-up-in-colab")
    cell.metadata = {"cellView": "form", "jupyter": {"source_hidden": True}}
    notebook.cells.insert(0, cell)
    return notebook


def write(folder, address):
    """Write every notebook of the book into a folder, under its own path."""
    for path in sorted((ROOT / "book").glob("*.ipynb")):
        target = folder / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        nbformat.write(with_setup(nbformat.read(path, as_version=4), address), target)


if __name__ == "__main__":
    write(Path(sys.argv[1]), sys.argv[2])
