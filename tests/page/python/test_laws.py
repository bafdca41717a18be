"""A law that the reader changes moves the demos below it, and sliders stand between their stops."""

import re
from urllib.parse import quote

import pytest
from playwright.sync_api import expect

from book._ext.numbering import with_figure_numbers
from tests import pages
from tests.page.python.conftest import CELL, STAND_IN
from vmc_lib import show
from vmc_lib.show import demo

pytestmark = pytest.mark.browser
LAW = "def law(x):\n    return 2 * x\n\n\nverify(law(1), 2)"
DEMO = """import matplotlib.pyplot as plt
from vmc_lib.show import Slider, explore


def draw(x):
    fig, ax = plt.subplots()
    ax.plot([0, law(x)])
    ax.set_title(f"at {x:g}: {law(x):g}")
    return fig


explore(draw, "A line.", x=Slider([0, 1, 3], "x", 1))"""
TITLE = ".vmc-picture svg"
FOLDED = """<div class="cell tag_runs-in-page"><details>
<summary style="padding: 0.5rem">Code</summary>
<div class="cell_input"><pre>{}</pre></div></details></div>"""


@pytest.fixture(scope="module")
def law_html(exercise_html):
    """A chapter of an exercise, a law (folded) and two demos: one follows it, one does not."""
    other = DEMO.replace("law(x)", "x")

    def declare():
        for lines in (DEMO, other):
            exec(f"{LAW}\n{lines}", {"verify": show.verify})  # noqa: S102

    with pytest.MonkeyPatch.context() as patch:
        shown = pages.displayed(patch, demo)
        patch.setenv("VMC_RENDER_MODE", "book")
        declare()
    law = FOLDED.format(LAW)
    cells = [
        f'<div class="cell tag_draws-in-page"><div class="cell_input"><pre>{lines}</pre></div>'
        f'<div class="cell_output">{item.data}</div></div>'
        for lines, item in zip((DEMO, other), shown, strict=True)
    ]
    return f"{exercise_html}{law}{with_figure_numbers(''.join(cells), (7,))}"


@pytest.fixture
def open_law(open_page, law_html):
    """A function that opens the chapter, with what the tests look at."""

    def open_law(*window):
        page = open_page(law_html, *window)
        page.evaluate(
            "() => { vmc['python/interpreter'].limit.seconds = 100 }"
        )  # others may be at work, too
        page.mine, page.other = page.locator(".vmc-demo").all()
        page.slider = page.mine.locator("input")
        page.line = page.mine.locator(".vmc-law [role=status]")
        return page

    return open_law


def run(page, lines):
    page.get_by_label("Your lines: law").fill(lines)
    page.get_by_role("button", name="Run", exact=True).click()


def test_a_law_moves_its_demos_and_goes_back(open_law, serious):
    page = open_law()
    page.get_by_role("button", name="Edit law").click()
    run(page, LAW.replace("2 *", "5 *"))
    said = page.locator("form[data-cell=law] [role=status]")
    words = "Your law differs from the book's, by at most 3: Figure 7.1 now runs yours."
    expect(said).to_have_text(words)
    expect(page.line).to_have_text("This demo runs your law.")
    expect(page.mine.locator(TITLE)).to_contain_text("at 1: 5")
    expect(page.mine.locator(".vmc-link")).to_have_attribute("href", re.compile(r"&law\.law=def"))
    expect(page.other.locator(TITLE)).to_contain_text("at 1: 1")
    expect(page.other.locator(".vmc-law [role=status]")).to_have_text("")
    expect(page.locator(".vmc-any:not([hidden])")).to_have_count(0)  # Python is there
    page.slider.fill("2")
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 15")
    expect(page.mine).not_to_have_attribute("aria-busy", "true")
    assert serious(page, "html", all_of_it=True) == []
    link = page.mine.locator(".vmc-link").get_attribute("href")
    page.reload()
    kept = "Your lines are kept: press Run, and Figure 7.1 will run them again."
    expect(said).to_have_text(f"Your law differs from the book's, by at most 3. {kept}")
    page.get_by_role("button", name="Run", exact=True).click()
    expect(said).to_have_text(words)
    page.slider.fill("2")
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 15")
    page.mine.get_by_role("button", name="Back to the book").click()
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 6")
    expect(page.line).to_have_text("")
    expect(said).to_contain_text("The figures run the book’s lines again")
    for address in (link, f"#{quote(link[1:])}"):  # as it is, and as some programs encode it again
        page.get_by_label("Your lines: law").fill("")
        page.evaluate("(link) => { location.hash = ''; location.hash = link }", address)
        expect(page.locator(".vmc-beside pre")).to_have_text(LAW.replace("2 *", "5 *"))
        expect(page.line).to_contain_text("This link brings another law.")
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 6")
    page.mine.get_by_role("button", name="Run it").click()
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 15")


def test_sliders_stand_between_their_stops(open_law, window):
    page = open_law(window(viewport={"width": 360, "height": 700}))
    page.mine.get_by_text("more", exact=True).click()
    page.mine.get_by_role("button", name="Any value").click()
    page.slider.fill("1.5")
    expect(page.mine.locator(TITLE)).to_contain_text("at 2: 4")
    expect(page.mine.locator("output")).to_have_text("2")
    expect(page.line).to_have_text("The sliders now take any value.")
    page.slider.fill("2")
    expect(page.mine.locator(TITLE)).to_contain_text("at 3: 6")
    expect(page.other.get_by_role("button", name="Any value")).to_be_hidden()
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360


LATE = {
    "a picture": "answer({ parts: [['late'], ['<p>late</p>']], texts: { x: 'late' } })",
    "an error": "answer({ error: 'late' })",
    "no answer": "fail(Error('late'))",
    "progress": "say('late')",
}


@pytest.mark.parametrize("what", LATE.values(), ids=LATE)
def test_what_comes_late_leaves_the_books_picture_at_a_stop(open_law, late, what):
    page = open_law()
    page.evaluate(STAND_IN)
    page.mine.get_by_text("more", exact=True).click()
    page.mine.get_by_role("button", name="Any value").click()
    late(page, "draw", "answer({ parts: [], texts: {} })")
    page.slider.fill("1.5")
    page.slider.fill("2")
    late(page, "draw", what)
    assert "late" not in page.mine.text_content()
    assert page.line.text_content() == "The sliders now take any value."


@pytest.fixture
def run_law(open_law, late):
    """The chapter, where a law has run, and the demos ask what has changed."""
    page = open_law()
    page.evaluate(STAND_IN)
    page.get_by_role("button", name="Edit law").click()
    run(page, LAW.replace("2 *", "5 *"))
    late(page, "run", "answer(['✓ It runs.', ''])")
    return page


def test_a_drawing_by_the_readers_law_leaves_the_book_that_came_back(run_law, late):
    page = run_law
    late(page, "changed_names", "answer(['law'])")
    page.mine.get_by_role("button", name="Back to the book").click()
    late(page, "draw", LATE["a picture"])
    assert "at 1: 2" in page.mine.locator(TITLE).text_content()


def test_a_law_that_was_reset_meanwhile_is_not_the_readers(run_law, late):
    page = run_law
    page.locator("[data-cell=law] [name=reset]").click()
    late(page, "changed_names", "answer(['law'])")
    assert page.mine.get_by_role("button", name="Back to the book").is_hidden()


def test_a_law_that_fails_at_one_place_is_asked_at_the_next(run_law, late):
    page = run_law
    late(page, "changed_names", "answer(['law'])")
    late(page, "draw", "fail(Error('Stopped after 10 s.'))")
    assert page.line.text_content() == "Stopped after 10 s. This is the book’s."
    page.slider.fill("2")
    late(page, "draw", LATE["a picture"])
    assert page.line.text_content() == "This demo runs your law."


def test_what_ran_when_the_lines_were_reset_does_not_come_back(run_law, late):
    page = run_law
    law = page.get_by_label("Your lines: law")
    page.get_by_role("button", name="Run", exact=True).click()
    page.locator("[data-cell=law] [name=reset]").click()
    late(page, "run", "answer(['✓ It runs.', ''])")
    assert page.locator("[data-cell=law] [role=status]").text_content() == ""
    assert law.evaluate("(area) => area.lastRun") == LAW
    page.get_by_role("button", name="Run", exact=True).click()
    late(page, "run", "answer(['✓ It runs.', ''])")
    assert "✓ It runs." in page.locator("[data-cell=law] [role=status]").text_content()


def test_what_ran_when_the_book_came_back_leaves_it(run_law, late):
    page = run_law
    late(page, "changed_names", "answer(['law'])")
    page.get_by_role("button", name="Run", exact=True).click()
    page.mine.get_by_role("button", name="Back to the book").click()
    late(page, "run", "answer(['✓ It runs.', ''])")
    said = page.locator("[data-cell=law] [role=status]").text_content()
    assert said.startswith("The figures run the book’s lines again")


def test_a_links_lines_run_while_others_are_checked(run_law, late):
    page = run_law
    brought = LAW.replace("2 *", "7 *")
    page.get_by_role("button", name="Run", exact=True).click()
    link = f"#{page.mine.get_attribute('id')}?law.law={quote(brought)}"
    page.evaluate("(link) => { location.hash = link }", link)
    page.mine.get_by_role("button", name="Run it").click()
    late(page, "run", "answer(['✓ It runs.', ''])")
    law = page.get_by_label("Your lines: law")
    assert law.evaluate("(area) => area.lastRun") == brought


@pytest.mark.audit
def test_arrays_that_the_page_cannot_make_come_with_it(open_page, monkeypatch):
    made = "import cv2\nimport numpy as np\ntable = cv2.multiply(np.ones(3), 2.0)[:, 0]"
    lines = DEMO.replace("law(x)", "x + table[0]").replace(
        "x=Slider", 'data={"table": table}, x=Slider'
    )
    shown = pages.displayed(monkeypatch, demo)
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    exec(f"{made}\n{lines}", {})  # noqa: S102
    cell = f'<div class="cell_input"><pre>{lines}</pre></div>{shown[0].data}'
    page = open_page(f'{CELL.format(made)}<div class="cell tag_draws-in-page">{cell}</div>')
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 100 }")
    page.get_by_text("more", exact=True).click()
    page.get_by_role("button", name="Any value").click()
    page.locator(".vmc-demo input").fill("1.5")
    expect(page.locator(TITLE)).to_contain_text("at 2: 4")


FAILING = {
    "def law(x):\n    return 1 / 0": "Your law stops: ZeroDivisionError",
    "def law(x):\n    return": "Your law stops: TypeError",
    "def law(x):\n    while True:\n        pass": "Stopped after 10 s.",
}


@pytest.mark.audit
def test_an_exercise_above_is_no_law_and_a_law_that_fails_gives_the_demo_back(open_law):
    page = open_law()
    page.get_by_label("Your lines: activation_rates").fill("1 / 0")
    page.get_by_role("button", name="Check").click()
    expect(page.locator("form[data-function] [role=status]")).to_contain_text("Line 1 stops")
    page.slider.fill("2")
    expect(page.mine.locator(".vmc-link")).to_have_attribute("href", re.compile(r"#demo-\d+\?x=2"))
    expect(page.line).to_have_text("")
    page.get_by_role("button", name="Edit law").click()
    for lines, words in FAILING.items():
        if "while" in lines:  # and all that is drawn with has been loaded
            page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 10 }")
        run(page, lines)
        expect(page.line).to_contain_text(words)
        expect(page.line).to_contain_text("This is the book’s.")
        expect(page.mine.locator(TITLE)).to_contain_text("at 3: 6")
