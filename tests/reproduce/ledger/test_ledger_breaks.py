"""A row that holds can fail: make something wrong under it, and its verdict changes."""

import pytest

from reproduce import ledger
from reproduce.ledger import calibration, filters, loop, planning
from reproduce.ledger.entry import DIFFERS, NOT_COMPARED, measure
from tests.reproduce.ledger.mutations_of_moving import MOVING, RIVALS
from tests.reproduce.ledger.mutations_of_seeing import (
    SEEING,
    SEEING_RIVALS,
    learns_by_a_broken_recipe,
)

MUTATIONS, EVERY_RIVAL = SEEING | MOVING, SEEING_RIVALS | RIVALS
ROWS = {row.where: row for row in ledger.ROWS}
HOLDS = [
    e["where"] for e in ledger.load_results()["rows"] if e["verdict"] not in (DIFFERS, NOT_COMPARED)
]
CACHES = (
    planning.planned_error_ratios,
    planning.draws,
    planning.errors_3d,
    calibration.left_from_origins,
    calibration.robot_errors,
    filters.gabor_correlations,
    filters.layer_maps,
    loop.level_scores,
    loop.published_scores,
)


@pytest.fixture(autouse=True)
def _afresh():
    """What a row has measured is kept for the next: not across a break."""
    for function in CACHES:
        function.cache_clear()
    yield
    for function in CACHES:
        function.cache_clear()


CASES = [
    pytest.param(where, mutate, marks=[pytest.mark.audit] * (where != "Fig. 2"))
    for where in HOLDS
    for mutate in MUTATIONS[where]
]


@pytest.mark.parametrize(("where", "mutate"), CASES)
def test_verdict_changes_when_the_code_is_wrong(where, mutate, monkeypatch):
    mutate(monkeypatch)
    assert measure(ROWS[where])["verdict"] == DIFFERS


@pytest.mark.audit
@pytest.mark.parametrize(
    ("where", "rival", "says"),
    [(where, *pair) for where, found in EVERY_RIVAL.items() for pair in found.items()],
)
def test_a_row_says_what_it_makes_of_a_rival(where, rival, says, monkeypatch):
    rival(monkeypatch)
    assert measure(ROWS[where])["verdict"] == says


def test_the_recipe_that_is_whole_looks_like_gabors(monkeypatch):
    """The short training of the ablation, with all three tricks: it is the tricks that decide."""
    learns_by_a_broken_recipe(monkeypatch, "all three")
    assert measure(ROWS["Fig. 7"])["verdict"] != DIFFERS
