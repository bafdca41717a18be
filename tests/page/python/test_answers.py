"""The page's Python and the notebook's say the same, of every exercise."""

import numpy as np
import pytest
from bs4 import BeautifulSoup

from page.python import pack
from tests.exercises import EVERY
from tests.pages import open_html
from tests.project import sample
from vmc_lib.grading import EMPTY, RIGHT, WRONG, feedback
from vmc_lib.show.figures import inline

pytestmark = pytest.mark.browser
each_exercise = pytest.mark.parametrize(
    "name", sample(EVERY, *list(EVERY)[::6]), ids=lambda name: name.lower()
)
ODD = {  # functions that are wrong everywhere, in one line
    "lambda *_: None": EMPTY,
    "lambda *_: 0.123": WRONG,
    "lambda *_: 'words'": WRONG,
    "lambda *_: [1, [2, 3]]": WRONG,
    "lambda *_: 1 / 0": WRONG,
    "3": WRONG,
}


def asked(name):
    """Lines that import an exercise, and its place, for the page's Python."""
    module = EVERY[name].right.__module__
    return f"from {module} import {name} as exercise\n{name.lower()} = ", f"{module}.{name.lower()}"


@each_exercise
def test_every_mistake_is_told_as_in_the_notebook(ask, name):
    lines, place = asked(name)
    assert ask([], f"{lines}exercise.right", place) == [RIGHT, ""]
    for number, hint in enumerate(EVERY[name].mistakes):
        mistake = f"{lines}list(exercise.mistakes.values())[{number}]"
        assert ask([], mistake, place) == [f"{WRONG} {hint}", ""]


@each_exercise
def test_an_odd_function_is_told_as_in_the_notebook(ask, name):
    lines, place = asked(name)
    for function, begins in ODD.items():
        said, _ = ask([], f"{lines}{function}", place)
        assert said.startswith(begins)
        names = {}
        exec(f"{lines}{function}", names)  # noqa: S102
        assert said == feedback(names[name.lower()], EVERY[name])


@each_exercise
def test_general_hints_are_those_of_the_notebook(ask, name):
    lines, place = asked(name)
    for wrong in ("-np.asarray({})", "[{}]", "np.asarray({}) + 1e-5"):
        function = f"lambda *x: {wrong.format('exercise.right(*x)')}"
        names = {"np": np}
        exec(f"{lines}{function}", names)  # noqa: S102
        said, _ = ask(["import numpy as np"], f"{lines}{function}", place)
        assert said == feedback(names[name.lower()], EVERY[name])


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("x = 1\ninput()", "Line 2 stops: `RuntimeError: This page cannot ask"),
        ("import torch", "This page has NumPy alone: torch needs Python of your own"),
        ("import asyncio", "This page has NumPy alone: asyncio needs Python of your own"),
    ],
)
def test_what_pyodide_has_not_is_refused_in_words(ask, typed, words):
    said, _ = ask([], typed)
    assert words in said


def test_every_module_of_the_list_runs_in_the_page(ask):
    modules = "\n".join(f"import {name}" for name in pack.MODULES)
    lines, place = asked("MIXED")
    assert ask([], f"{modules}\n{lines}lambda *_: None", place) == [EMPTY, ""]


def test_what_is_said_is_set_as_in_the_notebook(offline, site):
    texts = [hint for exercise in EVERY.values() for hint in exercise.mistakes]
    texts += [feedback(lambda *_: "<b> & *not* $x$", EVERY["MIXED"]), RIGHT, EMPTY]
    page = open_html(offline, site, "<h1>E</h1>")
    script = "(texts) => texts.map(vmc['python/grade'].inline)"
    plain = [str(BeautifulSoup(html, "html.parser")) for html in page.evaluate(script, texts)]
    assert plain == [str(BeautifulSoup(inline(text), "html.parser")) for text in texts]
    page.close()
