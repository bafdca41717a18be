"""What the chapters ask: predictions and quizzes, with why each is answered so.

Read from a chapter's notebook, where the run holds what came out (`vmc_lib.show.prose`).
"""

import re

from book._ext.plain import ANSWER, CHOICE, PREDICTION, QUIZ
from kit.question import Question
from vmc_lib.show.figures import inline
from vmc_lib.show.prose import COMMENT

WORDS = 6  # of a question, in its name
ON_ITS_PAGE = "needs-figure"  # the tag of a question that speaks of what stands beside it


def chapter_questions(cells):
    """The predictions and quizzes among a notebook's cells, as `Question`s in Markdown."""
    return [question for cell in cells if (question := _question(COMMENT.sub("", cell.source)))]


def _question(text):
    if prediction := PREDICTION.fullmatch(text):
        question, choices, outcome, why = prediction.groups()
        choices = tuple(CHOICE.findall(choices))
        return Question(question, outcome, hint=why, choices=choices, level="predict")
    if quiz := QUIZ.fullmatch(text):
        question, answers = quiz.groups()
        choices, marks, reasons = zip(*ANSWER.findall(answers), strict=True)
        right = choices[marks.index("✓")]
        return Question(question, right, choices=choices, feedback=reasons, level="understand")
    return None


def bank_questions(notebook):
    """The questions of a chapter that can be asked without its page, {name: [Question]}.

    HTML, with formulas as KaTeX reads them; the right choice stands at another place each time.
    """
    cells = (c for c in notebook.cells if ON_ITS_PAGE not in c.metadata.get("tags", ()))
    questions = {}
    for question in chapter_questions(cells):
        kind = "prediction" if question.level == "predict" else "quiz"
        words = re.findall(r"[a-z]+", question.text.lower())[:WORDS]
        name = "_".join([kind, str(len(questions) + 1), *words])  # as one would search for it
        questions[name] = [_for_bank(question).placed(len(questions))]
    return questions


def _for_bank(question):
    hint = f"{question.answer}. {question.hint}" if question.hint else ""
    return question._replace(
        text=_html(question.text),
        answer=_html(question.answer),
        hint=_html(hint),
        choices=tuple(map(_html, question.choices)),
        feedback=tuple(map(_html, question.feedback)),
        html=True,
    )


def _html(text):
    """Markdown as HTML with emphasis and code, nothing else."""
    return " ".join(re.sub(r"<(?!/?(?:em|strong|code)>)[^>]*>", "", inline(text)).split())
