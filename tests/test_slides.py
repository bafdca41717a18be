"""Slides: one sentence each, what to say in the notes; few, by the clock, offline."""

import re

import numpy as np
import pytest
from bs4 import BeautifulSoup

from book.figures.plans import PLANS
from kit.__main__ import CHAPTERS, ROOT
from kit.chapter_slides import EXERCISES, chapter_slides
from kit.session import MINUTES
from tests.pages import TWO_FRAMES, open_url
from tests.project import sample

BUILT = ROOT / "_build/html/book"


PAGE = """<section><h1>Arm</h1><p>Idea.</p><p>Aims.</p>
  <section id="pull"><h2>Pull</h2><p>See Eq. 1 first. Then more.</p>
    <div class="math">x \\tag{1}</div>
    <div class="exercise">Do.</div><div class="cell">Yours.<form data-function="x"></form></div>
    <div class="solution">So.</div>
    <div class="cell"><details>folded</details><div class="cell_output"><div class="output">
      <div class="admonition"><fieldset class="vmc-predict"><legend>How far?</legend>
      <details class="vmc-right"><summary>What came out</summary><p>Far.</p></details></fieldset>
      </div></div></div></div>
    <figure class="vmc-demo"><form class="vmc-controls"><label>speed</label></form>
      <figcaption>Blue: a path.</figcaption></figure><p>Third.</p></section>
  <section class="vmc-optional" id="more"><h2>More</h2><figure class="vmc-demo"></figure></section>
  <section id="recap"><h2>Recap</h2><p>It was far. And more.</p>
    <p><strong>What next?</strong></p></section></section>"""


def slides_of(html):
    """A chapter's slides, its equations before its recap, from its page's HTML."""
    chapter = chapter_slides(BeautifulSoup(html, "html.parser").section)
    slides = [*chapter.text(1), *chapter.equations({1}), chapter.recap]
    return [BeautifulSoup(str(slide), "html.parser") for slide in slides]


def bodies(html):
    return [slide.select_one(".fit").get_text(" ", strip=True) for slide in slides_of(html)]


def test_a_chapter_becomes_slides_and_notes():
    """A sentence on a slide, the rest in the notes; of exercises where, nothing optional."""
    assert bodies(PAGE) == [
        "Arm Idea.",
        "Pull How far? What came out Far.",
        "Pull speed Blue: a path.",
        "Pull See Eq. 1 first. x \\tag{1}",
        f"Recap It was far. And more. What next? {EXERCISES[3:-4]}",
    ]
    notes = slides_of(PAGE)[2].select_one(".notes").get_text(" ", strip=True)
    guide = "Ask. How far? Look for. Blue: a path. Stop at. Far."
    assert notes == f"{guide} See Eq. 1 first. Then more. Third."


SECTION = """<section><h1>Arm</h1><p>Idea.</p>{}<section><h2>{}</h2>{}</section>
  <section><h2>Recap</h2><p>It was far.</p></section></section>"""
ASKED = """<div class="admonition"><fieldset class="vmc-predict"><legend>How far?</legend>
  <details><summary>So</summary><p>Far.</p></details></fieldset></div>"""
MATH = '<div class="math">x \\tag{1}</div>'
DEMO = '<figure class="vmc-demo"><figcaption>Blue.</figcaption></figure>'
HIDDEN = f'<div class="cell tag_off-slides">{DEMO}</div>'


@pytest.mark.parametrize(
    ("opening", "heading", "text", "middle"),
    [
        ("", "Pull", f"<p>First. More.</p>{MATH}", ["Pull First. x \\tag{1}"]),
        ("", "Pull", f"{MATH}<p>Here x. More.</p>", ["Pull Here x. x \\tag{1}"]),
        (
            "",
            "Pull",
            f"<ul><li><p>A.</p></li><li><p>B.</p></li></ul>{MATH}",
            ["Pull B. x \\tag{1}"],
        ),
        (DEMO + ASKED, "Pull", "", ["Arm How far? So Far.", "Arm Blue."]),
        ("", "Pull", ASKED + HIDDEN, []),
        ("", "What the brain does", DEMO, ["What the brain does Blue."]),
    ],
    ids=["equation", "equation first", "list", "opening", "off", "wiring"],
)
def test_what_a_slide_of_a_section_holds(opening, heading, text, middle):
    """An equation with what tells of it; a chapter's first demo with the question below it."""
    assert bodies(SECTION.format(opening, heading, text)) == [
        "Arm Idea.",
        *middle,
        "Recap It was far.",
    ]


def test_a_question_between_two_demos_is_asked_before_the_lower_one():
    opening = SECTION.format(DEMO.replace("Blue", "Red") + ASKED + DEMO, "Pull", "")
    chapter = chapter_slides(BeautifulSoup(opening, "html.parser").section)
    [[_, [_, asked]]], [[_, [other]]] = chapter.asked, chapter.others
    assert ("Blue." in str(asked), "Red." in str(other)) == (True, True)


def test_nothing_is_shown_that_stands_under_another_heading():
    article = BeautifulSoup(PAGE, "html.parser").section
    assert chapter_slides(article, ["Recap"]).asked == []


def test_a_demo_is_found_by_its_section_or_by_its_chapter_once():
    opening = PAGE.replace("<p>Aims.</p>", f"{DEMO}<p>Aims.</p>")
    chapter = chapter_slides(BeautifulSoup(opening, "html.parser").section)
    [first] = chapter.demo_of("the arm")
    assert "Blue." in str(first)
    ask, demo = chapter.demo_of("Pull")
    assert ("How far?" in str(ask), "Blue: a path." in str(demo)) == (True, True)
    assert chapter.asked == chapter.others == []
    with pytest.raises(ValueError, match="Arm: no demo to open it"):
        chapter.demo_of("Pull")


def test_a_recap_that_only_says_next_says_what():
    page = PAGE.replace("<strong>What next?</strong>", "<strong>Next:</strong> a muscle.")
    assert bodies(page)[-1] == f"Recap It was far. And more. Next: a muscle. {EXERCISES[3:-4]}"


def deck(kit, name):
    page = BeautifulSoup((kit / f"slides/{name}.html").read_text(encoding="utf-8"), "html.parser")
    return page.select(".slides > section")


def test_a_session_has_few_slides_and_each_demo_its_notes(kit):
    decks = sorted(path.stem for path in (kit / "slides").glob("*.html"))
    assert decks == DECKS
    titles = 0
    for name in decks:
        slides = deck(kit, name)
        titles += len([slide for slide in slides if slide.select(".fit > h1")]) - 1
        assert 10 <= len(slides) <= MOST
        for slide in slides:
            words = [p.get_text() for p in slide.select(".fit > p:not(.fragment)")]
            assert sum(len(text.split()) for text in words) <= 75, words
            assert slide.select_one(".notes").get_text(strip=True)
            if slide.select(".fit .vmc-demo"):
                text = slide.select_one(".notes").get_text()
                assert all(word in text for word in ("Ask.", "Look for.", "Stop at."))
        assert len([cite for slide in slides for cite in slide.select(".notes cite")]) >= 3
    assert titles == len(CHAPTERS)


@pytest.fixture(params=range(1, 7))
def session(request, kit):
    """The number of a session, its slides, and the minutes of each."""
    slides = deck(kit, f"session-{request.param}")
    return request.param, slides, [int(slide["data-timing"]) / 60 for slide in slides]


def test_a_session_takes_ninety_minutes_of_which_students_act_in_half(session):
    _, slides, minutes = session
    assert sum(minutes) == pytest.approx(MINUTES, abs=0.2)
    active = [m for slide, m in zip(slides, minutes, strict=True) if slide.has_attr("data-active")]
    assert sum(active) >= MINUTES / 2
    clock = slides[0].select_one(".notes").get_text()
    assert "In class: from minute 5, slide 2" in clock
    assert "Next: from minute 85" in clock
    assert f"Students do something in {sum(active):.0f} minutes of 90." in clock


LINES = {  # that are changed, where a cell has them
    1: ["(name, k): segment(photos.as_float(image), k)"],
    2: ["x = p2.mean(1)  # Eq. 2: is there anything, and where?"],
    4: ["return (1 / d) / (1 / d).sum(axis=-1, keepdims=True)"],
    5: ["penalty = ridge * np.eye(active.shape[1])"],
}


def test_each_part_of_a_session_has_its_slide_and_a_pair_its_five_minutes(session):
    """Hands, board, break and cell; two questions of a quiz, three predictions or more."""
    number, slides, minutes = session
    heads = [slide.select_one(".fit > h2") for slide in slides]
    names = [head.get_text() if head else "" for head in heads]
    own = [names.index(name) for name in ("In class", "On the board", "Break", "Change a line")]
    assert own == sorted(own)
    hands, board, _, cell = (slides[k] for k in own)
    assert len(board.select(".fragment")) >= 3
    assert bool(board.select(".board div.math")) == (number in {3, 4})
    assert [line.get_text().strip() for line in cell.select("mark")] == LINES.get(number, [])
    assert len(hands.select("a")) == (number == 5)  # to the page for throws
    starts = np.cumsum([0, *minutes[:-1]])
    taken = [m for m, start in zip(minutes, starts, strict=True) if 5 <= start < 15]
    assert len(taken) == 1 or taken[-1] == pytest.approx(sum(taken) / 2)  # its demo has half
    assert len([slide for slide in slides if slide.select(".fit .vmc-quiz")]) == 2
    demos = [k for k in range(own[1]) if slides[k].select(".fit .vmc-demo") and minutes[k] < 5]
    asked = [k for k in demos if slides[k - 1].select(".fit .vmc-predict")]
    later = [k for k in asked if sum(minutes[: k - 1]) >= 14.9]  # not in class
    assert len(later) == (3 if number == 5 else 5)
    assert all(minutes[k - 1] + minutes[k] == pytest.approx(5) for k in later)
    wiring = [m for m, slide in zip(minutes, slides, strict=True) if "mossy" in str(slide.figure)]
    assert number != 5 or wiring == [5]
    assert all(1 <= m for m in minutes)
    assert slides[-1].select_one(".fit strong, .fit p").get_text()


def test_what_a_session_shows_was_read_or_has_its_title_before_it(kit):
    """But what opens the session, in class: that is shown before anybody knows it."""
    for number, plan in enumerate(PLANS[6], start=1):
        known, seconds = {int(name[:2]) for name in plan.read}, 0
        for slide in deck(kit, f"session-{number}"):
            known |= {int(n) for n in re.findall(r"<h1>(?:<span[^>]*>)?(\d+)\. ", str(slide))}
            figures = {int(n) for n in re.findall(r"Figure (\d+)\.\d+</span>", str(slide))}
            assert figures <= known or seconds < 900, (number, figures)
            seconds += int(slide["data-timing"])


MOST = 25  # slides
DECKS = ["more", *(f"session-{n}" for n in range(1, 7))]
# The slides that do not fit, or only too small, or whose plots have empty edges, by which handles
# would stand beside their marks: each has 600 pictures to settle in
MISFITS = """async () => {
  const misfits = [], frame = () => new Promise(requestAnimationFrame);
  for (let number = 0; number < Reveal.getTotalSlides(); number++) {
    Reveal.slide(number);
    const slide = Reveal.getCurrentSlide(), { style } = slide.querySelector(":scope > .fit");
    const tight = ({ viewBox: { baseVal }, clientWidth, clientHeight }) => !clientHeight ||
      Math.abs(clientWidth / clientHeight / (baseVal.width / baseVal.height) - 1) < 0.02;
    const plots = () => [...slide.querySelectorAll("svg[data-axes]")];
    const fits = () => slide.scrollHeight <= slide.clientHeight + 1 &&
      slide.scrollWidth <= slide.clientWidth + 1 && style.zoom >= 0.6 && plots().every(tight);
    let still = 0;
    for (let frames = 600; frames && still < 3; frames--) {
      await frame();
      still = fits() ? still + 1 : 0;
    }
    if (still < 3) misfits.push(number);
  }
  return misfits;
}"""


@pytest.mark.browser
@pytest.mark.parametrize(
    "name", sample(["more", *(f"session-{n}" for n in range(1, 7))], "session-2")
)
def test_slides_open_offline_fit_a_small_projector_and_their_demos_move(kit, window, name):
    projector = window(viewport={"width": 1280, "height": 720})
    page = open_url(projector, (kit / f"slides/{name}.html").as_uri())
    page.wait_for_function("() => window.Reveal?.isReady()")
    assert page.evaluate(MISFITS) == []
    if name != "more":
        assert_first_demo_moves(page)
    assert page.errors == page.failed == []


@pytest.mark.browser
def test_a_deck_prints_one_slide_a_page(kit, window, tmp_path):
    page = open_url(window(), (kit / "slides/session-5.html").as_uri())
    page.wait_for_function("() => window.Reveal?.isReady()")
    page.pdf(path=tmp_path / "deck.pdf", prefer_css_page_size=True)
    pages = re.findall(rb"/Type\s*/Page\b", (tmp_path / "deck.pdf").read_bytes())
    assert len(pages) == page.evaluate("() => Reveal.getTotalSlides()")
    assert page.locator(".fit details:not([open])").count() == 0
    page.emulate_media(media="print")
    reasons = page.locator(".fit :is(.vmc-quiz, .vmc-predict) details p")
    shown = "(all) => all.map((one) => one.checkVisibility())"
    assert all(reasons.evaluate_all(shown))
    line = "(mark) => getComputedStyle(mark).printColorAdjust + getComputedStyle(mark).outlineStyle"
    assert page.locator(".fit mark").first.evaluate(line) == "exactsolid"
    box = "(one) => getComputedStyle(one).listStyleType + getComputedStyle(one).listStylePosition"
    assert page.locator(".fit .vmc-quiz .vmc-right summary").first.evaluate(box) == '"☑ "inside'


def assert_first_demo_moves(page):
    plain = ".vmc-demo:has(> .vmc-pictures):not(:has(.vmc-scene)):has(input[type=range])"
    demo = page.locator(plain).first
    demo.evaluate("""demo => {
      const { h, v } = Reveal.getIndices(demo.closest("section"));
      Reveal.slide(h, v);
    }""")
    slider, pictures = demo.locator("input[type=range]").first, demo.locator(".vmc-pictures")
    slider.press("Home")
    first = pictures.inner_html()
    slider.press("End")
    assert pictures.is_visible()
    assert pictures.inner_html() != first
    assert page.evaluate("() => Reveal.getCurrentSlide().querySelector('.vmc-demo') !== null")


# Where each handle of a deck stands on its picture, as a share of it: as the slide fits, and larger
HANDLES = """async () => {
  const frames = async () => {
    for (let k = 0; k < 5; k++) await new Promise(requestAnimationFrame);
  };
  const middle = ({ left, top, width, height }) => [left + width / 2, top + height / 2];
  const places = [];
  for (const handle of document.querySelectorAll(".fit .vmc-handle")) {
    Reveal.slide(Reveal.getIndices(handle.closest(".slides > section")).h);
    const pictures = handle.closest(".vmc-pictures"), { style } = handle.closest(".fit");
    const plot = pictures.querySelectorAll("svg[data-axes]")[handle.dataset.picture];
    const place = () => {
      const { left, top, width, height } = plot.getBoundingClientRect();
      const [x, y] = middle(handle.getBoundingClientRect());
      return [(x - left) / width, (y - top) / height];
    };
    await frames();
    const fitted = place();
    style.zoom = 1.3;
    await frames();
    places.push([...fitted, ...place()]);
    Reveal.slide(0);
  }
  return places;
}"""


@pytest.mark.browser
def test_a_handle_stands_on_its_mark_however_small_its_slide_is_drawn(decks):
    places = []
    for deck in decks:
        deck.bring_to_front()
        places += deck.evaluate(HANDLES)
    assert len(places) >= 5
    x, y, larger_x, larger_y = np.transpose(places)
    assert max(np.abs(x - larger_x).max(), np.abs(y - larger_y).max()) < 0.02


@pytest.mark.browser
def test_a_plan_beside_a_scene_is_read_from_the_last_row(decks):
    deck = next(deck for deck in decks if deck.locator(".vmc-live .vmc-handle").count())
    deck.bring_to_front()
    plot = deck.locator(".vmc-live .vmc-handle >> xpath=.. >> css=svg[data-axes]").first
    plot.evaluate(SHOW)
    deck.evaluate(TWO_FRAMES)
    assert plot.bounding_box()["width"] >= 0.3 * 1280


CLICKED = {  # what a speaker clicks, and whether it needs the arrows and the space bar itself
    "answer": (".vmc-predict input", True, True),
    "folded summary": (".vmc-predict summary", False, True),
    "slider": (".vmc-controls [data-stride][type=range]", True, False),
    "pad": (".vmc-pad input", True, False),
    "handle": (".vmc-handle", False, False),
    "play": ("[data-stride] ~ .vmc-play", False, True),
    "arm": (".vmc-scene", False, False),
    "start": ("[name=main]", False, True),
}
SHOW = """(part) => {
  const { h } = Reveal.getIndices(part.closest(".slides > section"));
  Reveal.slide(h);
  return h; }"""
STATE = """(part) => [
  Reveal.getIndices().h, part.value, part.checked, part.closest("details")?.open]"""


@pytest.fixture(scope="module")
def decks(kit, chromium):
    """The sessions' decks, open before a projector."""
    projector = chromium.new_context(offline=True, viewport={"width": 1280, "height": 720})
    decks = [
        open_url(projector, path.as_uri()) for path in sorted((kit / "slides").glob("session-*"))
    ]
    yield decks
    projector.close()


@pytest.mark.browser
@pytest.mark.parametrize("kind", sample(CLICKED, "answer", "slider", "play", "start"))
def test_a_clicker_turns_the_page_after_whatever_was_clicked(decks, kind):
    """And moves no control; arrows and space bar do where the control does not need them."""
    selector, arrows, space = CLICKED[kind]
    page = next(deck for deck in decks if deck.locator(f".fit {selector}").count())
    page.bring_to_front()
    part = page.locator(f".fit {selector}").first
    here = part.evaluate(SHOW)

    def slide_after(key):
        part.evaluate(SHOW)
        part.click()
        _, *before = part.evaluate(STATE)
        page.keyboard.press(key)
        slide, *after = part.evaluate(STATE)
        assert slide == here or after == before
        return slide - here

    assert [slide_after(key) for key in ("PageDown", "PageUp")] == [1, -1]
    turned = [slide_after(key) for key in ("ArrowRight", "ArrowLeft")]
    assert turned == ([0, 0] if arrows else [1, -1])
    assert slide_after(" ") == (0 if space else 1)
    assert page.errors == []
