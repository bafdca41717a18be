"""The ledger says what a run says: every row measured again and compared with the file."""

import pytest

from reproduce import ledger
from reproduce.ledger import whole
from reproduce.ledger.entry import Quantity, measure
from vmc_lib.loop import RULES
from vmc_lib.photos import LEVELS

STORED = {entry["where"]: entry for entry in ledger.load()["rows"]}


def same(number):
    """A stored number or None, and what rounding on another machine may change of it."""
    return number if number is None else pytest.approx(number, rel=0.02, abs=1e-9)


def test_every_table_and_figure_of_the_paper_has_one_row():
    wanted = [f"Table {n}" for n in ("I", "II", "III", "IV", "V", "VI")]
    wanted += [f"Fig. {n}" for n in range(1, 13)]
    rows = [row.where for row in ledger.ROWS]
    assert list(STORED) == rows and len(set(rows)) == len(rows)
    assert sorted(where for where in rows if where.startswith(("Table", "Fig."))) == sorted(wanted)


@pytest.mark.parametrize("row", ledger.ROWS, ids=lambda row: row.where)
def test_row_is_what_a_run_gives(row):
    measured, stored = measure(row), STORED[row.where]
    assert [q["name"] for q in measured["quantities"]] == [q["name"] for q in stored["quantities"]]
    for now, then in zip(measured["quantities"], stored["quantities"], strict=True):
        assert now["claimed"] == then["claimed"]
        for number in ("obtained", "in_sample"):
            assert now[number] == same(then[number]), (now["name"], number)
    assert measured["state"] == stored["state"]


@pytest.mark.parametrize("row", ledger.ROWS, ids=lambda row: row.where)
def test_a_reason_stands_where_and_only_where_we_differ(row):
    assert bool(row.differs) == (STORED[row.where]["state"] == "differs")


@pytest.mark.parametrize("level", LEVELS)
def test_the_loop_on_the_test_photos_is_what_a_run_gives(level):
    now, then = whole.fate(level), ledger.load()["loop"][level]
    medians = ("target", "planned", *RULES)  # in m; the others are shares of forty photos
    for key, value in now["summary"].items():
        slack = 0 if key in medians else 0.03
        assert value == pytest.approx(then["summary"][key], rel=0.05, abs=slack), key
    for rule, stages in now["failures"].items():
        moved = sum(a != b for a, b in zip(stages, then["failures"][rule], strict=True))
        assert moved <= 0.05 * len(stages), rule


@pytest.mark.parametrize(
    ("claimed", "obtained", "better", "agrees"),
    [
        (0.9, 0.95, 0, True),
        (0.9, 1.05, 0, False),
        (0.9, 1.00, 1, True),
        (0.9, 0.50, 1, False),
        (0.9, 0.50, -1, True),
        (0.9, 1.10, -1, False),
    ],
)
def test_agreement_has_a_direction(claimed, obtained, better, agrees):
    quantity = Quantity("q", claimed, obtained, tolerance=0.1, better=better)
    assert quantity.agrees == agrees
