"""What the chapters ask: predictions and quizzes, with why each is answered so.

Read from a chapter's notebook, where the run holds what came out (`vmc_lib.show.prose`).
"""

import re
from html import escape

from book._ext.plain import ANSWER, CHOICE, PREDICTION, QUIZ, WRITTEN_CAPTION
from kit.question import Question
from vmc_lib.show.figures import inline
from vmc_lib.show.prose import COMMENT

WORDS = 6  # of a question, in its name


def chapter_questions(cells):
    """The predictions and quizzes among a notebook's cells, as `Question`s in Markdown."""
    return [question for cell in cells if (question := _question(cell))]


def _question(cell):
    text = COMMENT.sub("", cell.source)
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


def bank_questions(notebook, chapter, demos=(), web=""):
    """The questions of a chapter, such as "07_muscle", {name: [Question]}.

    HTML, with formulas as KaTeX reads them; the right choice stands at another place each time. A
    prediction says where it stands, and leads to its figure's demo where that is among `demos`
    ("figure-7-1"), on the `web` if the kit lies there at an address.
    """
    title, number = notebook.cells[0].source.splitlines()[0].lstrip("# "), int(chapter[:2])
    questions, figures = {}, 0
    for place, cell in enumerate(notebook.cells):
        figures += bool(WRITTEN_CAPTION.match(cell.source))
        if not (question := _question(cell)):
            continue
        kind = "prediction" if question.level == "predict" else "quiz"
        words = re.findall(r"[a-z]+", question.text.lower())[:WORDS]
        name = "_".join([kind, str(len(questions) + 1), *words])  # as one would search for it
        question = _for_bank(question).with_choice_at(len(questions))
        if kind == "prediction":
            own = _has_figure(notebook.cells[place + 1 :])
            where = _where(title, f"{number}.{figures + own}", own, demos, web)
            question = question._replace(text=f"{question.text} {where}")
        questions[name] = [question]
    return questions


def _has_figure(cells):
    """Whether a figure comes before the next heading or prediction."""
    ends = (cell.source for cell in cells if re.search(r"^(#+ |\*\*(Figure|Predict))", cell.source))
    return bool(WRITTEN_CAPTION.match(next(ends, "")))


def _where(title, figure, own, demos, web):
    """A sentence, HTML: where in its chapter a prediction stands."""
    place = f"<em>{escape(title)}</em>, {'' if own else 'after '}Figure {figure}"
    demo = f"figure-{figure.replace('.', '-')}"
    if not own or demo not in demos:
        return f"({place})"
    file = f"demos/{demo}.html"
    if web:
        return f'({place}: <a href="{escape(web.rstrip("/"))}/{file}">its demo</a>)'
    return f"({place}: <code>{file}</code> of the kit)"


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
