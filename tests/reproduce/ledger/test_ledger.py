"""The ledger: each row measured again and compared with the file."""

import numpy as np
import pytest

from reproduce import ledger
from reproduce.experiments.loop_evaluation import evaluate
from reproduce.ledger import entry, loop
from reproduce.ledger.entry import BEATEN, BY_CONSTRUCTION, DIFFERS, REPRODUCED, Quantity, measure
from reproduce.pipeline import smoke_run
from vmc_lib.photos import LEVELS

STORED = {entry["where"]: entry for entry in ledger.load()["rows"]}
NUMBERS = [q for entry in STORED.values() for q in entry["quantities"]]


def same(number):
    """A stored number or None, and what rounding on another machine may change of it."""
    return number if number is None else pytest.approx(number, rel=0.02, abs=1e-9)


def test_every_table_and_figure_of_the_paper_has_one_row():
    paper = [f"Table {n}" for n in ("I", "II", "III", "IV", "V", "VI")]
    paper += [f"Fig. {n}" for n in range(1, 13)]
    rows = [row.where for row in ledger.ROWS]
    assert list(STORED) == rows
    assert len(set(rows)) == len(rows)
    assert sorted(where for where in rows if where.startswith(("Table", "Fig."))) == sorted(paper)


def test_sixty_numbers_and_more_can_fail():
    assert sum(not q["trivial"] for q in NUMBERS) >= 60
    for q in NUMBERS:
        assert q["trivial"] == (q["verdict"] == BY_CONSTRUCTION), q["name"]


@pytest.mark.parametrize("row", ledger.ROWS, ids=lambda row: row.where)
def test_ledger_row_is_reproducible(row):
    measured, stored = measure(row), STORED[row.where]
    assert [q["name"] for q in measured["quantities"]] == [q["name"] for q in stored["quantities"]]
    for now, then in zip(measured["quantities"], stored["quantities"], strict=True):
        assert now["claimed"] == then["claimed"]
        assert now["verdict"] == then["verdict"], now["name"]
        for number in ("obtained", "in_sample", "low", "high", "p"):
            assert now["clock"] or now[number] == same(then[number]), (now["name"], number)
    assert measured["verdict"] == stored["verdict"]


@pytest.mark.parametrize("row", ledger.ROWS, ids=lambda row: row.where)
def test_rows_that_differ_give_a_reason(row):
    assert bool(row.differs) == (STORED[row.where]["verdict"] == DIFFERS)


def scores(level):
    """What ships of the loop's test photos: arrays (40,) of true or false, or of metres."""
    stored = ledger.load()["loop"][level]["scores"]
    return {k: np.array(v, bool if isinstance(v[0], bool) else float) for k, v in stored.items()}


@pytest.mark.parametrize("level", LEVELS)
def test_loop_scores_are_reproducible(level, tmp_path):
    """On every fourth, to be quick, photo by photo; one may round otherwise elsewhere."""
    some = range(0, 40, 4)
    smoke_run.copy_photos(tmp_path, {"test": some})
    now, then = evaluate(level, folder=tmp_path), scores(level)
    assert set(now) == set(then)
    for key, values in now.items():
        same = np.isclose(values, then[key][some], rtol=0.05, atol=5e-4, equal_nan=True)
        assert (~same).sum() <= 1, key


@pytest.mark.parametrize("level", LEVELS)
def test_loop_outcomes_follow_from_the_scores(level):
    stored = ledger.load()["loop"][level]
    assert loop.outcomes(scores(level)) == {k: stored[k] for k in ("summary", "failures")}


@pytest.mark.parametrize(
    ("claimed", "obtained", "better", "verdict"),
    [
        (0.9, 0.95, 0, REPRODUCED),
        (0.9, 1.05, 0, DIFFERS),
        (0.9, 0.95, 1, REPRODUCED),
        (0.9, 1.05, 1, BEATEN),
        (0.9, 0.50, 1, DIFFERS),
        (0.9, 0.50, -1, BEATEN),
        (0.9, 1.05, -1, DIFFERS),
    ],
)
def test_a_number_is_held_against_its_interval(claimed, obtained, better, verdict):
    ends = {"low": obtained - 0.1, "high": obtained + 0.1}
    assert Quantity("q", claimed, obtained, **ends, better=better).verdict == verdict


def test_rounding_widens_the_interval():
    assert Quantity("q", 0.595, 0.5954).verdict == DIFFERS
    assert Quantity("q", 0.595, 0.5954, rounding=0.0005).verdict == REPRODUCED


@pytest.mark.parametrize(
    ("obtained", "better", "p", "verdict"),
    [
        (0.8, -1, None, REPRODUCED),
        (0.95, -1, None, DIFFERS),  # the limit lies in the interval
        (0.8, 1, None, DIFFERS),
        (1.2, 1, None, REPRODUCED),
        (1.2, 1, 0.2, DIFFERS),
        (1.2, 1, 0.01, REPRODUCED),
    ],
)
def test_all_of_an_interval_is_beyond_a_limit(obtained, better, p, verdict):
    ends = {"low": obtained - 0.1, "high": obtained + 0.1, "p": p}
    assert Quantity("q", 1, obtained, **ends, better=better, bound=True).verdict == verdict


def test_verdict_of_a_row():
    trivial, good = entry.trivial_quantity("q", 1, 1), Quantity("q", 1, 1)
    better, worse = Quantity("q", 1, 2, better=1), Quantity("q", 1, 0)
    assert entry.verdict([trivial]) == BY_CONSTRUCTION
    assert entry.verdict([trivial, good]) == REPRODUCED
    assert entry.verdict([trivial, good, better]) == BEATEN
    assert entry.verdict([trivial, better, worse]) == DIFFERS
    assert entry.verdict([entry.trivial_quantity("q", 1, 2), good]) == DIFFERS, "a bug"


def test_the_wider_interval_of_trainings_over_photos_counts():
    alike, unlike = (
        entry.mean_of_trainings("q", 0.5, shares, n)
        for shares, n in (([0.5, 0.5, 0.5], 40), ([0.1, 0.5, 0.9], 10**6))
    )
    assert (alike.low, alike.high) == entry.wilson(20, 40)
    middle, half = entry.student([0.1, 0.5, 0.9])
    assert (unlike.low, unlike.high) == (middle - half, middle + half)


def test_ledger_values_are_found_by_name():
    row = ledger.load()["rows"][0]
    stored = row["quantities"][0]
    assert ledger.value(row["where"], stored["name"]).obtained == stored["obtained"]
    with pytest.raises(ValueError, match="no 'beauty'"):
        ledger.value("Fig. 1", "beauty")
    with pytest.raises(ValueError, match="no 'x'"):
        ledger.value("Fig. 99", "x")


def test_the_page_shows_every_row_and_every_number():
    entries = ledger.load()["rows"]
    page, lines = ledger.summary(entries), ledger.verdict_counts(entries).splitlines()
    assert len(page.splitlines()) == 2 + len(entries)
    assert lines[-1].replace(" ", "") == f"|together|{len(entries)}|{len(NUMBERS)}|"
    for one in entries:
        assert f"[{one['where']}]({one['chapter']}.ipynb)" in page
        assert all(q["name"] in ledger.details(one) for q in one["quantities"])
