"""The page's Python, packed, in a folder that has the book's scripts."""

import pytest

from page.python import pack
from tests import pages
from tests.exercises import EVERY
from vmc_lib.show import questions

SCRIPTS = pack.SCRIPT, pack.PLOTS
ABOVE = """import numpy as np
import cv2


def twice(x):
    return 2 * x


assert False"""
STUB = '''def {name}(u, a, rise, fall):
    """Per second."""
    ...  # your lines
'''
MECHANISM = "def cube(x):\n    return x**3\n\n\nassert cube(twice(2)) == 64"
ASK = "(question) => vmc['python/interpreter'].ask(question, () => {})"
PATIENT = "() => { vmc['python/interpreter'].limit.seconds = 1000 }"  # others may be at work, too
# In place of Python: a test answers, when it will
STAND_IN = """() => {
  window.asked = [];
  vmc['python/interpreter'].ask = (question, say, signal) => new Promise((answer, fail) => {
    asked.push({ name: question[1], say, answer, fail });
    signal?.addEventListener('abort', () => fail(signal.reason));
  });
}"""
CELL = '<div class="cell"><div class="cell_input"><pre>{}</pre></div></div>'


@pytest.fixture(scope="session")
def packed(once):
    """The page's Python, by name: as built, or packed by one worker."""
    folder = once("packed", lambda folder: pages.copy_scripts(folder, *SCRIPTS))
    return {name: (folder / name).read_text(encoding="utf-8") for name in SCRIPTS}


@pytest.fixture(scope="session")
def site(site, packed):
    """The folder with the book's styles and scripts, the page's Python among them."""
    (site / pack.SCRIPT).parent.mkdir(exist_ok=True)
    for name, script in packed.items():
        (site / name).write_text(script, encoding="utf-8")
    return site


@pytest.fixture(scope="session")
def exercise_html():
    """A chapter's code, and an exercise with its empty function, as the book has them."""
    name = EVERY["ACTIVATION_RATES"].right.__name__
    last = CELL.format(MECHANISM).replace('"cell"', '"cell tag_runs-in-page"')
    form = pages.book_html(
        questions, lambda: questions.grade(lambda *_: None, EVERY["ACTIVATION_RATES"])
    )
    first, stub = (CELL.format(lines) for lines in (ABOVE, STUB.format(name=name)))
    output = f'<div class="cell"><div class="cell_output">{form}</div></div>'
    return f"<h1>E</h1>{first}{stub}{output}{last}"


@pytest.fixture
def open_exercise(open_page, exercise_html):
    """A function that opens the exercise: its field, its buttons, and what it says."""

    def open_exercise(*window):
        page = open_page(exercise_html, *window)
        page.evaluate(PATIENT)
        page.lines, page.said = page.locator("textarea"), page.locator("form [role=status]")
        page.button = lambda name: page.get_by_role("button", name=name)
        return page

    return open_exercise


@pytest.fixture(scope="session")
def late():
    """A function: what the stand-in was asked by a name is met, late, as JavaScript has it."""

    def late(page, name, met):
        each = f"asked.filter((one) => one.name === '{name}').forEach((one) => one.{met})"
        page.evaluate(f"() => {{ {each} }}")
        page.evaluate(pages.TWO_FRAMES)

    return late


@pytest.fixture(scope="module")
def ask(offline, site):
    """A function that asks the page's Python about typed lines: what is said, what is printed."""
    python = "<!-- tag_runs-in-page: its policy lets Python run -->"
    page = pages.open_html(offline, site, f"<h1>E</h1>{python}")
    page.evaluate(PATIENT)
    yield lambda *question: page.evaluate(
        ASK, ["grader", "check" if len(question) == 3 else "run", *question]
    )
    page.close()
    assert page.errors == []
