"""Rows of the ledger are measured again in the page, by the ledger's own functions."""

import re
from functools import cache

import numpy as np
import pytest
from playwright.sync_api import expect

from page.python import measure
from reproduce import ledger, one_draw
from reproduce.experiments.calibration import MANY, SCENARIOS, load_results
from tests.page.python.conftest import ASK
from tests.pages import open_html
from tests.project import sample

ENTRIES = {entry["where"]: entry for entry in ledger.load_results()["rows"]}
QUICK = ["Fig. 9", "Ours, Eq. 5"]
draw_once = cache(measure.draw)


@pytest.mark.parametrize("where", one_draw.DRAWS)
def test_a_draw_has_numbers_of_its_row(where):
    draw = draw_once(where, 0)
    assert draw.keys() <= {q["name"] for q in ENTRIES[where]["quantities"]}
    assert f'data-where="{where}"' in ledger.details(ENTRIES[where])


@pytest.mark.parametrize("where", QUICK)
def test_the_ledgers_number_is_the_mean_of_its_draws(where):
    draws = [draw_once(where, seed) for seed in MANY]
    for name, text in measure.summary(draws).items():
        mean = np.mean([draw[name] for draw in draws])
        assert ledger.value(where, name).obtained == pytest.approx(mean, rel=0.02)
        assert re.fullmatch(r"[\d.]+ \([\d.]+ to [\d.]+\)", text)


def test_the_first_draw_is_the_one_that_ships():
    shipped = load_results()[SCENARIOS[0]]
    planned, own = draw_once("Table IV", 0), draw_once("Ours, Table V", 0)
    assert planned["planned error over reach, over the hold"] == pytest.approx(
        shipped["planned / reach"][0], abs=1e-4
    )
    for k in (1, 2, 4):
        now = own[f"error over planned, own off-line, {k} trials"]
        assert now == pytest.approx(shipped[f"own off-line, {k} trials"][0], abs=1e-4)


@pytest.fixture(scope="module")
def page(offline, site):
    forms = "".join(re.findall(r"<form.*</form>", ledger.details(ENTRIES[w]))[0] for w in QUICK)
    page = open_html(offline, site, f"<h1>L</h1>{forms}")
    page.evaluate(
        "() => { vmc['python/interpreter'].limit.seconds = 100 }"
    )  # others may be at work, too
    yield page
    page.close()
    assert page.errors == []


@pytest.mark.browser
@pytest.mark.parametrize("where", sample(QUICK, "Ours, Eq. 5"))
def test_the_pages_number_is_pythons(page, where):
    seen = page.evaluate(ASK, ["measure", "draw", where, 7])
    assert seen == pytest.approx(measure.draw(where, 7), rel=1e-6)


@pytest.mark.browser
def test_a_reader_measures_from_a_seed_on(page, serious):
    form = page.locator(".vmc-measure").first
    form.get_by_label("from seed").fill("41")
    form.get_by_role("button", name="Measure").click()
    expect(form.get_by_role("status")).to_have_text("Seeds 41 to 46.")
    [name] = measure.draw(QUICK[0], 0)
    now = measure.summary([measure.draw(QUICK[0], seed) for seed in range(41, 47)])[name]
    row = [name, ledger.result_text(ENTRIES[QUICK[0]]["quantities"][0]), now]
    measured = form.get_by_role("group", name="Measured again")
    assert measured.locator("td").all_inner_texts() == row
    assert serious(page, ".vmc-measure", all_of_it=True) == []


@pytest.mark.browser
def test_a_reader_stops_it(page):
    form = page.locator(".vmc-measure").nth(1)
    form.get_by_role("button", name="Measure").click()
    form.get_by_role("button", name="Stop").click()
    expect(form.get_by_role("status")).to_have_text("✗ Stopped.")
    expect(form.get_by_role("button", name="Stop")).to_be_disabled()
