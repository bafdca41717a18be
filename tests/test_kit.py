"""The teacher's kit: what students get, what the key says, and a bank whose answers are right."""

import ast
import io
import re
from collections import Counter
from inspect import getsource
from math import atan, degrees, exp, isfinite, log, radians, sin, tan
from xml.etree import ElementTree
from zipfile import ZipFile

import nbformat
import numpy as np
import pytest
from bs4 import BeautifulSoup

from book.exercises.loop import MIXED
from kit.__main__ import CHAPTERS, ROOT, bank, build
from kit.gift import gift
from kit.key import key
from kit.marks import marks
from kit.qti import SPACE, package
from kit.question import VARIANTS, choice, number, variants
from kit.slides import cut, stacks
from kit.student import solves, student
from vmc_lib.show import predict, questions

BUILT = ROOT / "_build/html/book"


@pytest.fixture(scope="module")
def asked():
    return bank()


# ---------------------------------------------------------------- what students get


@pytest.fixture(params=CHAPTERS, ids=lambda path: path.stem)
def chapter(request):
    return nbformat.read(request.param, as_version=4)


def test_a_student_gets_every_exercise_and_no_solution(chapter):
    given = student(chapter)
    nbformat.validate(given)
    text = "\n".join(cell.source for cell in given.cells)
    assert not re.findall("Show the solution|[*]Solution[*]", text)
    assert "# The solution" not in text
    assert not any(cell.get("outputs") for cell in given.cells)
    asked = [cell.metadata.exercise for cell in given.cells if "**Exercise" in cell.source]
    graded = [cell.metadata.exercise for cell in given.cells if "graded" in _tags(cell)]
    assert graded == asked
    assert asked


def test_nothing_that_a_student_gets_needs_a_solution(chapter):
    """A name that a solution alone binds is used by nothing that stays."""
    bound, used = {True: set(), False: set()}, set()
    for cell in chapter.cells:
        solving = solves(cell)
        if cell.cell_type == "code":
            names = [n for n in ast.walk(ast.parse(cell.source)) if isinstance(n, ast.Name)]
            bound[solving] |= {n.id for n in names if isinstance(n.ctx, ast.Store)}
            used |= set() if solving else {n.id for n in names if isinstance(n.ctx, ast.Load)}
    assert not (bound[True] - bound[False]) & used


@pytest.mark.parametrize(
    ("line", "right"), [("a = 2", True), ("a = 3", False), ("a = None", False)]
)
def test_a_mark_says_what_is_right_by_our_own_check(tmp_path, monkeypatch, line, right):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    cells = [
        nbformat.v4.new_code_cell("from vmc_lib.show import check"),
        _asked("sum", "**Exercise**\n\nHow much is 1 + 1?"),
        nbformat.v4.new_code_cell("a = None"),
        nbformat.v4.new_code_cell("check(a, 2)"),
    ]
    chapter = nbformat.v4.new_notebook(cells=cells)
    handed_in = student(chapter)
    handed_in.cells[2].source = line
    handed_in.cells[3].source = "print('✓ Right.')"
    assert marks(chapter, handed_in, tmp_path) == {"sum": right}


SOLVED = {"tags": ["solution"]}


def _asked(label, text):
    return nbformat.v4.new_markdown_cell(text, metadata={"exercise": label})


def _tags(cell):
    return cell.metadata.get("tags", [])


# ---------------------------------------------------------------- the key


def test_the_key_tells_what_is_right_and_why(monkeypatch):
    page = []
    monkeypatch.setattr(questions, "display", lambda html: page.append(html.data))
    predict("Is $a < b$?", ["yes", "*no*"], "yes", "It *must*.")
    page.append(
        '<fieldset class="vmc-quiz"><legend>\n<p>Which?</p>\n</legend>\n'
        '<details class="vmc-wrong"><summary>this</summary>\n'
        "<p><strong>✗ No.</strong> It is.</p>\n</details>\n"
        '<details class="vmc-right"><summary>that</summary>\n'
        "<p><strong>✓ Right.</strong> It is <code>not</code>.</p>\n</details>\n</fieldset>"
    )
    cells = [
        nbformat.v4.new_markdown_cell("# Title"),
        nbformat.v4.new_code_cell("from book.exercises.loop import MIXED\n\ngrade(mixed, MIXED)"),
        _asked("one", "**Exercise: One**\n\nHow many?"),
        nbformat.v4.new_markdown_cell(
            "<details><summary>Show the solution</summary>\n\nOne.\n\n</details>", metadata=SOLVED
        ),
        nbformat.v4.new_code_cell("check(1, 1)", metadata=SOLVED),
        nbformat.v4.new_code_cell("solution(MIXED)", metadata=SOLVED),
        nbformat.v4.new_markdown_cell("More."),
        nbformat.v4.new_code_cell("predict(...)"),
        nbformat.v4.new_markdown_cell("**Quiz.** Which? …"),
    ]
    notebook = nbformat.v4.new_notebook(cells=cells)
    with pytest.raises(ValueError, match="make book first"):
        key(notebook, page[0])
    told = key(notebook, "<p>".join(page))
    assert told.split("\n\n") == [
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


# ---------------------------------------------------------------- the bank


def test_the_bank_asks_of_every_chapter(asked):
    assert len(asked) >= 100
    chapters = Counter(chapter for chapter, _ in asked)
    assert chapters.keys() == {path.stem for path in CHAPTERS}
    assert min(chapters.values()) >= 5
    assert len({name for _, name in asked}) == len(asked)


def test_every_variant_is_another_question_with_an_answer(asked):
    assert {len(variants) for variants in asked.values()} == {VARIANTS}
    every = [question for found in asked.values() for question in found]
    assert len({question.text for question in every}) == len(every)
    for question in every:
        assert re.search(r"\d", question.text)
        assert not re.search(r"nan|np\.|array\(", question.text)
        if question.choices:
            assert question.choices.count(question.answer) == 1
        else:
            assert isfinite(question.answer)
            assert 0 <= question.tolerance < max(1.01, abs(question.answer) / 5)


def test_the_same_kit_every_time(asked):
    assert bank() == asked
    assert package(asked) == package(bank())


def test_what_cannot_be_asked_is_refused():
    with pytest.raises(ValueError, match="draw other numbers"):
        number("How many?", float("nan"))
    with pytest.raises(ValueError, match="must be one of the choices"):
        choice("Which?", ("a", "b"), "c")
    with pytest.raises(ValueError, match="let more of it be drawn"):
        variants(lambda rng: number("How many?", 1))


def _softmax(drives):
    return np.exp(drives) / (1 + np.exp(drives).sum())


def _wilson(right, n, sign, z=1.959964):
    p = right / n
    half = z * (p * (1 - p) / n + z * z / (4 * n * n)) ** 0.5
    return (p + z * z / (2 * n) + sign * half) / (1 + z * z / n)


AGAIN = {  # the answer from the numbers in the text, by a formula that is not the library's
    "pixel_column": lambda f, _, z, x: 300 + f * x / z,
    "apparent_width": lambda w, z, f: f * w / 100 / z,
    "where_the_ray_lands": lambda h, angle: h / tan(radians(angle)),
    "wrong_height": lambda angle, mm: mm / tan(radians(angle)),
    "field_of_view": lambda w, f: 2 * degrees(atan(w / 2 / f)),
    "turn_of_the_trunk": lambda r, angle: r * sin(radians(angle)),
    "boxes_in_a_picture": lambda w, h: w * (w + 1) * h * (h + 1) / 4,
    "shifted_box": lambda percent: (100 - percent) / (100 + percent),
    "hidden_width": lambda n, _, width, __: width - n + 1,
    "energy_of_a_pair": lambda v, h, w, b, *_: -h * (w * v + b) + v * v / 2,
    "pooled_unit": lambda *drives: _softmax(drives).sum(),
    "unit_in_a_block": lambda *drives: exp(drives[-1]) / (1 + np.exp(drives[:-1]).sum()),
    "score_of_a_chance": lambda p: log(p / (1 - p)),
    "table_without_errors": lambda n, *_: n / (n + 1.959964**2),
    "rate_of_rising": lambda a, u, *_: (u - a) * (u / 0.01 + (1 - u) / 0.04),
    "rate_of_falling": lambda a, u, *_: (u - a) / 0.04,
    "force_of_length": lambda x, *_: exp(-40 * (x - 0.95) ** 4 + (x - 0.95) ** 2),
    "shortening_of_a_muscle": lambda r, angle: r * radians(angle),
    "speed_of_the_hand": lambda r, v, reach: v * reach / r,
    "two_templates": lambda percent, *_: 1 - percent / 100,
    "least_change_of_four": lambda side, mm: mm / 10 / side / 2,
    "share_of_the_way": lambda p: 10 * (p / 100) ** 3 - 15 * (p / 100) ** 4 + 6 * (p / 100) ** 5,
    "vote_of_neurons": lambda n, *_: n / 2,
    "granule_cell": lambda width, d, *_: exp(-((d / width) ** 2) / 2),
    "behind_a_prism": lambda angle, d: 2 * d * sin(radians(abs(angle)) / 2),
    "lesson_with_caution": lambda miss, caution: miss * caution / (1 + caution),
    "numbers_that_g_learns": lambda n, *_: n * (3 * n + 3),
    "chain_of_links": lambda n, p: p**n,
    "shared_torque": lambda one, other, torque: torque * one / (one**2 + other**2),
    "weight_by_equation_4": lambda side, x, *_: x / side,
    "interval_of_arrivals": lambda k, n, *_: _wilson(k, n, 1) - _wilson(k, n, -1),
}


@pytest.mark.parametrize("name", AGAIN)
def test_an_answer_follows_from_the_numbers_in_its_text(asked, name):
    [found] = [variants for (_, one), variants in asked.items() if one == name]
    for question in found:
        numbers = [float(x) for x in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?", question.text)]
        again = AGAIN[name](*numbers)
        assert again == pytest.approx(question.answer, rel=2e-3, abs=question.tolerance / 5)


# ---------------------------------------------------------------- what platforms import

TEXT = r"(?:[^~=#{}:\\]|\\[~=#{}:\\])+"
ITEM = re.compile(
    rf"::{TEXT}::\[plain\]{TEXT}\{{"
    rf"(?:#-?[\d.e+-]+:[\d.e+-]+|(?:\n[=~]{TEXT})+)(?:\n####{TEXT})?\n\}}"
)


def test_gift_follows_its_grammar(asked):
    items = []
    for block in gift(asked).split("\n\n"):
        if not re.fullmatch(r"\$CATEGORY: \$course\$/\w+/\w+", block):
            assert ITEM.fullmatch(block), block
            items.append(block)
    assert len(items) == VARIANTS * len(asked)
    for block in items:
        assert len(re.findall(r"(?<!\\)=", block)) == (0 if "{#" in block else 1)


def test_qti_is_well_formed_and_each_item_accepts_its_answer(asked):
    zipped = ZipFile(io.BytesIO(package(asked)))
    manifest = ElementTree.fromstring(zipped.read("imsmanifest.xml"))  # noqa: S314 (our own)
    listed = [file.get("href") for file in manifest.findall(".//{*}file")]
    assert sorted(listed) == sorted(f"{path.stem}.xml" for path in CHAPTERS)
    items = {}
    for path in listed:
        quiz = ElementTree.fromstring(zipped.read(path))  # noqa: S314
        assert quiz.tag == f"{{{SPACE}}}questestinterop"
        items |= {item.get("title"): item for item in quiz.findall(".//{*}item")}
    assert len(items) == VARIANTS * len(asked)
    for (chapter, name), found in asked.items():
        for k, question in enumerate(found, start=1):
            item = items[f"{chapter} {name} {k}"]
            right = item.find(".//{*}varequal").text
            if question.choices:
                labels = {x.get("ident"): x for x in item.findall(".//{*}response_label")}
                assert labels[right].find(".//{*}mattext").text == question.answer
            else:
                bounds = [float(item.find(f".//{{*}}{tag}").text) for tag in ("vargte", "varlte")]
                assert bounds[0] <= float(right) <= bounds[1]
                assert float(right) == pytest.approx(question.answer)


# ---------------------------------------------------------------- the whole, and its slides


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    assert (BUILT / "teaching.html").exists(), "no built book in _build/html: run `make book` first"
    folder = tmp_path_factory.mktemp("made") / "kit"
    build(folder, BUILT)
    return folder


def test_the_whole_kit_is_built_from_chapters_and_pages(kit):
    made = {file.name for file in kit.iterdir()}
    pages = {"key.md", "key.html", "mathjax.js", "projects.md"}
    assert made == pages | {"students", "slides", "questions.gift", "questions-qti.zip"}
    students = {file.name for file in (kit / "students").glob("*.ipynb")}
    assert students == {path.name for path in CHAPTERS}
    told = (kit / "key.md").read_text(encoding="utf-8")
    assert told.count("**Solution.**") == told.count("### Exercise")
    assert "<details>" not in told


def test_slides_show_every_section_and_tell_the_speaker_the_rest():
    page = """<section><h2>Why<a>#</a></h2><p>First.</p><p>Second.</p>
      <div class="math">x</div><div class="cell"><details>folded</details>
      <div class="cell_output"><div class="output"><div class="admonition"><fieldset>
      <details><summary>Asked</summary><p>Answer.</p></details></fieldset></div></div></div></div>
      <p>Third.</p><section><h3>Below</h3><p>Fourth.</p></section></section>"""
    first, question, below = cut(BeautifulSoup(page, "html.parser").section)
    assert [part.get_text() for part in first.shown] == ["Why#", "First.", "x"]
    assert [part.get_text() for part in first.told] == ["Second."]
    assert question.shown[1]["class"] == ["admonition"]
    assert "".join(map(str, question.told)) == "<p>Asked: Answer.</p><p>Third.</p>"
    assert [part.get_text() for part in below.shown] == ["Below", "Fourth."]


def test_an_exercise_leaves_its_section_to_the_slides():
    exercise = """<div class="exercise">Do.</div><div class="cell">Yours.</div>
      <div class="solution">So.</div>"""
    page = f"""<section><h1>Arm</h1><p>Idea.</p>
      <section id="pull"><h2>Pull</h2><p>Why.</p>{exercise}<p>Then.</p></section>
      <section id="try-it"><h2>Try it</h2>{exercise}{exercise}</section>
      <section id="recap"><h2>Recap</h2></section></section>"""
    _title, [pull], _recap = stacks(BeautifulSoup(page, "html.parser").section)
    assert [part.get_text() for part in pull.shown + pull.told] == ["Pull", "Why.", "Then."]


def test_every_chapter_and_every_quiz_is_on_a_slide(kit):
    decks = sorted((kit / "slides").glob("session-*.html"))
    assert [deck.stem for deck in decks] == [f"session-{n}" for n in range(1, 7)]
    text = "".join(deck.read_text(encoding="utf-8") for deck in decks)
    assert text.count("<h1>") == len(CHAPTERS) + len(decks)
    told = (kit / "key.md").read_text(encoding="utf-8")
    assert text.count('<fieldset class="vmc-quiz"') == told.count("### Quiz")
    asked = text.count('<fieldset class="vmc-predict"')  # but for those that the page folds
    assert told.count("### Predict first") >= asked > 5 * len(CHAPTERS)


@pytest.mark.browser
@pytest.mark.parametrize("number", range(1, 7))
def test_slides_are_shown_offline_and_their_demos_move(kit, offline, number):
    page, failed = offline.new_page(), []
    for event in ("pageerror", "requestfailed"):
        page.on(event, lambda told: failed.append(str(told)))
    page.on("console", lambda told: told.type == "error" and failed.append(told.text))
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
    seen = pictures.inner_html()
    slider.press("End")
    assert pictures.is_visible()
    assert pictures.inner_html() != seen
    assert page.evaluate("() => Reveal.getCurrentSlide().querySelector('.vmc-demo') !== null")
    assert failed == []
    page.close()
