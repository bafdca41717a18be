"""Every chapter of the built book, opened in a browser with the network off."""

import re

import pytest

from tests.pages import (
    CHAPTERS,
    INSIDE,
    NUMBERED,
    TWO_FRAMES,
    boxes,
    broken_links,
    open_url,
    probe,
    unfold,
)
from tests.project import sample

pytestmark = pytest.mark.browser
# A page of each kind of figure: plots, photos, scenes, live arms, many controls, words alone
a_page_of_each_kind = pytest.mark.kinds(
    *("index", "03_regions", "07_muscle", "10_offline", "15_whole_arm", "ledger", "your_photo")
)
each_chapter = pytest.mark.only(*(path.stem for path in NUMBERED))


@pytest.fixture(scope="module", params=CHAPTERS, ids=lambda path: path.stem)
def page(request, offline):
    page = open_url(offline, request.param.as_uri())
    page.path = request.param
    yield page
    page.close()


def resize(page, width, height=800):
    page.set_viewport_size({"width": width, "height": height})
    page.evaluate(TWO_FRAMES)


def test_the_book_is_built():
    assert CHAPTERS, "no built book in _build/html: run `make book` first"


SCREENS = (390, 844), (1280, 800)  # a phone's, a laptop's: at which the page stays
FIRST = ".vmc-demo:has(.vmc-controls, input[type=range]), .vmc-live"
MOVABLE = ":is(.vmc-handle, input, select):visible"


@each_chapter
@a_page_of_each_kind
@pytest.mark.parametrize(("width", "height"), SCREENS)
def test_the_first_screen_plays(page, width, height):
    """Before anything is moved (so this test comes first), what can be moved stands there whole."""
    resize(page, width, height)
    page.evaluate("() => scrollTo(0, 0)")
    [[_, y, _, tall]] = boxes(page.locator(FIRST).first.locator(MOVABLE).first)
    assert y + tall <= height


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
PLAYING = ("01_loop", "09_planning", "12_while_it_moves", "13_see_and_reach", "15_whole_arm")
BUTTON = ".vmc-demo :is(.vmc-play, .vmc-live-form button)"
at_sizes = pytest.mark.parametrize(
    ("width", "height"),
    [
        SCREENS[1],
        pytest.param(*SCREENS[0], marks=pytest.mark.kinds("08_arm", "13_see_and_reach")),
    ],
)


@each_chapter
@at_sizes
def test_a_figure_and_its_controls_fit_the_window(page, width, height):
    resize(page, width, height)
    assert [(name, share) for name, share, _ in page.evaluate(SHOWN) if share > 0.85] == []


@each_chapter
@at_sizes
def test_words_of_plots_can_be_read(page, width, height):
    """11 px high at least, rounded."""
    resize(page, width, height)
    assert [(name, size) for name, _, size in page.evaluate(SHOWN) if round(size) < 11] == []


@pytest.mark.only(*PLAYING)
def test_on_a_phone_the_first_button_is_on_the_first_screen(page):
    resize(page, *SCREENS[0])
    [[_, top, _, height], *_] = boxes(page.locator(BUTTON))
    assert 0 < top < top + height <= 844


def test_asks_nothing_beyond_the_book(page):
    assert [url for url in page.asked if not url.startswith(INSIDE)] == []
    assert page.failed == []


def test_has_no_errors(page):
    assert page.errors == []


def test_equations_are_typeset(page):
    assert probe(page, "rawTex") == []


def test_links_lead_somewhere(page):
    assert broken_links(page) == []


@a_page_of_each_kind
def test_a_term_shows_its_card_to_the_keyboard(page):
    """The glossary's first sentence, as the link is reached by Tab."""
    unfold(page)
    terms = page.locator("article a[data-card]").filter(visible=True)
    if not terms.count():
        pytest.skip("no terms")
    terms.first.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    shown = terms.first.evaluate("(term) => getComputedStyle(term, '::after').content")
    assert shown[1:-1].replace('\\"', '"') == terms.first.get_attribute("data-card")


# Of the header's buttons those that look the same, whether the keyboard has reached them or not.
UNMARKED = """() => [...document.querySelectorAll(".bd-header-article button")]
  .filter((button) => button.checkVisibility({ visibilityProperty: true })).filter((button) => {
    button.focus({ focusVisible: true });
    const { outlineStyle, outlineWidth } = getComputedStyle(button);
    button.blur();
    return outlineStyle === "none" || parseFloat(outlineWidth) < 2;
  }).map((button) => button.outerHTML)"""


@a_page_of_each_kind
def test_buttons_of_the_header_show_the_keyboards_focus(page):
    resize(page, *SCREENS[1])
    page.keyboard.press("Tab")  # from now on focus comes by the keyboard
    assert page.evaluate(UNMARKED) == []


def test_equations_that_are_named_are_linked(page):
    assert probe(page, "unlinkedEquations") == []


def test_figures_are_numbered(page):
    captions = page.locator("figcaption").all_text_contents()
    numbers = [re.match(r"Figure (?:\d+\.)?(\d+) ", caption) for caption in captions]
    assert [number and int(number[1]) for number in numbers] == [*range(1, len(captions) + 1)]


# Captions that say "above", whose pictures or panels do not stand one below the other.
NOT_STACKED = """() => [...document.querySelectorAll("figcaption:has([data-stacked])")]
  .filter((caption) => caption.checkVisibility()).filter((caption) => {
    const parts = ".vmc-panels > div, .vmc-picture:not(:has(.vmc-panels))";
    const [first, second] = [...caption.closest("figure").querySelectorAll(parts)]
      .map((part) => part.getBoundingClientRect());
    return caption.innerText.includes("Left:") || !second?.height || second.top < first.bottom;
  }).map((caption) => caption.innerText)"""


@a_page_of_each_kind
def test_a_caption_says_above_where_pictures_stand_one_below_the_other(page):
    unfold(page)
    resize(page, 390, 844)
    assert page.evaluate(NOT_STACKED) == []


def test_pictures_are_there(page):
    assert probe(page, "missingPictures") == []


def test_folds_are_closed_and_hide_no_exercise(page):
    text = page.path.read_text(encoding="utf-8")
    assert text.count("<details") == text.count("</details>")
    assert page.locator("details .exercise").count() == 0


def test_every_icon_is_drawn(page):
    assert page.locator("i[class*=fa-]").count() == 0
    heights = "icons => icons.map((icon) => icon.getBoundingClientRect().height)"
    assert max(page.eval_on_selector_all(".svg-inline--fa", heights)) < 40


@a_page_of_each_kind
def test_every_control_moves_its_picture(page):
    assert probe(page, "idleControls") == []


@a_page_of_each_kind
def test_every_place_of_a_dragged_slider_is_drawn(page):
    assert probe(page, "brokenDrags") == []


@a_page_of_each_kind
def test_sliders_stand_in_a_grid_and_still(page):
    assert probe(page, "restlessSliders") == []


EIGHTHS = [0.02 + 0.12 * k for k in range(9)]


@a_page_of_each_kind
@pytest.mark.parametrize(
    ("width", "height", "places"),
    [
        (390, 844, [0.02, 0.5, 0.98]),  # where there is least room
        *(pytest.param(*screen, EIGHTHS, marks=pytest.mark.audit) for screen in SCREENS),
    ],
)
def test_nothing_jumps_while_a_slider_is_dragged(page, width, height, places):
    """From one end to the other: each control of its demo keeps its place in the window."""
    resize(page, width, height)
    unfold(page)
    assert probe(page, "jumpySliders", places) == []


PHONE, OTHER = (pytest.param(*one, marks=pytest.mark.audit) for one in (SCREENS[0], (1366, 768)))
[FRONT] = [path.as_uri() for path in CHAPTERS if path.stem == "index"] or [""]
ARM_MOVES = """() => {
  const edges = [...document.querySelectorAll(".vmc-picture :is(svg, canvas):not(.vmc-close-up *)")]
    .map((part) => part.getBoundingClientRect()).flatMap(({ top, bottom }) => [top, bottom]);
  const moves = document.querySelector(".vmc-clock [data-running]");
  return moves && [scrollY, edges.length, Math.min(...edges), Math.max(...edges)]; }"""


@pytest.mark.parametrize(("width", "height"), [*SCREENS, OTHER])
def test_three_doors_and_a_film_that_plays_are_on_the_first_screen(window, width, height):
    """The front page's film: by itself, photo and arm in the window when the arm begins to move."""
    page = open_url(window(viewport={"width": width, "height": height}), FRONT)
    scrolled, edges, top, bottom = page.wait_for_function(ARM_MOVES).json_value()
    assert (scrolled, edges) == (0, 4)
    assert 0 <= top < bottom <= height
    assert page.errors == []
    doors, film = page.locator(".vmc-doors a"), page.locator(".vmc-pictures").first
    addresses = [door.get_attribute("href") for door in doors.all()]
    assert addresses == ["01_loop.html", "your_photo.html", "teaching.html"]
    [[_, above, _, deep]] = boxes(film)
    assert all(y + tall <= above for _, y, _, tall in boxes(doors))
    assert above + deep <= height


def test_the_film_waits_where_less_motion_is_asked_for(window):
    page = open_url(window(reduced_motion="reduce"), FRONT)
    page.wait_for_selector(".vmc-scene canvas")
    page.evaluate(TWO_FRAMES)
    assert page.get_attribute("[data-unasked]", "data-running") is None
    assert page.get_attribute("[data-stride]", "aria-valuetext") == "a photo"


@a_page_of_each_kind
@pytest.mark.parametrize(("width", "height"), [PHONE, SCREENS[1], OTHER])
def test_no_control_lies_over_a_picture(page, width, height):
    resize(page, width, height)
    unfold(page)
    assert probe(page, "coveredPictures", 40) == []


RUNS = ".tag_hide-input:not(.tag_hide-input + .tag_hide-input)"  # their first cells
MARK = "details.hide > summary"
RUN_LENGTH = """(cell) => {
  let length = 0;
  for (; cell?.matches(".tag_hide-input"); cell = cell.nextElementSibling) length++;
  return length;
}"""


@a_page_of_each_kind
def test_a_run_of_folded_cells_has_one_mark(page):
    """The keyboard opens all the run's cells by it, and folds them again."""
    runs = page.locator(RUNS)
    if not runs.count():
        pytest.skip("no folded cells")
    unfold(page)
    seen = page.locator(MARK).filter(visible=True)
    assert seen.count() == runs.count() == page.locator(f"{RUNS} > {MARK}").count()
    run = page.locator(f"{RUNS}:has(+ .tag_hide-input)")
    first = (run if run.count() else runs).first
    cells = [first, *first.locator("xpath=following-sibling::div").all()]
    length = first.evaluate(RUN_LENGTH)
    for state in ("visible", "hidden"):
        first.locator(f"> {MARK}").press("Enter")
        for cell in cells[:length]:
            cell.locator("> details > .cell_input").wait_for(state=state)


@a_page_of_each_kind
def test_marks_of_folded_code_have_room(page):
    """In the margin of a wide page, 24 pixels; between the lines of a phone's, 44."""
    unfold(page)
    for width, least in ((360, 44), (768, 44), (800, 24), (1280, 24)):
        resize(page, width)
        assert probe(page, "crowdedMarks", least) == []


def test_a_box_shows_all_code_and_is_remembered(offline):
    [path] = [path for path in CHAPTERS if path.stem == "09_planning"]
    page = open_url(offline, path.as_uri())
    closed, box = page.locator("details.hide:not([open])"), page.get_by_label("Show all code")
    assert closed.count()
    box.check()
    assert not closed.count()
    page.reload()
    assert not closed.count()
    box.uncheck()
    assert closed.count() == page.locator("details.hide").count()
    page.close()


@a_page_of_each_kind
def test_sliders_answer_the_keyboard(page):
    unfold(page)
    page.eval_on_selector_all(".vmc-more", "folds => folds.forEach((fold) => (fold.open = true))")
    for slider in page.query_selector_all(".vmc-demo input[data-texts]"):
        value = int(slider.input_value())
        forward = value < int(slider.get_attribute("max"))
        words = slider.get_attribute("aria-valuetext")
        slider.focus()
        page.keyboard.press("ArrowRight" if forward else "ArrowLeft")
        assert int(slider.input_value()) == value + (1 if forward else -1)
        assert slider.get_attribute("aria-valuetext") != words


@pytest.mark.kinds("index", "03_regions", "10_offline", "15_whole_arm", "ledger", "your_photo")
def test_is_accessible(page, serious):
    assert serious(page, "html", all_of_it=True) == []


def test_no_equation_and_no_word_of_a_picture_is_cut(page):
    resize(page, 1280)
    assert probe(page, "cutWords") == []


@a_page_of_each_kind
@pytest.mark.parametrize("width", sample((320, 360, 412, 640, 768, 1024), 320, 768))
def test_fits_phones_tablets_and_enlarged_pages(page, width):
    """Three phones, two tablets; 320 and 640 are a window of 1280 at 400 % and at 200 %."""
    unfold(page)  # a folded section is not laid out anew
    resize(page, width, 700)
    whole = page.evaluate("() => document.documentElement.scrollWidth")
    assert (probe(page, "tooWide", "article"), whole) == ([], min(whole, width))


@pytest.mark.kinds("03_regions", "11_online")
def test_fits_a_phone_whose_letters_are_half_as_large_again(page):
    """24 px by the browser's own setting: breakpoints in rem know of it, those in px do not."""
    unfold(page)
    resize(page, *SCREENS[0])
    browser = page.context.new_cdp_session(page)
    browser.send("Page.setFontSizes", {"fontSizes": {"standard": 24}})
    page.evaluate(TWO_FRAMES)
    whole = page.evaluate("() => document.documentElement.scrollWidth")
    wide = probe(page, "tooWide", "article")
    browser.send("Page.setFontSizes", {"fontSizes": {"standard": 16}})
    browser.detach()
    assert (wide, whole) == ([], 390)
