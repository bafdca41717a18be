"""Answers to exercises: a value, or a function that the reader writes, beside the right one.

A mistake that readers are known to make is kept as a wrong function, with the hint that it earns:
whose function gets the numbers that it gets is given that hint, whatever the lines look like. What
is wrong in another way is given a general hint (`vmc_lib.hints`), and the smallest case that fails.
"""

import inspect
from collections.abc import Callable
from functools import partial
from traceback import format_exception_only, walk_tb
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from vmc_lib.hints import difference, fault, numbers

_AROUND = " \t\"'“”‘’."  # a word may come in quotes, and end its sentence
NOT_YET, RIGHT, WRONG, UNREAD = "Not answered yet.", "✓ Right.", "✗ Not yet.", "Not read."
COMMA = "with a point, not with a comma"
CASES = 20
LONGEST = 2000  # characters of what lines printed that are shown
EMPTY = f"{NOT_YET} The function returns nothing."


class Exercise(NamedTuple):
    """A function to be written: the right one, its inputs, and known mistakes."""

    right: Callable  # the solution, as it is shown
    draw: Callable  # draw(rng): the arguments of one case, a tuple
    mistakes: dict  # {hint, Markdown: a wrong function}
    tolerance: float = 1e-6  # of each number, in its own unit


def agree(answer: Any, expected: Any, tolerance: float) -> bool:
    """Whether a reader's `answer` is `expected`, within `tolerance`; NaN is NaN.

    For one number a list or an array of one is taken as well.
    """
    if isinstance(expected, str):
        return isinstance(answer, str) and answer.strip(_AROUND).lower() == expected.lower()
    answer, expected = numbers(answer), np.asarray(expected, float)
    if answer is None:
        return False
    if expected.ndim == 0 and answer.size == 1:
        answer = answer.reshape(())
    return answer.shape == expected.shape and np.allclose(
        answer, expected, rtol=0, atol=tolerance, equal_nan=True
    )


def has_comma(answer: Any, expected: Any) -> bool:
    """Whether one number is `expected` and Python read two whole ones, as it reads 0,8."""
    two = isinstance(answer, tuple) and [*map(type, answer)] == [int, int]
    one = np.ndim(expected) == 0 and not isinstance(expected, str)
    return two and one


def deviation(ours, library, tolerance=1e-8):
    """How `ours` deviates from what the `library` gives, in words; "" where `np.allclose` holds.

    `library` is what `np.asarray` takes, or a tuple or dictionary of that; `ours` may be anything.
    """
    if isinstance(library, dict):
        if hasattr(ours, "keys") and not library.keys() <= {*ours.keys()}:
            return f"by its names: {in_words(map(str, library))} are asked for"
        ours, library = tuple(ours[key] for key in library), tuple(library.values())
    if isinstance(library, tuple):
        ours = tuple(ours) if np.iterable(ours) else (ours,)
        if len(ours) != len(library):
            return f"by its length, {len(ours)} instead of {len(library)}"
        pairs = zip(ours, library, strict=True)
        return next(filter(None, (deviation(*pair, tolerance) for pair in pairs)), "")
    ours, library = numbers(ours), np.asarray(library, float)
    if ours is None:
        return "by what cannot be read as numbers"
    if ours.shape != library.shape:
        return f"by its shape, {ours.shape} instead of {library.shape}"
    if not np.isfinite(library).all():
        return "whose numbers are not all finite here"
    if not np.isfinite(ours).all():
        return "by numbers that are not finite"
    if np.allclose(ours, library, atol=tolerance):
        return ""
    return f"by at most {np.abs(ours - library).max():.2g}"


def own_law(names, deviates, effect):
    """What a reader is told whose functions of these `names` deviate from the book's, Markdown.

    `deviates` says how (see `deviation`), and `effect` what now runs them.
    """
    whose = in_words(map(_code, names)) if names else "lines"
    verb = "differs" if len(names) == 1 else "differ"
    return f"Your {whose} {verb} from the book's, {deviates}: {effect}."


def in_words(texts):
    """Texts as a sentence lists them: a, b and c."""
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last


def feedback(function, exercise):
    """What `grade` says of a function, Markdown: `RIGHT`, `EMPTY`, or `WRONG` and a hint."""
    try:
        got = [_result(function, exercise, case) for case in range(CASES)]
    except (Exception, SystemExit) as error:  # whatever the reader's lines raise, they are told
        called = f"{exercise.right.__name__}{inspect.signature(exercise.right)}"
        line = line_of(error, getattr(getattr(function, "__code__", None), "co_filename", None))
        where = f" in line {line}" if line else ""
        return f"{WRONG} Called as {_code(called)}, it stops{where}: {reason(error)}."
    if all(result is None for result in got):
        return EMPTY
    wanted = [_result(exercise.right, exercise, case) for case in range(CASES)]
    alike = partial(agree, tolerance=exercise.tolerance)
    right = [*map(alike, got, wanted)]
    if all(right):
        return RIGHT
    for hint, mistake in exercise.mistakes.items():
        if all(alike(one, _result(mistake, exercise, case)) for case, one in enumerate(got)):
            return f"{WRONG} {hint}"
    case = min((case for case in range(CASES) if not right[case]), key=partial(_size, exercise))
    general = fault(got, wanted, alike) or difference(got[case], wanted[case])
    if not general and any(right):
        general = f"Right in {sum(right)} of {CASES} cases."
    example = _example(exercise, case, got[case], wanted[case])
    return " ".join(filter(None, (WRONG, general, example)))


def unreadable(lines):
    """Why Python cannot read lines, Markdown, or None."""
    try:
        compile(lines, "lines", "exec")
    except SyntaxError as error:
        where = f"line {error.lineno}" if error.lineno else "these lines"
        return f"{WRONG} Python cannot read {where}: {error.msg}."
    except (MemoryError, RecursionError):
        return f"{WRONG} Python cannot read these lines: they are nested too deep."
    return None


def reason(error):
    """An exception as the last line of a traceback has it, Markdown."""
    return _code(format_exception_only(error)[-1].strip())


def line_of(error, file):
    """The last line of a file that an exception came through, or None."""
    frames = walk_tb(error.__traceback__)
    return ([line for frame, line in frames if frame.f_code.co_filename == file] or [None])[-1]


def _inputs(exercise, case):
    """The arguments of a case, drawn anew for each function, which may change them."""
    return exercise.draw(np.random.default_rng(case))


def _result(function, exercise, case):
    with np.errstate(all="ignore"):  # a division by nought shows in the result
        return function(*_inputs(exercise, case))


def _size(exercise, case):
    """How many numbers a case has, and how long it is in words."""
    inputs = _inputs(exercise, case)
    return sum(map(np.size, inputs)), sum(len(_short(value)) for value in inputs)


def _example(exercise, case, got, wanted):
    """One case in words: its inputs, what is right, and what came instead."""
    names = inspect.signature(exercise.right).parameters
    inputs = zip(names, _inputs(exercise, case), strict=True)
    arguments = ", ".join(_code(f"{name} = {_short(value)}") for name, value in inputs)
    for digits in (4, 7, 10, 16):  # as few as tell them apart
        right, yours = _short(wanted, digits), _short(got, digits)
        if right != yours:
            break
    return f"Where {arguments}, {_code(right)} is right; yours gives {_code(yours)}."


def _short(value, digits=4):
    """A value in few words."""
    if callable(value):
        return "a function"
    if isinstance(value, str):
        return repr(value[:100])
    if isinstance(value, tuple | list):
        begins, ends = "[]" if isinstance(value, list) else "()"
        return f"{begins}{', '.join(_short(one, digits) for one in value[:25])}{ends}"
    if isinstance(value, SimpleNamespace):
        return ", ".join(f"{name}: {_short(one, digits)}" for name, one in vars(value).items())
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    if getattr(value, "size", 0) > 25:
        return f"numbers of shape {value.shape}"
    with np.printoptions(precision=digits, suppress=True):
        text = " ".join(str(value).split())
    if " at 0x" in text:
        return f"a {type(value).__name__}"
    return f"{text}, shape {value.shape}" if getattr(value, "ndim", 0) > 1 else text


def _code(text):
    return f"`{text.replace('`', chr(39))}`"
