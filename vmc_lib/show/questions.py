"""Questions to the reader: a `prediction` before a demo, `check` an answer, `grade` a function.

All are plain HTML that works in a live notebook, in the built page and on paper. The page also
remembers what was chosen or typed. As it has no kernel to run the reader's line, `check` offers a
field to type the answer into; a function is graded there by the page's own Python (`grade.js`).
"""

import html
import inspect
import json
import zlib
from collections.abc import Callable
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import numpy as np
from IPython import get_ipython
from IPython.display import HTML, display

from vmc_lib.checks import check_kind, is_within
from vmc_lib.grading import (
    COMMA,
    EMPTY,
    LONGEST,
    NOT_YET,
    RIGHT,
    UNREAD,
    WRONG,
    Exercise,
    agree,
    feedback,
    has_comma,
    unreadable,
)
from vmc_lib.show.answers import RULES, judge, scales_of
from vmc_lib.show.figures import details, inline, markdown
from vmc_lib.show.markup import with_style_sheet
from vmc_lib.show.render_mode import render_mode

# JupyterLab would take Enter as its own, and the answer would stay closed.
_OWN_KEYS = 'onkeydown="event.stopPropagation()"'


def question_name(kind, text):
    """The name of a question in a page: it stays while the question's text does."""
    return f"{kind}-{zlib.crc32(text.encode()):08x}"


def prediction(question, choices, outcome, why):
    """A question before a demo, as HTML: what came out stays folded until asked.

    `question`, `choices` (two to four texts), `outcome` (one of these) and `why` are Markdown.
    Raises ValueError for another number of choices, a choice that comes twice, an `outcome` that
    is none of them, or no `why`.
    """
    if not 2 <= len(set(choices)) == len(choices) <= 4 or outcome not in choices or not why:
        raise ValueError(
            f"the prediction {question!r} needs two to four choices, a why, and its outcome "
            f"{outcome!r} among them: got {choices}"
        )
    name = question_name("predict", question)
    buttons = "".join(
        f'<label class="vmc-{"right" if choice == outcome else "wrong"}">'
        f'<input type="radio" name="{name}" value="{html.escape(choice)}"> {inline(choice)}</label>'
        for choice in choices
    )
    verdict = (
        '<details class="vmc-right"><summary>What came out</summary>'
        f"<p><strong>{inline(outcome)}.</strong> {inline(why)}</p></details>"
    )
    title = '<p class="admonition-title">Predict first</p>'
    return (
        f'<div class="admonition tip">{title}<fieldset class="vmc-predict" {_OWN_KEYS}>'
        f"<legend>{inline(question)}</legend>{buttons}{verdict}</fieldset></div>"
    )


def check(
    answer: Any, expected: Any, tolerance: float = 1e-6, hint: str = "", unit: str = ""
) -> None:
    """Show whether the reader's `answer` is right.

    `expected` is a number, a text, or any nesting of numbers; a number may be off by `tolerance`,
    and is in `unit`. An answer with a None in it is not answered yet; a text is read as
    `answers.judge` does, and what it cannot read is not wrong; what is wrong is shown the `hint`
    (Markdown). Where no reader is (in the book and in a test) what is not right raises
    AssertionError: running a chapter proves its solutions.
    """
    if expected is None or not is_within(tolerance, 0, np.inf):
        raise ValueError(
            f"expected {expected!r} within {tolerance!r}: give what is right, and a number"
        )
    if _unanswered(answer):
        typed = render_mode() == "book" and isinstance(expected, (int, float, str, tuple))
        form = _field(expected, tolerance, hint, unit) if typed else verdict(NOT_YET)
        return display(HTML(form))
    comma = has_comma(answer, expected)
    if isinstance(answer, str) and not isinstance(expected, str):
        state = judge(answer, expected, tolerance, unit)
    elif comma:
        state = "unread"
    else:
        state = "right" if agree(answer, expected, tolerance) else "wrong"
    if state != "right" and render_mode() != "live":
        raise AssertionError(f"check: {answer!r} is not {expected!r} within {tolerance}: {state}")
    got = f"You have {html.escape(repr(answer))}. "
    words = _words(np.size(expected), got + inline(hint), unit)
    words |= {"unread": f"{UNREAD} Write the number {COMMA}."} if comma else {}
    display(HTML(verdict(words[state])))


def _words(count, hint, unit):
    """What is said of an answer in each state, HTML."""
    number = "a number" if count == 1 else f"{count} numbers"
    asked = f"in {html.escape(unit)}" if unit else "without a unit"
    return {
        "right": RIGHT,
        "wrong": f"{WRONG} {hint}",
        "unread": f"{UNREAD} Write {number}, as 0.25, 1/4 or 2.5e-1.",
        "unit": f"{UNREAD} Write it {asked}, please.",
        "empty": NOT_YET,
    }


def _unanswered(answer):
    """Whether an answer is None, or one within it is."""
    parts = answer.ravel() if isinstance(answer, np.ndarray) else answer
    several = isinstance(parts, np.ndarray | list | tuple)
    return answer is None or (several and any(map(_unanswered, parts)))


def verdict(text):
    """A line that says how an answer is, HTML."""
    return with_style_sheet(f'<p class="vmc-check" role="status">{text}</p>')


def _field(expected, tolerance, hint, unit):
    """Where the reader of a page types an answer; questions.js judges it."""
    if isinstance(expected, str):
        data, size = {"expected": expected.lower()}, 1
    else:
        values, size = np.ravel(expected).tolist(), np.size(expected)
        data = {"expected": values, "tolerance": tolerance}
        data |= {"scales": scales_of(unit), "rules": RULES}
    name = question_name("check", f"{data['expected']} {hint} {unit}")
    several = f" ({size}, with spaces between)" if size > 1 else ""
    asked = f" in {html.escape(unit)}" if unit else ""
    words = json.dumps(_words(size, inline(hint), unit), ensure_ascii=False)
    return (
        f'<form class="vmc-check" autocomplete="off" data-check="{html.escape(json.dumps(data))}" '
        f'data-words="{html.escape(words)}">'
        f'<label>Your answer{asked}{several}: <input type="text" name="{name}" size="12"></label> '
        f'<button>Check</button> <span role="status">{NOT_YET}</span></form>'
    )


def grade(function: Callable[..., Any], exercise: Exercise) -> None:
    """Show whether the reader's `function` does what an `Exercise` asks; if not, a hint.

    Lines that Python cannot read have left an older function there: it is not graded. Of what the
    function prints, on its many cases, the beginning is shown. Where no reader is (in the
    book and in a test) a wrong one raises AssertionError.
    """
    if not isinstance(exercise, Exercise):
        raise ValueError(f"{exercise!r} is no Exercise: give one of book.exercises, as printed")
    with redirect_stdout(StringIO()) as printed:
        message = unreadable(_last_lines(exercise.right.__name__)) or feedback(function, exercise)
    print(printed.getvalue()[:LONGEST], end="")
    if message.startswith(WRONG) and render_mode() != "live":
        raise AssertionError(f"grade: {message}")
    unread = message == EMPTY and render_mode() == "book"
    display(HTML(_buttons(exercise.right) if unread else verdict(inline(message))))


def _last_lines(name):
    """The last cell that a kernel was given to define a function of that name, or ""."""
    cells = get_ipython().user_ns["In"] if get_ipython() else []
    return next((cell for cell in reversed(cells) if f"def {name}(" in cell), "")


def explain_unknown_names(shell: Any) -> None:
    """Let a kernel's NameError say that the cell that defines the name could not be read.

    Called as the kernel starts: `grade(f, …)` itself is not entered where there is no `f`.
    """

    def explain(shell, kind, error, trace, tb_offset=None):
        if why := unreadable(_last_lines(error.name)):
            error.add_note(f"In the cell that defines {error.name}:{why.removeprefix(WRONG)}")
        shell.showtraceback((kind, error, trace), tb_offset=tb_offset)

    shell.set_custom_exc((NameError,), explain)


def _buttons(right):
    """What the page's Python checks the cell above with; grade.js shows it, and opens the cell."""
    return (
        f'<form class="vmc-check" data-function="{right.__module__}.{right.__name__}" hidden>'
        '<button>Check</button> <button type="button" name="stop" disabled>Stop</button> '
        '<button type="button" name="reset" disabled>Reset</button> '
        '<div role="status"></div></form>'
    )


def solution(exercise: Exercise) -> None:
    """Show our lines for an `Exercise`: in a notebook folded, as the page does it itself."""
    check_kind("exercise", exercise, Exercise, "one of book.exercises")
    lines = f"```python\n{source(exercise)}```"
    if render_mode() == "book":
        markdown(lines)
    else:
        details("Show our lines", lines)


def source(exercise):
    """The lines of the right function."""
    return inspect.getsource(exercise.right)
