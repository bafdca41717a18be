"""Every example in a docstring runs and gives what it says."""

import ast
import doctest
import re
from importlib import import_module
from pkgutil import walk_packages

import pytest

import vmc_lib
from tests.project import ROOT, code, python, sample
from vmc_lib import show

MODULES = [module.name for module in walk_packages(vmc_lib.__path__, "vmc_lib.")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_a_module(name):
    failures, _ = doctest.testmod(import_module(name))
    assert failures == 0


@pytest.mark.parametrize("page", sample(["README.md", "book/library.md"], "README.md"))
def test_a_pages_python_sees_and_reaches(page):
    [lines] = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.S)
    sight, miss = python("-c", lines).splitlines()
    assert "a shuttlecock" in sight
    assert max(abs(float(part)) for part in miss.strip("[]").split()) < 0.02


def test_all_that_shows_has_an_example_that_runs():
    """In a docstring, or on the page on one's own demo."""
    page = ast.walk(ast.parse(code(ROOT / "book/your_demo.ipynb")))
    run = {node.id for node in page if isinstance(node, ast.Name)}
    examples = {name for name in show.__all__ if ">>> " in (getattr(show, name).__doc__ or "")}
    assert set(show.__all__) == (run | examples) & set(show.__all__)
