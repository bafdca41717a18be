"""The moving picture in README: the demo of the front page, photographed in a browser.

Build the book, then run python -m tools.cover.
"""

import io
from pathlib import Path

from PIL import Image

from book.figures.loop import LOOP_STEPS, SEEING
from tools import browser

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "_build/html/book/index.html"
LOOK, MOVE, REST = 1300, 60, 2000  # ms: for a step of seeing, for a moment of a reach, at its end
MOMENTS = 20  # of a reach
DRAWN = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
LABEL = """(pictures, text) => {
  const label = pictures.querySelector("b") ?? pictures.appendChild(document.createElement("b"));
  pictures.style.position = "relative";
  label.style.cssText = "position: absolute; left: 0; bottom: 0.5rem; font-size: 1.6rem";
  label.textContent = text;
}"""


def frames(page):
    """The demo's pictures as (image, ms), step by step; a reach moment by moment."""
    demo = page.locator(".vmc-demo").first
    pictures, end = demo.locator(".vmc-pictures"), demo.locator(".vmc-clock input")
    demo.locator("canvas").wait_for()
    page.wait_for_timeout(3000)  # the bones come last, unannounced

    def take_picture():
        page.evaluate(DRAWN)
        return Image.open(io.BytesIO(pictures.screenshot())).convert("RGB")

    for number, step in enumerate(LOOP_STEPS):
        demo.locator("input[type=range]").first.fill(str(number))
        pictures.evaluate(LABEL, step)
        if step in SEEING:
            yield take_picture(), LOOK
            continue
        last = float(end.get_attribute("max"))
        for moment in range(MOMENTS + 1):
            end.fill(f"{last * moment / MOMENTS:.2f}")
            yield take_picture(), MOVE if moment < MOMENTS else REST


if __name__ == "__main__":
    with browser.launch() as chromium:
        page = chromium.new_page(viewport={"width": 860, "height": 900})
        page.goto(PAGE.as_uri())
        first, *others = frames(page)
    first[0].save(
        ROOT / "book/_static/cover.webp",
        save_all=True,
        append_images=[image for image, _ in others],
        duration=[ms for _, ms in (first, *others)],
        loop=3,  # then it rests at the end: what moves for ever cannot be read beside
        quality=80,
        method=6,
    )
