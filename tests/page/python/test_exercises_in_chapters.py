"""Every exercise of the built book, in its own chapter: no lines, right ones, a known mistake."""

import inspect
import json

import pytest

from tests.exercises import exercises
from tests.pages import BUILT, INSIDE, open_url, probe
from tests.project import CHAPTERS, sample
from vmc_lib.grading import EMPTY, RIGHT, WRONG

pytestmark = pytest.mark.browser
THREE = {"04_crbm": "ENERGY_OF", "07_muscle": "ACTIVATION_TO_HOLD", "09_planning": "NEAR_WEIGHTS"}
CHECK = """const form = document.querySelector('form[data-function$=".%s"]');
const area = form.closest(".cell").previousElementSibling.querySelector("textarea");
if (lines) area.value = lines;
form.requestSubmit();
const { stop } = form.elements;
while (!stop.disabled) await new Promise((resolve) => setTimeout(resolve, 50));
return form.querySelector("[role=status]").textContent;"""
ENDLESS = "while True:\n    pass"


def built(chapter):
    return BUILT / "book" / f"{chapter.stem}.html"


def mistaken(name, one):
    """Lines that make the first known mistake."""
    exercise = f"from {one.right.__module__} import {name}"
    return f"{exercise}\n{name.lower()} = next(iter({name}.mistakes.values()))"


def first_words(markdown):
    """What stands before maths, code and other marks."""
    return markdown.split("$")[0].split("`")[0].split("*")[0].strip()


@pytest.mark.parametrize("chapter", sample(CHAPTERS, "11_online"), ids=lambda chapter: chapter.stem)
def test_every_exercise_is_checked_in_its_chapter(offline, chapter):
    page = open_url(offline, built(chapter).as_uri())
    page.evaluate(
        "() => { vmc['python/interpreter'].limit.seconds = 100 }"
    )  # others may be at work, too

    def check(name, lines):
        return page.evaluate(f"async (lines) => {{ {CHECK % name.lower()} }}", lines)

    found = exercises(chapter)
    assert page.locator("form[data-function]").count() == len(found)
    for name, one in found.items():
        assert check(name, "") == EMPTY
        assert check(name, inspect.getsource(one.right)) == RIGHT
        hint = f"{WRONG} {next(iter(one.mistakes))}"
        assert check(name, mistaken(name, one)).startswith(first_words(hint))
    assert probe(page, "rawTex") == []
    assert [url for url in page.asked if not url.startswith(INSIDE)] == []
    assert page.errors == page.failed == []
    page.evaluate("() => localStorage.clear()")
    page.close()


@pytest.mark.audit
def test_the_other_engines_check_three(engine):
    for stem, name in THREE.items():
        [chapter] = [chapter for chapter in CHAPTERS if chapter.stem == stem]
        one = exercises(chapter)[name]
        engine.open(built(chapter))
        engine.limit(100)

        def check(lines, name=name):
            return engine.run(f"const lines = {json.dumps(lines)}; {CHECK % name.lower()}")

        assert check(inspect.getsource(one.right)) == RIGHT
        hint = f"{WRONG} {next(iter(one.mistakes))}"
        assert check(mistaken(name, one)).startswith(first_words(hint))
        assert engine.errors() == ""
    engine.limit(1)
    assert "Stopped after 1 s." in check(ENDLESS)
