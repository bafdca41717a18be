"""In a live notebook a law that the reader changes moves demos, and its cell says so."""

import json

import nbformat
import pytest

from tests.laws import functions, law_cells
from tests.project import CHAPTERS, python, sample


def laws_of(path):
    """The names of a chapter's laws."""
    cells = law_cells(nbformat.read(path, 4).cells)
    return [law.name for cell in cells for law in functions(cell)]


LAWS = {path: laws for path in CHAPTERS if (laws := laws_of(path))}
SOME = sample(LAWS, "07_muscle")


@pytest.mark.parametrize("path", SOME, ids=lambda path: path.stem)
def test_a_changed_law_moves_a_demo_and_says_so(path):
    found = json.loads(python("-m", "tests.changed_laws", path.stem).splitlines()[-1])
    assert [*found] == LAWS[path]
    assert [name for name, one in found.items() if not one["follows"]] == []
    for name, one in found.items():
        assert f"Your <code>{name}</code> differs from the book's, by" in one["said"], one["said"]
        assert "the demos that use it now run yours" in one["said"]
