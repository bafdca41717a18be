"""Exercises that grade code: ours passes, a known mistake gets its hint, all else is told."""

import inspect
import re
from importlib import import_module
from pathlib import Path

import nbformat
import numpy as np
import pytest

from vmc_lib.show.grading import EMPTY, Exercise, feedback
from vmc_lib.show.questions import RIGHT, WRONG

BOOK = Path(__file__).parents[1] / "book"
CHAPTERS = sorted(BOOK.glob("[0-9]*.ipynb"))


def exercises(chapter):
    """The graded exercises of a chapter, by name."""
    module = import_module(f"book.exercises.{chapter.stem[3:]}")
    return {name: one for name, one in vars(module).items() if isinstance(one, Exercise)}


EVERY = {name: one for chapter in CHAPTERS for name, one in exercises(chapter).items()}


@pytest.fixture(params=EVERY, ids=str.lower)
def exercise(request):
    return EVERY[request.param]


def test_our_solution_passes(exercise):
    assert feedback(exercise.right, exercise) == RIGHT


def test_every_known_mistake_gets_its_own_hint(exercise):
    assert len(exercise.mistakes) >= 3
    for hint, mistake in exercise.mistakes.items():
        assert feedback(mistake, exercise) == f"{WRONG} {hint}"


def test_an_empty_function_is_not_answered_yet(exercise):
    assert feedback(lambda *_: None, exercise) == EMPTY


def test_what_fails_is_told_in_a_sentence(exercise):
    def fails(*_):
        raise IndexError("no such row")

    called = f"`{exercise.right.__name__}{inspect.signature(exercise.right)}`"
    assert feedback(fails, exercise) == (
        f"{WRONG} Called as {called}, it stops: `IndexError('no such row')`."
    )
    assert "it stops: `TypeError" in feedback(3, exercise)


@pytest.mark.parametrize("result", [np.zeros((7, 7)), [1, [2, 3]], "words", np.nan, [], {}])
def test_what_cannot_be_right_is_set_beside_what_is(exercise, result):
    said = feedback(lambda *_: result, exercise)
    assert said.startswith(f"{WRONG} Where ")
    assert all(f"`{name} = " in said for name in inspect.signature(exercise.right).parameters)
    assert "is right; yours gives" in said
    assert len(said) < 900


def test_inputs_that_a_function_changes_do_not_spoil_the_next(exercise):
    def spoils(*inputs):
        for one in inputs:
            if isinstance(one, np.ndarray):
                one[:] = 0
        return 0

    feedback(spoils, exercise)
    assert feedback(exercise.right, exercise) == RIGHT


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_a_chapter_grades_two_functions_or_more(path):
    """Each has an empty function of the solution's name and inputs, a grade, and the solution."""
    found = exercises(path)
    assert len(found) >= 2
    code = "\n".join(
        cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"
    )
    for name, one in found.items():
        asked = one.right.__name__
        inputs = ", ".join(inspect.signature(one.right).parameters)
        assert re.search(
            rf"^def {asked}\({inputs}\):\n(?: .*\n|\n)*?    \.\.\.  # your", code, re.M
        )
        assert f"grade({asked}, {name})" in code
        assert f"solution({name})" in code
        assert 3 <= len(inspect.getsource(one.right).splitlines()) <= 12
