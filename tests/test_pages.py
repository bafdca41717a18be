"""Every page of the built book, opened in a browser with the network off."""

import base64
import gzip
import json
import re
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import unquote, urljoin, urlsplit

import numpy as np
import pypdfium2
import pytest
from bs4 import BeautifulSoup

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import to_world
from vmc_lib.show.arm import BEYOND

pytestmark = pytest.mark.browser

BUILT = Path(__file__).parents[1] / "_build/html"
PAGES = sorted(path for path in BUILT.rglob("*.html") if "_static" not in path.parts)
CHAPTERS = [path for path in PAGES if path.parent == BUILT / "book"]
OTHERS = sorted({*PAGES} - {*CHAPTERS, BUILT / "index.html"})  # Sphinx's own: search, sources
KINDS = {path.relative_to(BUILT).parts[0]: path for path in OTHERS}.values()  # one of each
SCRIPTS = re.compile(r'<script[^>]* src="([^"]+)"')
HEAVIER = sorted(CHAPTERS, key=lambda path: path.stat().st_size)  # the heaviest of each kind counts
SCRIPTED = {
    frozenset(SCRIPTS.findall(path.read_text(encoding="utf-8"))): path for path in HEAVIER
}.values()
FINGERS = 2 * BEYOND  # from the wrist: what a hand holds lies half-way
INSIDE = (f"{BUILT.as_uri()}/", "data:", "blob:")

# Runs in the page. Moves every control of every demo through its values, if need be with the other
# controls elsewhere, until its picture differs; returns the controls that never moved it.
IDLE_CONTROLS = """async () => {
  const look = (demo) => [...demo.querySelectorAll(".vmc-picture")].map((picture) => {
    const scene = picture.querySelector(".vmc-scene");
    return scene ? vmcScene(scene).viewer.capture_image() : picture.innerHTML;
  }).join();
  const controls = (demo) => {
    const groups = Map.groupBy(demo.querySelectorAll("[data-stride]"), (i) => i.name || i.id || i);
    return [...groups.values()].map((inputs) => {
      const [input] = inputs;
      const fire = (input) => input.dispatchEvent(new Event("input", { bubbles: true }));
      const set = {
        range: (v) => { input.value = v; fire(input); },
        checkbox: (v) => { input.checked = v; fire(input); },
        radio: (v) => { inputs[v].checked = true; fire(inputs[v]); },
        "select-one": (v) => { input.selectedIndex = v; fire(input); },
      }[input.type];
      const count = { range: +input.max + 1, checkbox: 2, radio: inputs.length }[input.type]
        ?? input.options?.length;
      return { name: input.id || input.closest(".vmc-control").textContent, set, count };
    });
  };
  const moves = (demo, { set, count }) => {
    set(0);
    const first = look(demo);
    for (let v = count - 1; v > 0; v--) { set(v); if (look(demo) !== first) return true; }
    return false;
  };
  const idle = [];
  for (const demo of document.querySelectorAll(".vmc-demo[data-ready]")) {
    for (const div of demo.querySelectorAll(".vmc-scene")) await vmcScene(div).awake();
    const all = controls(demo);
    for (const control of all) {
      const others = all.filter((other) => other !== control);
      const settings = others.flatMap((o) => [...Array(o.count).keys()].map((v) => [o, v]));
      if (!moves(demo, control) && !settings.some(([o, v]) => (o.set(v), moves(demo, control))))
        idle.push(`${demo.id} ${control.name}`);
    }
  }
  return idle;
}"""

# Text that a reader sees outside code, with TeX that was not typeset.
RAW_TEX = r"""() => {
  const walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const wrong = document.querySelectorAll("mjx-merror, [data-mjx-error]");
  const raw = [...wrong].map((e) => e.outerHTML);
  const tex = /\\\(|\\\[|\$\$|\\(frac|sum|begin|mathbf|boldsymbol)|\$[^$\s][^$]*\$/;
  while (walker.nextNode()) {
    const { data, parentElement } = walker.currentNode;
    if (parentElement.closest("pre, code, script, style, mjx-container")) continue;
    if (tex.test(data)) raw.push(data);
  }
  return raw;
}"""

WIDE = """() => [...document.querySelectorAll("article *:not(pre *, table *, svg *)")]
  .filter((e) => e.getBoundingClientRect().right > innerWidth + 1
    && !e.closest("pre, table, div.math, .vmc-spoken, .vmc-picture"))
  .map((e) => e.outerHTML.slice(0, 120))"""


TWO_FRAMES = "() => new Promise((on) => requestAnimationFrame(() => requestAnimationFrame(on)))"


def test_the_book_is_built():
    assert CHAPTERS, "no built book in _build/html: run `make book` first"


def open_page(context, url):
    """The page at `url`, settled, with what it asked for and complained about on the way."""
    page = context.new_page()
    opened = SimpleNamespace(page=page, url=url, asked=[], failed=[], errors=[])
    page.on("request", lambda request: opened.asked.append(request.url))
    page.on("requestfailed", lambda request: opened.failed.append(request.url))
    page.on("pageerror", lambda error: opened.errors.append(str(error)))
    page.on("console", lambda m: m.type == "error" and opened.errors.append(m.text))
    page.goto(url)
    settle(page)
    return opened


def settle(page):
    """Wait until equations are set and demos can answer."""
    page.wait_for_load_state("load")
    page.evaluate("() => window.MathJax?.startup?.promise")
    page.wait_for_function(
        "() => ![...document.querySelectorAll('.vmc-demo:has(> script)')]"
        ".some((demo) => !('ready' in demo.dataset))"
    )


def told_by_arms(path):
    """What every arm scene of a page tells its viewer, state by state."""
    text = path.read_text(encoding="utf-8")
    for packed in re.findall(r'<script type="application/gzip">(.*?)</script>', text, re.S):
        data = json.loads(gzip.decompress(base64.b64decode(packed)))
        for _, *parts in data.get("states", []):
            for part in parts:
                lines = [data["lines"][place] for place in part]
                told = dict(line.split("|") for line in lines if re.match(r"\w+\|", line))
                if "motion" in told:
                    yield {name: json.loads(value) for name, value in told.items()}


def in_picture(camera, points):
    """Where points (n, 3) are seen, from −1 to 1 in the narrowest picture (vmc_lib's scene.js)."""
    eye, at = np.array(camera)
    forward = (at - eye) / np.linalg.norm(at - eye)
    right = np.cross(forward, [0, 1, 0]) / np.linalg.norm(np.cross(forward, [0, 1, 0]))
    axes = np.stack([right, np.cross(right, forward), forward])
    x, y, far = axes @ (points - eye).T
    half = far * np.tan(np.radians(35 / 2))
    return x / (1.15 * half), y / half


@pytest.fixture(scope="module", params=CHAPTERS, ids=lambda path: path.stem)
def opened(request, offline):
    opened = open_page(offline, request.param.as_uri())
    opened.path = request.param
    yield opened
    opened.page.close()


def test_asks_nothing_beyond_the_book(opened):
    assert [url for url in opened.asked if not url.startswith(INSIDE)] == []
    assert opened.failed == []


def test_has_no_errors(opened):
    assert opened.errors == []


def test_equations_are_typeset(opened):
    assert opened.page.evaluate(RAW_TEX) == []


@cache
def anchors(path):
    return set(re.findall(r'\b(?:id|name)="([^"]+)"', path.read_text(encoding="utf-8")))


def broken_links(page):
    """Links from a page in the browser that are `broken`."""
    return broken(page.eval_on_selector_all("a[href]", "links => links.map(a => a.href)"))


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


def test_links_lead_somewhere(opened):
    assert list(broken_links(opened.page)) == []


UNLINKED = """() => [...document.querySelectorAll('article p, article li, article figcaption')]
  .map((prose) => prose.cloneNode(true))
  .filter((prose) => {
    prose.querySelectorAll('a, code, label').forEach((part) => part.remove());
    return /\\bEqs?\\. \\d/.test(prose.textContent);
  }).map((prose) => prose.textContent)"""


def test_equations_that_are_named_are_linked(opened):
    assert opened.page.evaluate(UNLINKED) == []


def test_figures_are_numbered(opened):
    captions = opened.page.locator("figcaption").all_text_contents()
    numbers = [re.match(r"Figure (?:\d+\.)?(\d+) ", caption) for caption in captions]
    assert [number and int(number[1]) for number in numbers] == [*range(1, len(captions) + 1)]


def test_pictures_are_there(opened):
    missing = "pictures => pictures.filter(i => !i.complete || !i.naturalWidth).map(i => i.src)"
    opened.page.evaluate("() => document.querySelectorAll('img').forEach(i => i.loading = 'eager')")
    assert opened.page.eval_on_selector_all("img[src]", missing) == []


LINKED = re.compile(r'(?:src|href)="([^"#?:]+\.(?:js|css|png|svg|jpg|webp))[?"]')


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_hand_and_target_stay_in_the_picture(path):
    for told in told_by_arms(path):
        motion, target = told["motion"], told.get("target")
        turn = np.array(motion["turn"])
        wrist = hand(np.array(motion["q"]))
        points = [to_world(wrist + FINGERS, turn), to_world(wrist, turn)]
        if target:
            points += [[target + to_world(BEYOND, turn[-1]) - to_world(np.zeros(3), turn[-1])]]
        assert np.abs(in_picture(told["camera"], np.concatenate(points))).max() < 1


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.relative_to(BUILT).as_posix())
def test_is_light(path):
    """A page with all that it links to; what is fetched later (a scene's viewer) aside."""
    text = path.read_text(encoding="utf-8")
    linked = {(path.parent / unquote(link)).resolve() for link in LINKED.findall(text)}
    weight = sum(file.stat().st_size for file in {path, *linked} if file.is_file())
    assert weight <= (5e6 if 'class="vmc-demo"' in text else 3e6)
    assert ("mathjax.js" in text) == bool(re.search(r'class="math|\\\(', text))


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_folds_are_closed_and_hide_no_exercise(path):
    text = path.read_text(encoding="utf-8")
    assert text.count("<details") == text.count("</details>")
    assert not BeautifulSoup(text, "html.parser").select("details .exercise")


def test_every_icon_is_drawn(opened):
    assert opened.page.locator("i[class*=fa-]").count() == 0
    heights = "icons => icons.map((icon) => icon.getBoundingClientRect().height)"
    assert max(opened.page.eval_on_selector_all(".svg-inline--fa", heights)) < 40


def test_every_control_moves_its_picture(opened):
    assert opened.page.evaluate(IDLE_CONTROLS) == []


# Runs in the page. Moves each slider of a place that can be dragged through all its values; returns
# the pictures, as markup, that hold what is no number.
BROKEN_DRAGS = """() => [...document.querySelectorAll(".vmc-demo[data-ready] .vmc-pad input")]
  .flatMap((slider) => [...Array(+slider.max + 1).keys()].map((place) => {
    slider.value = place;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    const drawn = slider.closest(".vmc-demo").querySelector(".vmc-pictures").outerHTML;
    return drawn.replace(/data:[^"]*/g, ""); // a photograph's letters may spell anything
  })).filter((markup) => /NaN|undefined|Infinity/.test(markup))"""


def test_every_place_of_a_dragged_slider_is_drawn(opened):
    assert opened.page.evaluate(BROKEN_DRAGS) == []


# Runs in the page. The demos whose sliders begin at different places, or move when others do.
RESTLESS = """() => [...document.querySelectorAll(".vmc-demo[data-ready]")].filter((demo) => {
  const sliders = [...demo.querySelectorAll("input[data-texts]")];
  const ends = () => sliders.map((slider) => slider.getBoundingClientRect())
    .map(({ left, right }) => `${left} ${right}`);
  const before = ends();
  for (const slider of sliders) slider.value = slider.max;
  demo.dispatchEvent(new Event("input", { bubbles: true }));
  return new Set([...before, ...ends()]).size > 1;
}).map((demo) => demo.id)"""


def test_sliders_stand_in_a_grid_and_still(opened):
    assert opened.page.evaluate(RESTLESS) == []


def test_a_chapter_begins_with_a_demo(opened):
    """Its first demo begins within one and a half screens of 1280 × 800."""
    if not opened.path.stem[:2].isdigit():
        pytest.skip("not a chapter")
    opened.page.set_viewport_size({"width": 1280, "height": 800})
    opened.page.evaluate(TWO_FRAMES)
    first = opened.page.locator(".vmc-demo:has(.vmc-controls), .vmc-live").first
    top = first.evaluate("(demo) => demo.getBoundingClientRect().top + scrollY")
    assert top <= 1.5 * 800


RUNS = ".tag_hide-input:not(.tag_hide-input + .tag_hide-input)"  # their first cells
MARK = "details.hide > summary"


def test_a_run_of_folded_cells_has_one_mark(opened):
    """The keyboard opens all the run's cells by it, and folds them again."""
    page, runs = opened.page, opened.page.locator(RUNS)
    if not runs.count():
        pytest.skip("no folded cells")
    unfold(page)
    seen = page.locator(MARK).filter(visible=True)
    assert seen.count() == runs.count() == page.locator(f"{RUNS} > {MARK}").count()
    run = page.locator(f"{RUNS}:has(+ .tag_hide-input)")
    first = (run if run.count() else runs).first
    mark = first.locator(f"> {MARK}")
    cells = [first, *first.locator("xpath=following-sibling::div").all()]
    folded = [cell.locator("> details.hide").count() > 0 for cell in cells]
    cells = cells[: (*folded, False).index(False)]
    for is_open in (True, False):
        mark.press("Enter")
        for cell in cells:
            code = cell.locator("> details > .cell_input")
            code.wait_for(state="visible" if is_open else "hidden")


# Runs in the page. The marks that are smaller than a target must be, or that lie on words or code.
CROWDED = """(least) => {
  const apart = "summary, script, mjx-container, .vmc-spoken, [class*=scrollable-table]";
  const shown = { opacityProperty: true, visibilityProperty: true }; // a closed solution is not
  const range = document.createRange();
  const words = document.createTreeWalker(document.querySelector("article"), NodeFilter.SHOW_TEXT);
  const lines = [];
  while (words.nextNode()) {
    const { currentNode: word, currentNode: { parentElement: within } } = words;
    if (within.closest(apart) || !within.checkVisibility(shown) || !word.data.trim()) continue;
    range.selectNodeContents(word);
    lines.push(...range.getClientRects());
  }
  return [...document.querySelectorAll("details.hide > summary")].filter((mark) => {
    const { left, right, top, bottom, width, height } = mark.getBoundingClientRect();
    const lies = (line) => line.width && line.left < right - 1 && line.right > left + 1
      && line.top < bottom - 1 && line.bottom > top + 1;
    return width && (Math.min(width, height) < least || lines.some(lies));
  }).map((mark) => mark.closest(".cell").outerHTML.slice(0, 300));
}"""


def test_marks_of_folded_code_have_room(opened):
    """In the margin of a wide page, 24 pixels; between the lines of a phone's, 44."""
    for width, least in ((360, 44), (768, 44), (800, 24), (1280, 24)):
        opened.page.set_viewport_size({"width": width, "height": 800})
        opened.page.evaluate(TWO_FRAMES)
        assert opened.page.evaluate(CROWDED, least) == []


def test_a_box_shows_all_code_and_is_remembered(offline):
    [path] = [path for path in CHAPTERS if path.stem == "09_planning"]
    page = open_page(offline, path.as_uri()).page
    closed = page.locator("details.hide:not([open])")
    assert closed.count()
    page.get_by_label("Show all code").check()
    assert not closed.count()
    page.reload()
    assert not closed.count()
    page.get_by_label("Show all code").uncheck()
    assert closed.count() == page.locator("details.hide").count()
    page.close()


def unfold(page):
    for fold in page.query_selector_all(".vmc-folded button[aria-expanded=false]"):
        fold.click()


def test_sliders_answer_the_keyboard(opened):
    unfold(opened.page)
    for slider in opened.page.query_selector_all(".vmc-demo input[data-texts]"):
        value = int(slider.input_value())
        forward = value < int(slider.get_attribute("max"))
        said = slider.get_attribute("aria-valuetext")
        slider.focus()
        opened.page.keyboard.press("ArrowRight" if forward else "ArrowLeft")
        assert int(slider.input_value()) == value + (1 if forward else -1)
        assert slider.get_attribute("aria-valuetext") != said


def test_is_accessible(opened, serious):
    assert serious(opened.page, "html", all_of_it=True) == []


# Runs in the page. Equations that would scroll, and words that leave their picture.
CUT = """() => {
  const equations = [...document.querySelectorAll("div.math")];
  const wide = equations.filter((e) => e.scrollWidth > e.clientWidth + 1);
  const out = [...document.querySelectorAll(".vmc-picture svg text")].filter((word) => {
    const [box, frame] = [word, word.ownerSVGElement].map((e) => e.getBoundingClientRect());
    return box.width && (box.left < frame.left - 3 || box.right > frame.right + 3
      || box.top < frame.top - 3 || box.bottom > frame.bottom + 3);
  });
  return [...wide, ...out].map((e) => e.textContent);
}"""


def test_no_equation_and_no_word_of_a_picture_is_cut(opened):
    opened.page.set_viewport_size({"width": 1280, "height": 800})
    opened.page.evaluate(TWO_FRAMES)
    assert opened.page.evaluate(CUT) == []


def test_fits_phones_tablets_and_enlarged_pages(opened):
    """Three phones, two tablets; 320 and 640 are a window of 1280 at 400 % and at 200 %."""
    too_wide = []
    for width in (320, 360, 412, 640, 768, 1024):
        opened.page.set_viewport_size({"width": width, "height": 700})
        opened.page.evaluate(TWO_FRAMES)
        found = opened.page.evaluate(WIDE)
        whole = opened.page.evaluate("() => document.documentElement.scrollWidth")
        too_wide += [(width, whole, found)] if found or whole > width else []
    assert too_wide == []


# Runs in the page. Moves every slider to its end; returns what paper must show of it.
TO_THE_END = """() => [...document.querySelectorAll(".vmc-demo[data-ready]")].flatMap((demo) => {
  for (const slider of demo.querySelectorAll("input[data-texts]")) slider.value = slider.max;
  demo.dispatchEvent(new Event("input", { bubbles: true }));
  return [...demo.querySelectorAll("output, svg text, figcaption")].map((e) => e.textContent);
})"""


def test_prints_what_a_reader_sees(offline):
    """A chapter on paper: its text, its demos as they stand, nothing to click, solutions closed."""
    [path] = [path for path in CHAPTERS if path.stem == "09_planning"]
    page = open_page(offline, path.as_uri()).page
    seen = " ".join(page.evaluate(TO_THE_END) + page.locator("article h2").all_inner_texts())
    sheets = pypdfium2.PdfDocument(page.pdf())
    printed = "\n".join(sheet.get_textpage().get_text_range() for sheet in sheets)
    words = re.compile(r"[\w.−]{3,}")
    assert not set(words.findall(seen)) - set(words.findall(printed))
    assert not re.findall(r"\bPlay\b|Click to|turn the view|Next", printed)
    assert printed.count("Solution to") == page.locator(".solution").count()
    assert "d_1" not in printed
    assert "linear interpolation" not in printed
    page.close()


NO_WEBGL = """const was = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : was.call(this, kind, ...rest);
};"""
# Of every demo: is something to be seen, and what does it say where it cannot move?
SHOWN = """() => [...document.querySelectorAll(".vmc-demo:has(> script)")].map((demo) => ({
  seen: [...demo.querySelectorAll(".vmc-picture")].every((one) => one.getClientRects().length
    && (one.querySelector("svg, img") || one.innerText.trim())),
  caption: demo.querySelector("figcaption").innerText.trim(),
  said: getComputedStyle(demo, "::after").content }))"""


@pytest.mark.parametrize("missing", ["scripts", "a script", "DecompressionStream", "WebGL"])
def test_what_cannot_move_shows_its_first_picture_and_its_words(chromium, missing):
    path = next(path for path in CHAPTERS if path.stem == "08_arm")
    context = chromium.new_context(offline=True, java_script_enabled=missing != "scripts")
    if missing == "a script":
        context.route("**/demo.js*", lambda route: route.abort())
    if missing == "DecompressionStream":
        context.add_init_script("delete self.DecompressionStream")
    if missing == "WebGL":
        context.add_init_script(NO_WEBGL)
    page = context.new_page()
    page.goto(path.as_uri())
    unfold(page)
    if missing == "WebGL":
        settle(page)
        assert page.locator(".vmc-scene p").first.inner_text()
    shown = page.evaluate(SHOWN)
    assert shown
    assert all(demo["seen"] and demo["caption"] for demo in shown)
    assert all(("newer browser" in demo["said"]) == (missing != "WebGL") for demo in shown)
    context.close()


@pytest.mark.parametrize("path", KINDS, ids=lambda path: path.relative_to(BUILT).as_posix())
def test_pages_made_by_sphinx(offline, path):
    opened = open_page(offline, path.as_uri())
    assert [url for url in opened.asked if not url.startswith(INSIDE)] == []
    assert opened.errors == opened.failed == list(broken_links(opened.page)) == []
    opened.page.close()


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.relative_to(BUILT).as_posix())
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
    opened = open_page(offline, f"{root}/search.html?q=shuttlecock")
    opened.page.wait_for_selector("#search-results li a")
    assert opened.errors == []
    opened.page.evaluate("() => localStorage.clear()")  # it marks what was sought on every page
    opened.page.close()


def test_what_was_sought_is_marked_and_can_be_read(offline, serious):
    opened = open_page(offline, f"{BUILT.as_uri()}/book/glossary.html?highlight=cell")
    opened.page.wait_for_selector("span.highlighted")
    assert serious(opened.page, "article") == []
    opened.page.evaluate("() => localStorage.clear()")
    opened.page.close()


@pytest.mark.parametrize("path", SCRIPTED, ids=lambda path: path.stem)
def test_reads_over_http_too(offline, over_http, path):
    opened = open_page(offline, f"{over_http}/book/{path.name}")
    assert opened.errors == opened.failed == []
    assert all(url.startswith((over_http, "data:", "blob:")) for url in opened.asked)
    opened.page.close()
