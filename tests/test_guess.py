"""A reader's guess is drawn on the figure, where its axis has it."""

import math
import re

import pytest

from book._ext.plain import with_guess
from tests.pages import CHAPTERS, open_url
from tests.project import sample

TEXTS = {path: path.read_text(encoding="utf-8") for path in CHAPTERS}
GUESSED = [path for path, text in TEXTS.items() if "data-guess" in text]
PLOT = """(line) => {
  const plot = line.parentElement.querySelector("svg[data-axes]");
  const { x, y, width, height } = plot.getBoundingClientRect();
  return [plot.dataset.axes.split(" ").map(Number), [x, y, width, height]];
}"""


def place(axes, box, axis, value, log):
    """Where in the window a value of an axis ("x" or "y") lies, at its edge at most."""
    x0, x1, y0, y1, left, right, bottom, top = axes
    (low, high), (start, end) = {"x": ((x0, x1), (left, right)), "y": ((y0, y1), (bottom, top))}[
        axis
    ]
    scale = math.log if log else float
    share = (scale(value) - scale(low)) / (scale(high) - scale(low))
    at = start + min(max(share, 0), 1) * (end - start)
    return box[0] + at * box[2] if axis == "x" else box[1] + at * box[3]


@pytest.mark.browser
@pytest.mark.parametrize(
    "path", sample(GUESSED, "04_crbm", "09_planning"), ids=[path.stem for path in GUESSED]
)
def test_a_guess_is_drawn_where_its_value_lies(offline, path):
    page = open_url(offline, path.as_uri())
    page.evaluate("document.querySelectorAll('[hidden]').forEach((part) => (part.hidden = false))")
    for nth, question in enumerate(page.locator("[data-guess]").all()):
        guess, line = question.get_attribute("data-guess"), page.locator(".vmc-guess").nth(nth)
        log, axis, places = re.fullmatch(r"(log )?([xy]) (.+)", guess).groups()
        for choice, value in zip(question.locator("input").all(), places.split(), strict=True):
            choice.check(force=True)
            line.scroll_into_view_if_needed()
            box = line.bounding_box()
            wanted = place(*line.evaluate(PLOT), axis, float(value), log)
            assert box[axis] == pytest.approx(wanted, abs=1.5)
    assert page.errors == []
    page.close()


@pytest.mark.browser
def test_still_figures_below_a_prediction_wait_for_the_guess(window):
    """Both of them: either would give it away."""
    [path] = [path for path in CHAPTERS if path.stem == "15_whole_arm"]
    page = open_url(window(), path.as_uri())
    question = page.locator(".vmc-predict", has_text="an easy posture of its own")
    figures = [page.locator(f"#demo-{name} svg").first for name in ("wa-result", "wa-left")]
    assert [figure.is_visible() for figure in figures] == [False, False]
    question.locator("input").first.check()
    assert [figure.is_visible() for figure in figures] == [True, True]
    page.close()


def test_a_guess_needs_a_place_for_each_choice():
    box = '<fieldset class="vmc-predict">'
    assert with_guess(box, ["a", "b"], {}) == box
    assert 'data-guess="y 1 2"' in with_guess(box, ["a", "b"], {"guess": "y 1 2"})
    with pytest.raises(ValueError, match="a number for each"):
        with_guess(box, ["a", "b"], {"guess": "log x 1 2 3"})
