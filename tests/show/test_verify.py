"""A chapter's own functions beside the library's: an error in a build, words in a live notebook."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from vmc_lib.grading import deviation
from vmc_lib.show import verify

CELL = "def rate(x):\n    return {}\n\ndef respond(x):\n    return rate(x)\n\nverify(respond(1), 2)"


@pytest.fixture
def run(monkeypatch, outputs):
    """A function that runs a cell in a shell: what it says."""
    module = sys.modules["vmc_lib.show.verify"]
    cells, said = [], outputs(module)
    monkeypatch.setattr(module, "get_ipython", lambda: SimpleNamespace(user_ns={"In": cells}))
    monkeypatch.setattr(module, "_VERIFIED", {})

    def run(cell):
        cells.append(cell)
        del said[:]
        exec(cell, {"verify": verify})  # noqa: S102
        return "".join(said).split("</style>")[-1]

    return run


def test_a_live_notebook_names_what_has_changed_since_it_agreed(run, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    assert run(CELL.format("2 * x")) == ""
    said = run(CELL.format("5 * x"))
    words = "Your <code>rate</code> differs from the book's, by at most 3: the demos that use it"
    assert words in said
    assert "✗" not in said
    assert run(CELL.format("2 * x  # again")) == ""


def test_what_never_agreed_is_called_lines(run, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    assert "Your lines differ from the book's, by at most 1: " in run(CELL.format("3 * x"))


@pytest.mark.parametrize("mode", ["book", "test"])
def test_a_build_and_a_test_hold_a_chapter_to_the_library(run, monkeypatch, mode):
    monkeypatch.setenv("VMC_RENDER_MODE", mode)
    assert run(CELL.format("2 * x")) == ""
    with pytest.raises(AssertionError, match="by at most 3"):
        run(CELL.format("5 * x"))


@pytest.mark.parametrize(
    ("ours", "library", "words"),
    [
        ([1, 2], [1, 2 + 1e-9], ""),
        ([1, 2], [1, 4], "by at most 2"),
        ([[1, 2]], [1, 2], "by its shape, (1, 2) instead of (2,)"),
        (None, [1, 2], "by what cannot be read as numbers"),
        (np.array([1 + 5j]), [1], "by what cannot be read as numbers"),
        ([1], [np.nan], "whose numbers are not all finite here"),
        ([np.nan], [1], "by numbers that are not finite"),
        (([1], [2]), ([1], [3]), "by at most 1"),
        ({"a": 1, "b": 5}, {"a": 1}, ""),
        ({"a": 1}, {"a": 0.5}, "by at most 0.5"),
        ({"a": 1}, {"a": 1, "b": 2}, "by its names: a and b are asked for"),
        ((1, 2), (1, 2, 3), "by its length, 2 instead of 3"),
        (3, (1, 2, 3), "by its length, 1 instead of 3"),
    ],
)
def test_a_deviation_in_words(ours, library, words):
    assert deviation(ours, library) == words
