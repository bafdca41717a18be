"""The teacher's kit: what students get, what the key says, what platforms import, and slides."""

import ast
import re
from inspect import getsource

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit.__main__ import CHAPTERS, ROOT, build, index
from kit.key import key
from kit.student import LINK, checks, student
from vmc_lib.show import questions

BUILT = ROOT / "_build/html/book"

ENDS = ".gift", ".xml", "-qti.zip"
EXPORTS = [f"{name}{end}" for name in ("questions", "predictions") for end in ENDS]


def test_a_folder_that_cannot_be_written_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("kit.__main__.CHAPTERS", [])
    (tmp_path / "file").touch()
    with pytest.raises(SystemExit, match=r"the kit cannot be written: .*file"):
        build(tmp_path / "file/kit", tmp_path)


def test_without_a_built_book_the_old_kit_stays(tmp_path):
    (tmp_path / "old").mkdir()
    with pytest.raises(SystemExit, match="build the book first: make book"):
        build(tmp_path / "old", tmp_path / "pages")
    assert (tmp_path / "old").is_dir()


# ---------------------------------------------------------------- students' notebooks


@pytest.fixture(params=CHAPTERS, ids=lambda path: path.stem)
def chapter(request):
    return nbformat.read(request.param, as_version=4)


def test_a_student_gets_every_exercise_and_no_solution(chapter):
    notebook = student(chapter)
    nbformat.validate(notebook)
    text = "\n".join(cell.source for cell in notebook.cells)
    assert not re.findall("Show the solution|[*]Solution[*]", text)
    assert "# The solution" not in text
    assert not re.search(r"\b(check|grade)\(|book[.]exercises", text)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    exercises = [c.metadata.exercise for c in notebook.cells if "**Exercise" in c.source]
    graded = [c.metadata.exercise for c in notebook.cells if "graded" in c.metadata.get("tags", [])]
    assert graded == exercises
    assert exercises


def test_a_student_is_told_where_work_is_checked(chapter):
    [how_to_run] = [cell.source for cell in student(chapter).cells if cell.id == "how-to-run"]
    assert "your teacher's program checks your work there" in how_to_run
    assert "folded bar" not in how_to_run


def names_in(notebook, context):
    """The names that code cells load or store; the arguments of functions apart."""
    code = [ast.parse(cell.source) for cell in notebook.cells if cell.cell_type == "code"]
    nodes = [node for tree in code for node in ast.walk(tree)]
    names = {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, context)}
    return names - {node.arg for node in nodes if isinstance(node, ast.arg)}


def test_a_students_cells_use_no_name_of_what_was_taken_out(chapter):
    notebook = student(chapter)
    gone = names_in(chapter, ast.Store) - names_in(notebook, ast.Store)
    assert not gone & names_in(notebook, ast.Load)


# ---------------------------------------------------------------- the key


PREDICTION = """**Predict.** Is $a < b$?

- yes
- *no*

<details><summary>What came out</summary>

**yes.**<!--{a < b}--> It *must*: 2<!--{b - a}-->.

</details>"""
QUIZ = """**Quiz.** Which?

<details><summary>this</summary>

✗ It is.

</details>

<details><summary>that</summary>

✓ It is `not`.

</details>"""


def test_the_key_has_every_answer_and_why(outputs, monkeypatch):
    page = outputs(questions)
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    questions.check(None, 11.5, 0.6, "Draw it.", "mm")
    page = (
        f'<div class="exercise" id="one"></div><div>{page[0]}</div><div class="solution">'
        '<div class="cell_output"><p>1 mm</p></div></div>'
    )
    solution = {"tags": ["solution"]}
    details = "<details><summary>Show the solution</summary>\n\nOne.\n\n</details>"
    cells = [
        new_markdown_cell("# Title"),
        new_code_cell("from book.exercises.loop import MIXED\n\ngrade(mixed, MIXED)"),
        new_markdown_cell("**Exercise: One**\n\nHow many?", metadata={"exercise": "one"}),
        new_markdown_cell(details, metadata=solution),
        new_code_cell("check(1, 1)", metadata=solution),
        new_code_cell("solution(MIXED)", metadata=solution),
        new_markdown_cell("More."),
        new_markdown_cell(PREDICTION),
        new_markdown_cell(QUIZ),
    ]
    assert key(new_notebook(cells=cells), page).split("\n\n") == [
        "# Title",
        "### Predict first: Is $a < b$?",
        "- **yes** ✓\n- *no*",
        "It *must*: 2.",
        "### Quiz: Which?",
        "- this: It is.\n- **that** ✓: It is `not`.",
        "### Exercise `one`",
        "How many?",
        "**Answer.** 11.5 mm (± 0.6). Any other is told: Draw it.",
        "**Solution.**",
        "One.",
        "```python\ncheck(1, 1)\n```",
        f"```python\n{getsource(MIXED.right)}```",
        "Known mistakes, by what the page says to them:",
        "\n".join(f"- {hint}" for hint in MIXED.mistakes),
        "It prints:",
        "<p>1 mm</p>\n",
    ]


# ---------------------------------------------------------------- the whole


def test_the_whole_kit_is_built_from_chapters_and_pages(kit):
    pages = {
        "key.md",
        "key.html",
        "plan.md",
        "plan.html",
        "throws.html",
        "class.html",
        "concepts.html",
        "katex.js",
        "katex.css",
        "book.js",
        "index.html",
        "equations.html",
        "projects.html",
        "report.ipynb",
        "assistants.html",
    }
    folders = {"students", "nbgrader", "slides", "demos", "arm-in-page", "figures"}
    names = {file.name for file in kit.iterdir()}
    predictions, questions = (
        (kit / f"{name}.gift").read_text(encoding="utf-8") for name in ("predictions", "questions")
    )
    assert "/predict/" in predictions
    assert "/predict/" not in questions
    assert names == pages | folders | {*EXPORTS}
    chapters = {path.name for path in CHAPTERS}
    assert {file.name for file in (kit / "nbgrader/source").glob("*/*.ipynb")} == chapters
    students = {file.name for file in (kit / "students").glob("*.ipynb")}
    assert students == chapters
    text = (kit / "key.md").read_text(encoding="utf-8")
    assert text.count("**Solution.**") == text.count("### Exercise")
    assert "<details>" not in text


def test_predictions_lead_to_demos_that_are_there(kit):
    text = (kit / "predictions.xml").read_text(encoding="utf-8")
    demos = re.findall(r"demos/figure-[\d-]+\.html", text)
    assert len(demos) > 50
    assert all((kit / demo).exists() for demo in demos)


def test_links_of_the_kits_pages_lead_to_files_that_are_there(kit):
    """Each page of words and each deck; the first page leads to all that are read."""
    pages = [*kit.glob("*.html"), *kit.glob("slides/*.html")]
    links = {
        page: re.findall(
            r'<a [^>]*href="(?!https?:|#|data:)([^"#]+)', page.read_text(encoding="utf-8")
        )
        for page in pages
    }
    dead = [link for page in pages for link in links[page] if not (page.parent / link).exists()]
    assert dead == []
    first = {"plan.html", "key.html", "projects.html", "assistants.html", "throws.html"}
    assert first | {"class.html", "equations.html"} <= {*links[kit / "index.html"]}
    decks = {f"slides/{deck.name}" for deck in kit.glob("slides/*.html")}
    folders = {"students/", "figures/index.html", "demos/index.html", "arm-in-page/example.html"}
    assert decks | folders <= {*links[kit / "index.html"]}
    assert "(below)" not in index()  # there is nothing below


def test_the_page_of_equations_has_each_number_once(kit):
    page = (kit / "equations.html").read_text(encoding="utf-8")
    assert re.findall(r"tag\{(\d+)\}", page) == [str(number) for number in range(1, 13)]


def test_every_exercise_that_is_checked_has_its_answer_in_the_key(kit, chapter):
    text = (kit / "key.md").read_text(encoding="utf-8")
    for label, source in checks(chapter).items():
        if source:
            [section] = re.findall(rf"^### Exercise `{label}`$(.*?)(?=^##|\Z)", text, re.M | re.S)
            graded = "grade(" in source
            sign = r"```python\ndef |Known mistakes" if graded else r"\*\*Answer\.\*\* [\w.-]+"
            assert re.search(sign, section), section


def test_a_students_links_lead_to_files_that_are_there(kit):
    folder = kit / "students"
    texts = [(file.name, file.read_text(encoding="utf-8")) for file in folder.glob("*.md")]
    for file in folder.glob("*.ipynb"):
        cells = nbformat.read(file, as_version=4).cells
        texts += [(file.name, cell.source) for cell in cells if cell.cell_type == "markdown"]
    links = [(name, match[2]) for name, text in texts for match in LINK.finditer(text)]
    assert len(links) > 100
    assert [link for link in links if not (folder / link[1]).exists()] == []


@pytest.mark.audit
def test_the_worked_report_runs_and_its_reason_holds():
    """The best gain falls with the delay, and later sight swings slower: the run says so."""
    notebook = nbformat.read(ROOT / "kit/report.ipynb", as_version=4)
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(ROOT)}}).execute()
    texts = [
        output.data.get("text/markdown", "")
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "data" in output
    ]
    assert any("That it falls is right." in text for text in texts)
    assert any("slower, as we said" in text for text in texts)
