"""What the page's Python does with a function that the reader has typed: define it, grade it."""

import ast
from contextlib import redirect_stdout, suppress
from importlib import import_module
from io import StringIO

from vmc_lib.grading import WRONG, feedback

LONGEST = 2000  # characters of what was printed that are shown


def check(above, typed, name):
    """What the notebook's `grade` would say of the lines `typed`, Markdown, and what they printed.

    `above` is the chapter's code before them, a list of (lines, whether they are folded); `name`
    is the right function's, with its module.
    """
    module, _, function = name.rpartition(".")
    exercise, names = vars(import_module(module))[function.upper()], definitions(above)
    with redirect_stdout(StringIO()) as printed:
        said = _define(typed, function, names) or feedback(names[function], exercise)
    return said, printed.getvalue()[:LONGEST]


def definitions(above):
    """The names that a chapter's code defines: of its open cells, and what the folded ones import.

    Each statement runs by itself: where one needs what the page has not, its names are missing.
    """
    names = {"__name__": "__main__"}
    for lines, folded in above:
        with suppress(SyntaxError):  # in an earlier exercise
            for statement in ast.parse(lines).body:
                if not folded or isinstance(statement, ast.Import | ast.ImportFrom):
                    with suppress(Exception):
                        _run(ast.Module([statement], []), names)
    return names


def _define(typed, function, names):
    """Run the reader's lines; what is wrong with them before anything is called, or None."""
    names.pop(function, None)
    try:
        _run(typed, names)
    except SyntaxError as error:
        return f"{WRONG} Python cannot read line {error.lineno}: {error.msg}."
    except Exception as error:
        return f"{WRONG} Line {_line(error)} stops: `{error!r}`."
    return None if function in names else f"{WRONG} Your lines define no function `{function}`."


def _run(code, names):
    exec(compile(code, "page", "exec"), names)  # noqa: S102


def _line(error):
    """The last of the reader's own lines that an error came through."""
    trace, line = error.__traceback__, None
    while trace:
        line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == "page" else line
        trace = trace.tb_next
    return line
