"""Small models that the page fits and runs itself are those of Python."""

import re
from functools import partial

import matplotlib.pyplot as plt
import numpy as np
import pytest

from book.figures import regions, suppression
from reproduce.experiments import localisation
from tests.page.demos.markup import move, numbers, on, words
from tests.pages import drag, middle
from vmc_lib import photos
from vmc_lib.boxes import nms
from vmc_lib.show import Pad, Slider, explore

pytestmark = pytest.mark.browser
SHOT = photos.load("rig", "validation")[0]
FOUND = next(localisation.detect_photos("rig", "validation"))
BEST_FIRST = np.argsort(-FOUND.candidate_scores)[:24]
LIKELY, ALLOWED = FOUND.candidates[BEST_FIRST], np.linspace(0.1, 0.9, 81).round(2)
COSTS, PLACES, KERNELS = (
    np.geomspace(0.01, 100, 41),
    np.linspace(-4, 5, 91).round(1),
    ["linear", "rbf"],
)


def declare():
    explore(
        partial(suppression.suppression, SHOT.image, LIKELY),
        "c",
        in_page=suppression.suppression_in_page(SHOT.image, LIKELY),
        step=Slider(range(20), "step", 1),
        overlap=Slider(ALLOWED, "overlap allowed", 0.3),
    )
    explore(
        regions.margin_plot,
        "c",
        regions.margin_in_words,
        in_page=regions.margin_in_page(),
        cost=Slider(COSTS, "cost C", 0.1),
        kernel=KERNELS,
        yours=Pad(PLACES, PLACES, ("blueness", "roundness"), regions.YOURS),
    )


@pytest.mark.parametrize("place", np.random.default_rng(8).integers(0, (20, 81), (20, 2)).tolist())
def test_boxes_are_suppressed_step_by_step_as_in_python(page, place):
    step, overlap = place[0], ALLOWED[place[1]]
    [seen], said = move(page, 0, *place)
    drawn = suppression.suppression(SHOT.image, LIKELY, step, overlap)
    assert numbers(seen, "rect") == numbers(drawn, "rect")
    assert words(seen) == [text for text in words(drawn) if text]
    colours = re.compile(r'<rect[^>]*stroke="(#\w+)"')
    assert colours.findall(seen) == colours.findall(drawn)
    assert said == f"A photo with labels: {words(seen)[-1]}."


def test_the_overlap_allowed_has_any_value(page):
    box, image = page.locator(".vmc-demo").nth(0), SHOT.image
    step, overlap = box.get_by_role("slider").all()
    step.fill("4")
    for place in np.random.default_rng(3).uniform(0, 80, 20).round(1):
        overlap.dispatch_event("pointerdown")
        overlap.fill(str(place))
        allowed = Slider(ALLOWED, "").value_at(place)
        drawn = suppression.suppression(image, LIKELY, 4, allowed)
        assert words(box.locator(".vmc-picture").inner_html())[-1] == words(drawn)[-1]


def test_the_last_step_leaves_what_suppression_keeps():
    for overlap in ALLOWED[::10]:
        kept = [best for best, _ in suppression.rounds_of(LIKELY, overlap)]
        assert kept == nms(LIKELY, -np.arange(len(LIKELY)), overlap).tolist()


@pytest.mark.parametrize(
    "place", np.random.default_rng(9).integers(0, (41, 91, 91), (20, 3)).tolist()
)
@pytest.mark.parametrize("kernel", KERNELS)
def test_a_machine_between_two_clouds_is_that_of_python(page, place, kernel):
    cost, yours = COSTS[place[0]], PLACES[place[1:]]
    clouds, side, svm = regions.margin(cost, kernel, yours)
    svm.set_params(tol=1e-6).fit(clouds, side)
    labels, plane = np.where(side, 1, -1).tolist(), np.random.default_rng(0).uniform(-4, 5, (50, 2))
    alpha, scores, steps = page.evaluate(
        """([points, labels, cost, kernel, plane]) => {
          let reads = 0; // of the labels, two for each in a step
          const counted = new Proxy(labels, { get: (all, key) => (reads++, all[key]) });
          const { alpha, score } = vmc["demos/margin"].margin.fit(points, counted, cost, kernel);
          return [alpha, plane.map(score), reads / labels.length / 2];
        }""",
        [clouds.tolist(), labels, cost, kernel, plane.tolist()],
    )
    expected = np.zeros(40)
    expected[svm.support_] = abs(svm.dual_coef_[0])
    assert np.abs(alpha - expected).max() < 1e-3 * cost
    assert np.abs(scores - svm.decision_function(plane)).max() < 1e-3
    assert steps < 5000  # or the border would lag behind the reader's hand


@pytest.mark.parametrize("place", [(10, 0, 0), (10, 45, 45), (40, 80, 20)])
def test_the_border_is_drawn_where_the_score_is_zero(page, place):
    cost, yours = COSTS[place[0]], PLACES[[place[1], place[2]]]
    box = page.locator(".vmc-demo").nth(1)
    box.get_by_role("radio", name="rbf").check()
    for slider, at in zip(box.get_by_role("slider").all(), place, strict=True):
        slider.fill(str(at))
    plot, said = box.locator(".vmc-picture").inner_html(), box.locator(".vmc-pictures")
    *_, svm = regions.margin(cost, "rbf", yours)
    paths = [
        path
        for path in re.findall(r'<path d="(M[^"]*)" fill="none" stroke="var\(--vmc-grey\)', plot)
    ]
    lows, highs = on(plot, [(-4, -4), (5, 5)])
    for path, value in zip(paths, (-1, 0, 1), strict=True):
        ends = np.float64(re.findall(r"[\d.]+", path)).reshape(-1, 2)
        back = -4 + 9 * (ends - lows) / (highs - lows)
        assert np.abs(svm.decision_function(back) - value).max() < 0.03
    figure = regions.margin_plot(cost, "rbf", yours)
    assert figure.axes[0].get_title() in regions.margin_in_words(cost, "rbf", yours)
    plt.close(figure)
    here, there = (
        np.float64(re.findall(r"\d+(?:\.\d+)?", text))
        for text in (said.get_attribute("aria-label"), regions.margin_in_words(cost, "rbf", yours))
    )
    assert np.abs(here - there).max() <= 1  # a ring that hardly counts; the others are as in Python
    assert abs(here[-1] - there[-1]) <= 0.01


def test_the_readers_point_is_dragged(page):
    box = page.locator(".vmc-demo").nth(1)
    box.scroll_into_view_if_needed()
    handle, before = middle(box.locator(".vmc-handle")), box.locator("path").last.get_attribute("d")
    drag(page, handle, -60, -40)
    assert np.abs(np.subtract(middle(box.locator(".vmc-handle")), handle) - [-60, -40]).max() < 4
    assert box.locator("path").last.get_attribute("d") != before
