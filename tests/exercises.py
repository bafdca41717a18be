"""The exercises in which a reader writes a function, of every chapter."""

from importlib import import_module

from tests.project import CHAPTERS
from vmc_lib.grading import Exercise


def exercises(chapter):
    """The graded exercises of a chapter, by name."""
    module = import_module(f"book.exercises.{chapter.stem[3:]}")
    return {name: one for name, one in vars(module).items() if isinstance(one, Exercise)}


EVERY = {name: one for chapter in CHAPTERS for name, one in exercises(chapter).items()}
