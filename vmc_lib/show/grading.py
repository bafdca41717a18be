"""Exercises in which the reader writes a function: `grade` runs it, `solution` shows ours.

A mistake that readers are known to make is kept as a wrong function, with the hint that it earns:
whose function gets the numbers that it gets is given that hint, whatever the lines look like.
"""

import inspect
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.figures import details, inline, markdown
from vmc_lib.show.questions import NOT_YET, RIGHT, WRONG, agree, verdict
from vmc_lib.show.render_mode import render_mode

CASES = 20
EMPTY = f"{NOT_YET} The function returns nothing."
NEEDS_KERNEL = "To have it checked, write it in [a running notebook](index.html)."


class Exercise(NamedTuple):
    """A function to be written: the right one, its inputs, and known mistakes."""

    right: Callable  # the solution, as it is shown
    draw: Callable  # draw(rng): the arguments of one case, a tuple
    mistakes: dict  # {hint, Markdown: a wrong function}
    tolerance: float = 1e-6  # of each number, in its own unit


def grade(function, exercise):
    """Show whether the reader's `function` does what an `Exercise` asks; if not, a hint.

    In a test (`VMC_RENDER_MODE=test`) a wrong one raises AssertionError.
    """
    message = feedback(function, exercise)
    if message.startswith(WRONG) and render_mode() == "test":
        raise AssertionError(f"grade: {message}")
    unread = message == EMPTY and render_mode() == "book"
    display(HTML(verdict(inline(NEEDS_KERNEL if unread else message))))


def solution(exercise):
    """Show our lines for an `Exercise`: in a notebook folded, as the page does it itself."""
    lines = f"```python\n{source(exercise)}```"
    if render_mode() == "book":
        markdown(lines)
    else:
        details("Show our lines", lines)


def source(exercise):
    """The lines of the right function."""
    return inspect.getsource(exercise.right)


def feedback(function, exercise):
    """What `grade` says of a function, Markdown: `RIGHT`, `EMPTY`, or `WRONG` and a hint."""
    try:
        got = _results(function, exercise)
    except Exception as error:  # whatever the reader's lines raise, the reader is told
        called = f"{exercise.right.__name__}{inspect.signature(exercise.right)}"
        return f"{WRONG} Called as {_code(called)}, it stops: {_code(repr(error))}."
    if all(result is None for result in got):
        return EMPTY
    wanted = _results(exercise.right, exercise)
    right = [agree(*pair, exercise.tolerance) for pair in zip(got, wanted, strict=True)]
    if all(right):
        return RIGHT
    for hint, mistake in exercise.mistakes.items():
        alike = zip(got, _results(mistake, exercise), strict=True)
        if all(agree(*pair, exercise.tolerance) for pair in alike):
            return f"{WRONG} {hint}"
    case = right.index(False)
    return f"{WRONG} {_example(exercise, case, got[case], wanted[case])}"


def _results(function, exercise):
    """What a function returns for each case; the inputs are drawn anew for each function."""
    cases = (exercise.draw(np.random.default_rng(case)) for case in range(CASES))
    with np.errstate(all="ignore"):  # a division by nought shows in the result
        return [function(*inputs) for inputs in cases]


def _example(exercise, case, got, wanted):
    """One case in words: its inputs, what is right, and what came instead."""
    names = inspect.signature(exercise.right).parameters
    inputs = zip(names, exercise.draw(np.random.default_rng(case)), strict=True)
    arguments = ", ".join(_code(f"{name} = {_short(value)}") for name, value in inputs)
    return f"Where {arguments}, {_code(_short(wanted))} is right; yours gives {_code(_short(got))}."


def _short(value):
    """A value in few words."""
    if callable(value):
        return "a function"
    if isinstance(value, tuple):
        return f"({', '.join(map(_short, value))})"
    if isinstance(value, float):
        return f"{value:.4g}"
    with np.printoptions(precision=4, suppress=True):
        text = " ".join(str(value).split())
    if getattr(value, "ndim", 0) < 2:
        return text
    return f"{text}, shape {value.shape}" if value.size <= 25 else f"numbers of shape {value.shape}"


def _code(text):
    return f"`{text.replace('`', chr(39))}`"
