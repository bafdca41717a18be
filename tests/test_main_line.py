"""The main line of the built chapters is short: words, captions, controls, predictions."""

import json
from itertools import product

import pytest

from tests.pages import CHAPTERS, boxes, open_url
from tools.main_line import main_line

NUMBERED = [path for path in CHAPTERS if path.stem[:2].isdigit()]
each_chapter = pytest.mark.parametrize("path", NUMBERED, ids=lambda path: path.stem)


PAGE = """<article><h1>A title</h1><p>Two words <code>and three</code></p><pre>no code</pre>
<details><summary>one line</summary><p>folded away</p></details>
<section class="vmc-optional"><h2>A head</h2><p>deeper</p><i class="vmc-predict"></i></section>
<fieldset class="vmc-predict"><p>What then?</p></fieldset>
<figure class="vmc-demo" id="demo-1"><svg><text>plot</text></svg><form>
<div class="vmc-pad"><div class="vmc-control"><input type="range"></div></div>
<div class="vmc-control"><input type="range"></div><fieldset class="vmc-control"></fieldset>
<div class="vmc-control"><div class="vmc-options"><label><input type="checkbox"></label></div></div>
<details class="vmc-more"><summary>m</summary><fieldset class="vmc-control"></fieldset></details>
</form><figcaption>A caption of five words</figcaption></figure></article>"""


def test_what_is_read_is_counted(tmp_path):
    path = tmp_path / "page.html"
    path.write_text(PAGE, encoding="utf-8")
    line = main_line(path)
    assert (line.words, line.predictions, line.controls) == (17, 1, [4])
    assert [(one.name, one.caption) for one in line.figures] == [("demo-1", 5)]


def test_the_book_is_short():
    assert sum(main_line(path).words for path in NUMBERED) <= 36_000


@each_chapter
def test_a_chapter_is_short(path):
    assert main_line(path).words <= 2800


@each_chapter
def test_predictions_are_few(path):
    assert main_line(path).predictions <= 4


@each_chapter
def test_captions_are_short(path):
    assert [one for one in main_line(path).figures if one.caption > 40] == []


@each_chapter
def test_a_figure_has_few_controls(path):
    """The first that moves two at most, others three; but four weights are set by four sliders."""
    first, *others = main_line(path).controls
    assert first <= 2
    assert [count for count in others if count > 3] == [4] * (path.stem == "10_offline")


SHOWN = """() => [...document.querySelectorAll(".vmc-demo, .vmc-live")].flatMap((figure) => {
  const select = (names) => [...figure.querySelectorAll(names)].filter(
    (part) => part.checkVisibility({ contentVisibilityAuto: true }) && !part.closest("details"));
  const moved = ".vmc-controls, .vmc-live-form > :is(div:not(.vmc-muscles), fieldset)";
  const boxes = select(`.vmc-pictures, ${moved}`)
    .map((part) => part.getBoundingClientRect());
  const words = select(".vmc-picture svg text").filter((word) => word.textContent.trim());
  const sizes = words.map((word) => {
    const { a, b } = word.getScreenCTM();
    return parseFloat(getComputedStyle(word).fontSize) * Math.hypot(a, b);
  });
  const ends = boxes.flatMap(({ top, bottom }) => [top, bottom]);
  const share = (Math.max(...ends) - Math.min(...ends)) / innerHeight;
  return boxes.length ? [[figure.id, share, Math.min(...sizes, 99)]] : [];
})"""
SCREENS = {"laptop": {"width": 1280, "height": 800}, "phone": {"width": 390, "height": 844}}
PLAYING = {"01", "09", "12", "13", "15"}  # chapters with a button on a phone's first screen
ON_PHONES = PLAYING | {"04", "08"}  # chapters; the others' phones wait for the audit
BUTTON = ".vmc-demo :is(.vmc-play, .vmc-live-form button)"


def on_screen(path, screen):
    """A chapter's case on a screen: most phones wait for the audit."""
    waits = [pytest.mark.audit] * (screen == "phone" and path.stem[:2] not in ON_PHONES)
    return pytest.param(path, screen, marks=waits, id=f"{path.stem}-{screen}")


on_screens = pytest.mark.parametrize(
    ("path", "screen"), [on_screen(*case) for case in product(NUMBERED, SCREENS)]
)


@pytest.fixture
def measured(window, once, path, screen):
    """Figures: the name, height with controls (of the window's), least words; the first button."""

    def measure(folder):
        folder.mkdir()
        page = open_url(window(viewport=SCREENS[screen]), path.as_uri())
        page.wait_for_function("document.querySelector('.vmc-demo[data-ready]')")
        sizes = page.evaluate(SHOWN), boxes(page.locator(BUTTON))[:1]
        (folder / "sizes.json").write_text(json.dumps(sizes), encoding="utf-8")

    file = once(f"main_line_{path.stem}_{screen}", measure) / "sizes.json"
    return json.loads(file.read_text(encoding="utf-8"))


@pytest.mark.browser
@on_screens
def test_a_figure_and_its_controls_fit_the_window(measured):
    shown, _ = measured
    assert [(name, share) for name, share, _ in shown if share > 0.85] == []


@pytest.mark.browser
@on_screens
def test_words_of_plots_can_be_read(measured):
    """11 px high at least, rounded."""
    shown, _ = measured
    assert [(name, size) for name, _, size in shown if round(size) < 11] == []


@pytest.mark.browser
@pytest.mark.parametrize(
    ("path", "screen"),
    [on_screen(path, "phone") for path in NUMBERED if path.stem[:2] in PLAYING],
)
def test_on_a_phone_the_first_button_is_on_the_first_screen(measured):
    _, [[_, top, _, height]] = measured
    assert 0 < top < top + height <= 844
