"""The reader's own photo in the page: segments and boxes are the library's, and it stays there."""

import shutil
from base64 import b64decode, b64encode
from itertools import chain

import numpy as np
import pytest
from PIL import Image

from book.figures import where
from vmc_lib import photos
from vmc_lib.show.live import STATIC
from vmc_lib.where.selective_search import Strategy, hierarchies

HEAD = """<!doctype html><html lang="en"><meta charset="utf-8"><title>A photo</title>
<meta name="viewport" content="width=device-width"><link rel="stylesheet" href="demo.css">
<script defer src="canvas.js"></script><script defer src="selective_search.js"></script>
<script defer src="segmentation_demo.js"></script>
<body style="background: var(--vmc-paper); color: var(--vmc-ink)"><main>"""
GROWN = """([pixels, k]) => {
  const tree = vmcSearch(Uint8Array.from(atob(pixels), (c) => c.charCodeAt(0)), 600, 400)(k);
  let text = "";
  for (const byte of new Uint8Array(tree.labels.buffer)) text += String.fromCharCode(byte);
  return { ...tree, labels: btoa(text) };
}"""
SHOTS = (
    *chain(*(photos.load(level, "train")[:2] for level in photos.LEVELS)),
    *photos.everyday()[:4],
)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A page with the demo, as the book shows it, on disk."""
    folder, shown = tmp_path_factory.mktemp("site"), []
    for file in (STATIC / "demo.css", *where.STATIC.glob("*.js")):
        shutil.copy(file, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VMC_RENDER_MODE", "book")
        patch.setattr(where, "display", lambda item: shown.append(item.data))
        where.segmentation_demo(SHOTS[0].image, "Play.", "A shuttlecock and a cup.")
    (folder / "page.html").write_text(HEAD + shown[0], encoding="utf-8")
    Image.new("RGB", (900, 1600), "teal").save(folder / "tall.jpg")
    (folder / "words.jpg").write_text("no picture", encoding="utf-8")
    return folder


@pytest.fixture
def page(offline, site):
    page, errors = offline.new_page(), []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda m: m.type == "error" and errors.append(m.text))
    page.on("requestfailed", lambda request: errors.append(request.url))
    page.goto((site / "page.html").as_uri())
    page.locator("figure[data-ready]").wait_for()
    yield page
    page.close()
    assert errors == []


@pytest.mark.browser
def test_labels_merges_and_boxes_are_pythons(page):
    for number, shot in enumerate(SHOTS):
        k = (100, 37, 250)[number % 3]
        expected = next(hierarchies(shot.image, Strategy(k=(k,))))
        pixels = np.dstack([shot.image, np.full(shot.image.shape[:2], 255, np.uint8)])
        grown = page.evaluate(GROWN, [b64encode(pixels.tobytes()).decode(), k])
        labels = np.frombuffer(b64decode(grown["labels"]), np.int32).reshape(expected.labels.shape)
        assert (labels == expected.labels).all(), shot.name
        assert grown["merges"] == expected.merges.tolist(), shot.name
        assert (grown["boxes"] == expected.boxes).all(), shot.name


def told(page):
    return page.locator(".vmc-strip").inner_text()


@pytest.mark.browser
def test_the_first_picture_tells_nothing_and_the_keyboard_moves_it(page):
    assert told(page) == ""
    assert page.locator("canvas").is_hidden()
    scale, merged = page.get_by_role("slider").all()
    merged.focus()
    page.keyboard.press("End")
    page.get_by_text("so far").wait_for()
    assert merged.evaluate("it => it.nextElementSibling.textContent") == "1 left"
    assert "600 × 400 pixels hold 14,460,060,000 boxes" in told(page)
    at_100 = told(page)
    scale.focus()
    page.keyboard.press("Home")
    page.wait_for_function(
        "seen => !seen.includes(document.querySelector('.vmc-strip').textContent)",
        arg=[at_100, "Cutting …"],
    )
    assert scale.evaluate("it => it.nextElementSibling.textContent") == "25"
    finer, coarser = (int(words.split()[0].replace(",", "")) for words in (told(page), at_100))
    assert finer > coarser


@pytest.mark.browser
def test_the_readers_photo_is_seen_in_the_page_alone(page, site):
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.locator("[type=file]").set_input_files(site / "tall.jpg")
    page.get_by_text("tall.jpg stays in this page").wait_for()
    page.get_by_text("367 × 653 pixels").wait_for()  # of ours, as many
    assert [url for url in asked if not url.startswith("data:")] == []
    assert page.evaluate("() => localStorage.length + sessionStorage.length") == 0
    page.locator("[type=file]").set_input_files(site / "words.jpg")
    page.get_by_text(
        "cannot read words.jpg: save it, or a phone's HEIC, as a JPEG or PNG"
    ).wait_for()
    assert "367 × 653" in told(page)


@pytest.mark.browser
def test_it_plays_to_the_end_and_starts_again(page):
    play = page.get_by_role("button", name="Play")
    page.get_by_role("slider").nth(1).fill("0.99")
    play.click()
    page.get_by_text("1 left").wait_for()
    play.click()
    page.get_by_role("button", name="Pause").click()
    assert float(page.get_by_role("slider").nth(1).input_value()) < 0.99


@pytest.mark.browser
def test_the_demo_is_accessible(page, serious):
    page.get_by_role("slider").first.press("ArrowRight")
    page.get_by_text("so far").wait_for()
    assert serious(page, "main") == []
    page.set_viewport_size({"width": 360, "height": 700})
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    page.set_viewport_size({"width": 1200, "height": 900})


def test_in_a_kernel_it_is_the_same_page(monkeypatch):
    shown = []
    monkeypatch.setattr(where, "display", shown.append)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    where.segmentation_demo(SHOTS[0].image, "Play.", "A cup.")
    assert list(shown[1].scripts) == ["canvas.js", "selective_search.js", "segmentation_demo.js"]
    assert 'class="vmc-segmentation"' in shown[1].page
    monkeypatch.setenv("VMC_RENDER_MODE", "test")
    where.segmentation_demo(SHOTS[0].image, "Play.", "A cup.")
    assert len(shown) == 3
