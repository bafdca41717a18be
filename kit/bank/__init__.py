"""Question templates of each chapter: a module is named as its chapter, without the number.

Texts are plain, so that any learning platform shows them; answers are computed by the book's own
functions.
"""

from importlib import import_module

from book.figures.plans import NAMES
from kit.question import Template


def templates(chapter):
    """The `Template`s of a chapter, such as "07_muscle", in the order of its module."""
    module = import_module(f"kit.bank.{chapter.split('_', 1)[1]}")
    return [value for value in vars(module).values() if isinstance(value, Template)]


def bank(chapters=NAMES):
    """The public variants of every question, {(chapter, name): [Question]}, in the book's order."""
    return {
        (chapter, template.name): template.variants()
        for chapter in chapters
        for template in templates(chapter)
    }
