"""Plots and their controls as the page's scripts move them; a demo's state in the address."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from tests.pages import boxes, drag, middle, stop_clock
from tests.show.kernel import named
from vmc_lib.show import Choice, Pad, Slider, explore, figure, photo_view

pytestmark = pytest.mark.browser


def tall(height):
    return figure(f"<p style='height: {height}em'>Tall.</p>", "Tall.", "tall")


def test_a_pad_follows_the_pointer_and_the_keyboard(open_demo):
    def draw(at):
        fig, ax = plt.subplots()
        ax.plot(*at, "o")
        ax.set(xlim=(-1, 11), ylim=(-1, 6))
        return fig

    page = open_demo(draw, alt=lambda at: f"at {at}", at=Pad(range(11), range(6), ("x", "y")))
    dot = page.locator("svg use[clip-path], svg g[clip-path] use")
    x, y = start = middle(dot)
    [[*_, width, height]] = boxes(page.locator("svg").first)
    drag(page, start, width / 2, -height / 2)
    assert page.inner_text("output") != "0"
    to_x, to_y = middle(dot)
    assert abs(to_x - x - width / 2) < width / 22
    assert abs(to_y - y + height / 2) < height / 12
    alt = page.get_attribute(".vmc-pictures", "aria-label")
    page.focus("input >> nth=1")
    page.keyboard.press("ArrowDown")
    assert page.get_attribute(".vmc-pictures", "aria-label") != alt
    assert page.inner_text(".vmc-spoken") == page.get_attribute(".vmc-pictures", "aria-label")


def test_a_pad_is_dragged_by_its_handle_with_a_finger(open_demos, window):
    def draw(at):
        return photo_view(np.zeros((200, 300, 3), np.uint8), points=[(at, "", "green")])

    pad = Pad(range(0, 301, 20), range(0, 201, 25), start=(100, 100))
    phone = window(has_touch=True, viewport={"width": 360, "height": 640})
    page = open_demos(lambda: [explore(draw, "c", lambda at: f"{at}", at=pad), tall(90)], phone)
    touch = phone.new_cdp_session(page)

    def finger(*path):
        for kind, (x, y) in zip(["touchStart", "touchMove", "touchMove"], path, strict=True):
            points = [{"x": x, "y": y}]
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    def stands(where):
        """Wait until the handle's middle is at a place (x, y); a script gives it."""
        page.wait_for_function(
            f"""() => {{
              const middle = (each) => {{
                const box = document.querySelector(each).getBoundingClientRect();
                return [box.x + box.width / 2, box.y + box.height / 2];
              }};
              const [x, y] = middle(".vmc-handle"), [right, down] = {where};
              return Math.hypot(x - right, y - down) < 1.5;
            }}"""
        )

    stands('middle("circle")')  # on the mark, once the page is laid out
    [[*_, wide, _], [left, top, *size]] = boxes(page.locator("svg[data-axes], .vmc-handle"))
    assert min(size) >= 24
    x, y = left + size[0] / 2, top + size[1] / 2
    finger((x + 8, y + 8), (x + 30, y + 40), (x + 8 + wide / 5, y + 8 + wide / 6))
    for i, value in enumerate(["160", "150"]):  # 60 and 50 of 300 farther, wherever it was taken
        page.locator(f"output >> nth={i} >> text={value}").wait_for()
    stands(f"[{x + wide / 5}, {y + wide / 6}]")
    assert page.evaluate("scrollY") == 0
    there = page.locator("output", has_text="100").first
    for _ in range(5):  # on a busy machine a tap may last so long that it is a press, and no click
        page.touchscreen.tap(x, y)
        if there.count():
            break
    there.wait_for()


def test_play_goes_to_the_end_and_stops(open_demo, window):
    page = open_demo(np.eye, window(), N=Slider(range(2, 6), "size", play=True))
    stop_clock(page)
    page.click(".vmc-play")
    assert page.get_attribute(".vmc-play", "data-running") is not None
    page.clock.run_for(60_000)
    assert page.get_attribute(".vmc-play", "data-running") is None
    assert page.inner_text("output") == "5"


def test_on_a_phone_panels_stand_one_above_the_other(open_demo):
    def draw(x):
        fig, (left, right) = plt.subplots(1, 2, figsize=(8.2, 3.4))
        left.plot([0, x], label="left")
        right.plot([x, 0], color="red")
        right.set(ylabel="right")
        return fig

    page = open_demo(draw, x=Slider([1, 2], "x"))
    shown = page.locator(".vmc-panels > div")
    assert [shown.nth(i).is_visible() for i in (0, 1)] == [True, False]
    page.set_viewport_size({"width": 360, "height": 700})
    (above, *panels) = boxes(shown)
    assert above[1] + above[3] <= panels[0][1]
    assert all(0 <= x and x + width <= 360 for x, _, width, _ in (above, *panels))
    assert page.eval_on_selector(".vmc-picture", "p => p.scrollWidth <= p.clientWidth")
    before = shown.nth(1).screenshot()
    page.fill("input", "1")
    assert shown.nth(1).screenshot() != before  # the same drawing, moved by the same slider


CUT = """(panels) => {
  const wide = (element) => element.getBoundingClientRect().width;
  const split = +getComputedStyle(panels).getPropertyValue("--split");
  const [left, right] = panels.children;
  const [whole, again] = [left, right].map((panel) => wide(panel.firstElementChild));
  return [wide(left) - split * whole, wide(right) - (1 - split) * again]; }"""
WORD_SIZES = """(words) => words.filter((word) => word.textContent.trim())
  .map((word) => parseFloat(getComputedStyle(word).fontSize) * word.getScreenCTM().a)
  .filter((size) => size > 0)"""  # a label that is turned has none here
STRIP = '<svg class="vmc-strip" viewBox="0 0 440 96" width="440"><path d="M0 0H440"/></svg>'


@pytest.mark.parametrize(("wide", "strip"), [(6.5, ()), (6.5, (STRIP,)), (8.2, ())])
@pytest.mark.parametrize("width", [320, 390, 600])
def test_on_a_phone_no_panel_is_cut_off(open_demo, wide, strip, width):
    """Nor beside a drawing, nor where its words need more width; and they can be read."""

    def draw(x):
        fig, (left, right) = plt.subplots(1, 2, figsize=(wide, 3.3), layout="none")
        left.plot([0, x])
        right.plot([x, 0])
        return *strip, fig

    page = open_demo(draw, alt="Two plots.", x=Slider([1, 2], "x"))
    page.set_viewport_size({"width": width, "height": 844})
    assert page.eval_on_selector(".vmc-panels", CUT) == pytest.approx([0, 0], abs=1)
    assert page.eval_on_selector(".vmc-picture:last-child", "p => p.scrollWidth <= p.clientWidth")
    sizes = page.eval_on_selector_all(".vmc-panels text", WORD_SIZES)
    assert width == 320 or round(min(sizes)) >= 11


UNREADY_AND_READY = """(demo) => {
  const high = () => demo.getBoundingClientRect().height, ready = high();
  delete demo.dataset.ready;
  return [high(), ready]; }"""


def test_a_demo_that_becomes_ready_moves_nothing_below_it(open_demo):
    page = open_demo(np.eye, N=Slider(range(2, 6), "size"))
    before, after = page.eval_on_selector(".vmc-demo", UNREADY_AND_READY)
    assert before == after


def test_a_slider_and_its_button_stay_in_place_while_the_picture_grows(open_demos):
    widths = ["i", "WWWW", "mmmm mmmm", "%"]

    def draw(size):
        return f'<p style="height: {4 + 3 * widths.index(size)}em">{size}</p>'

    size = Slider(widths, "size", play=True)
    page = open_demos(lambda: [tall(40), explore(draw, "c", "words", size=size), tall(90)])
    page.focus("[type=range]")
    page.locator("[type=range]").scroll_into_view_if_needed()
    places = []
    for key in ("Home", "ArrowRight", "ArrowRight", "ArrowRight"):
        page.keyboard.press(key)
        places.append([place[:2] for place in boxes(page.locator("[type=range], .vmc-play"))])
    across, down = np.ptp(places, axis=0).T
    assert across.max() == 0
    assert down.max() <= 1
    assert page.evaluate("scrollY") > 0


def test_a_plots_numbers_are_a_table_that_follows_its_controls(open_demo):
    def draw(slope):
        fig, ax = plt.subplots()
        ax.plot([0, 1, 2], [0, slope, 2 * slope], label="pull")
        ax.set(xlabel="time (s)", ylabel="force (N)")
        return fig

    page = open_demo(draw, slope=Slider([1, 3], "s"))
    page.click(".vmc-demo summary")
    page.focus("[type=range]")
    page.keyboard.press("End")
    numbers = page.get_by_role("group", name="The plot's numbers")
    rows = [row.split() for row in numbers.locator("tr").all_inner_texts()]
    assert rows == [["time", "(s)", "force", "(N)"], ["0", "0"], ["1", "3"], ["2", "6"]]
    assert page.locator("details").get_attribute("open") is not None


# ---- A demo's state is in the address ----


@pytest.fixture
def addressed(open_demos):
    kinds = dict(
        x=Slider(range(5), "x", play=True),
        way=["left", "right"],
        name=Choice("abcdefg", "name"),
        on=[False, True],
    )
    page = open_demos(
        lambda: [tall(90), explore(named, "c", lambda **values: f"{values}", **kinds)]
    )
    page.id = page.get_attribute(".vmc-demo >> nth=1", "id")
    return page


def shown_now(page):
    return page.locator(".vmc-demo").nth(1).locator("text").text_content()


def test_a_link_opens_a_demo_as_it_was(addressed):
    link = addressed.locator(".vmc-link")
    assert link.get_attribute("href") == f"#{addressed.id}?x=0&way=0&name=0&on=0"
    addressed.focus("[type=range]")
    addressed.keyboard.press("End")
    addressed.get_by_label("right").check()
    addressed.select_option("select", "2")
    addressed.get_by_role("checkbox").check()
    state = f"#{addressed.id}?x=4&way=1&name=2&on=1"
    addressed.wait_for_function("state => location.hash === state", arg=state)
    assert link.get_attribute("href") == state
    assert shown_now(addressed) == "[4, 'right', 'c', True]"
    other = addressed.context.new_page()
    other.goto(addressed.url)
    other.wait_for_selector(".vmc-demo[data-ready] >> nth=0")
    other.wait_for_function("() => scrollY > 0")
    assert shown_now(other) == "[4, 'right', 'c', True]"
    assert other.locator("output").inner_text() == "4"
    other.close()


def test_an_address_is_followed_and_its_impossible_values_are_ignored(addressed):
    for state, seen in (
        ("?x=2&way=1", "[2, 'right', 'a', False]"),
        ("%3Fx%3D3%26way%3D0", "[3, 'left', 'a', False]"),  # as mail programs change it
        ("?x=2&amp;way=1", "[2, 'right', 'a', False]"),
        ("?on=1&x=99&name=99&way=7&who=3", "[4, 'right', 'a', True]"),
        ("?", "[4, 'right', 'a', True]"),
        ("?x=3.", "[3, 'right', 'a', True]"),  # it ends a sentence,
        ("?name=1&x=2)", "[2, 'right', 'b', True]"),
        ("?name=length&x=&on=&way=0", "[2, 'left', 'b', True]"),  # was cut,
        ("?name=__proto__&x=two&way=1>", "[2, 'right', 'b', True]"),  # or mangled
    ):
        addressed.evaluate(f"location.hash = '#{addressed.id}{state}'")
        addressed.wait_for_function(
            "seen => document.querySelectorAll('.vmc-demo text')[0].textContent === seen", arg=seen
        )
    addressed.evaluate("location.hash = '#%'")
    assert shown_now(addressed) == "[2, 'right', 'b', True]"


def test_a_link_that_is_followed_right_after_a_move_is_not_lost(addressed):
    """Its address is not overwritten by the move's, which is written when the hand rests."""
    addressed.evaluate(
        """(link) => {
      document.querySelector("[type=range]").dispatchEvent(new Event("input", { bubbles: true }));
      for (const due = performance.now() + 300; performance.now() < due; );
      location.hash = link;
    }""",
        f"{addressed.id}?x=2&way=1",
    )
    addressed.wait_for_function(
        "seen => document.querySelectorAll('.vmc-demo text')[0].textContent === seen",
        arg="[2, 'right', 'a', False]",
    )


def test_play_leaves_the_address_alone_and_stops_for_any_control(addressed):
    addressed.click(".vmc-play")
    addressed.get_by_label("right").check()
    assert addressed.get_attribute(".vmc-play", "data-running") is None
    addressed.wait_for_function("() => location.hash.includes('way=1')")
    addressed.click(".vmc-play")
    addressed.wait_for_selector(".vmc-play:not([data-running])")
    assert "x=4" not in addressed.evaluate("location.hash")
    assert "?x=4&" in addressed.get_attribute(".vmc-link", "href")  # which says what is shown now
