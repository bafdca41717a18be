"""The key: every prediction, quiz and exercise of a chapter with its answer.

Predictions and quizzes are read from the built page, for what comes out is the run's to say, and
so are the number that an exercise wants and what its solution prints. Exercises and their
solutions are the notebook's.
"""

import json
import re
from html import unescape
from importlib import import_module
from itertools import groupby

from bs4 import BeautifulSoup

from book._ext.plain import EXERCISE, FOLD
from kit.student import solves
from vmc_lib.grading import WRONG
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
    return "\n\n".join([title, *questions, *_exercises(notebook, answers(page))]) + "\n"


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
        found[exercise["id"]] = _wanted(form) if form else "", "\n\n".join(map(str, printed))
    return found


def _wanted(form):
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
                yield from _graded(exercise_named(notebook, graded[1]))
            elif solving:
                yield text if cell.cell_type == "markdown" else f"```python\n{text}\n```"
        if solving and printed:
            yield f"It prints:\n\n{printed}"


def _graded(exercise):
    """The right function of a graded exercise, and what the page says to the known mistakes."""
    yield f"```python\n{source(exercise).strip()}\n```"
    if exercise.mistakes:
        hints = "\n".join(f"- {hint}" for hint in exercise.mistakes)
        yield f"Known mistakes, by what the page says to them:\n\n{hints}"


def exercise_named(notebook, name):
    """The chapter's graded exercise of that name."""
    module = next(match[1] for cell in notebook.cells if (match := IMPORT.search(cell.source)))
    return getattr(import_module(module), name)
