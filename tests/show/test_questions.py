"""Predictions and checks: what they show, what they refuse, and how the page answers."""

from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

from tests.pages import boxes
from tests.project import python
from vmc_lib.show import check, questions
from vmc_lib.show.questions import prediction


@pytest.fixture
def shown(monkeypatch):
    """What is displayed, in order, as HTML."""
    outputs = []
    monkeypatch.setattr(questions, "display", lambda html: outputs.append(html.data))
    return outputs


ASKED = "How much is $1 + 1$?", ["one", "two", "*three*"], "two", "One and *one*."


PREDICTION = prediction(*ASKED)

KERNEL = """
from IPython.core.interactiveshell import InteractiveShell
from vmc_lib.show.questions import explain_unknown_names
shell = InteractiveShell.instance(colors="nocolor")
explain_unknown_names(shell)
for cell in ("def half(x:\\n    return x / 2", "half(1)", "third(1)"):
    shell.run_cell(cell, store_history=True)
"""


def test_an_unknown_name_is_told_with_the_cell_that_was_not_read(tmp_path):
    _, half, third = python("-c", KERNEL, IPYTHONDIR=str(tmp_path)).split("Error: ")[-3:]
    assert "In the cell that defines half: Python cannot read line 1: '('" in half
    assert "In the cell" not in third


def test_a_prediction_folds_the_outcome():
    page = PREDICTION
    assert page.count('type="radio"') == 3
    choices, verdict = page.split("<details")
    assert "<em>three</em>" in choices
    assert "One and" not in choices
    assert "<strong>two.</strong> One and <em>one</em>." in verdict
    assert prediction(*ASKED) == page  # so that the page knows it again


@pytest.mark.parametrize(
    ("choices", "outcome", "why"),
    [
        (["a"], "a", "so"),
        (list("abcde"), "a", "so"),
        (["a", "a"], "a", "so"),
        (["a", "b"], "c", "so"),
        (["a", "b"], "a", ""),
    ],
)
def test_impossible_predictions_are_refused(choices, outcome, why):
    with pytest.raises(ValueError, match="'Well\\?' needs two to four choices"):
        prediction("Well?", choices, outcome, why)


@pytest.mark.parametrize(
    ("answer", "expected", "tolerance"),
    [
        (11.6, 20 / np.tan(np.radians(60)), 0.1),
        (190, 190, 0),
        ((190, 189.9, 95), (190, 190, 95), 0.2),
        (np.eye(2), [[1, 0], [0, 1]], 1e-9),
        ("same", "same", 0),
        (" Same", "same", 0),
        ('"same" ', "same", 0),
        ("‘same’", "same", 0),
        ("1/9", 1 / 9, 1e-6),
        ("11,5", 11.5, 0),
        ("same.", "same", 0),
        ("−11,5", -11.5, 0),
        ("(190, 190, 95)", (190, 190, 95), 0),
        ("80 %", 0.8, 1e-9),
        (True, True, 0),
        ([0.8], 0.8, 1e-9),
    ],
)
def test_right_answers_are_accepted_in_every_render_mode(
    answer, expected, tolerance, shown, monkeypatch
):
    for render_mode in ("live", "book", "test"):
        monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
        check(answer, expected, tolerance)
    assert all("✓ Right." in page for page in shown)
    assert len(shown) == 3


WRONG = [
    (11.8, 11.6, 0.1),
    (np.nan, 1, 0.1),
    ((1, 2), (1, 2, 3), 0),
    ([1, 2], 1, 5),
    (np.zeros(3), [1, 0.1, 0], 1e-3),
    ("same", "different", 0),
    ("11.5", 12, 0.1),
    ("1/0", 1, 1),
    ([1, [2, 3]], (1, 2), 5),
    ("11.5", "same", 0),
]


@pytest.mark.parametrize(("answer", "expected", "tolerance"), WRONG)
def test_wrong_answers_show_the_hint_and_fail_where_no_reader_is(
    answer, expected, tolerance, shown, monkeypatch
):
    for render_mode in ("book", "test"):
        monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
        with pytest.raises(AssertionError, match="check: "):
            check(answer, expected, tolerance)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    check(answer, expected, tolerance, hint="Draw it: $x < y$.")
    [page] = shown
    assert "✗ Not yet." in page
    assert r"\(x &lt; y\)" in page


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("eleven", "Write a number"),
        ("11 or 12", "Write a number"),
        ("11 km", "Write it without"),
        ((11, 5), "Write the number with a point, not with a comma"),
    ],
)
def test_what_cannot_be_read_is_not_wrong_and_fails_a_test(answer, said, shown, monkeypatch):
    with pytest.raises(AssertionError, match="check: "):
        check(answer, 11)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    check(answer, 11, hint="Think.")
    assert f"Not read. {said}" in shown[0]
    assert "Think." not in shown[0]


@pytest.mark.parametrize("answer", [None, (None, None), (1, None), [None, "a"]])
@pytest.mark.parametrize("render_mode", ["live", "test"])
def test_none_counts_as_not_answered(answer, render_mode, shown, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    check(answer, 3)
    assert "Not answered yet." in shown[0]
    assert "<input" not in shown[0]


def test_the_page_has_a_field_for_numbers_and_words_but_not_for_arrays(shown, book):
    for expected in (3, "same", (1, 2), np.float64(0.5), [0.1, 0.2], np.eye(2)):
        check(None, expected)
    assert ["<input" in page for page in shown] == [True, True, True, True, False, False]


@pytest.fixture
def open_questions(open_page, shown, book):
    """A function that opens a page of some parts, and of what was shown."""
    return lambda *parts: open_page(f"<h1>Q</h1>{''.join([*parts, *shown])}")


@pytest.fixture
def unanswered(open_questions):
    """The page of a prediction, of which nothing is kept, with the keyboard on its first choice."""
    page = open_questions(PREDICTION)
    page.evaluate("() => localStorage.clear()")
    page.keyboard.press("Tab")
    return page


MARKS = """() => [...document.querySelectorAll("label")]
  .map((label) => getComputedStyle(label, "::after").content.replaceAll('"', ""))"""


ANSWERS = "() => JSON.parse(localStorage.vmcRecord ?? '[]').map(({ answer }) => answer)"


@pytest.mark.browser
def test_a_prediction_is_kept_and_marked_beside_the_outcome(unanswered):
    page = unanswered
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowDown")
    assert page.is_checked("input >> nth=2")
    assert min(height for *_, height in boxes(page.locator("label, summary"))) >= 24
    assert not page.is_visible("text=One and")
    assert page.evaluate(MARKS) == ["none"] * 3
    page.reload()
    assert page.is_checked("input >> nth=2")
    assert not page.is_visible("text=One and")
    assert page.evaluate(ANSWERS) == []  # the arrows pass over choices
    page.focus("input >> nth=2")
    page.keyboard.press("Enter")
    assert page.is_visible("text=One and")
    assert page.evaluate(ANSWERS) == ["*three*"]
    assert page.evaluate(MARKS) == ["none", "✓", "✗"]
    page.emulate_media(media="print")
    assert page.is_visible("text=three")
    assert not page.is_visible("text=One and")


@pytest.mark.browser
def test_enter_on_a_choice_that_no_arrow_passed_counts_as_that_choice(unanswered):
    page = unanswered
    page.keyboard.press("Enter")
    assert page.is_checked("input >> nth=0")
    assert page.evaluate(ANSWERS) == ["one"]


@pytest.mark.browser
@pytest.mark.parametrize("by", ["input >> nth=1", "label >> nth=1", "summary"])
def test_a_choice_opens_what_came_out(open_questions, by):
    page = open_questions(PREDICTION)
    page.click(by)
    assert page.is_visible("text=One and")


@pytest.mark.browser
@pytest.mark.parametrize("by", ["input >> nth=0", "summary"])
def test_a_still_output_below_a_prediction_is_hidden_until_it_is_made(open_questions, by):
    below = ["<p>four</p>", "<form class='vmc-controls'></form>a demo"]
    cells = [f"<div class='cell'><div class='cell_output'>{x}</div></div>" for x in below]
    code, again = "<div class='cell'>code</div>", PREDICTION.replace("predict-", "again-")
    page = open_questions(PREDICTION, code, cells[0], again, cells[1])
    page.focus("input >> nth=1")
    page.keyboard.press("ArrowDown")
    assert not page.is_visible("text=four")
    assert page.is_visible("text=a demo")
    page.click(by)
    page.wait_for_selector("text=four", state="visible")


@pytest.mark.browser
def test_a_prediction_works_where_storage_is_forbidden(open_questions):
    page = open_questions(PREDICTION)
    page.add_init_script("Object.defineProperty(window, 'localStorage', { get() { throw 'no' } })")
    page.reload()
    page.check("input >> nth=1")
    assert page.evaluate(MARKS) == ["none", "✓", "none"]


CELL = """<div class="cell tag_runs-in-page"><div class="cell_input"><pre>def f(x):
    return x</pre></div></div>"""


@pytest.mark.browser
def test_each_field_has_its_own_answer_again(open_questions):
    """Whatever other forms there are: a cell that can be edited gets one when the page starts."""
    check(None, 3)
    check(None, 4)
    page = open_questions(CELL)
    fields = page.locator("form[data-check] input").all()
    for typed, field in enumerate(fields):
        field.fill(f"{typed}")
        field.press("Enter")
    page.reload()
    assert [field.input_value() for field in fields] == ["0", "1"]


@pytest.mark.browser
def test_a_field_has_its_answer_again_where_an_edition_asks_more(open_questions, shown):
    check(None, 3, hint="Three.")
    page = open_questions()
    page.fill("input", "2")
    page.press("input", "Enter")
    check(None, 4)
    file = Path(unquote(urlsplit(page.url).path))
    more = file.read_text(encoding="utf-8").replace("<h1>Q</h1>", shown[1])
    file.write_text(more, encoding="utf-8")
    page.reload()
    assert page.locator("input").evaluate_all("(all) => all.map((one) => one.value)") == ["", "2"]


@pytest.mark.browser
@pytest.mark.parametrize(
    ("expected", "tries"),
    [
        (-11.5, {"": "Not answered", "11": "Not yet", "−11.55": "Right", "x": "Not read"}),
        ((190, 95), {"190": "Not read", "190,95": "Right", "95 190": "Not yet"}),
        ((0.5, 8), {"0,5 8": "Right", "1/2; 8": "Right", "0.5 9": "Not yet"}),
        (
            0.8,
            {
                "4/5": "Right",
                "80 %": "Right",
                "0,8 m": "Not read",
                "1 constructor": "Not read",
                "8": "Not yet",
                "1/0": "Not yet",
            },
        ),
        ("same", {"different": "Not yet", "Same": "Right", '"same".': "Right", "‘same’": "Right"}),
    ],
)
def test_the_page_checks_what_is_typed(open_questions, expected, tries):
    check(None, expected, tolerance=0.1, hint="*Think*.")
    page = open_questions()
    for typed, verdict in tries.items():
        page.fill("input", typed)
        page.keyboard.press("Enter")
        said = page.inner_text("[role=status]")
        assert verdict in said
        assert ("Think." in said) == (verdict == "Not yet")
    page.reload()
    assert page.input_value("input") == typed


@pytest.mark.browser
def test_questions_are_accessible(open_questions, serious):
    check(None, 3)
    check(3, 3)
    page = open_questions(PREDICTION)
    page.eval_on_selector_all("details", "all => all.forEach((d) => (d.open = true))")
    assert serious(page, "html", all_of_it=True) == []
