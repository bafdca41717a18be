"""Pages that tests open: the book's own scripts around what demos show, and a reader's hand."""

import itertools
import os
import re
import shutil
from contextlib import suppress
from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit
from weakref import WeakSet

import pytest
import yaml
from bs4 import BeautifulSoup
from joblib import cpu_count
from playwright.sync_api import TimeoutError, expect

from book._ext.packed import write_script
from book._ext.policy import seal

ROOT = Path(__file__).parents[1]
BUILT = ROOT / "_build/html"
CHAPTERS = sorted((BUILT / "book").glob("*.html"))
NUMBERED = [path for path in CHAPTERS if path.stem[:2].isdigit()]
INSIDE = (f"{BUILT.as_uri()}/", "data:", "blob:")
PACKED = re.compile(r'<script type="application/gzip">([^<]+)')
AXE = (ROOT / "tests/vendor/axe.js").read_text(encoding="utf-8")
PROBES = (ROOT / "tests/probes.js").read_text(encoding="utf-8")
CONFIG = yaml.safe_load((ROOT / "_config.yml").read_bytes())["sphinx"]["config"]
STYLES = CONFIG["html_css_files"]
SCRIPT = "photo.js"  # of page/book: the page that has all of the book's modules
STATIC = [ROOT / "book/_static", ROOT / "page/static"]
HEAD = "".join(
    (
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>A page</title>'
        '<meta name="viewport" content="width=device-width">',
        *(f'<link rel="stylesheet" href="{name}">' for name in STYLES),
        f'<script defer src="{SCRIPT}"></script>',
        '<body style="background: var(--vmc-paper); color: var(--vmc-ink)"><main>',
    )
)
NO_WEBGL = """const { getContext } = HTMLCanvasElement.prototype;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
};"""
CAPTURE = "div => vmc['demo/scene'].viewOf(div).viewer.capture_image()"
# While the mouse holds an element, another pointer moves over it
SECOND_FINGER = """(it) => {
  const { left, top } = it.getBoundingClientRect();
  const place = { pointerId: 99, pointerType: "touch", clientX: left + 9, clientY: top + 9 };
  for (const type of ["pointermove", "pointerup"])
    it.dispatchEvent(new PointerEvent(type, { ...place, bubbles: true }));
}"""
TWO_FRAMES = "() => new Promise((on) => requestAnimationFrame(() => requestAnimationFrame(on)))"
STILL_BOXES = """async (things) => {
  const boxes = () => things.map((thing) => thing.getBoundingClientRect())
    .map(({ x, y, width, height }) => [x, y, width, height]);
  let last = boxes();
  for (let still = 0; still < 10; still++) {
    await new Promise(requestAnimationFrame);
    const now = boxes();
    if (`${now}` !== `${last}`) still = -1;
    last = now;
  }
  return last;
}"""
OPEN = WeakSet()  # pages that are observed: what they show is kept when a test fails
counter = itertools.count(1)


def above_sections(path):
    """What stands above the first section of a built page: its sidebar and its strip."""
    above, _ = path.read_text(encoding="utf-8").split("<section", 1)
    return BeautifulSoup(above, "html.parser")


def copy_scripts(folder, *names):
    """Copy packed scripts of the built book into a folder, or pack those that hold a newer file."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        with suppress(FileNotFoundError):
            shutil.copy2(BUILT / "_static" / name, folder / name)
        write_script(folder, name)


def displayed(patch, module, handle=None):
    """List what a module displays from now on, in order; `display` returns `handle`."""
    shown = []
    patch.setattr(module, "display", lambda *items, **_: shown.extend(items) or handle)
    return shown


def book_html(module, declare):
    """HTML that a module displays in the book while `declare()` runs."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VMC_RENDER_MODE", "book")
        shown = displayed(patch, module)
        declare()
    return "\n".join(item.data for item in shown)


def patience():
    """How long a test waits for what a reader sees at once, ms: it ends a hang, and no work.

    Half a minute, or VMC_PATIENCE seconds; as many times longer as the machine is busy.
    """
    busy = os.getloadavg()[0] / cpu_count() if hasattr(os, "getloadavg") else 1
    return 1000 * float(os.environ.get("VMC_PATIENCE", 30)) * max(1, busy)


def patient(new_context, **kind):
    """A browser window that waits as long as a busy machine may need."""
    context = new_context(**kind)
    context.set_default_timeout(patience())
    expect.set_options(timeout=patience())
    return context


# Writes into a browser's storage until it takes no more.
FILL = """() => { for (let text = "x".repeat(2 ** 20), n = 0; text; n++)
  try { localStorage[n] = text } catch { text = text.slice(0, text.length / 2) } }"""


def observe(page):
    """Keep what a page asks for, what does not come, and what it complains about."""
    OPEN.add(page)
    page.asked, page.failed, page.errors = [], [], []
    page.on("request", lambda request: page.asked.append(request.url))
    page.on(
        "requestfailed",  # a worker's own text is no file: it fails when Python is stopped
        lambda request: request.url.startswith("blob:null/") or page.failed.append(request.url),
    )
    page.on("pageerror", lambda error: page.errors.append(f"{error} {error.stack}"))
    page.on(
        "console",
        lambda said: (
            said.type == "error" and page.errors.append(f"{said.text} {said.location['url']}")
        ),
    )
    return page


WAITING = "[...document.querySelectorAll('.vmc-demo:has(> script):not([data-ready])')]"


def settle(page):
    """Wait until demos can answer."""
    page.wait_for_load_state("load")
    with suppress(TimeoutError):
        page.wait_for_function(f"() => !{WAITING}.length")
    waiting = page.evaluate(f"() => {WAITING}.map((demo) => demo.id)")
    assert not waiting, f"{page.url}: these demos never became ready: {waiting}; {page.errors}"


def open_url(window, url):
    """Open a page, observed and settled."""
    page = observe(window.new_page())
    page.goto(url)
    settle(page)
    return page


def open_html(window, site, html):
    """Open some HTML, observed and settled, under its policy, beside the book's scripts."""
    path = site / f"page{next(counter)}.html"
    path.write_text(seal(HEAD + html), encoding="utf-8")
    return open_url(window, path.as_uri())


def stop_clock(page):
    """Let time pass in a page's window, its own, by `page.clock.run_for(ms)` alone.

    Then none passes while a test looks.
    """
    page.clock.install(time=0)
    page.clock.pause_at(1)


def unfold(page):
    """Open the parts of a chapter that are folded below their headings."""
    for fold in page.query_selector_all(".vmc-optional > * > button[aria-expanded=false]"):
        fold.click()


def boxes(things):
    """The boxes [x, y, width, height] of a locator's elements, px, read together.

    Once they have stood still for ten frames: what is compared must be of one moment.
    """
    return things.evaluate_all(STILL_BOXES)


def middles(things):
    """Where the middles of a locator's elements are, px from the window's corner (see `boxes`)."""
    return [(x + width / 2, y + height / 2) for x, y, width, height in boxes(things)]


def middle(thing):
    """Where the middle of a locator's one element is."""
    [place] = middles(thing)
    return place


def drag(page, place, right, down, button="left"):
    """Press the mouse at a place (x, y), move it, in px, and let it go."""
    x, y = place
    page.mouse.move(x, y)
    page.mouse.down(button=button)
    page.mouse.move(x + right, y + down, steps=4)
    page.mouse.up(button=button)


def probe(page, name, asked=None):
    """What is wrong with a page, as a function of `probes.js` finds it."""
    return page.evaluate(f"(asked) => {{ {PROBES}; return {name}(asked); }}", asked)


@cache
def anchors(path):
    return set(re.findall(r'\b(?:id|name)="([^"]+)"', path.read_text(encoding="utf-8")))


def broken(links):
    """Of `links` those into the book whose file or anchor is not there."""
    for href in set(links):
        link = urlsplit(href)
        target = Path(unquote(link.path))
        if link.scheme == "file" and not target.is_file():
            yield href
        elif link.scheme == "file" and link.fragment and target.suffix == ".html":
            if unquote(link.fragment).split("?")[0] not in anchors(target):  # a demo's state
                yield href


def broken_links(page):
    """Links of an open page that are `broken`."""
    return [*broken(page.eval_on_selector_all("a[href]", "links => links.map(a => a.href)"))]
