"""Questions to the reader: `predict` before a demo, `check` to test an answer.

Both are plain HTML that works in a live notebook, in the built page and on paper. The page also
remembers a prediction; and as it has no kernel to run the reader's line, `check` offers a field
to type the answer into.
"""

import html
import json
import re
import zlib

import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.figures import inline
from vmc_lib.show.markup import styled
from vmc_lib.show.render_mode import render_mode

# JupyterLab would take Enter as its own, and the answer would stay closed.
_OWN_KEYS = 'onkeydown="event.stopPropagation()"'
# A number, perhaps over another, and perhaps a unit or a per cent sign
_NUMBER = re.compile(r"([-+]?\d*[.,]?\d+)\s*(?:/\s*(\d*[.,]?\d+))?\s*(%|[^\W\d]*|°)")
_AROUND = " \t\"'“”‘’"  # a word may come in quotes
NOT_YET, RIGHT, WRONG = "Not answered yet.", "✓ Right.", "✗ Not yet."


def predict(question, choices, outcome, why):
    """Let the reader choose what a demo will show; what the run showed stays folded until asked.

    `question`, `choices` (two to four texts) and `why` are Markdown; `outcome` is the choice that
    the run itself worked out. Where `choices` maps each text to a number, `outcome` is a number,
    and the nearest is right. Raises ValueError for another number of choices, a choice that comes
    twice, an `outcome` that is none of them, or no `why`.
    """
    if isinstance(choices, dict) and np.isfinite(outcome):
        outcome = min(choices, key=lambda choice: abs(choices[choice] - outcome))
    if not 2 <= len(set(choices)) == len(choices) <= 4 or outcome not in choices or not why:
        raise ValueError(
            f"the prediction {question!r} needs two to four choices, a why, and its outcome "
            f"{outcome!r} among them: got {choices}"
        )
    name = f"predict-{zlib.crc32(question.encode()):08x}"  # stays while the question does
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
    display(
        HTML(
            styled(
                f'<div class="admonition tip">{title}<fieldset class="vmc-predict" {_OWN_KEYS}>'
                f"<legend>{inline(question)}</legend>{buttons}{verdict}</fieldset></div>"
            )
        )
    )


def check(answer, expected, tolerance=1e-6, hint=""):
    """Show whether the reader's `answer` is right.

    `expected` is a number, a text, or any nesting of numbers; a number may be off by `tolerance`,
    in its own unit. An answer with a None in it is not answered yet; a wrong one is shown the
    `hint` (Markdown) and, in a test (`VMC_RENDER_MODE=test`), raises AssertionError: running a
    chapter proves its solutions.
    """
    if _unanswered(answer):
        typed = render_mode() == "book" and isinstance(expected, (int, float, str, tuple))
        return display(HTML(_field(expected, tolerance, hint) if typed else verdict(NOT_YET)))
    if agree(answer, expected, tolerance):
        return display(HTML(verdict(RIGHT)))
    if render_mode() == "test":
        raise AssertionError(f"check: {answer!r} is not {expected!r} within {tolerance}")
    display(HTML(verdict(f"{WRONG} You have {html.escape(repr(answer))}. {inline(hint)}")))


def _unanswered(answer):
    """Whether an answer is None, or one within it is."""
    parts = answer.ravel() if isinstance(answer, np.ndarray) else answer
    several = isinstance(parts, np.ndarray | list | tuple)
    return answer is None or (several and any(map(_unanswered, parts)))


def agree(answer, expected, tolerance):
    """Whether a reader's `answer` is `expected`, as `check` has it; NaN is NaN."""
    if isinstance(expected, str):
        return isinstance(answer, str) and answer.strip(_AROUND).lower() == expected.lower()
    if isinstance(answer, str):
        return np.ndim(expected) == 0 and any(
            abs(value - expected) <= tolerance for value in readings(answer)
        )
    try:
        answer, expected = np.asarray(answer, float), np.asarray(expected, float)
    except (TypeError, ValueError):  # words among numbers, or rows of unequal length
        return False
    return answer.shape == expected.shape and np.allclose(
        answer, expected, rtol=0, atol=tolerance, equal_nan=True
    )


def readings(text):
    """The numbers that a typed answer may mean: "1/9", "11,5", "11.5 mm"; of "80 %", 80 and 0.8.

    Empty where it is no number. questions.js reads what is typed into a page by the same rule.
    """
    match = _NUMBER.fullmatch(text.strip().replace("−", "-"))
    if not match:
        return []
    over, under = (float(part.replace(",", ".")) for part in (match[1], match[2] or "1"))
    value = over / under if under else np.nan
    return [value, value / 100] if match[3] == "%" else [value]


def verdict(text):
    """A line that says how an answer is, HTML."""
    return styled(f'<p class="vmc-check" role="status">{text}</p>')


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
