"""Compiled where it can be kept, and where it cannot."""

import os
import subprocess
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from vmc_lib.compiled import compiled

ROOT = Path(__file__).parents[1]
SOURCE = "def total(values):\n    s = 0.0\n    for v in values:\n        s += v\n    return s\n"


def define(source, **read):
    """What a source defines, whose functions read these values from outside."""
    exec(source, read)  # noqa: S102
    return SimpleNamespace(**read), read


def test_functions_without_a_file_are_compiled_without_a_cache():
    total = compiled(define(SOURCE)[0].total)  # no folder can hold what was compiled
    assert total((1.0, 2.5)) == total.__wrapped__((1.0, 2.5)) == 3.5


def test_numba_is_imported_at_the_first_call():
    code = "import sys, vmc_lib.loop; assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("expression", "first", "second"),
    [
        ("x * c", 2.0, 3.0),
        ("x * c[1]", np.array([1.0, 2.0]), np.array([1.0, 3.0])),
        ("x * c[0][1]", ((1, 2.0),), ((1, 3.0),)),
        ("c(x)", lambda x: 2 * x, lambda x: 3 * x),
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


def test_unsupported_arguments_affect_their_call_alone():
    total = compiled(define(SOURCE)[0].total)
    for _ in range(2):
        with pytest.warns(UserWarning, match="total runs as plain Python"):
            assert total(iter((1.0, 2.5))) == 3.5
    with warnings.catch_warnings(action="error"):
        assert total((1.0, 2.5)) == 3.5


def test_without_numba_loops_run_as_plain_python(monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    total = compiled(define(SOURCE)[0].total)
    with pytest.warns(UserWarning, match="without numba"):
        assert total((1.0, 2.5)) == 3.5


def test_disk_cache_is_not_used_for_changed_source(tmp_path):
    loop = "from law import law\nfrom vmc_lib.compiled import compiled\n"
    loop += "@compiled\ndef total(x):\n    return law(x) + 1.0\nprint(total(2.0))\n"
    (tmp_path / "loop.py").write_text(loop, encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
    results = []
    for law in ("x * 2", "x * 2", "x * 5"):
        (tmp_path / "law.py").write_text(f"def law(x):\n    return {law}\n", encoding="utf-8")
        command = [sys.executable, "loop.py"]
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, check=True, capture_output=True
        )
        results.append((float(done.stdout), len(list(tmp_path.rglob("*.nbc")))))
    assert results == [(5.0, 1), (5.0, 1), (11.0, 2)]


def test_disk_cache_survives_a_law_whose_module_is_gone(tmp_path):
    loop = (
        "import sys\nfrom importlib import import_module\nfrom vmc_lib.compiled import compiled\n"
    )
    loop += (
        "law = import_module(sys.argv[1]).law\n@compiled\ndef total(x):\n    return law(x) + 1.0\n"
    )
    (tmp_path / "loop.py").write_text(loop + "print(total(2.0))\n", encoding="utf-8")
    env = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
    for name in ("old_law", "new_law"):
        (tmp_path / f"{name}.py").write_text("def law(x):\n    return x * 2\n", encoding="utf-8")
        command = [sys.executable, "loop.py", name]
        done = subprocess.run(command, cwd=tmp_path, env=env, check=True, capture_output=True)
        assert float(done.stdout) == 5.0
        (tmp_path / f"{name}.py").unlink()
