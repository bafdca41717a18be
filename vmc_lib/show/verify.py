"""`verify`: a chapter's own functions beside the library's, and what is said where they differ.

The build and the tests hold a chapter to the library: there a difference is an error. A reader may
change a function on purpose: a live notebook says by how much, and the demos run the reader's.
"""

import ast
from typing import Any

from IPython import get_ipython
from IPython.display import HTML, display

from vmc_lib.grading import deviation, own_law
from vmc_lib.show.figures import inline
from vmc_lib.show.questions import verdict
from vmc_lib.show.render_mode import render_mode

_VERIFIED = {}  # functions by their names, as they were when they last agreed with the library


def verify(ours: Any, library: Any, tolerance: float = 1e-8) -> None:
    """Verify what a cell's own functions return against what the library's do.

    Both are arrays, or tuples or dictionaries of these, as `vmc_lib.grading.deviation` takes them.
    One call a cell, for it names the functions of its cell that the reader has changed. Outside a
    live kernel AssertionError where they differ by more than the `tolerance`.
    """
    deviates, functions = deviation(ours, library, tolerance), _functions()
    if not deviates:
        _VERIFIED.update(functions)
        return
    changed = [name for name, one in functions.items() if _VERIFIED.get(name, one) != one]
    words = own_law(changed, deviates, "the demos that use it now run yours")
    if render_mode() != "live":
        raise AssertionError(words)
    display(HTML(verdict(inline(words))))


def _functions():
    """The functions that the cell which now runs defines, {name: as Python reads it}."""
    shell = get_ipython()
    cell = ast.parse(shell.user_ns["In"][-1] if shell else "")
    return {one.name: ast.dump(one) for one in cell.body if isinstance(one, ast.FunctionDef)}
