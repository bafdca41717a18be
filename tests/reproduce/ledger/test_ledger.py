"""The ledger: each row measured again and compared with the file."""

import re
from pathlib import Path

import numpy as np
import pytest

from book.figures.claims import ALL, claims
from reproduce import ledger, results
from reproduce.experiments.loop_evaluation import evaluate
from reproduce.ledger import loop
from reproduce.ledger.entry import (
    BEATEN,
    BY_CONSTRUCTION,
    DIFFERS,
    FITTED,
    NOT_COMPARED,
    REPRODUCED,
    VERDICTS,
    measure,
)
from reproduce.pipeline import smoke_run
from reproduce.pipeline.stored import RESTS_ON
from vmc_lib import data
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load
from vmc_lib.photos import LEVELS
from vmc_lib.statistics import t_interval

TIME = "Ours, time"
STORED = {entry["where"]: entry for entry in ledger.load_results()["rows"]}
NUMBERS = [q for entry in STORED.values() for q in entry["quantities"]]


def same(number):
    """A stored number or None, and what rounding on another machine may change of it."""
    return number if number is None else pytest.approx(number, rel=0.02, abs=1e-9)


def test_every_table_and_figure_of_the_paper_has_one_row():
    paper = [f"Table {n}" for n in ("I", "II", "III", "IV", "V", "VI")]
    paper += [f"Fig. {n}" for n in range(1, 14)]
    rows = [row.where for row in ledger.ROWS]
    assert list(STORED) == rows
    assert len(set(rows)) == len(rows)
    assert sorted(where for where in rows if where.startswith(("Table", "Fig."))) == sorted(paper)


def test_sixty_numbers_and_more_can_fail():
    compared = [q for q in NUMBERS if q["verdict"] not in (NOT_COMPARED, FITTED)]
    assert sum(not q["trivial"] for q in compared) >= 60
    for q in NUMBERS:
        assert q["trivial"] == (q["verdict"] == BY_CONSTRUCTION), q["name"]
        assert (q["claimed"] is None) == (q["verdict"] == NOT_COMPARED), q["name"]


def test_what_was_fitted_beats_nothing_and_what_was_practised_decides_nothing():
    for q in NUMBERS:
        assert not q["fitted"] or q["verdict"] not in (BEATEN, REPRODUCED), q["name"]
        assert "in-sample" not in q["name"]


@pytest.fixture(scope="module", autouse=True)
def _the_loop_as_it_ships():
    """The loop on all photos takes a while: `test_loop_scores_are_reproducible` runs a fourth."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loop, "level_scores", scores)
        yield


@pytest.fixture
def results_read(monkeypatch):
    """The names of the stored results that are read."""
    found, read = set(), data.read

    def watched(path):
        if Path(path).is_relative_to(results.FOLDER):
            found.add(Path(path).relative_to(results.FOLDER).with_suffix("").as_posix())
        return read(path)

    data.arrays.cache_clear()
    monkeypatch.setattr(data, "read", watched)
    return found


def test_every_number_with_an_interval_says_what_it_was_measured_on():
    assert [q["name"] for q in NUMBERS if q["low"] is not None and not q["sample"]] == []


def test_no_interval_of_a_share_passes_1():
    ends = "obtained", "low", "high", "least", "most"
    shares = [q for q in NUMBERS if q["name"].endswith((": precision", ": recall"))]
    assert len(shares) > 20
    for q in shares:
        assert all(0 <= q[end] <= 1 for end in ends if q[end] is not None), q["name"]


def _row(row):
    """A row as a case: those that take long wait for the audit."""
    long = row.where in (
        "V, robots",
        "Ours, robots",
        "Ours, space",
        "Table V",
        "Fig. 1",
        "Fig. 7",
        "Fig. 8",
        "IV A, search",
        "IV B, W²",
        "III, Block 3",
        TIME,
    )
    return pytest.param(row, marks=[pytest.mark.audit] * long, id=row.where)


@pytest.mark.parametrize("row", map(_row, ledger.ROWS))
def test_ledger_row_is_reproducible(row, results_read):
    measured, stored = measure(row), STORED[row.where]
    # the loop is not run here, but read from the ledger itself
    stale = {name for name in results_read - {"ledger"} if row.where not in RESTS_ON[name]}
    assert not stale, "say in `stored.RESTS_ON` that the row rests on it"
    assert [q["name"] for q in measured["quantities"]] == [q["name"] for q in stored["quantities"]]
    for now, then in zip(measured["quantities"], stored["quantities"], strict=True):
        assert now.keys() == then.keys()
        for key, value in now.items():
            if isinstance(value, float | int | dict) and not isinstance(value, bool):
                assert now["clock"] or value == same(then[key]), (now["name"], key)
            else:
                assert value == then[key], (now["name"], key)
    words = "where", "claim", "chapter", "verdict"
    assert {k: measured[k] for k in words} == {k: stored[k] for k in words}
    for text in ("because", "note"):
        assert _without_numbers(measured[text]) == _without_numbers(stored[text])


def _without_numbers(text):
    """A text with its numbers left out: those of quantities may round otherwise elsewhere."""
    return re.sub(r"\d+(\.\d+)?", "#", text)


def test_rows_that_differ_give_a_reason():
    for where, entry in STORED.items():
        assert bool(entry["because"]) == (entry["verdict"] == DIFFERS), where


def scores(level):
    """What ships of the loop's test photos: arrays (40,) of true or false, or of metres."""
    stored = ledger.load_results()["loop"][level]["scores"]
    return {k: np.array(v, bool if isinstance(v[0], bool) else float) for k, v in stored.items()}


@pytest.mark.audit
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
    stored = ledger.load_results()["loop"][level]
    assert loop.outcomes(scores(level)) == {k: stored[k] for k in ("summary", "failures")}


def test_ledger_values_are_found_by_name():
    row = ledger.load_results()["rows"][0]
    stored = row["quantities"][0]
    assert ledger.value(row["where"], stored["name"]).obtained == stored["obtained"]
    with pytest.raises(ValueError, match="no 'beauty'"):
        ledger.value("Fig. 1", "beauty")
    with pytest.raises(ValueError, match="no 'x'"):
        ledger.value("Fig. 99", "x")


def test_the_page_shows_every_row_and_every_number():
    entries = ledger.load_results()["rows"]
    page, lines = claims(ALL, ALL), ledger.verdict_counts(entries).splitlines()
    assert list(page) == list(ledger.PARTS)
    drawn = {line.address: (line.name, len(line.marks)) for part in page.values() for line in part}
    limits = sum(q["bound"] for q in NUMBERS)
    together = f"|together|{len(entries)}|{len(NUMBERS)}|{limits}|"
    assert lines[-1].replace(" ", "") == together
    assert len(drawn) == len(entries)
    for one in entries:
        compared = [q for q in one["quantities"] if q["verdict"] != NOT_COMPARED]
        assert drawn[ledger.anchor(one["where"])] == (one["where"], len(compared))
        text = ledger.details(one)
        assert f'id="{ledger.anchor(one["where"])}"' in text
        assert f"({one['chapter']}.ipynb)" in text
        assert all(q["name"] in text for q in one["quantities"])


def test_the_picture_is_filtered_by_verdict_and_part():
    found = {
        v: [m for ls in claims(v, ALL).values() for line in ls for m in line.marks]
        for v in VERDICTS
    }
    for v, marks in found.items():
        numbers = [q for q in NUMBERS if q["verdict"] == v != NOT_COMPARED]
        assert [mark.kind for mark in marks] == [v] * len(numbers)
    assert list(claims(DIFFERS, "What")) == ["What"]


def test_a_mark_is_ours_over_the_papers_or_on_a_scale_of_its_own():
    marks = [mark for lines in claims(ALL, ALL).values() for line in lines for mark in line.marks]
    for mark, q in zip(marks, [q for q in NUMBERS if q["claimed"] is not None], strict=True):
        assert mark.value * q["claimed"] == pytest.approx(q["obtained"] if q["claimed"] else 0)
        ends = [*mark.interval, *mark.wider, mark.value]
        assert min(ends) <= mark.value <= max(ends)
        assert q["claimed"] or max(map(abs, ends)) in (0, pytest.approx(1))
        assert q["claimed"] or mark.value * q["obtained"] >= 0


@pytest.mark.audit
def test_broydens_rule_counts_at_two_trials_and_hardly_at_four():
    """As *Ours, Table V* says of the pseudo-inverse: six draws of 25 movements."""
    left, past = {True: [], False: []}, load()
    for seed in range(6):
        habit = plan(draw_targets(past, 25, np.random.default_rng(seed)), past)
        for broyden, draws in left.items():
            error = broyden_calibration(habit, 4, broyden=broyden).error
            best = np.minimum.accumulate(error, axis=0).mean(axis=1)
            draws.append(best[[2, 4]] / best[0])
    (two, four), (half_two, half_four) = t_interval(np.subtract(left[False], left[True]))
    assert two > half_two
    assert abs(four) < half_four
