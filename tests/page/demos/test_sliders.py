"""What the page works out for any position of a slider is what Python works out."""

import re
from functools import cache, partial

import matplotlib.pyplot as plt
import numpy as np
import pytest

from book.figures import crbm, granule, names, trade
from reproduce.experiments import localisation, recognition
from tests.page.demos.markup import move, numbers, on, polylines, words
from vmc_lib import photos
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.show import Slider, explore
from vmc_lib.what.crbm import CRBM

pytestmark = pytest.mark.browser
THRESHOLDS, ALLOWED = np.linspace(-2, 2, 41).round(2), np.linspace(0.1, 0.9, 41).round(2)
WIDTHS, X = np.geomspace(0.003, 0.15, 41), np.linspace(0.005, 0.235, 60)
LINE = X[:, None] + 0.01 * np.sin(20 * X[:, None]), 8 + 6 * np.sin(30 * X), X, np.arange(60)[::-1]
LEVELS = "rig", "free"
DRIVES, CUTS = np.linspace(-3, 3, 61).round(1), np.linspace(0.01, 0.99, 99).round(2)
CHANCES = {level: recognition.load_probabilities(level, "test") for level in ("rig", "varied")}


@cache
def detected(level):
    return [*localisation.detect_photos(level, "validation")]


@cache
def scored(level):
    return trade.scored_level(photos.load(level, "validation"), detected(level))


def excite(x, centres, width):
    return np.exp(-((x - centres.T) ** 2) / (2 * width**2))


def purkinje(active, answers, ridge):
    return np.linalg.solve(active.T @ active + ridge * np.eye(40), active.T @ answers)


RULES = excite, purkinje


def block_chances(drives):
    one = CRBM(np.ones((1, 1, 1, 1)), np.zeros(1), np.zeros(1))
    on, pooled = one.posterior(np.reshape(drives, (1, 1, 2, 2)))
    return [*on.ravel(), 1 - pooled.item()]


def declare():
    explore(
        lambda level, threshold, overlap: trade.trade(scored(level), threshold, overlap),
        "c",
        lambda level, threshold, overlap: trade.trade_in_words(scored(level), threshold, overlap),
        in_page=trade.trade_in_page({level: scored(level) for level in LEVELS}),
        level=[*LEVELS],
        threshold=Slider(THRESHOLDS, "threshold"),
        overlap=Slider(ALLOWED, "overlap"),
    )
    explore(
        partial(granule.bells, *RULES, *LINE),
        "c",
        in_page=granule.bells_in_page(*LINE),
        width=Slider(WIDTHS, "width"),
        lessons=Slider(range(2, 41), "lessons"),
        place=Slider(LINE[2], "place"),
    )
    explore(
        lambda **drives: crbm.block(block_chances([*drives.values()])),
        "c",
        in_page=crbm.block_in_page(),
        **{f"I{i}": Slider(DRIVES, f"drive {i}") for i in range(4)},
    )
    explore(
        lambda level, method, threshold: names.sorted_crops(
            CHANCES[level][0][method], CHANCES[level][1], threshold
        ),
        "c",
        in_page=names.sorted_crops_in_page(CHANCES, ["HOG", "CDBN, MP2"]),
        level=[*CHANCES],
        method=["HOG", "CDBN, MP2"],
        threshold=Slider(CUTS, "threshold"),
    )


@pytest.mark.parametrize("place", np.random.default_rng(6).integers(0, 41, (8, 2)).tolist())
def test_a_threshold_trades_precision_for_recall_as_in_python(page, place):
    level, (threshold, overlap) = ["rig", "free"][sum(place) % 2], place
    box = page.locator(".vmc-demo").nth(0)
    box.get_by_label(level).check()
    for name, at in zip(("threshold", "overlap"), place, strict=True):
        box.get_by_role("slider", name=name).fill(str(at))
    photo, plot = [picture.inner_html() for picture in box.locator(".vmc-picture").all()]
    threshold, overlap = THRESHOLDS[threshold], ALLOWED[overlap]
    kept = [localisation.keep_boxes(one, threshold, overlap) for one in detected(level)]
    precision, recall = localisation.precision_recall(scored(level).photos, kept)
    rates = re.findall(r"[\d.]+", words(plot)[-1])
    assert np.abs(np.float64(rates) - [precision, recall]).max() <= 0.005 + 1e-9
    drawn, figure = trade.trade(scored(level), threshold, overlap)
    plt.close(figure)
    assert sorted(numbers(photo, "rect")) == sorted(numbers(drawn, "rect"))
    assert len(numbers(photo, "rect")) == 2 * len(kept[trade.SHOWN])
    assert words(plot)[-1] in trade.trade_in_words(scored(level), threshold, overlap)
    curve = trade.trace(scored(level), overlap)[2]
    assert np.abs(polylines(plot)[0] - on(plot, curve)).max() < 0.2
    assert (
        np.abs(np.array(numbers(plot, "circle")[-1][:2]) - on(plot, [recall, precision])).max()
        < 0.2
    )


@pytest.mark.parametrize("place", np.random.default_rng(7).integers(0, 39, (20, 3)).tolist())
def test_granule_cells_answer_as_in_python(page, place):
    [seen], said = move(page, 1, *place)
    width, lessons, at = WIDTHS[place[0]], place[1] + 2, X[place[2]]
    some = LINE[3][:lessons]
    cells = GranuleCells(width, granule.CELLS).fit(LINE[0][some], LINE[1][some])
    needed = np.interp(X, LINE[0][:, 0], LINE[1])
    sums, active = cells.predict(X[:, None]), cells.excite([[at]])[0]
    off = abs(sums[place[2]] - needed[place[2]])
    mean = granule.off_by(*RULES, *LINE, width, lessons)
    assert words(seen)[-1] == f"off by {mean:.2f} mm on average, here by {off:.2f}"
    assert said.endswith(f"{words(seen)[-1]}.")
    *grey, need, drawn, error = polylines(seen)
    assert np.abs(need - on(seen, np.c_[X, needed])).max() < 0.1
    assert np.abs(drawn - on(seen, np.c_[X, sums.clip(-3, 16)])).max() < 0.1
    bells = [on(seen, np.c_[X, 3 * height - 3]) for height in cells.excite(X[:, None]).T[::3]]
    assert np.abs(np.subtract(grey, bells)).max() < 0.1
    dots = np.array(numbers(seen, "circle"))[:, :3]
    assert np.abs(dots[:40, 2] - 3 * active).max() < 0.006
    middles = on(seen, np.c_[cells.centres_[:, 0], np.full(40, -1.5)])
    assert np.abs(dots[:40, :2] - middles).max() < 0.1
    assert len(dots) == 40 + lessons
    assert len(error) == 2


@pytest.mark.parametrize("place", np.random.default_rng(8).integers(0, 61, (20, 4)).tolist())
def test_a_block_chooses_one_of_its_units_as_in_python(page, place):
    [seen], _ = move(page, 2, *place)
    chances = block_chances(DRIVES[place])
    pooled = 1 - chances[-1]
    shown = np.float64([text for text in words(seen)[-6:-1]])
    assert np.abs(shown - chances).max() <= 0.005 + 1e-6
    assert float(words(seen)[-1].split()[-1]) == pytest.approx(pooled, abs=0.0005 + 1e-6)
    corners = re.findall(r'<polygon points="([^"]*)"', seen)
    tops = [float(bar.split()[1].split(",")[1]) for bar in corners]
    assert np.abs(tops - on(seen, np.c_[np.arange(5), chances])[:, 1]).max() < 0.1


@pytest.mark.parametrize("place", np.random.default_rng(9).integers(0, 99, 20).tolist())
def test_a_line_between_crops_is_drawn_as_in_python(page, place):
    box = page.locator(".vmc-demo").nth(3)
    level, method = ["rig", "varied"][place % 2], ["HOG", "CDBN, MP2"][place // 2 % 2]
    for name in (level, method):
        box.get_by_label(name).check()
    box.get_by_role("slider").fill(str(place))
    seen = box.locator(".vmc-picture").inner_html()
    chances, truth = CHANCES[level][0][method], CHANCES[level][1]
    counts = recognition.confusion_counts(chances, truth, CUTS[place])
    shown = np.float64(re.findall(r"[\d.]+", words(seen)[-1]))
    assert np.abs(shown - recognition.rates_of_counts(counts)).max() <= 0.0005 + 1e-6
    dots = np.array(numbers(seen, "circle"))[:, :2]
    assert np.abs(dots - on(seen, np.c_[chances, names._spread(truth)])).max() < 0.1
    [upright] = polylines(seen)
    assert np.abs(upright[:, 0] - on(seen, [CUTS[place], 0])[0]).max() < 0.1
