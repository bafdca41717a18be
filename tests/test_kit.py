"""The teacher's kit: what students get, what the key says, what platforms import, and slides."""

import ast
import io
import re
from inspect import getsource
from xml.etree import ElementTree
from zipfile import ZipFile

import nbformat
import pytest
from bs4 import BeautifulSoup
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit.__main__ import CHAPTERS, ROOT, bank, build
from kit.gift import gift
from kit.key import key
from kit.qti import SPACE, package
from kit.question import VARIANTS
from kit.slides import cut, stacks
from kit.student import solves, student
from vmc_lib.show import predict, questions

BUILT = ROOT / "_build/html/book"


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
    assert not any(cell.get("outputs") for cell in notebook.cells)
    exercises = [c.metadata.exercise for c in notebook.cells if "**Exercise" in c.source]
    graded = [c.metadata.exercise for c in notebook.cells if "graded" in c.metadata.get("tags", [])]
    assert graded == exercises
    assert exercises


def test_other_cells_use_no_name_of_a_solution(chapter):
    bound, used = {True: set(), False: set()}, set()
    for cell in chapter.cells:
        solving = solves(cell)
        if cell.cell_type == "code":
            names = [n for n in ast.walk(ast.parse(cell.source)) if isinstance(n, ast.Name)]
            bound[solving] |= {n.id for n in names if isinstance(n.ctx, ast.Store)}
            used |= set() if solving else {n.id for n in names if isinstance(n.ctx, ast.Load)}
    assert not (bound[True] - bound[False]) & used


# ---------------------------------------------------------------- the key


def test_the_key_has_every_answer_and_why(outputs):
    page = outputs(questions)
    predict("Is $a < b$?", ["yes", "*no*"], "yes", "It *must*.")
    page.append(
        '<fieldset class="vmc-quiz"><legend>\n<p>Which?</p>\n</legend>\n'
        '<details class="vmc-wrong"><summary>this</summary>\n'
        "<p><strong>✗ No.</strong> It is.</p>\n</details>\n"
        '<details class="vmc-right"><summary>that</summary>\n'
        "<p><strong>✓ Right.</strong> It is <code>not</code>.</p>\n</details>\n</fieldset>"
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
        new_code_cell("predict(...)"),
        new_markdown_cell("**Quiz.** Which? …"),
    ]
    notebook = new_notebook(cells=cells)
    with pytest.raises(ValueError, match="make book first"):
        key(notebook, page[0])
    assert key(notebook, "<p>".join(page)).split("\n\n") == [
        "# Title",
        "### Predict first: Is $a < b$?",
        "- **yes** ✓\n- *no*",
        "It *must*.",
        "### Quiz: Which?",
        "- this: It is.\n- **that** ✓: It is `not`.",
        "### Exercise `one`",
        "How many?",
        "**Solution.**",
        "One.",
        "```python\ncheck(1, 1)\n```",
        f"```python\n{getsource(MIXED.right)}```\n",
    ]


# ---------------------------------------------------------------- what platforms import


@pytest.fixture(scope="module")
def variants():
    return bank()


TEXT = r"(?:[^~=#{}:\\]|\\[~=#{}:\\])+"
NUMBER = r"-?\d+(?:\.\d+)?"  # the grammar has no exponents
ITEM = re.compile(
    rf"::{TEXT}::\[plain\]{TEXT}\{{"
    rf"(?:#{NUMBER}:{NUMBER}|(?:\n[=~]{TEXT})+)(?:\n####{TEXT})?\n\}}"
)


def test_gift_follows_its_grammar(variants):
    items = []
    for block in gift(variants).split("\n\n"):
        if not re.fullmatch(r"\$CATEGORY: \$course\$/\w+/\w+", block):
            assert ITEM.fullmatch(block), block
            items.append(block)
    assert len(items) == VARIANTS * len(variants)
    for block in items:
        assert len(re.findall(r"(?<!\\)=", block)) == (0 if "{#" in block else 1)


def test_a_number_is_exported_to_a_fraction_of_its_tolerance(variants):
    for question in (question for several in variants.values() for question in several):
        if not question.choices:
            error = abs(float(question.decimal(question.answer)) - question.answer)
            assert error <= question.tolerance / 100


def test_qti_is_well_formed_and_each_item_accepts_its_answer(variants):
    zipped = ZipFile(io.BytesIO(package(variants)))
    assert package(variants) == package(bank())
    manifest = ElementTree.fromstring(zipped.read("imsmanifest.xml"))  # noqa: S314 (our own)
    files = [file.get("href") for file in manifest.findall(".//{*}file")]
    assert sorted(files) == sorted(f"{path.stem}.xml" for path in CHAPTERS)
    items = {}
    for path in files:
        tree = ElementTree.fromstring(zipped.read(path))  # noqa: S314
        assert tree.tag == f"{{{SPACE}}}questestinterop"
        items |= {item.get("title"): item for item in tree.findall(".//{*}item")}
    assert len(items) == VARIANTS * len(variants)
    for (chapter, name), several in variants.items():
        for k, question in enumerate(several, start=1):
            item = items[f"{chapter} {name} {k}"]
            right = item.find(".//{*}varequal").text
            if question.choices:
                labels = {x.get("ident"): x for x in item.findall(".//{*}response_label")}
                assert labels[right].find(".//{*}mattext").text == question.answer
            else:
                bounds = [float(item.find(f".//{{*}}{tag}").text) for tag in ("vargte", "varlte")]
                assert bounds[0] <= float(right) <= bounds[1]
                error = max(question.tolerance / 100, 1e-12)
                assert float(right) == pytest.approx(question.answer, abs=error)


# ---------------------------------------------------------------- the whole, and its slides


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    assert (BUILT / "teaching.html").exists(), "no built book in _build/html: run `make book` first"
    folder = tmp_path_factory.mktemp("kit") / "kit"
    build(folder, BUILT)
    return folder


def test_the_whole_kit_is_built_from_chapters_and_pages(kit):
    pages = {"key.md", "key.html", "katex.js", "katex.css", "book.js", "projects.md"}
    names = {file.name for file in kit.iterdir()}
    assert names == pages | {"students", "slides", "questions.gift", "questions-qti.zip"}
    students = {file.name for file in (kit / "students").glob("*.ipynb")}
    assert students == {path.name for path in CHAPTERS}
    text = (kit / "key.md").read_text(encoding="utf-8")
    assert text.count("**Solution.**") == text.count("### Exercise")
    assert "<details>" not in text


def test_a_section_becomes_slides_and_notes():
    page = """<section><h2>Why<a>#</a></h2><p>First.</p><p>Second.</p>
      <div class="math">x</div><div class="cell"><details>folded</details>
      <div class="cell_output"><div class="output"><div class="admonition"><fieldset>
      <details><summary>Asked</summary><p>Answer.</p></details></fieldset></div></div></div></div>
      <p>Third.</p><section><h3>Below</h3><p>Fourth.</p></section></section>"""
    first, question, below = cut(BeautifulSoup(page, "html.parser").section)
    assert [part.get_text() for part in first.body] == ["Why#", "First.", "x"]
    assert [part.get_text() for part in first.notes] == ["Second."]
    assert question.body[1]["class"] == ["admonition"]
    assert "".join(map(str, question.notes)) == "<p>Asked: Answer.</p><p>Third.</p>"
    assert [part.get_text() for part in below.body] == ["Below", "Fourth."]


def test_exercises_are_on_no_slide():
    exercise = """<div class="exercise">Do.</div><div class="cell">Yours.</div>
      <div class="solution">So.</div>"""
    page = f"""<section><h1>Arm</h1><p>Idea.</p>
      <section id="pull"><h2>Pull</h2><p>Why.</p>{exercise}<p>Then.</p></section>
      <section id="try-it"><h2>Try it</h2>{exercise}{exercise}</section>
      <section id="recap"><h2>Recap</h2></section></section>"""
    _title, [pull], _recap = stacks(BeautifulSoup(page, "html.parser").section)
    assert [part.get_text() for part in pull.body + pull.notes] == ["Pull", "Why.", "Then."]


def test_every_chapter_and_every_quiz_is_on_a_slide(kit):
    decks = sorted((kit / "slides").glob("session-*.html"))
    assert [deck.stem for deck in decks] == [f"session-{n}" for n in range(1, 7)]
    slides = "".join(deck.read_text(encoding="utf-8") for deck in decks)
    assert slides.count("<h1>") == len(CHAPTERS) + len(decks)
    text = (kit / "key.md").read_text(encoding="utf-8")
    assert slides.count('<fieldset class="vmc-quiz"') == text.count("### Quiz")
    predictions = slides.count('<fieldset class="vmc-predict"')  # but for those the page folds
    assert text.count("### Predict first") >= predictions > 5 * len(CHAPTERS)


@pytest.mark.browser
@pytest.mark.parametrize("number", range(1, 7))
def test_slides_open_offline_and_their_demos_move(kit, offline, number):
    page, failures = offline.new_page(), []
    for event in ("pageerror", "requestfailed"):
        page.on(event, lambda failure: failures.append(str(failure)))
    page.on("console", lambda m: m.type == "error" and failures.append(m.text))
    page.goto((kit / f"slides/session-{number}.html").as_uri())
    page.wait_for_function("() => window.Reveal?.isReady()")
    plain = ".vmc-demo:has(> .vmc-pictures):not(:has(.vmc-scene)):has(input[type=range])"
    demo = page.locator(plain).first
    demo.evaluate("""demo => {
      const { h, v } = Reveal.getIndices(demo.closest("section"));
      Reveal.slide(h, v);
    }""")
    page.wait_for_function("demo => 'ready' in demo.dataset", arg=demo.element_handle())
    slider, pictures = demo.locator("input[type=range]").first, demo.locator(".vmc-pictures")
    slider.press("Home")
    first = pictures.inner_html()
    slider.press("End")
    assert pictures.is_visible()
    assert pictures.inner_html() != first
    assert page.evaluate("() => Reveal.getCurrentSlide().querySelector('.vmc-demo') !== null")
    assert failures == []
    page.close()
