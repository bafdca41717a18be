"""Demos and scenes as the page's scripts move them."""

import shutil
from pathlib import Path
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pypdfium2
import pytest
from meshcat import geometry as g
from meshcat.transformations import translation_matrix

from tests.show.kernel import render
from vmc_lib.arm.dynamics import hand
from vmc_lib.show import Choice, Pad, Scene, Slider, demo, explore, figure, photo_view
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.live import STATIC

pytestmark = pytest.mark.browser
MESHCAT = Path(__file__).parents[2] / "book/_static/vendor/meshcat.js"
HEAD = """<!doctype html><meta charset="utf-8"><link rel="stylesheet" href="demo.css">
<link rel="stylesheet" href="scene.css">""" + "".join(
    f'<script defer src="{path.name}"></script>' for path in demo.SCRIPTS
)
CAPTURE = "div => vmcScene(div).viewer.capture_image()"


@pytest.fixture
def open_demos(offline, tmp_path, monkeypatch):
    """A function that opens a page made of what `declare()` shows in the book."""
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    shutil.copytree(STATIC, tmp_path, dirs_exist_ok=True)
    shutil.copy(MESHCAT, tmp_path / "vendor/meshcat.js")

    def open_demos(declare, context=offline):
        shown = []
        monkeypatch.setattr(demo, "display", lambda *items: shown.extend(i.data for i in items))
        declare()
        (tmp_path / "page.html").write_text(HEAD + "\n".join(shown), encoding="utf-8")
        page = context.new_page()
        page.errors = []
        page.on("pageerror", lambda error: page.errors.append(str(error)))
        page.goto((tmp_path / "page.html").as_uri())
        page.wait_for_function(
            "() => [...document.querySelectorAll('.vmc-demo:has(> script)')]"
            ".every((demo) => 'ready' in demo.dataset)"
        )
        return page

    return open_demos


def ball(x):
    scene = Scene()
    scene["ball"].set_object(g.Sphere(0.2), g.MeshLambertMaterial(color=0xFF0000))
    scene["ball"].set_transform(translation_matrix([x, 0.0, 0.0]))
    if x > 0.3:
        scene["box"].set_object(g.Box([0.2, 0.2, 0.2]), g.MeshLambertMaterial(color=0x0000FF))
    return scene


def set_value(page, selector, value):
    page.eval_on_selector(
        selector,
        "(input, value) => { input.value = value;"
        " input.dispatchEvent(new Event('input', { bubbles: true })); }",
        str(value),
    )


def test_a_scene_is_what_it_shows_and_not_how_it_got_there(open_demos):
    xs = [0.0, 0.2, 0.4, 0.6]
    page = open_demos(
        lambda: explore(ball, "c", lambda x: f"ball at {x}", x=Slider(xs, "x", start=0.2))
    )
    page.wait_for_selector(".vmc-scene canvas")
    scene = page.query_selector(".vmc-scene")
    looks = []
    for place in (0, 1, 2, 3, 2, 1, 0):
        set_value(page, "input", place)
        looks.append(scene.evaluate(CAPTURE))
    assert looks[:3] == looks[:-4:-1]
    assert len(set(looks)) == 4
    set_value(page, ".vmc-controls > label input", 90)  # walk around
    assert scene.evaluate(CAPTURE) != looks[-1]
    assert page.get_attribute(".vmc-pictures", "aria-label") == "ball at 0.0"
    assert page.errors == []


def test_few_scenes_live_and_the_others_are_stills(open_demos):
    page = open_demos(lambda: [figure(ball(0.1), "c", f"scene {i}") for i in range(9)])
    for _ in range(2):  # down, and up again
        for scene in page.query_selector_all(".vmc-scene"):
            scene.scroll_into_view_if_needed()
            scene.wait_for_selector("canvas")
            assert len(page.query_selector_all(".vmc-scene canvas")) <= 6
    assert len(page.query_selector_all(".vmc-scene img")) == 3
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    stills = page.eval_on_selector_all(".vmc-scene img", "all => all.map(i => i.src)")
    assert len(stills) == 9
    assert len(set(stills)) == 1
    assert len(stills[0]) > 3000
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.wait_for_selector(".vmc-scene canvas")
    assert page.errors == []


def test_without_webgl_words_stand_for_the_scene(open_demos, chromium):
    context = chromium.new_context(offline=True)
    context.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page = open_demos(lambda: figure(ball(0.1), "c", "a red ball"), context)
    page.wait_for_function("() => window.MeshCat")
    assert page.inner_text(".vmc-scene") == "a red ball"
    assert page.errors == []
    context.close()


def test_a_pad_follows_the_pointer_and_the_keyboard(open_demos):
    def draw(at):
        fig, ax = plt.subplots()
        ax.plot(*at, "o")
        ax.set(xlim=(-1, 11), ylim=(-1, 6))
        return fig

    page = open_demos(
        lambda: explore(draw, "c", lambda at: f"at {at}", at=Pad(range(11), range(6), ("x", "y")))
    )
    dot = page.query_selector("svg use[clip-path], svg g[clip-path] use")
    start, svg = dot.bounding_box(), page.query_selector("svg").bounding_box()
    place = [start["x"] + start["width"] / 2, start["y"] + start["height"] / 2]
    page.mouse.move(*place)
    page.mouse.down()
    page.mouse.move(place[0] + svg["width"] / 2, place[1] - svg["height"] / 2, steps=4)
    page.mouse.up()
    assert page.inner_text("output") != "0"
    after = page.query_selector("svg use[clip-path], svg g[clip-path] use").bounding_box()
    assert abs(after["x"] - start["x"] - svg["width"] / 2) < svg["width"] / 22
    assert abs(after["y"] - start["y"] + svg["height"] / 2) < svg["height"] / 12
    alt = page.get_attribute(".vmc-pictures", "aria-label")
    page.focus("input >> nth=1")
    page.keyboard.press("ArrowDown")
    assert page.get_attribute(".vmc-pictures", "aria-label") != alt
    assert page.inner_text(".vmc-spoken") == page.get_attribute(".vmc-pictures", "aria-label")


def test_paper_shows_every_demo_as_it_stands(open_demos):
    def draw(x, label):
        return ball(x), f"<p>{label} at {x}</p>"

    def declare():
        figure('<p style="height: 60em">Tall.</p>', "The scene below is not in sight.", "words")
        explore(
            draw, "A ball.", "alt", x=Slider([0.1, 0.4], "place", play=True), label=["now", "then"]
        )

    page = open_demos(declare)
    page.wait_for_function("() => window.MeshCat")
    set_value(page, "input", 1)
    page.evaluate("() => { document.documentElement.dataset.theme = 'dark' }")
    pdf = pypdfium2.PdfDocument(page.pdf(print_background=True))
    text = "\n".join(sheet.get_textpage().get_text_range() for sheet in pdf)
    assert "now at 0.4" in text
    assert "place" in text
    assert "A ball." in text
    assert not any(word in text for word in ("then", "0.1", "Play", "turn the view"))
    sheets = [np.int16(sheet.render().to_numpy()) for sheet in pdf]
    blue, _, red = np.moveaxis(np.concatenate([s.reshape(-1, s.shape[-1]) for s in sheets]), 1, 0)
    assert (red > blue + 60).any()
    assert (blue > red + 60).any()
    assert page.get_attribute("html", "data-theme") == "dark"


def test_play_walks_to_the_end_and_stops(open_demos):
    page = open_demos(
        lambda: explore(
            lambda x: np.eye(x), "c", "a diagonal", x=Slider(range(2, 6), "size", play=True)
        )
    )
    page.click(".vmc-play")
    assert page.get_attribute(".vmc-play", "aria-pressed") == "true"
    page.wait_for_selector(".vmc-play[aria-pressed=false]")
    assert page.inner_text("output") == "5"


def test_on_a_phone_panels_stand_one_above_the_other(open_demos):
    def draw(x):
        fig, (left, right) = plt.subplots(1, 2, figsize=(8.2, 3.4))
        left.plot([0, x], label="left")
        right.plot([x, 0], color="red")
        right.set(ylabel="right")
        return fig

    page = open_demos(lambda: explore(draw, "c", "two plots", x=Slider([1, 2], "x")))
    shown = page.locator(".vmc-panels > div")
    assert [shown.nth(i).is_visible() for i in (0, 1)] == [True, False]
    page.set_viewport_size({"width": 360, "height": 700})
    boxes = [shown.nth(i).bounding_box() for i in (0, 1)]
    assert boxes[0]["y"] + boxes[0]["height"] <= boxes[1]["y"]
    assert all(0 <= box["x"] and box["x"] + box["width"] <= 360 for box in boxes)
    picture = page.query_selector(".vmc-picture")
    assert picture.evaluate("p => p.scrollWidth <= p.clientWidth")
    second = shown.nth(1)
    before = second.screenshot()
    set_value(page, "input", 1)
    assert second.screenshot() != before  # the same drawing, moved by the same slider
    assert page.errors == []


def movement(elbow):
    """The elbow bends, the shoulder stays; a target where the hand ends."""
    angles = np.linspace([0.0, 1.0], [0.0, elbow], 201)
    course = '<svg viewBox="0 0 9 9"><g data-course="0,0 1,2 4,6"><circle r="1"/></g></svg>'
    balls = [(hand(angles[-1]), "green")]
    return course, arm_scene(angles, np.linspace(6 * [0], 6 * [1], 201), balls=balls)


@pytest.fixture
def moving(open_demos):
    page = open_demos(
        lambda: explore(movement, "c", lambda elbow: f"to {elbow}", elbow=Slider([1.2, 1.5], "to"))
    )
    page.wait_for_selector(".vmc-scene canvas")
    yield page
    assert page.errors == []


def numbers(page):
    return dict(line.split("\n") for line in page.locator(".vmc-numbers > div").all_inner_texts())


def test_one_clock_moves_the_arm_the_numbers_and_the_picture_beside(moving):
    scene, looks = moving.query_selector(".vmc-scene"), []
    for time, elbow, activation, place in ((0, 57.3, 0, "0 0"), (0.1, 63.0, 0.5, "1 2")):
        set_value(moving, ".vmc-clock input", time)
        assert numbers(moving)["elbow"] == f"{elbow}°"
        assert moving.locator(".vmc-muscles b").last.inner_text() == f"{activation:.2f}"
        assert moving.get_attribute("[data-course]", "transform") == f"translate({place})"
        looks.append(scene.evaluate(CAPTURE))
    assert looks[0] != looks[1]
    set_value(moving, ".vmc-clock input", 0.15)  # between two moments
    assert numbers(moving)["elbow"] == "65.9°"
    set_value(moving, ".vmc-controls [data-stride]", 1)  # another movement, the same time
    assert numbers(moving)["elbow"] == "78.8°"
    set_value(moving, ".vmc-clock input", 0.2)
    assert numbers(moving)["hand to target"] == "0.0 mm"


def test_a_movement_plays_to_its_end_and_yields_to_the_hand(moving):
    assert moving.inner_text(".vmc-clock output") == "0.20 s"
    moving.select_option(".vmc-clock select", label="quarter speed")
    moving.click(".vmc-clock button")
    moving.wait_for_selector(".vmc-clock button[aria-pressed=false]")
    assert moving.inner_text(".vmc-clock output") == "0.20 s"
    moving.click(".vmc-clock button")
    set_value(moving, ".vmc-clock input", 0.04)
    assert moving.get_attribute(".vmc-clock button", "aria-pressed") == "false"
    assert moving.inner_text(".vmc-clock output") == "0.04 s"


def test_hand_and_slider_turn_the_same_view_and_none_looks_from_below(moving):
    box = moving.locator(".vmc-canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    moving.mouse.move(x, y)
    moving.mouse.down()
    moving.mouse.move(x - 100, y - 300, steps=3)
    moving.mouse.up()
    turned = float(moving.input_value(".vmc-turn input"))
    assert 40 <= turned <= 60
    height = "div => vmcScene(div).viewer.camera.position.y - vmcScene(div).told.camera[1][1]"
    assert moving.eval_on_selector(".vmc-scene", height) > 0


def test_a_muscle_is_named_where_one_points_and_found_by_its_name(moving):
    seen = """div => {
      const view = vmcScene(div);
      const { top, left, width, height } = div.getBoundingClientRect();
      for (let x = -1; x < 1; x += 0.02) for (let y = -1; y < 1; y += 0.02) {
        const k = view.body.muscles.found([x, y]);
        if (k !== null) return [left + (x + 1) / 2 * width, top + (1 - y) / 2 * height,
                                view.anatomy.muscles[k].name];
      } }"""
    x, y, name = moving.eval_on_selector(".vmc-scene", seen)
    moving.mouse.move(x, y)
    assert moving.inner_text(".vmc-tip") == name
    moving.mouse.click(x, y)
    chosen = moving.locator(".vmc-muscles label", has=moving.locator(":checked"))
    assert chosen.inner_text().startswith(name)
    scene = moving.query_selector(".vmc-scene")
    before = scene.evaluate(CAPTURE)
    moving.locator(".vmc-muscles input:checked").press("ArrowDown")
    assert scene.evaluate(CAPTURE) != before


def test_without_webgl_the_numbers_follow_the_controls(open_demos, chromium):
    context = chromium.new_context(offline=True)
    context.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page = open_demos(
        lambda: explore(movement, "c", lambda elbow: f"to {elbow}", elbow=Slider([1.2, 1.5], "to")),
        context,
    )
    assert page.inner_text(".vmc-scene") == "to 1.2"
    set_value(page, ".vmc-clock input", 0)
    assert numbers(page)["elbow"] == "57.3°"
    assert page.errors == []
    context.close()


# ---- A demo's state is in the address ----


def every_kind(**values):
    return f"<svg>\n<text>{list(values.values())}</text>\n</svg>"


@pytest.fixture
def addressed(open_demos):
    kinds = dict(
        x=Slider(range(5), "x", play=True),
        way=["left", "right"],
        name=Choice("abcdefg", "name"),
        on=[False, True],
    )
    page = open_demos(
        lambda: [
            figure("<p style='height: 90em'>Tall.</p>", "Above.", "tall"),
            explore(every_kind, "Below.", lambda **values: f"{values}", **kinds),
        ]
    )
    page.id = page.get_attribute(".vmc-demo >> nth=1", "id")
    yield page
    assert page.errors == []


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


def test_an_address_is_followed_and_what_it_cannot_mean_is_ignored(addressed):
    for state, seen in (
        ("x=2&way=1", "[2, 'right', 'a', False]"),
        ("on=1&x=99&name=99&way=7&who=3", "[4, 'right', 'a', True]"),
        ("", "[4, 'right', 'a', True]"),
    ):
        addressed.evaluate(f"location.hash = '#{addressed.id}?{state}'")
        addressed.wait_for_function(
            "seen => document.querySelectorAll('.vmc-demo text')[0].textContent === seen", arg=seen
        )
    addressed.evaluate("location.hash = '#%'")
    assert shown_now(addressed) == "[4, 'right', 'a', True]"


def test_playing_leaves_the_address_alone_and_yields_to_any_control(addressed):
    addressed.click(".vmc-play")
    addressed.get_by_label("right").check()
    assert addressed.get_attribute(".vmc-play", "aria-pressed") == "false"
    addressed.wait_for_function("() => location.hash.includes('way=1')")
    addressed.click(".vmc-play")
    addressed.wait_for_selector(".vmc-play[aria-pressed=false]")
    assert "x=4" not in addressed.evaluate("location.hash")


# ---- A finger ----


def test_a_pad_is_dragged_by_its_handle_with_a_finger(open_demos, chromium):
    context = chromium.new_context(
        offline=True, has_touch=True, viewport={"width": 360, "height": 640}
    )
    page = open_demos(
        lambda: [
            explore(
                lambda at: photo_view(
                    np.zeros((200, 300, 3), np.uint8), points=[(at, "", "green")]
                ),
                "c",
                lambda at: f"{at}",
                at=Pad(range(0, 301, 20), range(0, 201, 25), start=(100, 100)),
            ),
            figure("<p style='height: 90em'>Tall.</p>", "Below.", "tall"),
        ],
        context,
    )
    touch = context.new_cdp_session(page)

    def finger(*path):
        for kind, (x, y) in zip(["touchStart", "touchMove", "touchMove"], path, strict=True):
            touch.send(
                "Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]}
            )
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    def middle(selector):
        box = page.locator(selector).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

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
    x, y = middle(".vmc-handle")
    size = page.locator(".vmc-handle").bounding_box()
    assert min(size["width"], size["height"]) >= 24
    wide = page.locator("svg[data-axes]").bounding_box()["width"]
    finger((x + 8, y + 8), (x + 30, y + 40), (x + 8 + wide / 5, y + 8 + wide / 6))
    for i, told in enumerate(["160", "150"]):  # 60 and 50 of 300 farther, wherever it was taken
        page.locator(f"output >> nth={i} >> text={told}").wait_for()
    stands(f"[{x + wide / 5}, {y + wide / 6}]")
    assert page.evaluate("scrollY") == 0
    there = page.locator("output", has_text="100").first
    for _ in range(5):  # on a busy machine a tap may last so long that it is a press, and no click
        page.touchscreen.tap(x, y)
        if there.count():
            break
    there.wait_for()
    assert page.errors == []
    context.close()


def test_a_movement_that_comes_after_a_posture_is_shown_at_its_end(open_demos):
    page = open_demos(
        lambda: explore(
            lambda moves: movement(1.2)[1] if moves else arm_scene([0, 1]),
            "c",
            "an arm",
            moves=[False, True],
        )
    )
    assert page.locator(".vmc-clock").is_hidden()
    page.get_by_role("checkbox").check()
    assert page.inner_text(".vmc-clock output") == "0.20 s"
    assert page.inner_text(".vmc-clock button") == "Play the movement"
    assert page.errors == []


def test_the_row_of_a_slider_stays_where_the_hand_is(open_demos):
    widths = ["i", "WWWW", "mmmm mmmm", "%"]
    page = open_demos(
        lambda: [
            figure("<p style='height: 40em'>Tall.</p>", "Above.", "tall"),
            explore(
                lambda size: f'<p style="height: {4 + 3 * widths.index(size)}em">{size}</p>',
                "c",
                "words",
                size=Slider(widths, "size", play=True),
            ),
            figure("<p style='height: 90em'>Tall.</p>", "Below.", "tall"),
        ]
    )
    page.focus("[type=range]")
    page.locator("[type=range]").scroll_into_view_if_needed()
    places = []
    for key in ("Home", "ArrowRight", "ArrowRight", "ArrowRight"):
        page.keyboard.press(key)
        places.append([page.locator(s).bounding_box() for s in ("[type=range]", ".vmc-play")])
    for place in places[1:]:
        assert [box["x"] for box in place] == [box["x"] for box in places[0]]
        assert place[0]["y"] == pytest.approx(places[0][0]["y"], abs=1)
    assert page.evaluate("scrollY") > 0
    assert page.errors == []


def test_a_plots_numbers_are_a_table_that_follows_its_controls(open_demos):
    def draw(slope):
        fig, ax = plt.subplots()
        ax.plot([0, 1, 2], [0, slope, 2 * slope], label="pull")
        ax.set(xlabel="time (s)", ylabel="force (N)")
        return fig

    page = open_demos(
        lambda: explore(draw, "c", lambda slope: f"{slope}", slope=Slider([1, 3], "s"))
    )
    page.click(".vmc-demo summary")
    page.focus("[type=range]")
    page.keyboard.press("End")
    rows = [row.split() for row in page.locator(".vmc-data tr").all_inner_texts()]
    assert rows == [
        ["time", "(s)", "force", "(N)"],
        *([x, y] for x, y in (("0", "0"), ("1", "3"), ("2", "6"))),
    ]
    assert page.locator("details").get_attribute("open") is not None
    assert page.errors == []


def test_paper_shows_where_a_demo_leads_that_nobody_touched(open_demos):
    def draw(x):
        return ball(x), f"<p>now at {x}</p>"

    page = open_demos(
        lambda: explore(draw, "A ball.", "alt", x=Slider([0.1, 0.2, 0.4], "place", play=True))
    )
    page.wait_for_selector(".vmc-scene canvas")
    pdf = pypdfium2.PdfDocument(page.pdf(print_background=True))
    assert "now at 0.4" in pdf[0].get_textpage().get_text_range()
    pixels = np.int16(pdf[0].render().to_numpy())
    assert (
        pixels[..., 0] > pixels[..., 2] + 60
    ).any()  # the blue box, which stands there at 0.4 only
    assert page.inner_text("output") == "0.1"
    assert page.inner_text(".vmc-picture p") == "now at 0.1"
    assert page.errors == []


@pytest.fixture
def live_demo(offline, monkeypatch):
    """A function that declares a demo in a live kernel, and returns a page with its widget."""
    pages = []

    def live_demo(draw, busy=False, **controls):
        monkeypatch.setenv("VMC_RENDER_MODE", "live")
        shown = []
        handle = SimpleNamespace(update=shown.append)
        monkeypatch.setattr(demo, "display", lambda item, **_: shown.append(item) or handle)
        explore(draw, "c", "words", **controls)
        page = offline.new_page()
        pages.append(page)
        page.faults = []
        page.on("pageerror", lambda error: page.faults.append(str(error)))
        page.set_content(shown[0].data)
        render(page, shown[1], monkeypatch, busy=busy)
        return page

    yield live_demo
    for page in pages:
        page.close()
        assert page.faults == []


def dot(k):
    return f'<svg width="20" height="20">\n<circle r="{k}"/>\n</svg>'


RADIUS = "() => document.querySelector('circle').getAttribute('r')"


def test_controls_stand_at_once_and_open_when_the_kernel_answers(live_demo):
    page = live_demo(dot, busy=True, k=Slider([1, 2, 3], "k"))
    slider = page.get_by_role("slider")
    assert slider.is_visible()
    assert slider.is_disabled()
    assert page.evaluate(RADIUS) == "1"
    page.get_by_text("The chapter is still running").wait_for()
    page.evaluate("() => (kernelModel.busy = false)")
    page.wait_for_function("() => !document.querySelector('input').disabled")
    assert not page.get_by_text("The chapter is still running").count()
    slider.press("End")
    page.wait_for_function(f"() => ({RADIUS})() === '3'")


def test_a_first_scene_needs_no_answer(live_demo):
    page = live_demo(ball, busy=True, x=Slider([0.0, 0.4], "x"))
    scene = page.locator(".vmc-demo:not(.vmc-still) .vmc-scene")
    messages = scene.evaluate("(div) => vmcScene(div).messages.length")
    assert messages == len(ball(0.0).messages())


@pytest.mark.parametrize("way", ["emit('comm_live_update')", "closed = true"])
def test_a_demo_says_that_its_kernel_has_gone(live_demo, way):
    page = live_demo(dot, k=Slider([1, 2, 3], "k"))
    slider = page.get_by_role("slider")
    page.wait_for_function("() => !document.querySelector('input').disabled")
    slider.press("ArrowRight")
    page.wait_for_function(f"() => ({RADIUS})() === '2'")
    page.evaluate(f"() => {{ kernelModel.{way} }}")
    if slider.is_enabled():
        slider.press("ArrowRight")
    page.get_by_text("The kernel has gone: Run > Run All Cells").wait_for()
    assert slider.is_disabled()
    assert page.evaluate(RADIUS) == "2"


def test_a_scene_is_no_wider_than_its_place(open_demos):
    photo = np.zeros((400, 600, 3), np.uint8)
    page = open_demos(lambda: figure((photo_view(photo), ball(0.1)), "c", "a photo and a ball"))
    page.wait_for_selector(".vmc-scene canvas")
    page.eval_on_selector(".vmc-pictures", "(box) => (box.style.width = '1105px')")
    page.wait_for_function("() => document.querySelector('canvas').style.width === '545px'")
    wide = "(box) => [box.scrollWidth, Math.ceil(box.getBoundingClientRect().width)]"
    drawn, room = page.eval_on_selector(".vmc-pictures", wide)
    assert drawn <= room
