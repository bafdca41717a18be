"""What the page's Python does with lines that the reader has typed: run them, grade a function."""

import ast
from contextlib import redirect_stdout
from dis import get_instructions
from importlib import import_module
from io import StringIO
from types import CodeType
from typing import NamedTuple

import numpy as np

from python_in_page import absent
from vmc_lib.grading import LONGEST, WRONG, feedback, line_of, reason, unreadable

absent.stand_in()  # before a chapter's code asks for them

READ = "LOAD_NAME", "LOAD_GLOBAL"


def check(above, typed, name):
    """What the notebook's `grade` would say of the lines `typed`, Markdown, and what they printed.

    `above` is the chapter's code before them, a text for each cell; `name` is the right
    function's, with its module.
    """
    module, _, function = name.rpartition(".")
    exercise, names = vars(import_module(module))[function.upper()], definitions(above, typed)
    names.pop(function, None)
    said, printed = _run(typed, names)
    if not said and function not in names:
        said = f"{WRONG} Your lines define no function `{function}`."
    if not said:
        with redirect_stdout(StringIO()) as more:
            said = feedback(names[function], exercise)
        printed += more.getvalue()
    return said, printed[:LONGEST]


def run(above, typed):
    """How a chapter's cell ran with the reader's lines, Markdown, and what it printed."""
    said, printed = _run(typed, definitions(above, typed))
    holds = ", and its `assert` holds" if "assert " in typed else ""
    return said or f"✓ It runs{holds}.", printed[:LONGEST]


def definitions(above, typed, errors=None, known=None):
    """The names that the lines `typed` need of a chapter's code: no other statement of it runs.

    Each runs by itself: where one needs what the page has not, its names are missing, and what it
    raised is added to `errors`. What makes names that are `known`, with their values, does not run.
    """
    names = {"__name__": "__main__"} | (known or {})
    for statement in needed(above, typed, frozenset(known or ())):
        try:
            with redirect_stdout(StringIO()):
                exec(statement.code, names)  # noqa: S102
        except Exception as error:
            if errors is not None and not isinstance(error, ImportError):
                errors.append(error)
    return names


def call(above, name, given):
    """What a function of the chapter's code answers to arrays: {"answer": lists} or {"error"}."""
    try:
        with redirect_stdout(StringIO()):
            answer = np.asarray(definitions(above, name)[name](*map(np.array, given)), float)
        if not np.isfinite(answer).all():
            raise ValueError(f"{answer} is not finite")
    except Exception as error:
        return {"error": repr(error)}
    return {"answer": answer.tolist()}


class Statement(NamedTuple):
    """A statement of a chapter: its `code`, and its `source` as Python reads it."""

    code: CodeType
    source: str


def needed(above, typed, known=frozenset()):
    """The statements of the code `above`, cell by cell, that the lines `typed` need, in order.

    The names that are `known` need none.
    """
    names, kept = set(), []
    for statement in reversed([*_statements(typed)]):
        names = _before(statement, _compiled(statement), names) - known
    for statement in reversed([one for lines in above for one in _statements(lines)]):
        code = _compiled(statement)
        if not names & set(code.co_names):  # soon said: most are not needed
            continue
        if names & (set(_names(code, "STORE_NAME")) | _changed(statement)):
            names = _before(statement, code, names) - known
            kept.append(Statement(code, ast.unparse(statement)))
    return kept[::-1]


def _before(statement, code, names):
    """The names that must be there before a statement, so that these are after it."""
    always = not isinstance(statement, ast.If | ast.For | ast.While | ast.With | ast.Try)
    given = set(_names(code, "STORE_NAME")) if always else set()
    return names - given | set(_names(code, *READ))


def changed(above, book, cell):
    """The names that a demo's cell needs, and that the reader's code gives otherwise."""
    kept = {statement.source for statement in needed(book, cell)}
    ours = [statement for statement in needed(above, cell) if statement.source not in kept]
    return sorted({name for statement in ours for name in _names(statement.code, "STORE_NAME")})


def _statements(lines):
    """The statements of a cell; of an import each name, for others may be missing."""
    for one in [] if unreadable(lines) else ast.parse(lines).body:  # some are still being typed
        if isinstance(one, ast.ImportFrom):
            yield from (ast.ImportFrom(one.module, [name], one.level) for name in one.names)
        else:
            yield one


def _compiled(statement):
    tree = ast.fix_missing_locations(ast.Module([statement], []))
    return compile(tree, "above", "exec")


def _names(code, *operations):
    """The names that compiled code and its functions read or assign by these operations."""
    codes = [code]
    while codes:
        code = codes.pop()
        yield from (x.argval for x in get_instructions(code) if x.opname in operations)
        codes += [x for x in code.co_consts if isinstance(x, CodeType)]


def _changed(statement):
    """The names of what a statement changes a part of."""
    parts = (x for x in ast.walk(statement) if isinstance(x, ast.Subscript | ast.Attribute))
    wholes = (ast.walk(x.value) for x in parts if isinstance(x.ctx, ast.Store))
    return {x.id for whole in wholes for x in whole if isinstance(x, ast.Name)}


def _run(typed, names):
    """Run the reader's lines: what is wrong with them, or None, and what they print and return."""
    if said := unreadable(typed):
        return said, ""
    names["__builtins__"] = absent.BUILTINS
    with redirect_stdout(StringIO()) as printed:
        try:
            tree = ast.parse(typed)
            last = [tree.body.pop()] if tree.body and isinstance(tree.body[-1], ast.Expr) else []
            exec(compile(tree, "page", "exec"), names)  # noqa: S102
            for expression in last:
                value = eval(compile(ast.Expression(expression.value), "page", "eval"), names)  # noqa: S307
                if value is not None:
                    print(repr(value))
        except AssertionError as error:
            line = line_of(error, "page")
            said = f"{WRONG} Line {line} no longer holds: `{typed.splitlines()[line - 1].strip()}`."
        except (Exception, SystemExit) as error:
            said = f"{WRONG} Line {line_of(error, 'page')} stops: {reason(error)}."
    return said, printed.getvalue()
