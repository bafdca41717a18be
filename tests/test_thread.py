"""The running thread: one photo, one arm, one miss, above every chapter and at the end."""

import json
import re

import pytest

from book.figures import thread
from page.arm.live import PHOTO_1
from tests.pages import BUILT, NUMBERED, above_sections, open_url
from vmc_lib.show.packed import unpack_bytes

pytestmark = pytest.mark.browser
BOOK = BUILT / "book"
each_page = pytest.mark.parametrize(
    "path", [*NUMBERED, BOOK / "epilogue.html"], ids=lambda path: path.stem
)


def number(path):
    return int(path.stem[:2]) if path.stem[:2].isdigit() else None


@each_page
def test_a_strip_stands_above_every_chapter(path):
    """Sixteen marks, this chapter's lit; the photo; and the miss, as the run works it out."""
    assert path.read_text(encoding="utf-8").count('class="vmc-thread"') == 1
    soup = above_sections(path)
    strip = soup.select_one(".vmc-thread")
    marks = strip.select("li a")
    assert [mark["href"] for mark in marks] == [
        "#" if other == path else other.name for other in NUMBERED
    ]
    lit = [n for n, mark in enumerate(marks, start=1) if mark.get("aria-current")]
    assert lit == [number(path)] * bool(number(path))
    step, motion = thread.CHAPTERS[number(path)]
    miss = f"{thread.misses()[motion]:.1f} mm" if motion else f"photo 1: {step}"
    assert strip.select_one("a span").text.endswith(miss)
    assert len(strip.select("b")) == bool(motion)
    assert (path.parent / strip.select_one("image")["href"]).resolve().stat().st_size < 10_000
    assert soup.article.find(True) == strip


def test_a_strip_tells_the_plans_miss_where_a_chapter_changes_it():
    said = {}
    for path in NUMBERED:
        [link] = above_sections(path).select(".vmc-thread > a")
        said[number(path)] = link.span.text
        assert link["aria-label"].startswith(said[number(path)])
    numbers = {name: f"{miss:.1f}" for name, miss in thread.misses().items()}
    changes = {10: "off-line", 11: "online", 14: "whole hold"}  # each a correction of the plan
    assert {n: text for n, text in said.items() if "→" in text} == {
        n: f"miss {numbers['plan']} → {numbers[after]} mm" for n, after in changes.items()
    }


def test_the_miss_shrinks_from_chapter_to_chapter():
    motions = [motion for _, motion in thread.CHAPTERS.values()]
    misses = [thread.misses()[name] for name in dict.fromkeys(filter(None, motions))]
    assert misses == sorted(misses, reverse=True)
    assert misses[0] > 10 > misses[-1]


def test_chapter_1_tells_the_same_misses():
    text = (BOOK / "01_loop.html").read_text(encoding="utf-8")
    numbers = re.findall(r"<strong>([\d.]+)\u00a0mm</strong>", text)
    for motion in ("plan", "off-line"):
        assert f"{thread.misses()[motion]:.1f}" in numbers


@pytest.mark.parametrize(
    ("width", "height"), [pytest.param(1280, 800, marks=pytest.mark.audit), (390, 844)]
)
def test_a_strip_is_low_and_leads_to_its_step(window, serious, width, height):
    reader = window(viewport={"width": width, "height": height})
    page = open_url(reader, (BOOK / "10_offline.html").as_uri())
    box = page.locator(".vmc-thread").bounding_box()
    assert box["height"] <= 52
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= width
    assert serious(page, ".vmc-thread") == []
    page.locator(".vmc-thread > a").click()
    page.wait_for_selector("#demo-whole-loop[data-ready]")
    assert page.get_attribute("#demo-whole-loop-step", "aria-valuetext") == "calibrated reach"
    page.close()


@pytest.mark.parametrize("name", ["demo-whole-loop", "demo-1"])  # its name, and its number of old
def test_a_demo_is_at_its_address(offline, name):
    page = open_url(offline, f"{(BOOK / '01_loop.html').as_uri()}#{name}?photo=0&step=3")
    assert page.input_value("#demo-whole-loop-step") == "3"
    page.close()


def test_a_strip_is_not_printed(offline):
    page = open_url(offline, (BOOK / "10_offline.html").as_uri())
    page.emulate_media(media="print")
    assert page.locator(".vmc-thread").is_hidden()
    page.close()


# ---- The miss, close by ----


def miss_settings(path):
    """The miss that each arm scene of a page's first demo carries, state by state."""
    text = path.read_text(encoding="utf-8")
    packed = re.search(r'<script type="application/gzip">(.*?)</script>', text, re.S)[1]
    data = json.loads(unpack_bytes(packed))
    for _, *parts in data["states"]:
        lines = [data["lines"][place] for part in parts for place in part]
        yield [json.loads(line[5:]) for line in lines if line.startswith("miss|")]


FILLS = "all => all.map((one) => getComputedStyle(one).fill)"


def test_the_ruler_shows_the_miss_that_the_panel_tells(offline):
    """In the close-up the ruler is as long as the number says; without it, before the end."""
    page = open_url(offline, (BOOK / "epilogue.html").as_uri())
    page.wait_for_selector(".vmc-scene canvas")
    close_up, slider = page.locator(".vmc-close-up"), page.locator(".vmc-demo [data-stride]")
    for place, motion in enumerate(("plan", "off-line", "online", "whole hold")):
        slider.fill(str(place))
        said = f"{thread.misses()[motion]:.1f} mm"
        assert close_up.locator("text").text_content() == said
        panel = page.locator(".vmc-numbers div", has_text="miss over the hold")
        assert panel.locator("dd").inner_text() == said
        radius = close_up.locator("circle").first.get_attribute("r")
        assert float(radius) == pytest.approx(thread.misses()[motion], abs=1e-3)
    circle, scale, *_ = close_up.locator("circle, path").evaluate_all(FILLS)
    assert circle == scale == "none"  # lines, not discs
    page.fill(".vmc-clock input", "0.5")
    assert close_up.is_hidden()
    page.close()


def test_the_live_arm_begins_with_photo_1_and_its_miss(offline):
    """Its ruler, its words and the strip tell one miss; the ruler goes when the target moves."""
    reach = thread.first_reach().reach
    assert reach.plan.target == pytest.approx(PHOTO_1, abs=1e-4)
    page = open_url(offline, (BOOK / "09_planning.html").as_uri())
    page.wait_for_selector(".vmc-live canvas")
    close_up, said = page.locator(".vmc-live .vmc-close-up"), f"{thread.misses()['plan']:.1f} mm"
    assert close_up.locator("text").text_content() == said
    assert page.locator("[data-tell=planned]").first.inner_text() == said
    page.locator(".vmc-live [name=up]").fill("-0.39")
    assert close_up.count() == 0
    page.close()


HEIGHT = """(div) => vmc["demo/scene"].viewOf(div).viewer.scene_tree
  .find(["meshcat", "goal", "shuttlecock"]).object.position.y"""


def test_a_hit_lifts_the_shuttlecock_and_a_miss_does_not(offline):
    [[first], [calibrated], _, [third]] = miss_settings(BOOK / "epilogue.html")
    assert [one["lifted"] for one in (first, calibrated, third)] == [False, True, True]
    page = open_url(offline, (BOOK / "epilogue.html").as_uri())
    page.wait_for_selector(".vmc-scene canvas")
    scene, play = page.locator(".vmc-scene"), page.locator(".vmc-clock button")
    before = scene.evaluate(HEIGHT)
    slider = page.locator(".vmc-demo [data-stride]")
    for place, lifts in ((0, False), (3, True)):
        slider.fill(str(place))
        assert scene.evaluate(HEIGHT) == pytest.approx(before)
        play.click()
        page.wait_for_selector(".vmc-clock button:not([data-running])")
        assert (scene.evaluate(HEIGHT) > before + 0.02) == lifts
    slider.fill("0")
    assert scene.evaluate(HEIGHT) == pytest.approx(before)
    page.close()


@pytest.mark.audit
def test_nothing_is_lifted_where_less_motion_is_asked_for(window):
    page = open_url(window(reduced_motion="reduce"), (BOOK / "epilogue.html").as_uri())
    page.wait_for_selector(".vmc-scene canvas")
    before = page.locator(".vmc-scene").evaluate(HEIGHT)
    page.locator(".vmc-clock button").click()
    page.wait_for_selector(".vmc-clock button:not([data-running])")
    assert page.locator(".vmc-scene").evaluate(HEIGHT) == pytest.approx(before)
    assert page.locator(".vmc-close-up text").is_visible()
    page.close()


# ---- The face ----

SIZE = "(e) => parseFloat(getComputedStyle(e).fontSize)"


def test_a_chapter_is_larger_than_its_sections_and_code_can_be_read(offline):
    page = open_url(offline, (BOOK / "13_see_and_reach.html").as_uri())
    h1, h2, h3 = (page.locator(f"article {tag}").first.evaluate(SIZE) for tag in ("h1", "h2", "h3"))
    assert h1 > h2 > h3 > 16
    assert page.locator("article pre").first.evaluate(SIZE) >= 14
    caption = page.locator("figcaption").first
    assert caption.evaluate("(e) => getComputedStyle(e).textAlign") == "left"
    assert page.evaluate("document.fonts.check('16px \"Source Serif 4\"')")
    page.close()


def test_the_face_is_light():
    fonts = (BUILT / "_static/vendor").glob("text-*.css")
    assert 0 < sum(font.stat().st_size for font in fonts) < 150_000
