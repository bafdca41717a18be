"""Numba-compiled loops: their cache, changed constants, and plain Python where Numba is missing."""

import sys
import warnings
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from tests.project import ROOT, python, sample
from vmc_lib.compiled import _content, compiled

SOURCE = "def total(values):\n    s = 0.0\n    for v in values:\n        s += v\n    return s\n"


def define(source, **read):
    """What a source defines, whose functions read these values from outside."""
    exec(source, read)  # noqa: S102
    return SimpleNamespace(**read), read


def test_functions_without_a_file_are_compiled_without_a_cache():
    total = compiled(define(SOURCE)[0].total)  # no folder can hold what was compiled
    assert total((1.0, 2.5)) == total.__wrapped__((1.0, 2.5)) == 3.5


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (np.float32(1), np.float32(2)),
        (frozenset({1, 2}), frozenset({1, 3})),
        ((np.array([1.0]),), (np.array([1.0 + 1e-12]),)),
        (lambda x, *, by=1: x, lambda x, *, by=2: x),
    ],
)
def test_values_that_differ_have_different_contents(one, other):
    """Or the machine code of the one would be taken for the other's."""
    assert repr(_content(one)) != repr(_content(other))


@pytest.mark.parametrize(
    ("expression", "first", "second"),
    [
        ("x * c", 2.0, 3.0),
        ("x * c[1]", np.array([1.0, 2.0]), np.array([1.0, 3.0])),
        ("x * c[0][1]", ((1, 2.0),), ((1, 3.0),)),
        ("x * c", np.float32(2), np.float32(3)),
        ("c(x)", lambda x: 2 * x, lambda x: 3 * x),
        ("sum([c * y for y in (x, x)])", 1.0, 2.0),
        ("sum([c(y) for y in (x, x)])", lambda x: x, lambda x: 3 * x),
        ("x * c(x)", lambda x, by=2.0: by, lambda x, by=3.0: by),
    ],
)
def test_changed_constants_and_functions_are_compiled_again(expression, first, second):
    functions, space = define(
        f"def inner(x):\n    return {expression}\ndef outer(x):\n    return inner(x)\n", c=first
    )
    outer = compiled(functions.outer)
    for value in (first, second, first):
        space["c"] = value
        assert outer(1.5) == outer.__wrapped__(1.5)
    assert outer(1.5) == 3.0


def test_a_changed_number_of_a_module_is_compiled_again():
    laws = ModuleType("laws")
    product = compiled(define("def product(x):\n    return x * laws.c\n", laws=laws)[0].product)
    for laws.c in (2.0, 3.0, 2.0):
        assert product(1.5) == 1.5 * laws.c


def test_unsupported_arguments_affect_their_call_alone():
    total = compiled(define(SOURCE)[0].total)
    for _ in range(2):
        with pytest.warns(UserWarning, match="total runs as plain Python"):
            assert total(iter((1.0, 2.5))) == 3.5
    with warnings.catch_warnings(action="error"):
        assert total((1.0, 2.5)) == 3.5


def test_without_numba_loops_run_as_plain_python_and_say_so_once(monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    one, other = (compiled(define(SOURCE)[0].total) for _ in range(2))
    with warnings.catch_warnings(record=True, action="default") as warned:
        assert one((1.0, 2.5)) == 3.5
        assert other((1.0, 2.5)) == 3.5
    assert ["without numba" in str(each.message) for each in warned] == [True]


LOOP = """
import sys
from importlib import import_module

from vmc_lib.compiled import compiled


@compiled
def total(x):
    return law(x) + 1.0


for name in sys.argv[1:]:
    law = import_module(name).law
    print(total(2.0))
"""


@pytest.fixture
def run_loop(tmp_path):
    """A function: what the loop gives with a law, and how many files the cache then holds.

    Before it, in the same process, the loop may run with others.
    """
    (tmp_path / "loop.py").write_text(LOOP, encoding="utf-8")

    def run_loop(name, expression, **before):
        laws = before | {name: expression}
        for law, text in laws.items():
            written = f"def law(x):\n    return {text}\n"
            (tmp_path / f"{law}.py").write_text(written, encoding="utf-8")
        environment = {"PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
        *_, total = python("loop.py", *laws, cwd=tmp_path, **environment).split()
        for law in laws:
            (tmp_path / f"{law}.py").unlink()
        return float(total), len(list(tmp_path.rglob("*.nbc")))

    return run_loop


def test_loops_are_plain_python_for_a_debugger(run_loop, tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    for expression in ("x * 2", "__import__('sys')._getframe().f_lineno * 2"):  # numba has none
        assert run_loop("law", expression) == (5.0, 0)


def test_disk_cache_is_not_used_for_changed_source(run_loop):
    totals = [run_loop("law", expression) for expression in ("x * 2", "x * 2", "x * 5")]
    assert totals == [(5.0, 1), (5.0, 1), (11.0, 2)]


def test_disk_cache_survives_a_law_whose_module_is_gone(run_loop):
    assert [run_loop(name, "x * 2")[0] for name in ("old_law", "new_law")] == [5.0, 5.0]


LONG = " + ".join(f"1e-9 * x ** 0.{power}" for power in range(10, 90))  # too long to be inlined


def test_code_from_the_disk_calls_its_own_law(run_loop):
    """Though this process has compiled another, of the same name."""
    alone, _ = run_loop("one", f"x * 2 + {LONG}")
    after, _ = run_loop("one", f"x * 2 + {LONG}", other=f"x * 5 + {LONG}")
    assert after == alone == pytest.approx(5)


def empty(file):
    file.write_bytes(b"")


def cut(file):
    file.write_bytes(file.read_bytes()[:-20])


def foreign(file):
    file.write_bytes(b"words" * 1000)


def unwritable(file):
    file.unlink()
    file.mkdir()


@pytest.mark.parametrize("kind", sample(["nbi", "nbc"], "nbc"))
def test_a_damaged_disk_cache_is_made_anew(run_loop, tmp_path, kind):
    run_loop("law", "x * 2")
    [file] = tmp_path.rglob(f"*.{kind}")
    for harm in (empty, cut, foreign, unwritable):
        harm(file)
        assert run_loop("law", "x * 2")[0] == 5.0, harm
        assert file.is_dir() if harm is unwritable else file.stat().st_size > 500
