"""The key: every prediction, quiz and exercise of a chapter with its answer.

Predictions and quizzes are read from the built page, for what comes out is the run's to say;
exercises and their solutions from the notebook.
"""

import re
from html import unescape
from importlib import import_module
from itertools import groupby

from book._ext.plain import EXERCISE, FOLD
from kit.student import solves
from vmc_lib.show.questions import source

QUESTION = re.compile(
    r'<fieldset class="vmc-(predict|quiz)".*?<legend>(.*?)</legend>(.*?)</fieldset>', re.S
)
CALL = re.compile(r"^(?:(?:show\.)?predict\(|\*\*Quiz\.\*\* )", re.M)
CHOICE = re.compile(r"<label[^>]*><input[^>]*>(.*?)</label>", re.S)
ANSWER = re.compile(
    r'<details class="vmc-(right|wrong)"><summary>(.*?)</summary>'
    r"\s*<p><strong>(.*?)</strong>(.*?)</p>\s*</details>",
    re.S,
)
IMPORT = re.compile(r"^from (book\.exercises\.\w+) import", re.M)
SOLUTION = re.compile(r"^solution\((\w+)\)$", re.M)
HEADS = {"predict": "Predict first", "quiz": "Quiz"}


def key(notebook, page):
    """The key of a chapter as Markdown, from its notebook and the HTML of its built page.

    ValueError where the page has other questions than the notebook.
    """
    title = notebook.cells[0].source.splitlines()[0]
    questions = [_question(*parts) for parts in QUESTION.findall(page)]
    calls = sum(len(CALL.findall(cell.source)) for cell in notebook.cells)
    if len(questions) != calls:
        raise ValueError(
            f"{title!r} asks {calls} questions, its built page {len(questions)}: make book first"
        )
    return "\n\n".join([title, *questions, *_exercises(notebook)]) + "\n"


def _question(kind, question, inside):
    """A prediction or a quiz: the choices, the right one in bold, and why."""
    answers = [tuple(map(markdown, parts)) for parts in ANSWER.findall(inside)]
    if kind == "predict":
        [(_, _, outcome, why)] = answers
        choices = [(markdown(choice), "") for choice in CHOICE.findall(inside)]
        right, why = outcome.removesuffix("."), f"\n\n{why}"
    else:
        choices = [(answer, f": {why}") for _, answer, _, why in answers]
        right, why = next(answer for state, answer, *_ in answers if state == "right"), ""
    lines = "\n".join(
        f"- **{choice}** ✓{reason}" if choice == right else f"- {choice}{reason}"
        for choice, reason in choices
    )
    return f"### {HEADS[kind]}: {markdown(question)}\n\n{lines}{why}"


def markdown(html):
    """A line of HTML as Markdown: emphasis, code and maths, nothing else."""
    for tag, mark in {"em": "*", "strong": "**", "code": "`"}.items():
        html = re.sub(rf"</?{tag}>", mark, html)
    return unescape(re.sub(r"<[^>]+>", "", re.sub(r"\\[()]", "$", html))).strip()


def _exercises(notebook):
    """Each exercise, then its solution, text and code."""
    for solving, cells in groupby(notebook.cells, solves):
        if solving:
            yield "**Solution.**"
        for cell in cells:
            text = SOLUTION.sub(lambda m: _solution(notebook, m[1]), FOLD.sub(r"\1", cell.source))
            if "exercise" in cell.metadata:
                yield f"### Exercise `{cell.metadata.exercise}`\n\n{EXERCISE.sub('', text)}"
            elif solving:
                yield text if cell.cell_type == "markdown" else f"```python\n{text}\n```"


def _solution(notebook, name):
    """The solution of the chapter's graded exercise of that name."""
    module = next(match[1] for cell in notebook.cells if (match := IMPORT.search(cell.source)))
    return source(getattr(import_module(module), name)).strip()
