"""Questions in GIFT, for Moodle: a category a question, named after chapter and level."""

import re
from itertools import zip_longest


def gift(bank):
    """The text of a GIFT file; `bank` maps (chapter, name) to the variants of a question.

    GIFT holds no pictures: questions with one are left out.
    A quiz that draws one question at random from a category gives each student other numbers.
    """
    return "\n\n".join(
        "\n\n".join(
            [
                f"$CATEGORY: {category(chapter, name, variants)}",
                *map(_item, item_names(f"{chapter} {name}", variants), variants),
            ]
        )
        for (chapter, name), variants in bank.items()
        if not variants[0].picture
    )


def category(chapter, name, variants):
    """Where Moodle keeps the variants of a question."""
    return f"$course$/{chapter}/{variants[0].level}/{name}"


def item_names(name, variants):
    """A name for each variant of a question."""
    return [f"{name} {k}" for k, _ in enumerate(variants, start=1)]


def _item(name, question):
    hint = f"\n####{_escape(question.hint)}" if question.hint else ""
    kind = "html" if question.html else "plain"
    prompt = f"::{_escape(name)}::[{kind}]{_escape(question.prompt)}"
    return f"{prompt} {{{_answers(question)}{hint}\n}}"


def _answers(question):
    if question.choices:
        return "".join(
            f"\n{'=' if text == question.answer else '~'}{_escape(text)}"
            f"{feedback and '#'}{_escape(feedback)}"
            for text, feedback in zip_longest(question.choices, question.feedback, fillvalue="")
        )
    return f"#{question.decimal(question.answer)}:{question.decimal(question.tolerance)}"


def _escape(text):
    """Text in which no character means anything to GIFT."""
    return re.sub(r"([~=#{}:\\])", r"\\\1", text)
