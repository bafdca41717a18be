"""Marks: right work is marked right whatever an editor did to its file; no file ends the run."""

import csv
import io
import json
import sys
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit import marks
from kit.student import student

EXERCISES = (
    "known",
    "plain",
    "moved",
    "bare",
    "twice",
    "text",
    "wrong",
    "unread",
    "forged",
    "none",
    "broken",
    "cut",
)


GRADE = "from book.exercises.loop import MIXED\n\ngrade(known, MIXED)"
[HINT, *_] = MIXED.mistakes


@pytest.fixture(autouse=True)
def live(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")


@pytest.fixture
def chapter():
    """A chapter of exercises: in each, its own variable has to become 2."""
    cells = [
        new_markdown_cell("# A chapter"),
        new_code_cell("from vmc_lib.show import check, grade"),
    ]
    for name in EXERCISES:
        cells += [
            new_markdown_cell("**Exercise**\n\nHow much is 1 + 1?", metadata={"exercise": name}),
            new_code_cell(f"{name} = None"),
            new_code_cell(GRADE if name == "known" else f"check({name}, 2)"),
        ]
    cells += [
        new_code_cell("solution(MIXED)", metadata={"tags": ["solution"]}),
        new_markdown_cell("**Exercise**\n\nWhy?", metadata={"exercise": "why"}),
        new_markdown_cell("Because.", metadata={"tags": ["solution"]}),
    ]
    cells.insert(5, cells.pop(-3))  # below the exercise that it solves
    return new_notebook(cells=cells)


@pytest.fixture
def hand_in(chapter):
    """What a student made of it, right but for the last six exercises."""
    notebook = student(chapter)
    checks = {
        cell.metadata.exercise: cell
        for cell in notebook.cells
        if cell.cell_type == "code" and "exercise" in cell.metadata
    }
    for cell in notebook.cells:
        if cell.source.endswith(" = None"):
            name = cell.source.split()[0]
            lines = {
                "known": "lambda *parts: [*MIXED.mistakes.values()][0](*parts)",
                "text": "'2.'",
                "unread": "'two'",
                "wrong": "3",
                "forged": "3",
                "none": "None",
                "broken": "unknown",
            }
            cell.source = f"{name} = {lines.get(name, 2)}"
    checks["moved"].id = "another"
    checks["bare"].metadata = {}
    notebook.cells.append(new_code_cell("twice = 3"))
    notebook.cells.append(nbformat.from_dict(checks["twice"] | {"id": "copy"}))
    checks["forged"].source = "print('✓ Right.')"
    notebook.cells.remove(checks["cut"])
    return notebook


MARKS = {
    "known": f"a known mistake: {HINT}",
    "plain": "right",
    "moved": "right",
    "bare": "right",
    "twice": "right",
    "text": "right",
    "wrong": "not right",
    "unread": "not read",
    "forged": "not right",
    "none": "not answered",
    "broken": "NameError: name 'broken' is not defined",
    "cut": "no cell checks it",
    "why": "in words: for you to read",
}


def test_an_answer_is_marked_by_our_own_check(chapter, hand_in, tmp_path):
    assert marks.marks(chapter, hand_in, tmp_path) == MARKS


def test_endless_loop_is_interrupted(chapter, tmp_path):
    notebook = student(chapter)
    notebook.cells.insert(2, new_code_cell("while True:\n    pass"))
    results = marks.marks(chapter, notebook, tmp_path, limit=5)
    assert results.pop("why") == MARKS["why"]
    assert results.pop("known") == "not right"  # None is no function
    assert set(results.values()) == {"not answered"}


@pytest.fixture
def book(chapter, tmp_path, monkeypatch):
    """The chapter as the seventh of a book."""
    nbformat.write(chapter, tmp_path / "07_chapter.ipynb")
    monkeypatch.setattr(marks, "CHAPTERS", [tmp_path / "07_chapter.ipynb"])


@pytest.mark.usefixtures("book")
def test_every_file_gets_its_rows(hand_in, tmp_path, monkeypatch, capsys):
    """Renamed, from Windows, without ids, metadata or kernel; without a heading; cut; of none."""
    folder = tmp_path / "handed in, ü&b#c"
    folder.mkdir()
    bare = json.loads(nbformat.writes(hand_in)) | {"nbformat_minor": 4}
    bare["metadata"] = {"kernelspec": {"name": "none", "display_name": "None", "language": "R"}}
    for cell in bare["cells"]:
        del cell["id"]
        cell["metadata"] = {}
    (folder / "a student.ipynb").write_text(json.dumps(bare), encoding="utf-8-sig")
    (folder / "cut.ipynb").write_text(json.dumps(bare)[:-300], encoding="utf-8")
    (folder / "empty.ipynb").touch()
    nbformat.write(new_notebook(cells=[new_code_cell("1 / 0")]), folder / "7 a student.ipynb")
    nbformat.write(new_notebook(), folder / "notes.ipynb")
    monkeypatch.setattr(sys, "argv", ["kit.marks", str(folder)])
    marks.main()
    table = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert tuple(table[0]) == marks.COLUMNS
    rows = {}
    for row in table:
        rows.setdefault(Path(row["file"]).name, []).append(row)
    bare_marks = MARKS | {"forged": "no cell checks it"}  # it has lost its metadata and source
    *found, total = rows.pop("a student.ipynb")
    assert {row["exercise"]: row["mark"] for row in found} == bare_marks
    points = {row["exercise"]: row["points"] for row in found}
    assert (points["plain"], points["known"], points["wrong"], points["why"]) == (
        "2.0",
        "1.0",
        "0.0",
        "",
    )
    right = sum(mark == "right" for mark in bare_marks.values())
    assert float(total["points"]) == 2 * right + 1
    assert float(total["of"]) == 2 * len(EXERCISES)
    *unmarked, total = rows.pop("7 a student.ipynb")
    assert {row["mark"] for row in unmarked} == {"no cell checks it", MARKS["why"]}
    assert float(total["points"]) == 0
    assert rows.keys() == {"cut.ipynb", "empty.ipynb", "notes.ipynb"}
    assert all(row["mark"].startswith("cannot be marked (") for [row] in rows.values())
    assert "no chapter has its first heading" in rows["notes.ipynb"][0]["mark"]
    for none in ([], [str(folder / "none")], [str(folder / "cut.ipynb")]):
        monkeypatch.setattr(sys, "argv", ["kit.marks", *none])
        with pytest.raises(SystemExit, match=r"no notebooks under .* FOLDER"):
            marks.main()
