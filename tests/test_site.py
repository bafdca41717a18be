"""The built book as a whole: weight, links, search; on paper, over HTTP, without scripts."""

import json
import re
from urllib.parse import unquote, urljoin, urlsplit

import numpy as np
import pypdfium2
import pytest
from sphinx.errors import ExtensionError

from book._ext.offline import own_words
from tests.pages import (
    BUILT,
    CHAPTERS,
    INSIDE,
    TWO_FRAMES,
    broken,
    broken_links,
    open_url,
    unfold,
)  # fmt: skip
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import to_world
from vmc_lib.show.arm import BEYOND
from vmc_lib.show.packed import unpack_bytes

pytestmark = pytest.mark.browser
CHAPTER = {path.stem: path for path in CHAPTERS}
PAGES = sorted(path for path in BUILT.rglob("*.html") if "_static" not in path.parts)
OTHERS = sorted({*PAGES} - {*CHAPTERS, BUILT / "index.html"})  # Sphinx's own: search, sources
KINDS = {path.relative_to(BUILT).parts[0]: path for path in OTHERS}.values()  # one of each
LINKED = re.compile(r'(?:src|href)="([^"#?:]+\.(?:js|css|png|svg|jpg|webp))[?"]')


def each(paths):
    return pytest.mark.parametrize(
        "path", paths, ids=lambda path: path.relative_to(BUILT).as_posix()
    )


@each(PAGES)
def test_is_light(path):
    """A page with all that it links to; what is fetched later (a scene's viewer) aside."""
    text = path.read_text(encoding="utf-8")
    linked = {(path.parent / unquote(link)).resolve() for link in LINKED.findall(text)}
    weight = sum(file.stat().st_size for file in {path, *linked} if file.is_file())
    assert weight <= (4e6 if 'class="vmc-demo"' in text else 3e6)
    prose = re.sub("<pre>.*?</pre>", "", text, flags=re.S)
    assert ("katex.js" in text) == bool(re.search(r'class="math|\\\(', prose))


# ---- Arms ----

FINGERS = 2 * BEYOND  # from the wrist: what a hand holds lies half-way


def arm_scenes(path):
    """What every arm scene of a page tells its viewer, state by state."""
    text = path.read_text(encoding="utf-8")
    for packed in re.findall(r'<script type="application/gzip">(.*?)</script>', text, re.S):
        data = json.loads(unpack_bytes(packed))
        for _, *parts in data.get("states", []):
            for part in parts:
                lines = [data["lines"][place] for place in part]
                scene = dict(line.split("|") for line in lines if re.match(r"\w+\|", line))
                if "motion" in scene:
                    yield {name: json.loads(value) for name, value in scene.items()}


def in_picture(camera, points):
    """Where points (n, 3) are seen, from −1 to 1 in the narrowest picture (page/demo/scene.js)."""
    eye, at = np.array(camera)
    forward = (at - eye) / np.linalg.norm(at - eye)
    right = np.cross(forward, [0, 1, 0]) / np.linalg.norm(np.cross(forward, [0, 1, 0]))
    axes = np.stack([right, np.cross(right, forward), forward])
    x, y, far = axes @ (points - eye).T
    half = far * np.tan(np.radians(35 / 2))
    return x / (1.15 * half), y / half


@each(CHAPTERS)
def test_hand_and_target_stay_in_the_picture(path):
    for scene in arm_scenes(path):
        motion, target = scene["motion"], scene.get("target")
        turn = np.array(motion["turn"])
        wrist = hand(np.array(motion["q"]))
        points = [to_world(wrist + FINGERS, turn), to_world(wrist, turn)]
        if target:
            points += [[target + to_world(BEYOND, turn[-1]) - to_world(np.zeros(3), turn[-1])]]
        assert np.abs(in_picture(scene["camera"], np.concatenate(points))).max() < 1


# ---- On paper, and where something is missing ----

# Moves every slider to its end; returns what paper must show of it.
TO_THE_END = """() => [...document.querySelectorAll(".vmc-demo[data-ready]")].flatMap((demo) => {
  for (const slider of demo.querySelectorAll("input[data-texts]")) slider.value = slider.max;
  demo.dispatchEvent(new Event("input", { bubbles: true }));
  demo.querySelector(".vmc-listen").remove(); // as on paper
  return [...demo.querySelectorAll("output, svg text, figcaption")].map((e) => e.textContent);
})"""


def test_prints_what_a_reader_sees(offline):
    """A chapter on paper: its text, its demos as they stand, nothing to click, solutions closed."""
    page = open_url(offline, CHAPTER["09_planning"].as_uri())
    seen = " ".join(page.evaluate(TO_THE_END) + page.locator("article h2").all_inner_texts())
    sheets = pypdfium2.PdfDocument(page.pdf())
    printed = "\n".join(sheet.get_textpage().get_text_range() for sheet in sheets)
    words = re.compile(r"[\w.−]{3,}")
    assert not set(words.findall(seen)) - set(words.findall(printed))
    assert not re.findall(r"\bPlay\b|\bListen\b|Click to|turn the view|Next", printed)
    assert printed.count("Solution to") == page.locator(".solution").count()
    assert "d_1" not in printed
    assert "linear interpolation" not in printed
    page.close()


# Of every demo: is something to be seen, and what does it say where it cannot move?
SHOWN = """() => [...document.querySelectorAll(".vmc-demo:has(> script)")].map((demo) => ({
  seen: [...demo.querySelectorAll(".vmc-picture")].every((one) => one.getClientRects().length
    && (one.querySelector("svg, img") || one.innerText.trim())),
  caption: demo.querySelector("figcaption").innerText.trim(),
  said: getComputedStyle(demo, "::after").content }))"""


@pytest.mark.parametrize("missing", ["scripts", "a script", "DecompressionStream"])
def test_what_cannot_move_shows_its_first_picture_and_its_words(window, missing):
    script = f"delete self.{missing}" if missing == "DecompressionStream" else ""
    reader = window(script, java_script_enabled=missing != "scripts")
    if missing == "a script":
        reader.route("**/chapter.js*", lambda route: route.abort())
    page = reader.new_page()
    page.goto(CHAPTER["08_arm"].as_uri())
    unfold(page)
    shown = page.evaluate(SHOWN)
    assert shown
    assert all(demo["seen"] and demo["caption"] for demo in shown)
    assert all("newer browser" in demo["said"] for demo in shown)


def test_a_slider_restyles_its_own_demo(chromium, offline):
    """A rule for what has a demo (`:has`) may not make the browser restyle the whole page."""
    page = open_url(offline, CHAPTER["10_offline"].as_uri())
    page.locator("#demo-weight-change input[type=range]").first.focus()
    chromium.start_tracing(page=page, categories=["devtools.timeline"])
    page.keyboard.press("ArrowRight")
    page.evaluate(TWO_FRAMES)
    events = json.loads(chromium.stop_tracing())["traceEvents"]
    restyled = [e["args"]["elementCount"] for e in events if "elementCount" in e["args"]]
    everything = page.evaluate("() => document.querySelectorAll('*').length")
    assert 0 < max(restyled) < everything / 5
    page.close()


# ---- Pages made by Sphinx, search, and the web ----


def test_a_line_of_the_ledger_opens_its_row(offline):
    page = open_url(offline, CHAPTER["ledger"].as_uri())
    page.click('.vmc-forest a[href="#row-table-ii"]')
    page.wait_for_selector("#row-table-ii table", state="visible")
    page.press('.vmc-forest a[href="#row-fig-6"]', "Enter")
    page.wait_for_selector("#row-fig-6 table", state="visible")
    page.close()


@each(KINDS)
def test_pages_made_by_sphinx(offline, path):
    page = open_url(offline, path.as_uri())
    assert [url for url in page.asked if not url.startswith(INSIDE)] == []
    assert page.errors == page.failed == broken_links(page) == []
    page.close()


@each(OTHERS)
def test_links_of_pages_made_by_sphinx(path):
    links = re.findall(r'<a [^>]*href="([^"]+)"', path.read_text(encoding="utf-8"))
    assert list(broken(urljoin(path.as_uri(), link) for link in links)) == []


def test_the_front_door_leads_into_the_book(offline):
    page = offline.new_page()
    page.goto((BUILT / "index.html").as_uri(), wait_until="commit")  # it sends the reader on
    page.wait_for_url((BUILT / "book/index.html").as_uri())
    page.close()


@pytest.fixture
def over_http(offline):
    """The built book at http://book/, without a server: no port is opened."""

    def serve(route):
        path = BUILT / unquote(urlsplit(route.request.url).path).lstrip("/")
        route.fulfill(path=path) if path.is_file() else route.fulfill(status=404)

    offline.route("http://book/**", serve)
    yield "http://book"
    offline.unroute("http://book/**")


@pytest.mark.parametrize("scheme", ["file", "http"])
def test_search_finds_the_shuttlecock(offline, over_http, scheme):
    root = over_http if scheme == "http" else BUILT.as_uri()
    page = open_url(offline, f"{root}/search.html?q=shuttlecock")
    page.wait_for_selector("#search-results li a")
    assert page.errors == []
    page.evaluate("() => localStorage.clear()")  # it marks what was sought on every page
    page.close()


def test_search_takes_no_property_of_an_object_for_a_word(offline):
    page = open_url(offline, f"{BUILT.as_uri()}/search.html?q=__proto__")
    page.wait_for_selector(".search-summary:not(:empty)")
    assert page.locator("#search-results li").count() == 0
    found = page.evaluate("() => Search.performTermsSearch(new Set(['constructor']), new Set())")
    assert found == page.errors == []
    page.evaluate("() => localStorage.clear()")
    page.close()


def test_a_search_that_cannot_be_mended_fails_the_build():
    mended = own_words((BUILT / "_static/searchtools.js").read_text(encoding="utf-8"))
    assert own_words(mended) == mended
    with pytest.raises(ExtensionError, match="own_words"):
        own_words("const files = index.get(word);")


def test_words_that_a_search_marks_are_readable(offline, serious):
    page = open_url(offline, f"{BUILT.as_uri()}/book/glossary.html?highlight=cell")
    page.wait_for_selector("span.highlighted")
    assert serious(page, "article") == []
    page.evaluate("() => localStorage.clear()")
    page.close()


SCRIPTS = re.compile(r'<script[^>]* src="([^"]+)"')
SCRIPTED = {  # of pages with the same scripts the heaviest
    frozenset(SCRIPTS.findall(path.read_text(encoding="utf-8"))): path
    for path in sorted(CHAPTERS, key=lambda path: path.stat().st_size)
}.values()


@each(SCRIPTED)
def test_reads_over_http_too(offline, over_http, path):
    page = open_url(offline, f"{over_http}/book/{path.name}")
    assert page.errors == page.failed == []
    assert all(url.startswith((over_http, "data:", "blob:")) for url in page.asked)
    page.close()
