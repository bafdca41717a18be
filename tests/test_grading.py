"""What is said of a function that is wrong: its line, its smallest case, what differs, a hint."""

import inspect
import re
from types import SimpleNamespace

import numpy as np
import pytest

from tests.exercises import EVERY
from vmc_lib.grading import LONGEST, RIGHT, WRONG, Exercise, agree, feedback, unreadable
from vmc_lib.hints import FAULTS, fault
from vmc_lib.show import questions
from vmc_lib.show.questions import grade

each_exercise = pytest.mark.parametrize("name", EVERY, ids=str.lower)
CASES = [np.random.default_rng(k).uniform(1, 9, (3, 3)) for k in range(4)]


def near(answer, expected):
    return agree(answer, expected, 1e-6)


def said(function, name="COMBINE"):
    """What is said after *Not yet*, without the case."""
    text = feedback(function, EVERY[name])
    return text.removeprefix(f"{WRONG} ").partition(" Where ")[0]


@pytest.mark.parametrize(("hint", "spoil"), FAULTS, ids=[hint for hint, _ in FAULTS])
def test_each_fault_is_named(hint, spoil):
    right = CASES if hint.startswith("Rows") else [one[0] for one in CASES]
    assert fault(list(map(spoil, right)), right, near) == hint


def test_no_fault_explains_one_number_or_another_fault():
    right = [one[0] for one in CASES]
    for answers in ([3 * one for one in right], [1] * 4, [np.ones(3)] * 4):
        assert fault(answers, right, near) is None
    halves = [np.array([0.5, 0.5])] * 4
    assert fault([one.sum() for one in halves], halves, near) is None
    assert fault([1.0], [2.0], lambda *_: False) is None  # a number has no first, no order


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda right: -right, "The sign is wrong, everywhere."),
        (lambda right: right + 1e-5, "Nearly: it differs by 1e-05 at most."),
        (lambda right: str(right), "It returns a text, not numbers."),
        (lambda right: right.sum, "It returns a function, not numbers."),
        (
            lambda right: [right, right],
            "It returns a list of 2 numbers; one plain number is asked for.",
        ),
        (
            lambda right: [2.3 * right + 1],
            "It returns a list of 1 number; one plain number is asked for.",
        ),
        (lambda right: right * np.nan, "It is *nan*, not a number: a division of zero by zero?"),
        (lambda right: right if right < 1 else None, "Here it returns nothing"),
        (lambda right: min(right, 0.1), "Right in "),
        (lambda right: {right}, "What it returns cannot be read as numbers"),
    ],
)
def test_what_differs_is_said_first(spoil, words):
    right = EVERY["COMBINE"].right
    assert said(lambda *inputs: spoil(right(*inputs))).startswith(words)


def test_a_shape_is_told_from_a_number():
    right = EVERY["HONEST"].right
    assert said(lambda *x: right(*x)[:, None], "HONEST").startswith(
        "The right numbers, shape (2, 1)"
    )
    assert said(lambda *x: right(*x)[0], "HONEST") == "That is the first alone: all are asked for."
    assert said(lambda *_: 3.0, "HONEST") == "One number, shape () for (2,)."


def test_one_number_may_come_in_a_list_but_not_as_text():
    assert agree([0.8], 0.8, 1e-6)
    assert agree(np.array([[0.8]]), 0.8, 1e-6)
    assert not agree([0.8, 0.8], 0.8, 1e-6)
    assert not agree(0.8, [0.8], 1e-6)
    assert not agree("0.8", 0.8, 1e-6)
    assert not agree(0.8 + 1j, 0.8, 1e-6)


def test_nothing_is_no_number_and_nan_is_nan():
    assert not agree(None, np.nan, 1e-6)
    assert agree(np.nan, np.nan, 1e-6)


@each_exercise
def test_right_and_wrong_are_shown_in_digits_that_tell_them_apart(name):
    one = EVERY[name]
    for off in (1, 1e-2, 1e-5):
        text = feedback(lambda *x, off=off: np.asarray(one.right(*x), float) + off, one)
        [(right, yours)] = re.findall(r"`([^`]*)` is right; yours gives `([^`]*)`", text)
        assert right != yours


@each_exercise
def test_no_hint_of_an_exercise_is_given_for_a_constant(name):
    for constant in ([], [0], 0, 1, 0.5, -1, np.nan):
        text = feedback(lambda *_, constant=constant: constant, EVERY[name])
        assert not any(hint in text for hint in EVERY[name].mistakes)


def test_one_false_alarm_is_not_taken_for_percentages_that_are_not_rounded():
    def one_alarm(percents, most):
        printed = {n: round(100 * n / (n + 1), 1) for n in range(1, most + 1)}
        return [n for n in printed if (percents == printed[n]).all()]

    assert said(one_alarm, "POSSIBLE_COUNTS") == "It returns numbers, shape (0,) for (1,)."


def test_a_named_tuple_is_shown_as_a_tuple():
    one = Exercise(lambda x: (x, 2 * x), lambda rng: (rng.random(2),), {})
    text = feedback(lambda x: np.linalg.slogdet(np.diag(x)), one)
    assert re.search(r"yours gives `\(.*\)`", text)


def test_the_smallest_case_that_fails_is_shown():
    one = Exercise(lambda x: x.sum(), lambda rng: (np.arange(rng.integers(2, 9)),), {})
    assert "Where `x = [0 1 2]`, `3` is right" in feedback(lambda x: x.sum() * (len(x) < 3), one)


def test_an_exception_names_the_readers_own_line():
    def helper(x):
        return np.linalg.inv(x)  # numpy raises, deeper

    def mine(reports, errors):
        return helper(np.zeros((2, 2)))

    line = inspect.getsourcelines(helper)[1] + 1
    assert f"it stops in line {line}: `numpy.linalg.LinAlgError: Singular matrix`." in said(mine)


def test_leaving_python_does_not_end_it():
    def leave(reports, errors):
        raise SystemExit

    assert said(leave).endswith(": `SystemExit`.")


@pytest.mark.parametrize("lines", ["f(", "return 1", "def f():\nreturn 1"])
def test_lines_that_python_cannot_read_are_told(lines):
    assert unreadable(lines).startswith(f"{WRONG} Python cannot read line ")
    assert unreadable("x = 1") is None
    assert RIGHT not in unreadable(lines)


@pytest.mark.parametrize(("lines", "why"), [("\0", "null bytes"), ("-" * 20_000 + "1", "too deep")])
def test_lines_that_python_refuses_as_a_whole_have_no_number(lines, why):
    assert re.match(f"{WRONG} Python cannot read these lines: .*{why}", unreadable(lines))


@pytest.fixture
def live(outputs, monkeypatch):
    """What a notebook shows."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    return outputs(questions)


def test_a_notebook_does_not_grade_what_stood_before_lines_that_it_cannot_read(live, monkeypatch):
    one, cells = EVERY["COMBINE"], ["def combine(reports, errors):\n    return ("]
    kernel = SimpleNamespace(user_ns={"In": cells})
    monkeypatch.setattr(questions, "get_ipython", lambda: kernel)
    grade(one.right, one)
    cells += [inspect.getsource(one.right), "x = ("]
    grade(one.right, one)
    assert "Python cannot read line 2: '(' was never closed." in live[0]
    assert RIGHT in live[1]


def test_a_notebook_shows_the_beginning_of_what_a_function_prints(live, capsys):
    grade(lambda *_: print("here" * 100), EVERY["COMBINE"])
    assert capsys.readouterr().out.startswith("hereh")
    grade(lambda *_: print("here" * 100), EVERY["COMBINE"])
    assert len(capsys.readouterr().out) == LONGEST
