"""The key: every prediction, quiz and exercise of a chapter with its answer.

All of it is read from the notebook, but for what only the run can say: the number that an exercise
wants and what its solution prints are read from the built page.
"""

import json
import re
from html import unescape
from importlib import import_module
from itertools import groupby

from bs4 import BeautifulSoup

from book._ext.plain import EXERCISE, FOLD
from kit.chapter_questions import chapter_questions
from kit.student import solves
from vmc_lib.grading import WRONG
from vmc_lib.show.questions import source

IMPORT = re.compile(r"^from (book\.exercises\.\w+) import", re.M)
SOLUTION = re.compile(r"^solution\((\w+)\)$", re.M)
HEADS = {"predict": "Predict first", "understand": "Quiz"}


def key(notebook, page):
    """The key of a chapter as Markdown, from its notebook and the HTML of its built page."""
    title = notebook.cells[0].source.splitlines()[0]
    questions = map(_question, chapter_questions(notebook.cells))
    return "\n\n".join([title, *questions, *_exercises(notebook, answers(page))]) + "\n"


def _question(question):
    """A prediction or a quiz: the choices, the right one in bold, and why."""
    reasons = [f": {reason}" for reason in question.feedback] or [""] * len(question.choices)
    lines = "\n".join(
        f"- **{choice}** ✓{reason}" if choice == question.answer else f"- {choice}{reason}"
        for choice, reason in zip(question.choices, reasons, strict=True)
    )
    why = f"\n\n{question.hint}" if question.hint else ""
    return f"### {HEADS[question.level]}: {question.text}\n\n{lines}{why}"


def markdown(html):
    """A line of HTML as Markdown: emphasis, code and maths, nothing else."""
    for tag, mark in {"em": "*", "strong": "**", "code": "`"}.items():
        html = re.sub(rf"</?{tag}>", mark, html)
    return unescape(re.sub(r"<[^>]+>", "", re.sub(r"\\[()]", "$", html))).strip()


def answers(page):
    """What a page says of its exercises, {label: (answer, what comes out)}, as Markdown and HTML.

    The answer is that of a field to type into: the number, or the word, that `check` wants.
    """
    found = {}
    for exercise in BeautifulSoup(page, "html.parser").select(".exercise"):
        solution = exercise.find_next_sibling(class_="solution")
        form, after = None, exercise
        while form is None and (after := after.find_next_sibling()) is not solution:
            form = after.select_one("form[data-check]")
        printed = solution.select(".cell_output :is(table, p:not(table p))")
        found[exercise["id"]] = _answer_of(form) if form else "", "\n\n".join(map(str, printed))
    return found


def _answer_of(form):
    """What a field accepts, and what it says to another answer."""
    check, words = json.loads(form["data-check"]), json.loads(form["data-words"])
    values = check["expected"] if isinstance(check["expected"], list) else [check["expected"]]
    shown = ", ".join(v if isinstance(v, str) else f"{v:.4g}" for v in values)
    unit = re.search(r"(?: in (.+?))?(?: \(\d+, with spaces between\))?:", form.label.get_text())[1]
    unit = f" {unit}" if unit else ""
    within = f" (± {check['tolerance']:.2g})" if check.get("tolerance", 0) > 1e-6 else ""
    hint = markdown(words["wrong"].removeprefix(WRONG))
    return f"\n\n**Answer.** {shown}{unit}{within}. Any other is told: {hint}"


def _exercises(notebook, found):
    """Each exercise, its answer, then its solution, text and code, and what that prints."""
    printed = ""
    for solving, cells in groupby(notebook.cells, solves):
        if solving:
            yield "**Solution.**"
        for cell in cells:
            text = FOLD.sub(r"\1", cell.source)
            if label := cell.metadata.get("exercise"):
                wanted, printed = found[label]
                yield f"### Exercise `{label}`\n\n{EXERCISE.sub('', text)}{wanted}"
            elif solving and (graded := SOLUTION.fullmatch(text)):
                yield from _solution_of(exercise_named(notebook, graded[1]))
            elif solving:
                yield text if cell.cell_type == "markdown" else f"```python\n{text}\n```"
        if solving and printed:
            yield f"It prints:\n\n{printed}"


def _solution_of(exercise):
    """The right function of a graded exercise, and what the page says to the known mistakes."""
    yield f"```python\n{source(exercise).strip()}\n```"
    if exercise.mistakes:
        hints = "\n".join(f"- {hint}" for hint in exercise.mistakes)
        yield f"Known mistakes, by what the page says to them:\n\n{hints}"


def exercise_named(notebook, name):
    """The chapter's graded exercise of that name."""
    module = next(match[1] for cell in notebook.cells if (match := IMPORT.search(cell.source)))
    return getattr(import_module(module), name)
