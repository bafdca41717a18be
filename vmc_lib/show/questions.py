"""Questions to the reader: `quiz` (choose an answer, read why) and `check` (test an answer).

Both are plain HTML that works in a live notebook, in the built page and on paper. Where the built
page has no kernel to run the reader's line, `check` offers a field to type the answer into.
"""

import html
import json

import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.figures import inline
from vmc_lib.show.render_mode import render_mode

# JupyterLab would take Enter as its own, and the answer would stay closed.
_OWN_KEYS = 'onkeydown="event.stopPropagation()"'
NOT_YET, RIGHT, WRONG = "Not answered yet.", "✓ Right.", "✗ Not yet."


def quiz(question, answers, right):
    """Ask a multiple-choice question. Each answer, when opened, says whether it is right, and why.

    `question` is Markdown; `answers` maps each answer to its why, both Markdown (an answer needs
    words: maths alone has no name that could be read aloud); `right` is the right answer's own
    text. Raises ValueError for fewer than two answers, an answer without a why, or a `right` that
    is none of them.
    """
    if len(answers) < 2 or not all(answers.values()) or right not in answers:
        raise ValueError(
            f"the quiz {question!r} needs two or more answers, a why for each, and {right!r} "
            f"among them: got {answers}"
        )
    choices = "".join(
        f'<details class="{"vmc-right" if answer == right else "vmc-wrong"}">'
        f"<summary>{inline(answer)}</summary>"
        f"<p><strong>{RIGHT if answer == right else '✗ No.'}</strong> {inline(why)}</p></details>"
        for answer, why in answers.items()
    )
    legend = f"<legend>{inline(question)}</legend>"
    display(HTML(f'<fieldset class="vmc-quiz" {_OWN_KEYS}>{legend}{choices}</fieldset>'))


def check(answer, expected, tolerance=1e-6, hint=""):
    """Show whether the reader's `answer` is right.

    `expected` is a number, a text, or any nesting of these; each number may be off by `tolerance`,
    in its own unit. An answer with a None in it is not answered yet; a wrong one is shown the
    `hint` (Markdown) and, in a test (`VMC_RENDER_MODE=test`), raises AssertionError: running a
    chapter proves its solutions.
    """
    if None in np.ravel(np.asarray(answer, object)).tolist():
        typed = render_mode() == "book" and isinstance(expected, (int, float, str, tuple))
        return display(HTML(_field(expected, tolerance, hint) if typed else _verdict(NOT_YET)))
    if _agree(answer, expected, tolerance):
        return display(HTML(_verdict(RIGHT)))
    if render_mode() == "test":
        raise AssertionError(f"check: {answer!r} is not {expected!r} within {tolerance}")
    display(HTML(_verdict(f"{WRONG} You have {html.escape(str(answer))}. {inline(hint)}")))


def _agree(answer, expected, tolerance):
    answer, expected = np.asarray(answer), np.asarray(expected)
    if answer.shape != expected.shape:
        return False
    if {answer.dtype.kind, expected.dtype.kind} <= set("biuf"):
        return np.allclose(answer, expected, rtol=0, atol=tolerance)
    return (answer == expected).all()


def _verdict(text):
    return f'<p class="vmc-check" role="status">{text}</p>'


def _field(expected, tolerance, hint):
    """Where the reader of a page types an answer; questions.js compares it."""
    data = json.dumps({"expected": np.ravel(expected).tolist(), "tolerance": tolerance})
    words = {"right": RIGHT, "wrong": f"{WRONG} {inline(hint)}", "empty": NOT_YET}
    several = f" ({np.size(expected)}, with spaces between)" if np.size(expected) > 1 else ""
    return (
        f'<form class="vmc-check" autocomplete="off" data-check="{html.escape(data)}" '
        f'data-words="{html.escape(json.dumps(words, ensure_ascii=False))}">'
        f'<label>Your answer{several}: <input type="text" size="12"></label> '
        f'<button>Check</button> <span role="status">{NOT_YET}</span></form>'
    )
