"""What the chapters ask, for the bank: predictions and quizzes, with the feedback of each choice.

Read from a chapter's built page, as its run closes the predictions. A question that speaks of what
stands beside it on the page is left out.
"""

import re

from kit.key import ANSWER, CHOICE, QUESTION
from kit.question import Question

BESIDE = re.compile(
    r"\b(photo|map|plot|demo|figure|table)s?\b[^.]{0,20} (below|above)|\b(these|first) photos?\b"
    r"|\bthe (two|three|four|five|six) (above|below)\b|\bdemos?\b|\b(dashed|dotted|orange)\b",
    re.I,
)


def chapter_questions(page):
    """The questions of a page, {name: [Question]}: HTML, with formulas as KaTeX reads them."""
    questions = {}
    for kind, legend, inside in QUESTION.findall(page):
        if not BESIDE.search(_html(legend + " ".join(CHOICE.findall(inside)))):
            name = f"{'prediction' if kind == 'predict' else 'quiz'}_{len(questions) + 1}"
            questions[name] = [_question(kind, legend, inside).placed(len(questions))]
    return questions


def _question(kind, legend, inside):
    answers = ANSWER.findall(inside)
    if kind == "predict":
        [(_, _, outcome, why)] = answers
        choices = tuple(map(_html, CHOICE.findall(inside)))
        right, feedback = _html(outcome).removesuffix("."), ()
        hint, level = f"{_html(outcome)} {_html(why)}", "predict"
    else:
        choices = tuple(_html(answer) for _, answer, _, _ in answers)
        right = next(_html(answer) for state, answer, *_ in answers if state == "right")
        feedback = tuple(_html(why) for *_, why in answers)
        hint, level = "", "understand"
    return Question(_html(legend), right, 0.0, "", hint, choices, feedback, level, html=True)


def _html(text):
    """A line of HTML with emphasis and code, nothing else."""
    return " ".join(re.sub(r"<(?!/?(?:em|strong|code)>)[^>]*>", "", text).split())
