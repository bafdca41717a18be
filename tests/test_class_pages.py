"""Pages for a class without a server: throws with a turned pointer, and what all have answered."""

import csv
import io
import json
import re

import numpy as np
import pytest
from playwright.sync_api import expect

from kit import class_pages
from kit.class_pages import class_page, throws, throws_page
from tests.formulas import FORMULAS, computes
from tests.pages import FILL, book_html, boxes, observe
from vmc_lib.show import check, questions

pytestmark = pytest.mark.browser


@pytest.fixture
def page(tmp_path, window):
    """A function: one of the kit's pages, open; it may not complain."""
    opened = []

    def page(html):
        (tmp_path / "page.html").write_text(html, encoding="utf-8")
        opened.append(observe(window(viewport={"width": 1000, "height": 900}).new_page()))
        opened[-1].goto((tmp_path / "page.html").as_uri())
        return opened[-1]

    yield page
    assert [error for one in opened for error in one.errors] == []


def saved(page, button):
    """The file that a button saves, as text."""
    with page.expect_download() as download:
        page.click(button)
    return download.value.path().read_text(encoding="utf-8")


def throw(page, degrees, steps=6):
    """Throw with the mouse, so many degrees to the right."""
    page.evaluate("scrollTo(0, 0)")
    [[left, top, width, height]] = boxes(page.locator("#field"))
    scale = min(width / 600, height / 400)
    x, y = left + width / 2, top + height / 2 + 140 * scale
    page.mouse.move(x, y)
    page.mouse.down()
    way = 260 * scale * np.array([np.sin(np.radians(degrees)), -np.cos(np.radians(degrees))])
    page.mouse.move(x + way[0], y + way[1], steps=steps)
    page.mouse.up()


def test_throws_are_turned_saved_and_drawn_beside_the_model(page, tmp_path):
    """One who always throws straight misses by 30 degrees while turned; all are drawn.

    The page gives nothing away: neither when the turn comes nor the model's curve.
    """
    room = page(throws_page())
    assert room.input_value("#who")
    throw(room, 10)
    assert room.locator("#plot rect, #plot polyline[stroke-dasharray]").count() == 0
    room.fill("#who", "ann")
    for _ in range(60):  # the page takes no more than 55
        room.click("#throw")
    text = saved(room, "#save")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["who"] for row in rows] == ["ann"] * 55
    misses = np.array([float(row["miss"]) for row in rows])
    np.testing.assert_allclose(misses[0], 10, atol=1)
    np.testing.assert_array_equal(misses[1:], np.repeat([0, 30, 0], [9, 30, 15]))
    assert room.locator("#plot circle").count() == 55
    by_hand = re.sub(r",0$", ",300", text, flags=re.M)  # as if thrown, not with the slider
    (tmp_path / "ann.csv").write_text(by_hand, encoding="utf-8")
    slider = "\n".join([text.splitlines()[0], *text.splitlines()[2:]])
    (tmp_path / "slider.csv").write_text(slider, encoding="utf-8")
    shifted = [[k, 20 * (k in range(11, 41)), 10 * (k in range(11, 41))] for k in range(1, 56)]
    goggles = "".join(f"bob;{k};{turned},0;{miss},0;\n" for k, turned, miss in shifted)  # in cm
    (tmp_path / "bob.csv").write_text(f"who;throw;turned;miss;ms\n{goggles}", encoding="utf-8")
    (tmp_path / "bad.csv").write_text("1,2", encoding="utf-8")
    room.set_input_files(
        "#files", [tmp_path / f"{name}.csv" for name in ("ann", "bob", "slider", "bad")]
    )
    room.wait_for_selector("#status:has-text('bad.csv: its first line is not')")
    assert "slider.csv: all in it was thrown with the slider" in room.inner_text("#status")
    assert "the mean of 2 of the class" in room.inner_text("#legend")
    assert "last five turned: 0.75 ± 3.18" in room.inner_text("#sums")  # Student's, of two
    room.check("#model")
    points = room.locator("#plot polyline").evaluate_all(
        "all => all.map((p) => p.getAttribute('points'))"
    )
    model, mean = (
        [(150 - float(point.split(",")[1])) / 90 for point in line.split()] for line in points
    )
    np.testing.assert_allclose(model, throws(), atol=1e-3)
    np.testing.assert_allclose(mean[10:40], 0.75)
    room.evaluate(CHOSEN_TWICE, text)
    assert room.inner_text("#status").startswith("1 of the class")


# Chooses one file while three others are still being read; goes on when all have been.
CHOSEN_TWICE = """async (text) => {
  const file = (who) => new File([text.replaceAll(",0\\n", ",300\\n")], who);
  for (const names of [["ann", "bob", "cy"], ["di"]]) {
    const chosen = new DataTransfer(), files = document.querySelector("#files");
    for (const name of names) chosen.items.add(file(name));
    files.files = chosen.files;
    files.dispatchEvent(new Event("change"));
  }
  for (let k = 0; k < 9; k++) await file("x").text(); }"""


def test_throws_travel_as_a_line_and_a_class_pastes_all_at_once(page):
    """Who copied twice counts once; a cut line is named; the slider's throws give no line.

    A name may hold what parts a line.
    """
    room = page(throws_page())
    room.fill("#who", "ann")
    throw(room, 10)
    assert room.is_disabled("#copy")
    for _ in range(54):
        room.click("#throw")
    line = room.evaluate("() => ownLine()")
    assert line.startswith("throws 1: ann; ")
    assert room.is_enabled("#copy")
    misses = line.split("; ")[1]
    lines = f"[9:02] Bo: throws 1: bo; 5 {misses}\n{line}\n{line} thanks\nthrows 1: cy; 1 2 end"
    room.fill("#lines", f"{lines}\nthrows 1: di; {misses}")
    assert "2 of the class" in room.inner_text("#status")
    assert "bo: 56 throws. cy: 2 throws." in room.inner_text("#status")
    assert "the mean of 2 of the class" in room.inner_text("#legend")
    room.fill("#who", 'Anna; "B"')
    room.fill("#lines", room.evaluate("() => ownLine()"))
    assert room.inner_text("#status") == "1 of the class."
    another = line.replace("ann; ", "ann; 7")
    room.fill("#lines", f"{line}\n{another}")
    assert room.inner_text("#status") == (
        "1 of the class. Other throws with the same name, the last read: ann."
    )
    other = page(throws_page())
    for _ in range(55):
        other.click("#throw")
    assert other.is_disabled("#copy")


def test_a_cell_that_is_no_number_is_named_by_its_line(page, tmp_path):
    rows = [f"a,{k},{'12 cm' if k == 20 else 30 * (k > 10)},3,200" for k in range(1, 56)]
    (tmp_path / "a.csv").write_text(
        "\n".join(["who,throw,turned,miss,ms", *rows]), encoding="utf-8"
    )
    room = page(throws_page())
    room.set_input_files("#files", tmp_path / "a.csv")
    room.wait_for_selector("#status:has-text('a.csv: line 21, turned: \"12 cm\" is no number')")
    assert "0 of the class" in room.inner_text("#status")


def test_model_of_the_throws_adapts_and_has_an_after_effect():
    left = throws()
    assert left[:10].tolist() == [0] * 10
    assert left[10] == 1
    assert 0 < left[39] < 0.5
    assert -1 < left[40] < -0.5
    assert abs(left[54]) < abs(left[40]) / 2


def test_throws_are_as_many_and_as_turned_as_the_blocks_say(page, monkeypatch):
    monkeypatch.setattr(class_pages, "BLOCKS", ((2, 0), (6, 20), (4, 0)))
    room = page(throws_page())
    assert room.inner_text("#status") == "Throw 1 of 12."
    for _ in range(12):
        room.click("#throw")
    heights = room.locator("#plot circle").evaluate_all("all => all.map((c) => c.cy.baseVal.value)")
    np.testing.assert_allclose(heights, np.repeat([150, 60, 150], [2, 6, 4]))
    room.fill("#lines", "\n".join(f"throws 1: {who}; {SHORT} end" for who in ("ann", "bob")))
    assert room.inner_text("#sums") == (
        "first turned: 1.00 ± 0.00; last five turned: 0.50 ± 0.00; first after: -0.50 ± 0.00"
    )


SHORT = "0 0 20 10 10 10 10 10 -10 0 0 0"


def test_the_table_of_throws_has_a_name_that_is_read_aloud(page):
    assert page(throws_page()).get_by_role("region", name="the throws").count() == 1


def test_sheet_for_goggles_has_a_line_for_each_throw(page):
    rows = list(csv.DictReader(io.StringIO(saved(page(throws_page()), "#sheet"))))
    assert [row["throw"] for row in rows] == [str(k) for k in range(1, 56)]
    assert [row["turned"] for row in rows] == ["0"] * 10 + [""] * 30 + ["0"] * 15


# ---------------------------------------------------------------- what a class answered


QUIZ = """<fieldset class="vmc-quiz" name="quiz-which"><legend>Which?</legend>
<details class="vmc-wrong"><summary>This</summary><p>✗ No.</p></details>
<details class="vmc-right"><summary>That</summary><p>✓ Right.</p></details></fieldset>"""
GRADED = """<form class="vmc-check"></form>"""


@pytest.fixture
def chapter(open_page):
    """A chapter's page that asks: a prediction, a number, a quiz, a function."""

    prediction = questions.prediction("How far?", ["one", "two"], "two", "It is.")
    number = book_html(questions, lambda: check(None, 3, hint="Think."))
    exercise = '<div class="exercise" id="ex-one"><p class="admonition-title">Exercise 1</p></div>'
    cell = '<div class="cell">{}</div>'.format
    below = cell(number) + cell(GRADED)
    return open_page(f"<article><h1>A</h1>{prediction}{exercise}{below}{QUIZ}</article>")


def grade(chapter, **detail):
    """Tell the page what was `said` of a function's `lines`, as its grader does."""
    chapter.locator("form:not([data-check])").evaluate(
        "(form, detail) => form.dispatchEvent("
        "new CustomEvent('vmc-graded', { bubbles: true, detail }))",
        detail,
    )


def test_a_page_keeps_what_was_answered_shows_it_and_saves_it(chapter):
    record = chapter.locator(".vmc-record")
    assert not record.is_visible()
    for choice in ("one", "two"):
        chapter.check(f"input[value={choice}]")
    for typed in ("4", "?", "3"):
        chapter.fill("form[data-check] input", typed)
        chapter.keyboard.press("Enter")
    chapter.locator(".vmc-quiz .vmc-right").evaluate("(one) => { one.open = true }")  # a search may
    chapter.click("summary:text('This')")
    chapter.wait_for_function("() => localStorage.vmcRecord.includes('quiz')")
    grade(chapter, said="✗ Not yet. The sign is wrong.", lines="def f():\n    return -1")
    chapter.reload()
    assert "7" not in record.locator("summary").inner_text()
    assert "6" in record.locator("summary").inner_text()
    assert record.locator("li").count() == 0  # many would take long: they wait until it is open
    record.locator("summary").click()
    expect(record.locator("li")).to_have_count(6)
    record.get_by_label("Name or number").fill("ann 1")
    kept = json.loads(saved(chapter, ".vmc-record button"))
    assert (kept["format"], kept["who"]) == ("answers 1", "ann 1")
    entries = [(a["kind"], a["answer"], a["right"], a["feedback"]) for a in kept["answers"]]
    assert entries == [
        ("prediction", "one", False, ""),
        ("prediction", "two", True, ""),
        ("exercise", "4", False, "Think."),
        ("exercise", "3", True, ""),
        ("quiz", "This", False, ""),
        ("exercise", "def f():\n    return -1", False, "The sign is wrong."),
    ]
    assert {a["id"] for a in kept["answers"] if a["kind"] == "exercise"} == {"ex-one"}
    assert [a["id"] for a in kept["answers"] if a["kind"] == "quiz"] == ["quiz-which"]
    record.get_by_role("button", name="Forget").click()
    with chapter.expect_navigation():
        record.get_by_role("button", name="Forget every answer and line").click()
    assert not record.is_visible()
    assert chapter.locator("input:checked").count() == 0  # nor is anything left in a field
    assert chapter.locator("form[data-check] input").input_value() == ""
    assert chapter.evaluate("() => Object.keys(localStorage)") == []


def test_what_another_tab_keeps_is_counted_here_too(chapter):
    other = chapter.context.new_page()
    other.goto(chapter.url)
    chapter.check("input[value=one]")
    expect(other.locator(".vmc-record summary")).to_contain_text("1")
    chapter.evaluate("() => localStorage.clear()")
    expect(other.locator(".vmc-record")).to_be_hidden()
    other.close()


def test_a_long_question_ends_in_an_ellipsis_and_an_answer_stands_out(chapter):
    """And one line of code keeps its indentation; the buttons look as others do."""
    chapter.locator("legend").first.evaluate("(it) => (it.textContent = 'Why? '.repeat(100))")
    chapter.check("input[value=one]")
    chapter.wait_for_function("() => localStorage.vmcRecord")
    grade(chapter, said="✗ Not yet.", lines="    return -1")
    record = chapter.locator(".vmc-record")
    record.locator("summary").click()
    expect(record.locator("li")).to_have_count(2)
    first, code = record.locator("li").all()
    expect(first).to_contain_text(re.compile(r"Why\?… → one ✗"))
    expect(first.locator("strong")).to_have_text("one")
    assert code.locator("pre").evaluate("(it) => it.textContent") == "    return -1"
    check, save = (
        chapter.locator(f"{where} button").first.evaluate("(it) => getComputedStyle(it).borderTop")
        for where in (".vmc-check:not(.vmc-record *)", ".vmc-record")
    )
    assert save == check


def test_where_the_browser_keeps_no_more_it_is_said_and_the_file_has_the_answers(chapter):
    chapter.evaluate(FILL)
    chapter.check("input[value=one]")
    record = chapter.locator(".vmc-record")
    expect(record.get_by_role("status")).to_contain_text("save your answers as a file")
    kept = json.loads(saved(chapter, ".vmc-record button"))
    chapter.evaluate("() => localStorage.clear()")
    assert [one["answer"] for one in kept["answers"]][-1:] == ["one"]


def test_a_file_holds_no_more_answers_than_the_teachers_page_reads(chapter):
    short = dict.fromkeys(["page", "kind", "id", "question"], "")  # the next one needs more room
    answers = [answer(f"{n}", False) | short for n in range(2000)]
    chapter.evaluate("(all) => { localStorage.vmcRecord = JSON.stringify(all) }", answers)
    chapter.evaluate(FILL)
    chapter.check("input[value=one]")
    kept = json.loads(saved(chapter, ".vmc-record button"))["answers"]
    assert [one["answer"] for one in kept] == [*map(str, range(1, 2000)), "one"]


def answer(text, right, feedback=""):
    kind = {"page": "07_muscle", "kind": "exercise", "id": "ex-one", "question": "One"}
    return kind | {"answer": text, "right": right, "feedback": feedback}


@pytest.fixture
def write(tmp_path):
    """A function: the path of a student's file, with these answers; its name is the student's."""

    def write(name, answers, who=None):
        file = {"format": "answers 1", "who": who or name, "answers": answers}
        path = tmp_path / f"{name}.json"
        path.write_text(json.dumps(file), encoding="utf-8")
        return path

    return write


@pytest.fixture
def read(page):
    """A function: the teacher's page, which has read these files."""

    def read(*files):
        room = page(class_page())
        room.set_input_files("#files", files)
        room.wait_for_selector("#rows tr")
        return room

    return read


def table(room):
    """The rows of the table that the teacher's page saves, without its head."""
    return list(csv.reader(io.StringIO(saved(room, "#save"))))[1:]


def test_the_teachers_page_joins_two_hundred_files(read, write, tmp_path):
    """150 students meet one mistake, 50 of them keep it; one file is none; one student has two."""
    wrong, right = answer("", False, "The sign is wrong."), answer("", True)
    answers = [[wrong]] * 50 + [[wrong, right]] * 100 + [[right]] * 50
    files = [write(f"answers-{k}", given, f"{k}") for k, given in enumerate(answers)]
    second, bad = write("zero", [answer("=2", False)], "0"), tmp_path / "bad.json"
    bad.write_text("[]", encoding="utf-8")
    room = read(*files, second, bad)
    assert "200 students." in room.inner_text("#status")
    assert "bad.json" in room.inner_text("#status")
    rows = table(room)
    question = ["07_muscle", "exercise: One"]
    numbers = ["200", "50", "150"]
    assert rows == [
        [*question, "The sign is wrong.", "150", "150", "49", *numbers],
        [*question, "'=2", "1", "0", "1", *numbers],
    ]
    room.select_option("#page", "07_muscle")
    assert room.locator("#rows tr").count() == 2


@pytest.mark.parametrize("names", [("ann", "ann (1)"), ("ann (1)", "ann")])
def test_of_two_files_of_which_one_begins_the_other_the_longer_counts(read, write, names):
    """A browser saves the second as "ann (1)", which many computers list first."""
    answers = [answer("1", False), answer("2", True)]
    kept = {"ann": answers[:1], "ann (1)": answers}
    (row,) = table(read(*(write(name, kept[name], "ann") for name in names)))
    assert row[2:] == ["1", "1", "1", "0", "1", "0", "1"]


# Reads one file while three others are still being read; returns who is in the table.
READ_TWICE = """async () => {
  const file = (who) => new File([JSON.stringify({ format: "answers 1", who, answers: [] })], who);
  await Promise.all([read(["ann", "bob", "cy"].map(file)), read([file("di")])]);
  return [...students.keys()]; }"""


def test_files_that_are_chosen_while_others_are_read_take_their_place(page):
    room = page(class_page())
    assert room.evaluate(READ_TWICE) == ["di"]
    assert room.inner_text("#status") == "1 students."


@pytest.mark.parametrize(
    "answers",
    [
        [None],
        [answer("", False) | {"feedback": {"toString": 1}}],
        [answer("", False) | {"page": 7}],
    ],
)
def test_a_file_that_no_page_saved_leaves_the_others_in_the_table(read, write, answers):
    room = read(write("ann", [answer("2", False)]), write("bob", answers))
    assert room.inner_text("#status") == (
        "1 students. Not read: bob.json (it is no file of answers)."
    )
    assert room.locator("#rows tr").count() == 1


def test_of_a_longer_file_than_a_page_keeps_the_last_answers_are_read(read, write):
    """A page saves more where its browser kept no more; what is left out is said."""
    room = read(write("ann", [answer("old", False), *[answer("new", False)] * 2000]))
    assert room.inner_text("#status") == (
        "1 students. Only the last 2000 answers are read of: ann.json (1 left out)."
    )
    assert room.locator("#rows td:nth-child(3)").all_inner_texts() == ["new"]


def test_no_answer_becomes_a_formula(read, write):
    answers = [answer(formula, False) | {"id": formula} for formula in FORMULAS]
    rows = table(read(write("ann", answers)))
    assert len(rows) == len(FORMULAS)
    assert [cell for row in rows for cell in row if computes(cell)] == []


def test_of_a_quiz_only_the_first_answer_counts(read, write):
    """One opens the right answer and then reads the others; another opens a wrong one first."""
    this, that = (answer(text, text == "That") | {"kind": "quiz"} for text in ("This", "That"))
    (row,) = table(read(write("ann", [that, this]), write("bob", [this, that])))
    assert row[2:] == ["This", "1", "1", "1", "2", "1", "1"]
