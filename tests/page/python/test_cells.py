"""A mechanism's cells that can be edited run in the page's Python."""

import nbformat
import pytest

from tests.project import CHAPTERS
from vmc_lib.grading import WRONG

pytestmark = pytest.mark.browser
HIDDEN = {"solution", "remove-input"}


def cells_with_edit():
    """Every cell that the page lets its reader edit: (chapter, its lines, the cells above)."""
    for chapter in CHAPTERS:
        above = []
        for cell in nbformat.read(chapter, 4).cells:
            tags = set(cell.metadata.get("tags", []))
            if cell.cell_type == "code" and not tags & HIDDEN:
                if "runs-in-page" in tags:
                    yield chapter, cell.source, list(above)
                above.append(cell.source)


def case(chapter, *rest):
    """A cell as a test's case: but for two chapters', they wait for the audit."""
    later = chapter.stem not in ("04_crbm", "11_online")
    return pytest.param(*rest, marks=[pytest.mark.audit] * later, id=chapter.stem)


CELLS = [case(*cell) for cell in cells_with_edit()]


@pytest.mark.parametrize(("lines", "above"), CELLS)
def test_a_cell_with_edit_runs_in_the_page(ask, lines, above):
    said, _ = ask(above, lines)
    agrees = ", and gives what the library gives" if "verify(" in lines else ""
    assert said == f"✓ It runs{agrees}."
    wrong = f"{lines}\nassert 1 > 2"
    words = f"{WRONG} Line {len(wrong.splitlines())} no longer holds: `assert 1 > 2`."
    assert ask(above, wrong) == [words, ""]


def test_some_cells_have_edit():
    assert len(CELLS) >= 7
