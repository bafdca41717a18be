"""nbgrader's notebooks: its rules for cells, and hidden tests that give the points of a mark."""

import re

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit import nbgrader
from kit.__main__ import CHAPTERS, ROOT
from kit.student import student

HIDDEN = re.compile(r"\n### BEGIN HIDDEN TESTS\n[\s\S]*?### END HIDDEN TESTS")


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_its_source_without_hidden_tests_is_what_students_get(path):
    chapter = nbformat.read(path, as_version=4)
    notebook, hidden = nbgrader.source(chapter), 0
    nbformat.validate(notebook)
    for cell in notebook.cells:
        hidden += len(HIDDEN.findall(cell.source))
        cell.source = HIDDEN.sub("", cell.source)
    assert notebook.cells == student(chapter).cells
    graded = [cell for cell in notebook.cells if "nbgrader" in cell.metadata]
    assert hidden == sum(cell.cell_type == "code" for cell in graded)
    ids = [cell.metadata.nbgrader.grade_id for cell in graded]
    assert len(ids) == len({*ids}) >= 2
    for cell in graded:
        rules = cell.metadata.nbgrader
        assert re.fullmatch(r"[a-zA-Z0-9_-]+", rules.grade_id)
        assert (rules.schema_version, rules.grade, rules.task) == (3, True, False)
        assert rules.cell_type == cell.cell_type
        assert rules.points > 0
        assert rules.solution == (cell.cell_type == "markdown") != rules.locked


ANSWERS = {
    "right": ("2", "2.0"),
    "wrong": ("3", "AssertionError: not right"),
    "none": ("None", "AssertionError: not answered"),
    "mistaken": ("lambda *parts: [*MIXED.mistakes.values()][0](*parts)", "1.0"),
}


def test_a_hidden_test_gives_the_points_of_its_mark():
    cells = [
        new_code_cell(
            "from book.exercises.loop import MIXED\nfrom vmc_lib.show import check, grade"
        )
    ]
    for name in ANSWERS:
        check = "grade(mistaken, MIXED)" if name == "mistaken" else f"check({name}, 2)"
        cells += [
            new_markdown_cell("**Exercise**", metadata={"exercise": name}),
            new_code_cell(f"{name} = None"),
            new_code_cell(check),
        ]
    cells.append(new_code_cell("solution(MIXED)", metadata={"tags": ["solution"]}))
    notebook = nbgrader.source(new_notebook(cells=cells))
    for cell in notebook.cells:
        if cell.source.endswith(" = None"):
            name = cell.source.split()[0]
            cell.source = f"{name} = {ANSWERS[name][0]}"
    assert MIXED.mistakes
    client = NotebookClient(notebook, allow_errors=True, resources={"metadata": {"path": ROOT}})
    client.execute()
    for cell in notebook.cells:
        if "nbgrader" in cell.metadata and cell.cell_type == "code":
            [output] = cell.outputs
            error = f"{output.get('ename')}: {output.get('evalue')}"
            got = output.data["text/plain"] if "data" in output else error
            assert got == ANSWERS[cell.metadata.exercise][1]
