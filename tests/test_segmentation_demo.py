"""The reader's own photo in the page: segments and boxes are the library's, and it stays there."""

import re
from base64 import b64decode, b64encode
from itertools import chain

import numpy as np
import pytest
from PIL import Image

from book.figures import where
from page.bundle import FOLDER, widget_script
from tests.pages import book_html, displayed, observe
from tests.show.kernel import render
from vmc_lib import photos
from vmc_lib.where.selective_search import Strategy, hierarchies

GROWN = """([pixels, k]) => {
  const data = Uint8Array.from(atob(pixels), (c) => c.charCodeAt(0));
  const { finish } = vmc["eye/pieces"], { grow, prepare, segment } = vmc["eye/selective_search"];
  const prepared = finish(prepare({ data, width: 600, height: 400 }, "HSV"));
  const segments = finish(segment(prepared, k));
  let text = "";
  for (const byte of new Uint8Array(segments.labels.buffer)) text += String.fromCharCode(byte);
  return { ...grow(segments, [true, true, true, true]), labels: btoa(text) };
}"""
SHOTS = (
    *chain(*(photos.load(level, "train")[:1] for level in photos.LEVELS)),
    *photos.everyday()[:3],
)


@pytest.fixture(scope="module")
def html():
    alt = "A shuttlecock and a cup."
    return book_html(where, lambda: where.segmentation_demo(SHOTS[0].image, alt))


@pytest.fixture
def page(open_page, html):
    page = open_page(html)
    page.locator("figure[data-ready]").wait_for()
    return page


@pytest.mark.browser
def test_labels_merges_and_boxes_are_those_of_python(page):
    for number, shot in enumerate(SHOTS):
        k = (100, 37, 250)[number % 3]
        expected = next(hierarchies(shot.image, Strategy(k=(k,))))
        pixels = np.dstack([shot.image, np.full(shot.image.shape[:2], 255, np.uint8)])
        grown = page.evaluate(GROWN, [b64encode(pixels.tobytes()).decode(), k])
        labels = np.frombuffer(b64decode(grown["labels"]), np.int32).reshape(expected.labels.shape)
        assert (labels == expected.labels).all(), shot.name
        assert grown["merges"] == expected.merges.tolist(), shot.name
        assert (grown["boxes"] == expected.boxes).all(), shot.name


def numbers(page):
    return page.locator(".vmc-strip").inner_text()


@pytest.mark.browser
def test_numbers_appear_when_the_keyboard_moves_a_slider(page):
    assert numbers(page) == ""
    assert page.locator("canvas").is_hidden()
    scale, merged = page.get_by_role("slider").all()
    merged.focus()
    page.keyboard.press("End")
    page.get_by_text("so far").wait_for()
    assert merged.evaluate("it => it.nextElementSibling.textContent") == "1 left"
    assert "a box around each, in 600 × 400 pixels" in numbers(page)
    at_100 = numbers(page)
    scale.focus()
    page.keyboard.press("Home")
    page.wait_for_function(
        "seen => !seen.includes(document.querySelector('.vmc-strip').textContent)",
        arg=[at_100, "Cutting …"],
    )
    assert scale.evaluate("it => it.nextElementSibling.textContent") == "25"
    finer, coarser = (int(words.split()[0].replace(",", "")) for words in (numbers(page), at_100))
    assert finer > coarser


@pytest.mark.browser
def test_the_readers_photo_is_seen_in_the_page_alone(page, tmp_path):
    Image.new("RGB", (900, 1600), "teal").save(tmp_path / "tall.jpg")
    (tmp_path / "words.jpg").write_text("no picture", encoding="utf-8")
    page.asked.clear()
    page.locator("[type=file]").set_input_files(tmp_path / "tall.jpg")
    page.get_by_text("tall.jpg stays in this page").wait_for()
    page.get_by_text("367 × 653 pixels").wait_for()  # of ours, as many
    assert [url for url in page.asked if not url.startswith("data:")] == []
    assert page.evaluate("() => localStorage.length + sessionStorage.length") == 0
    page.locator("[type=file]").set_input_files(tmp_path / "words.jpg")
    remedy = "cannot read words.jpg: save it, or a phone's HEIC, as a JPEG or PNG"
    page.get_by_text(remedy).wait_for()
    assert "367 × 653" in numbers(page)
    box = page.locator("img").bounding_box()
    assert box["height"] <= 0.8 * page.viewport_size["height"]
    assert box == page.locator("canvas").bounding_box()
    page.get_by_role("button", name="The book's photo").click()
    page.get_by_text("600 × 400 pixels").wait_for()
    assert page.get_by_role("button", name="The book's photo").is_hidden()


@pytest.mark.browser
def test_it_plays_to_the_end_and_starts_again(page):
    play = page.get_by_role("button", name="Play")
    page.get_by_role("slider").nth(1).fill("0.99")
    play.click()
    page.get_by_text("1 left").wait_for()
    play.evaluate("(play) => { play.click(); play.click(); }")  # starts again, and waits
    assert float(page.get_by_role("slider").nth(1).input_value()) < 0.99


@pytest.mark.browser
def test_a_translated_button_plays_and_pauses(page):
    """Browsers put a translation in the place of a button's words."""
    play = page.locator("button").first
    for running in (True, False):
        play.evaluate("(it) => (it.innerHTML = '<font><font>Abspielen</font></font>')")
        play.click()
        assert (play.get_attribute("data-running") is not None) == running


def test_no_script_compares_words_that_a_reader_sees():
    compares = re.compile(r"(textContent|innerText|innerHTML)(\.trim\(\))? *[!=]==? *[\"'`]")
    scripts = [path for path in FOLDER.rglob("*.js") if "vendor" not in path.parts]
    assert len(scripts) > 50
    assert not [path.name for path in scripts if compares.search(path.read_text(encoding="utf-8"))]


@pytest.mark.browser
def test_the_demo_is_accessible(page, serious):
    page.get_by_role("slider").first.press("ArrowRight")
    page.get_by_text("so far").wait_for()
    assert serious(page, "main") == []
    page.set_viewport_size({"width": 360, "height": 700})
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360


FALSE = """Object.assign(CanvasRenderingContext2D.prototype, { getImageData: (x, y, ...size) => {
  const picture = new ImageData(...size);
  picture.data.fill(255);
  CHANGE;
  return picture;
} })"""
HIDDEN = {  # as Firefox has done it, and as Tor Browser did
    "noise": FALSE.replace("CHANGE", "picture.data.forEach((_, k, data) => (data[k] = 97 * k))"),
    "white": FALSE.replace("CHANGE", ""),
}


@pytest.mark.browser
@pytest.mark.parametrize("script", HIDDEN.values(), ids=HIDDEN)
def test_a_browser_that_falsifies_pixels_says_so(open_page, html, window, script, tmp_path):
    page = open_page(html, window(script))
    page.get_by_role("button", name="Play").click()
    page.get_by_text("hides a picture's pixels").wait_for()
    assert page.locator("img").is_visible()
    assert page.locator("canvas").is_hidden()
    Image.new("RGB", (60, 40), "teal").save(tmp_path / "own.png")
    before = page.locator("img").get_attribute("src")
    page.locator("[type=file]").set_input_files(tmp_path / "own.png")
    page.get_by_text("own.png stays").wait_for()
    assert page.get_by_role("button", name="Play").is_visible()
    assert page.locator("img").get_attribute("src") == before


@pytest.mark.browser
def test_noise_too_weak_to_change_a_picture_is_no_reason_to_stop(open_page, html, window):
    weak = """const get = CanvasRenderingContext2D.prototype.getImageData;
      CanvasRenderingContext2D.prototype.getImageData = function (...area) {
        const picture = get.apply(this, area);
        for (let k = 0; k < picture.data.length; k += 4) picture.data[k] ^= 1;
        return picture;
      };"""
    page = open_page(html, window(weak))
    page.get_by_role("slider").first.press("ArrowRight")
    page.get_by_text("so far").wait_for()


@pytest.mark.browser
def test_no_false_pixels_travel_to_a_kernel(monkeypatch, window, tmp_path):
    widgets, asked = displayed(monkeypatch, where), []
    monkeypatch.setattr(where, "figure", lambda *_, **__: None)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    where.photo_upload(asked.append, SHOTS[0].image, "alt")
    page = observe(window(HIDDEN["noise"]).new_page())
    render(page, widgets[-1], monkeypatch)
    Image.new("RGB", (60, 40), "teal").save(tmp_path / "own.png")
    page.locator("[type=file]").set_input_files(tmp_path / "own.png")
    page.get_by_text("hides a picture's pixels").wait_for()
    assert len(asked) == 1  # our own photo
    assert page.errors == []


def test_in_a_kernel_it_is_the_same_page(monkeypatch):
    shown = displayed(monkeypatch, where)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    where.segmentation_demo(SHOTS[0].image, "A cup.")
    assert shown[1]._esm == widget_script("demos/segmentation.js")
    assert 'class="vmc-segmentation"' in shown[1].page
    monkeypatch.setenv("VMC_RENDER_MODE", "test")
    where.segmentation_demo(SHOTS[0].image, "A cup.")
    assert len(shown) == 2
