"""A claim has one number: what a chapter sets beside the paper's is what the ledger sets there."""

import ast
from functools import cache

import numpy as np
import pytest

from reproduce import ledger
from reproduce.experiments import fresh_test_set, localisation, recognition
from reproduce.experiments.calibration import AS_PRINTED, SCENARIOS, load_results
from tests.project import CHAPTERS, ROOT, code_cells, each_chapter

CLAIMS = {"planned_error_ratio", "calibrated_error_ratio", "MEAN_ERROR"}
CLAIMS |= {"TABLE_1", "TABLE_2", "TABLE_3"}
SHARED = {"ledger.value", "load_results", "load_probabilities", "table_2"}  # as chapters call them
SHARED |= {f"localisation.{name}" for name in ("table_1", "table_2", "table_2_interval")}
SHARED |= {"recognition.table_3", "fresh_test_set.table_1"}
PAPER_ALONE = {  # cells that show what the paper prints, and no number of ours beside it
    "printed-sums",  # what Tables IV to VI add up to
    "six-experiments",  # a line in a figure
}


@cache
def cells(chapter):
    """The code cells of a chapter, by id: what each names, calls and defines."""
    return {cell.id: Names(ast.parse(cell.source)) for cell in code_cells(chapter)}


class Names:
    """What a piece of code mentions, and the names that it gives a value."""

    def __init__(self, tree):
        nodes = list(ast.walk(tree))
        names = [n for n in nodes if isinstance(n, ast.Name)]
        attributes = {n.attr for n in nodes if isinstance(n, ast.Attribute)}
        self.calls = {ast.unparse(n.func) for n in nodes if isinstance(n, ast.Call)}
        self.uses = attributes | {n.id for n in names}
        self.gives = {n.id for n in names if isinstance(n.ctx, ast.Store)}
        self.gives |= {n.name for n in nodes if isinstance(n, ast.FunctionDef)}
        self.values = [
            [a.value for a in n.args]
            for n in nodes
            if isinstance(n, ast.Call)
            and ast.unparse(n.func) == "ledger.value"
            and all(isinstance(a, ast.Constant) for a in n.args)
        ]


def rests_on(chapter, cell):
    """Whether a cell, or one that gives it a name, calls what the ledger calls."""
    code, waiting, visited = cells(chapter), [cell], set()
    while waiting:
        if SHARED & code[one := waiting.pop()].calls:
            return True
        visited.add(one)
        waiting += [k for k, c in code.items() if c.gives & code[one].uses and k not in visited]
    return False


@each_chapter
def test_claims_are_shown_beside_the_ledgers_number(path):
    for name, cell in cells(path).items():
        if CLAIMS & cell.uses and name not in PAPER_ALONE:
            assert rests_on(path, name), f"{path.stem}, {name}: ask `ledger.value`"


def test_ledger_has_the_values_that_chapters_show():
    shown = [names for path in CHAPTERS for cell in cells(path).values() for names in cell.values]
    assert shown
    assert np.isfinite([ledger.value(*names).obtained for names in shown]).all()


def test_the_shared_functions_give_the_ledgers_numbers():
    here = SCENARIOS[0]
    printed = f"{here}, {AS_PRINTED}"
    pairs = {
        ("Table IV", "planned error over reach"): (printed, "planned / reach"),
        ("Table IV", "planned error over reach, over the hold"): (here, "planned / reach"),
        ("Table V", f"error after over planned, {here}"): (printed, "off-line, published"),
        ("Ours, Table V", "error over planned, own off-line, 2 trials"): (
            here,
            "own off-line, 2 trials",
        ),
    }
    for names, (part, entry) in pairs.items():
        assert ledger.value(*names).obtained == pytest.approx(load_results()[part][entry].mean())
    for kernel, key in (("linear", "linear"), ("RBF", "rbf")):
        ours = fresh_test_set.table_1()[key].mean(axis=0)
        for k, measure in enumerate(("precision", "recall")):
            assert ledger.value("Table I", f"{kernel}: {measure}").obtained == pytest.approx(
                ours[k]
            )
    middle, _ = localisation.table_2_interval("rig", "improved")
    for name, row, recall in (
        ("published", "Table II", fresh_test_set.rates_by_seed("IoU")[:, 1].mean()),
        ("improved", "Ours, Table II", middle[1]),
    ):
        assert ledger.value(row, f"{name}, IoU: recall").obtained == pytest.approx(recall)


def test_chapter_6_and_the_ledger_ask_one_family_of_duels():
    corrected = {(one, other): p for one, other, *_, p in recognition.fresh_duels()}
    for method in ("HOG", "SIFT, bag of words"):
        q = ledger.value("IV B, features", f"errors of MP2 less those of {method}")
        assert q.p == pytest.approx(corrected["CDBN, MP2", method])
    calls = {call for cell in cells(ROOT / "book/06_names.ipynb").values() for call in cell.calls}
    assert "recognition.fresh_duels" in calls
    assert "recognition.mcnemar_tests" not in calls
