"""The teacher's kit: what students get, what the key says, what platforms import, and slides."""

import ast
import io
import re
from collections import Counter
from inspect import getsource
from xml.etree import ElementTree
from zipfile import ZipFile

import nbformat
import pytest
from bs4 import BeautifulSoup
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.exercises.loop import MIXED
from kit.__main__ import CHAPTERS, ROOT, bank, build
from kit.asked import asked
from kit.chapter_slides import chapter_slides
from kit.gift import gift
from kit.key import key
from kit.qti import SPACE, package
from kit.slides import MOST
from kit.student import LINK, checks, student
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
    assert not re.search(r"\b(check|grade)\(|book[.]exercises", text)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    exercises = [c.metadata.exercise for c in notebook.cells if "**Exercise" in c.source]
    graded = [c.metadata.exercise for c in notebook.cells if "graded" in c.metadata.get("tags", [])]
    assert graded == exercises
    assert exercises


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


def test_the_key_has_every_answer_and_why(outputs, monkeypatch):
    page = outputs(questions)
    predict("Is $a < b$?", ["yes", "*no*"], "yes", "It *must*.")
    page.append(
        '<fieldset class="vmc-quiz"><legend>\n<p>Which?</p>\n</legend>\n'
        '<details class="vmc-wrong"><summary>this</summary>\n'
        "<p><strong>✗ No.</strong> It is.</p>\n</details>\n"
        '<details class="vmc-right"><summary>that</summary>\n'
        "<p><strong>✓ Right.</strong> It is <code>not</code>.</p>\n</details>\n</fieldset>"
    )
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    questions.check(None, 11.5, 0.6, "Draw it.", "mm")
    page[2] = (
        f'<div class="exercise" id="one"></div><div>{page[2]}</div><div class="solution">'
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


# ---------------------------------------------------------------- what platforms import


@pytest.fixture(scope="module")
def variants():
    """The bank, and what the chapters ask."""
    pages = {
        path.stem: (BUILT / f"{path.stem}.html").read_text(encoding="utf-8") for path in CHAPTERS
    }
    return bank() | {
        (chapter, name): several
        for chapter, page in pages.items()
        for name, several in asked(page).items()
    }


def test_the_chapters_own_questions_are_most_of_the_bank_and_say_why(variants):
    levels = Counter(several[0].level for several in variants.values())
    assert levels["apply"] <= levels["predict"] + levels["understand"]
    for (chapter, name), [question, *_] in variants.items():
        if re.match("prediction|quiz", name):
            assert question.answer in question.choices
            assert question.hint or all(question.told), (chapter, name)
            assert not re.search(r"<(?!/?(em|strong|code)>)\w", question.text)


TEXT = r"(?:[^~=#{}:\\]|\\[~=#{}:\\])+"
NUMBER = r"-?\d+(?:\.\d+)?"  # the grammar has no exponents
ITEM = re.compile(
    rf"::{TEXT}::\[(?:plain|html)\]{TEXT}\{{"
    rf"(?:#{NUMBER}:{NUMBER}|(?:\n[=~]{TEXT}(?:#{TEXT})?)+)(?:\n####{TEXT})?\n\}}"
)


def test_gift_follows_its_grammar(variants):
    items = []
    for block in gift(variants).split("\n\n"):
        if not re.fullmatch(r"\$CATEGORY: \$course\$/\w+/\w+/\w+", block):
            assert ITEM.fullmatch(block), block
            items.append(block)
    assert len(items) == sum(map(len, variants.values()))
    for block in items:
        assert len(re.findall(r"(?<!\\)=", block)) == (0 if "{#" in block else 1)


def test_a_number_is_exported_to_a_fraction_of_its_tolerance(variants):
    for question in (question for several in variants.values() for question in several):
        if not question.choices:
            error = abs(float(question.decimal(question.answer)) - question.answer)
            assert error <= question.tolerance / 100


# Of QTI 1.2: what an element may hold, in this order (the parts that the bank uses)
MODEL = {
    "questestinterop": "assessment",
    "assessment": "section+",
    "section": "selection_ordering?(section|item)+",
    "selection_ordering": "selection",
    "selection": "selection_number selection_extension",
    "item": "itemmetadata presentation resprocessing itemfeedback*",
    "itemmetadata": "qtimetadata",
    "qtimetadata": "qtimetadatafield+",
    "qtimetadatafield": "fieldlabel fieldentry",
    "presentation": "material(response_lid|response_str)",
    "response_lid": "render_choice",
    "response_str": "render_fib",
    "render_choice": "response_label+",
    "render_fib": "response_label",
    "response_label": "material?",
    "resprocessing": "outcomes respcondition+",
    "outcomes": "decvar",
    "respcondition": "conditionvar setvar?displayfeedback?",
    "conditionvar": "(varequal|or|other)",
    "or": "varequal and",
    "and": "vargte varlte",
    "itemfeedback": "flow_mat",
    "flow_mat": "material",
    "material": "mattext",
    "selection_extension": "points_per_item",
}


def assert_model(element):
    """Each element holds what QTI allows it, and no two items have one ident."""
    name = element.tag.removeprefix(f"{{{SPACE}}}")
    held = "".join(f"<{child.tag.removeprefix(f'{{{SPACE}}}')}>" for child in element)
    assert re.fullmatch(re.sub(r"(\w+) ?", r"(?:<\1>)", MODEL.get(name, "")), held), (name, held)
    idents = [child.get("ident") for child in element if child.get("ident")]
    assert len({*idents}) == len(idents)
    for child in element:
        assert_model(child)


def test_qti_is_well_formed_and_each_item_accepts_its_answer(variants):
    zipped = ZipFile(io.BytesIO(package(variants)))
    assert package(variants) == package(variants)
    manifest = ElementTree.fromstring(zipped.read("imsmanifest.xml"))  # noqa: S314 (our own)
    files = [file.get("href") for file in manifest.findall(".//{*}file")]
    assert sorted(files) == sorted(f"{path.stem}.xml" for path in CHAPTERS)
    items = {}
    for path in files:
        tree = ElementTree.fromstring(zipped.read(path))  # noqa: S314
        assert tree.tag == f"{{{SPACE}}}questestinterop"
        assert_model(tree)
        items |= {item.get("title"): item for item in tree.findall(".//{*}item")}
    assert len(items) == sum(map(len, variants.values()))
    for (chapter, name), several in variants.items():
        for k, question in enumerate(several, start=1):
            item = items[f"{chapter} {name} {k}"]
            scored = item.find(".//{*}setvar/..")
            right = scored.find(".//{*}varequal").text
            shown = {told.get("linkrefid") for told in item.findall(".//{*}displayfeedback")}
            kept = {told.get("ident") for told in item.findall("{*}itemfeedback")}
            assert shown == kept
            assert shown
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
    pages = {
        "key.md",
        "key.html",
        "plan.md",
        "plan.html",
        "throws.html",
        "class.html",
        "katex.js",
        "katex.css",
        "book.js",
        "projects.md",
    }
    names = {file.name for file in kit.iterdir()}
    assert names == pages | {"students", "slides", "questions.gift", "questions-qti.zip"}
    students = {file.name for file in (kit / "students").glob("*.ipynb")}
    assert students == {path.name for path in CHAPTERS}
    text = (kit / "key.md").read_text(encoding="utf-8")
    assert text.count("**Solution.**") == text.count("### Exercise")
    assert "<details>" not in text


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


PAGE = """<section><h1>Arm</h1><p>Idea.</p><p>Aims.</p>
  <section id="pull"><h2>Pull</h2><p>See Eq. 1 first. Then more.</p><div class="math">x</div>
    <div class="exercise">Do.</div><div class="cell">Yours.</div><div class="solution">So.</div>
    <div class="cell"><details>folded</details><div class="cell_output"><div class="output">
      <div class="admonition"><fieldset class="vmc-predict"><legend>How far?</legend>
      <details class="vmc-right"><summary>What came out</summary><p>Far.</p></details></fieldset>
      </div></div></div></div>
    <figure class="vmc-demo"><form class="vmc-controls"><label>speed</label></form>
      <figcaption>Blue: a path.</figcaption></figure><p>Third.</p></section>
  <section class="vmc-optional" id="more"><h2>More</h2><figure class="vmc-demo"></figure></section>
  <section id="recap"><h2>Recap</h2><p>It was far. And more.</p></section></section>"""


def test_a_chapter_becomes_slides_and_notes():
    """A sentence on a slide, the rest in the notes; nothing of exercises, nothing optional."""
    article = BeautifulSoup(PAGE, "html.parser").section
    slides = [BeautifulSoup(str(s), "html.parser") for s in chapter_slides(article, 8)]
    bodies = [slide.select_one(".fit").get_text(" ", strip=True) for slide in slides]
    assert bodies == [
        "Arm Idea.",
        "Pull See Eq. 1 first. x",
        "Pull How far? What came out Far.",
        "Pull speed Blue: a path.",
        "Recap It was far.",
    ]
    notes = slides[3].select_one(".notes").get_text(" ", strip=True)
    guide = "Ask. How far? Look for. Blue: a path. Stop at. Far."
    assert notes == f"{guide} See Eq. 1 first. Then more. Third."


def test_a_session_has_few_slides_and_each_demo_its_notes(kit):
    decks = sorted((kit / "slides").glob("*.html"))
    assert [deck.stem for deck in decks] == ["more", *(f"session-{n}" for n in range(1, 7))]
    titles = 0
    for deck in decks:
        page = BeautifulSoup(deck.read_text(encoding="utf-8"), "html.parser")
        slides = page.select(".slides > section")
        titles += len(page.select(".fit > h1")) - 1
        assert 10 <= len(slides) <= MOST
        for slide in slides:
            words = [p.get_text() for p in slide.select(".fit > p")]
            assert sum(len(text.split()) for text in words) <= 60, words
            if slide.select(".fit .vmc-demo"):
                text = slide.select_one(".notes").get_text()
                assert all(word in text for word in ("Ask.", "Look for.", "Stop at."))
        assert any(slide.select(".notes cite") for slide in slides)
    assert titles == len(CHAPTERS)


FIT = """() => {
  const slide = Reveal.getCurrentSlide(), { style } = slide.querySelector(":scope > .fit");
  return slide.scrollHeight <= slide.clientHeight + 1 &&
    slide.scrollWidth <= slide.clientWidth + 1 && style.zoom >= 0.6;
}"""


@pytest.mark.browser
@pytest.mark.parametrize("name", ["more", *(f"session-{n}" for n in range(1, 7))])
def test_every_slide_fits_a_small_projector(kit, chromium, name):
    page = chromium.new_context(offline=True, viewport={"width": 1280, "height": 720}).new_page()
    page.goto((kit / f"slides/{name}.html").as_uri())
    page.wait_for_function("() => window.Reveal?.isReady()")
    for number in range(page.evaluate("Reveal.getTotalSlides()")):
        page.evaluate(f"Reveal.slide({number})")
        page.wait_for_timeout(200)  # its demo is drawn
        page.wait_for_function(FIT, timeout=10_000)
    page.context.close()


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
