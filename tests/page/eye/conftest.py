"""The eye in a page, as tests ask it."""

import shutil
from base64 import b64encode

import numpy as np
import pytest

from book.figures import your_photo
from page.eye import brain
from tests import pages
from vmc_lib import photos

ASK = """async ([asked, pixels, width, height]) => {
  const data = Uint8ClampedArray.from(atob(pixels), (c) => c.charCodeAt(0));
  const photo = { data, width, height };
  const modules = Object.keys(vmc).filter((path) => path.startsWith("eye/"));
  const eye = Object.assign({}, ...modules.map((path) => vmc[path]));
  const brain = await eye.unpack();
  %s
}"""
NOTHING = np.zeros((1, 1, 3), np.uint8)


@pytest.fixture(scope="session", autouse=True)
def brain_script(site, once):
    """What the eye has learnt, as built or packed by one worker, is among the book's scripts."""
    folder = once("brain", lambda folder: pages.copy_scripts(folder, brain.SCRIPT))
    shutil.copytree(folder, site, dirs_exist_ok=True)


@pytest.fixture(scope="session")
def eye_page(chromium, site):
    """A page, offline, with the book's scripts."""
    context = chromium.new_context(offline=True)
    eye = '<!-- class="vmc-eye": its policy lets WebAssembly run -->'
    page = pages.open_html(context, site, eye)
    yield page
    context.close()
    assert page.errors == page.failed == []


@pytest.fixture(scope="session")
def html():
    """The reader's own photo, in the book."""
    shot = photos.load(photos.SHEET_LEVEL, "test")[20]
    return pages.book_html(your_photo, lambda: your_photo.your_photo(shot))


@pytest.fixture
def ask(eye_page):
    """A function: what a script returns that has `brain`, `asked` and an image as `photo`."""

    def ask(script, asked=None, image=NOTHING):
        height, width = image.shape[:2]
        pixels = np.dstack([image, np.full((height, width), 255, np.uint8)]).tobytes()
        return eye_page.evaluate(ASK % script, [asked, b64encode(pixels).decode(), width, height])

    return ask
