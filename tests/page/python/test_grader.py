"""What is said of the lines that a reader types."""

import inspect
import json
import sys
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest

from page.python import absent
from page.python.grader import call, changed_names, check, definitions, run
from tests.exercises import EVERY
from vmc_lib.grading import EMPTY, RIGHT, WRONG, feedback

RATES = EVERY["ACTIVATION_RATES"]
NAME = "book.exercises.muscle.activation_rates"
IMPORT = ["import numpy as np\nimport nowhere"]
HEAD = "def activation_rates(u, a, rise, fall):\n"


def test_a_right_function_is_right():
    assert check(IMPORT, inspect.getsource(RATES.right), NAME) == (RIGHT, "")


@pytest.mark.parametrize(
    "last", ["return (u - a) / fall", "return 1", "return nothing", "return 1 / 0"]
)
def test_a_wrong_one_gets_what_the_notebook_says(last):
    names = {}
    exec(f"{HEAD}    {last}", names)  # noqa: S102
    said, _ = check([], f"{HEAD}    {last}", NAME)
    assert said == feedback(names["activation_rates"], RATES)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        (f"{HEAD}    return =", "cannot read line 2: invalid syntax"),
        (f"{HEAD}return 1", "cannot read line 2: expected an indented block"),
        ("x = 1\ny = unknown", "Line 2 stops: `NameError"),
        ("def f():\n    return 1 / 0\n\nf()", "Line 2 stops: `ZeroDivisionError"),
        ("f = 1", "define no function `activation_rates`"),
    ],
)
def test_lines_that_define_no_function_get_the_reason(typed, words):
    """Also where the chapter above has one of that name."""
    said, _ = check([f"{HEAD}    return 0"], typed, NAME)
    assert words in said


def test_an_exception_in_the_function_names_its_line():
    said, _ = check([], f"{HEAD}    rates = []\n    return rates[7]", NAME)
    assert "it stops in line 3: `IndexError: list index out of range`." in said


def test_what_is_printed_is_shown_not_for_ever():
    said, printed = check(["print('above')"], f"{HEAD}    print('here' * 999)", NAME)
    assert said == EMPTY
    assert printed.startswith("hereh")
    assert len(printed) == 2000


def test_the_code_above_has_run_where_it_is_needed():
    above = [
        "import math\nfrom nowhere import x",
        "half = 0.5\nlost = x\n\ndef area(r):\n    return math.pi * r**2",
        "not Python",
        "half = 2\nhalf = 0.5\nfew = [1, 2]\nfor k in range(2):\n    few[k] += half\nmath.e / 0",
        "unasked = 1",
    ]
    names = definitions(above, "def mine():\n    return area(1) + lost + few[0]")
    assert names["area"](1) == pytest.approx(3.1415926)
    assert names["few"] == [1.5, 2.5]
    assert not {"x", "lost", "unasked"} & names.keys()


def test_a_name_that_the_lines_give_themselves_is_not_asked_for():
    assert definitions(["def f():\n    return 1"], "def f():\n    pass\nf()").keys() == {"__name__"}


def test_what_the_reader_has_changed_is_found_where_it_is_needed():
    book = ["def f(x):\n    return x\n\n\ndef g(x):\n    return 1", "h = f(2)"]
    mine = [book[0].replace("return x", "return 2 * x"), book[1]]
    assert changed_names(mine, book, "print(h)") == ["f"]
    assert changed_names(mine, book, "print(g(1))") == []
    assert changed_names(book, [f"{book[0]}  # as it was", book[1]], "print(h)") == []


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("print(1)\n2 + 2", ("✓ It runs.", "1\n4\n")),
        ("assert area(1) < 4\nNone", ("✓ It runs.", "")),
        ("x = 1\nassert x == 2", (f"{WRONG} Line 2 no longer holds: `assert x == 2`.", "")),
        ("assert not (\n    1,\n)", (f"{WRONG} Line 1 no longer holds: `assert not (1,)`.", "")),
        ("verify(area(2), 12)", ("✓ It runs, and gives what the library gives.", "")),
        ("print(1)\nf(", (f"{WRONG} Python cannot read line 2: '(' was never closed.", "")),
    ],
)
def test_a_cell_runs_as_in_a_notebook(typed, words):
    assert run(["def area(r):\n    return 3 * r**2"], typed) == words


LAW = "def law(x):\n    return 2 * x\n\n\nverify(law(1), 2)"
HEAVY = "def heavier(x):\n    return law(x) + 1"


@pytest.mark.parametrize(
    ("cells", "effect"),
    [
        (["print(1)"], "no figure of this page uses it"),
        (["print(1)", "show(lambda: law(3))"], "Figure 7.2 now runs yours"),
        (["law(2)", "heavier(2)", "1"], "Figures 7.1 and 7.2 now run yours"),
        (["law(2)", "law(1)", "heavier(2)"], "Figures 7.1, 7.2 and 7.3 now run yours"),
    ],
)
def test_a_law_changed_on_purpose_is_told_which_figures_run_it(cells, effect):
    mine = LAW.replace("2 *", "5 *")
    figures = [(f"7.{n}", [HEAVY, mine], [HEAVY, LAW], one) for n, one in enumerate(cells, start=1)]
    said, printed = run([HEAVY], mine, LAW, figures)
    assert said == f"Your `law` differs from the book's, by at most 3: {effect}."
    assert printed == ""


def test_what_a_function_reads_is_the_last_that_is_given():
    """So a demo above a law runs the library's until the reader's is there, and then that."""
    above = ["rate = 1", "def draw():\n    return rate", "rate = 2", "unread = 3"]
    assert definitions(above, "draw()")["rate"] == 2
    assert definitions(above[:2], "draw()")["rate"] == 1
    assert "unread" not in definitions(above, "draw()")


def test_what_no_page_has_can_be_imported_and_does_nothing(monkeypatch):
    monkeypatch.setattr(absent, "NAMES", "nowhere nowhere.else json")
    for name in ("nowhere", "nowhere.else"):
        monkeypatch.setitem(sys.modules, name, None)
        monkeypatch.delitem(sys.modules, name)
    absent.stand_in()
    Widget = import_module("nowhere").Widget

    class Mine(Widget):
        pass

    assert not Mine().tag(sync=True)
    assert not Widget
    assert not hasattr(Widget, "__path__")
    assert json.loads("1") == 1


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("import nowhere.deep as deep", "NumPy alone: nowhere needs Python of your own`."),
        ("from nowhere import x", "NumPy alone: nowhere needs Python of your own`."),
        ("import json.nowhere", "No module named 'json.nowhere'"),
        (
            "import idle\nidle.linalg",
            "Line 1 stops: `ModuleNotFoundError: This page has NumPy alone",
        ),
        (
            "def f():\n    return input()\n\nf()",
            "Line 2 stops: `RuntimeError: This page cannot ask",
        ),
        ("quit()", "Nothing to leave here"),
        ("raise SystemExit", "Line 1 stops: `SystemExit`."),
    ],
)
def test_what_the_page_has_not_is_refused_in_words(monkeypatch, typed, words):
    monkeypatch.setitem(sys.modules, "idle", SimpleNamespace(fft=np.fft))
    assert words in run(["return 1", "from idle import fft"], typed)[0]
    assert run(["from idle import fft"], "import json\nfft.ifft([1.0])")[0] == "✓ It runs."


@pytest.mark.parametrize(
    ("last", "answer"),
    [
        ("return x + y.sum()", {"answer": [4.0, 5.0]}),
        ("return x / 0", {"error": "inf inf] is not finite"}),
        ("return z", {"error": "NameError"}),
    ],
)
def test_a_law_is_called_with_arrays(last, answer):
    above = ["import numpy as np\nimport nowhere", f"def law(x, y):\n    {last}"]
    with np.errstate(divide="ignore"):
        found = call(above, "law", [[1, 2], [3]])
    [(key, value)] = answer.items()
    assert found == answer if key == "answer" else value in found["error"]
