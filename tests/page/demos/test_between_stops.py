"""Between a slider's stops, too, what the page works out is what Python works out."""

import numpy as np
import pytest
from playwright.sync_api import expect

from book.figures import aiming, trade, votes, where
from reproduce.experiments import recognition
from tests.page.demos import test_drags as dragged
from tests.page.demos import test_sliders as slid
from tests.pages import drag, middle, open_url
from vmc_lib.show import Slider

pytestmark = pytest.mark.browser


def declare():
    dragged.declare()
    slid.declare()


def trade_words(threshold, overlap):
    return trade.trade_in_words(slid.scored("rig"), threshold, overlap)


def block_words(*drives):
    weights = np.exp([*drives, 0.0])
    return "Chances: " + ", ".join(f"{x:.2f}" for x in weights / weights.sum())


def line_words(threshold):
    chances, truth = slid.CHANCES["rig"][0]["HOG"], slid.CHANCES["rig"][1]
    counts = recognition.confusion_counts(chances, truth, threshold)
    precision, recall = recognition.rates_of_counts(counts)
    words = f"precision {precision + 1e-9:.3f}, recall {recall + 1e-9:.3f}"
    return words.replace("nan", "–")


DEMOS = {  # by its number in the page: its sliders' values, and words of Python's
    0: (
        [dragged.XS, dragged.YS, dragged.WIDE, dragged.HIGH],
        lambda *box: where.describe_overlap(dragged.CUP, box[:2], box[2:]),
    ),
    2: (
        [dragged.AROUND] * 2,
        lambda x, y: f"their sum is {votes.lean(np.array([x, y]), 4, False):.0f}° off.",
    ),
    3: (
        [dragged.ACROSS_SHOT, dragged.DOWN_SHOT],
        lambda *pixel: aiming.describe_aim(dragged.SHOT, np.array(pixel)),
    ),
    4: ([slid.THRESHOLDS, slid.ALLOWED], trade_words),
    6: ([slid.DRIVES] * 4, block_words),
    7: ([slid.CUTS], line_words),
}


@pytest.mark.parametrize("number", DEMOS)
def test_any_value_is_answered_as_in_python(page, number, rng):
    values, words = DEMOS[number]
    box = page.locator(".vmc-demo").nth(number)
    sliders, beside = (box.locator(f"[data-between]{k}") for k in ("", " + output"))
    for _ in range(8):
        places = [round(rng.uniform(0, len(v) - 1), 1) for v in values]
        for slider, place in zip(sliders.all(), places, strict=True):
            slider.dispatch_event("pointerdown")
            slider.fill(str(place))
        there = [Slider(v, "").value_at(place) for v, place in zip(values, places, strict=True)]
        assert words(*there) in box.locator(".vmc-pictures").get_attribute("aria-label")
        shown = [text.replace("−", "-") for text in beside.all_inner_texts()]
        np.testing.assert_allclose(np.float64(shown), there, rtol=1e-3, atol=1e-3)


def test_a_handle_stays_under_the_hand_and_keys_go_from_stop_to_stop(page):
    box = page.locator(".vmc-demo").nth(0)
    box.scroll_into_view_if_needed()
    across, *others = box.locator("[data-between]").all()
    for slider in (across, *others):
        slider.fill("5")
    handle = box.locator(".vmc-handle").first
    place = middle(handle)
    drag(page, place, 21, 13)
    assert np.abs(np.subtract(middle(handle), place) - [21, 13]).max() < 1
    between = across.input_value()
    assert float(between) % 1
    across.press("Tab")
    assert across.input_value() == between
    across.press("ArrowRight")
    assert float(across.input_value()) % 1 == 0


def test_a_link_leads_between_stops(page):
    box = page.locator(".vmc-demo").nth(0)
    slider, pictures = box.locator("[data-between]").first, box.locator(".vmc-pictures")
    slider.dispatch_event("pointerdown")
    slider.fill("5.3")
    link = box.locator(".vmc-link").get_attribute("href")
    words = pictures.get_attribute("aria-label")
    slider.press("ArrowRight")
    page.evaluate("(link) => { location.hash = ''; location.hash = link }", link)
    expect(slider).to_have_value("5.3")
    other = open_url(page.context, f"{page.url.split('#')[0]}{link}")
    there = other.locator(".vmc-demo").nth(0)
    assert there.locator("[data-between]").first.input_value() == "5.3"
    assert there.locator(".vmc-pictures").get_attribute("aria-label") == words
    other.close()
