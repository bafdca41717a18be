"""What the page's Python does with lines that the reader has typed: run them, grade a function."""

import ast
from contextlib import redirect_stdout
from dis import get_instructions
from functools import lru_cache
from importlib import import_module
from io import StringIO
from types import CodeType
from typing import NamedTuple

import numpy as np

from page.python import absent
from vmc_lib.grading import (
    LONGEST,
    WRONG,
    deviation,
    feedback,
    in_words,
    line_of,
    own_law,
    reason,
    unreadable,
)

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


def run(above, typed, book="", figures=()):
    """How a chapter's cell ran with the reader's lines, Markdown, and what it printed.

    `book` are the lines that the book has there. Each of the `figures` is its number, the code
    before it as the reader has it and as the book has it, and its own cell. Where the lines do not
    give what the library gives (the notebook's `verify`), the answer names those that run them.
    """
    deviations = []
    verify = {"verify": lambda *given: deviations.append(deviation(*given))}
    said, printed = _run(typed, definitions(above, typed, known=verify))
    if not said and any(deviations):
        laws = _reassigned_names(_statements(typed), _statements(book))
        follow = [number for number, *code in figures if laws & {*changed_names(*code)}]
        said = own_law(sorted(laws), next(filter(None, deviations)), _figures_in_words(follow))
    agrees = ", and gives what the library gives" if deviations else ""
    return said or f"✓ It runs{agrees}.", printed[:LONGEST]


def _figures_in_words(figures):
    """Which figures, by their numbers, run a law of the reader's, in words."""
    if not figures:
        return "no figure of this page uses it"
    kind, verb = ("Figure", "runs") if len(figures) == 1 else ("Figures", "run")
    return f"{kind} {in_words(figures)} now {verb} yours"


def definitions(above, typed, errors=None, known=None):
    """The names that the lines `typed` need of a chapter's code: no other statement of it runs.

    Each runs by itself: where one needs what the page has not, its names are missing, and what it
    raised is added to `errors`. What makes names that are `known`, with their values, does not run.
    """
    names = {"__name__": "__main__"} | (known or {})
    for statement in needed_statements(above, typed, frozenset(known or ())):
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
    """A statement of a chapter, as it is compiled, and its `source` as Python reads it."""

    tree: ast.stmt
    code: CodeType
    source: str


def needed_statements(above, typed, known=frozenset()):
    """The statements of the code `above`, cell by cell, that the lines `typed` need, in order.

    The names that are `known` need none. What a function reads is read when it is called: of names
    that are given twice it needs the last.
    """
    lines, code = _statements(typed), [one for cell in above for one in _statements(cell)]
    late = set()
    while True:
        names, kept = set(late), []
        for statement in reversed(lines):
            names = _names_before(statement, names) - known
        for statement in reversed(code):
            if not names & set(statement.code.co_names):  # soon said: most are not needed
                continue
            if names & (_assigned_names(statement) | _mutated_names(statement.tree)):
                names = _names_before(statement, names) - known
                kept.append(statement)
        functions = [one for each in (*lines, *kept) for one in _functions(each.code)]
        more = {name for one in functions for name in _names(one, *READ)} - known
        if more <= late:
            return kept[::-1]
        late |= more


def _names_before(statement, names):
    """The names that must be there before a statement, so that these are after it."""
    always = not isinstance(statement.tree, ast.If | ast.For | ast.While | ast.With | ast.Try)
    assigned = _assigned_names(statement) if always else set()
    return names - assigned | {*_names(statement.code, *READ)}


def _assigned_names(statement):
    return set(_names(statement.code, "STORE_NAME"))


def changed_names(above, book, cell):
    """The names that a demo's cell needs, and that the reader's code gives otherwise."""
    return sorted(_reassigned_names(needed_statements(above, cell), needed_statements(book, cell)))


def _reassigned_names(statements, book):
    """The names that statements give, those of the book left out."""
    kept = {statement.source for statement in book}
    ours = [statement for statement in statements if statement.source not in kept]
    return {name for statement in ours for name in _assigned_names(statement)}


@lru_cache(1000)
def _statements(lines):
    """The statements of a cell; of an import each name, for others may be missing."""
    trees = []
    for one in [] if unreadable(lines) else ast.parse(lines).body:  # some are still being typed
        names = one.names if isinstance(one, ast.ImportFrom) else None
        trees += [ast.ImportFrom(one.module, [n], one.level) for n in names] if names else [one]
    return [_compile(tree) for tree in trees]


def _compile(tree):
    module = ast.fix_missing_locations(ast.Module([tree], []))
    return Statement(tree, compile(module, "above", "exec"), ast.unparse(tree))


def _functions(code):
    return [one for one in code.co_consts if isinstance(one, CodeType)]


def _names(code, *operations):
    """The names that compiled code and its functions read or assign by these operations."""
    codes = [code]
    while codes:
        code = codes.pop()
        yield from (x.argval for x in get_instructions(code) if x.opname in operations)
        codes += _functions(code)


def _mutated_names(tree):
    """The names of what a statement changes a part of."""
    parts = (x for x in ast.walk(tree) if isinstance(x, ast.Subscript | ast.Attribute))
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
            answers = tree.body and isinstance(tree.body[-1], ast.Expr)
            body = tree.body[:-1] if answers else tree.body
            exec(compile(ast.Module(body, []), "page", "exec"), names)  # noqa: S102
            if answers:
                last = ast.Expression(tree.body[-1].value)
                value = eval(compile(last, "page", "eval"), names)  # noqa: S307
                if value is not None:
                    print(repr(value))
        except AssertionError as error:
            line = line_of(error, "page")
            said = f"{WRONG} Line {line} no longer holds: `{_statement_at(line, tree)}`."
        except (Exception, SystemExit) as error:
            said = f"{WRONG} Line {line_of(error, 'page')} stops: {reason(error)}."
    return said, printed.getvalue()


def _statement_at(line, tree):
    """The whole statement, in one line, of which a line of the code is a part."""
    statements = (x for x in ast.walk(tree) if isinstance(x, ast.stmt))
    around = [x for x in statements if x.lineno <= line <= x.end_lineno]
    return " ".join(ast.unparse(max(around, key=lambda x: x.lineno)).split())
