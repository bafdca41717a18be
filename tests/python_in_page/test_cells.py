"""A mechanism's cells can be edited where they run in the page's Python, and only there."""

import nbformat
import pytest
from playwright.sync_api import Error

from tests.project import CHAPTERS
from vmc_lib.grading import WRONG

pytestmark = pytest.mark.browser
HIDDEN = {"solution", "remove-input"}


def open_cells():
    """Every open cell with an assert: (chapter, its lines, the lines above, whether tagged)."""
    for chapter in CHAPTERS:
        above = []
        for cell in nbformat.read(chapter, 4).cells:
            tags = set(cell.metadata.get("tags", []))
            if cell.cell_type == "code" and not tags & HIDDEN:
                if "\nassert " in cell.source and "hide-input" not in tags:
                    yield chapter, cell.source, list(above), "runs-in-page" in tags
                above.append(cell.source)


@pytest.mark.parametrize(
    ("lines", "above", "tagged"),
    [pytest.param(*rest, id=chapter.stem) for chapter, *rest in open_cells()],
)
def test_a_cell_has_edit_if_it_runs_in_the_page(ask, lines, above, tagged):
    try:
        said, _ = ask(above, lines)
    except Error as stopped:  # it takes longer than a page's reader is asked to wait
        said = str(stopped)
    assert (said == "✓ It runs, and its `assert` holds.") == tagged, said
    if tagged:
        wrong = f"{lines}\nassert 1 > 2"
        line = len(wrong.splitlines())
        words = f"{WRONG} Line {line} no longer holds: `assert 1 > 2`."
        assert ask(above, wrong) == [words, ""]


def test_some_cells_have_edit():
    assert sum(tagged for *_, tagged in open_cells()) >= 7
