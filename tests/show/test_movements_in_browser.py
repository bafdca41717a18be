"""A movement of the arm in a scene: its clock, view and muscles, and where it cannot be drawn."""

import numpy as np
import pytest

from tests.pages import CAPTURE, NO_WEBGL, SECOND_FINGER, boxes, drag, middle, stop_clock
from vmc_lib.arm.dynamics import hand
from vmc_lib.show import Slider
from vmc_lib.show.arm import arm_scene

pytestmark = pytest.mark.browser


def movement(elbow):
    """The elbow bends, the shoulder stays; a target where the hand ends."""
    angles = np.linspace([0.0, 1.0], [0.0, elbow], 201)
    course = '<svg viewBox="0 0 9 9"><g data-course="0,0 1,2 4,6"><circle r="1"/></g></svg>'
    place, beside = hand(angles[-1]), np.array([0, 0.004, 0])
    marks = {"balls": [(place, "green")], "end": (place + beside, 0.0123)}
    return course, arm_scene(angles, np.linspace(6 * [0], 6 * [1], 201), **marks)


MOVEMENT = {"alt": lambda elbow: f"to {elbow}", "elbow": Slider([1.2, 1.5], "to")}


@pytest.fixture
def moving(open_demo):
    page = open_demo(movement, **MOVEMENT)
    page.wait_for_selector(".vmc-scene canvas")
    page.click(".vmc-more summary")
    return page


def numbers(page):
    return dict(line.split("\n") for line in page.locator(".vmc-numbers > div").all_inner_texts())


def test_one_clock_moves_the_arm_the_numbers_and_the_picture_beside(moving):
    scene, seen = moving.query_selector(".vmc-scene"), []
    for time, elbow, activation, place in (("0", 57.3, 0, "0 0"), ("0.1", 63.0, 0.5, "1 2")):
        moving.fill(".vmc-clock input", time)
        assert numbers(moving)["elbow"] == f"{elbow}°"
        assert moving.locator(".vmc-muscles b").last.inner_text() == f"{activation:.2f}"
        assert moving.get_attribute("[data-course]", "transform") == f"translate({place})"
        seen.append(scene.evaluate(CAPTURE))
    assert seen[0] != seen[1]
    moving.fill(".vmc-clock input", "0.15")  # between two moments
    assert numbers(moving)["elbow"] == "65.9°"
    moving.fill(".vmc-controls [data-stride]", "1")  # another movement, the same time
    assert numbers(moving)["elbow"] == "78.8°"
    moving.fill(".vmc-clock input", "0.2")
    assert numbers(moving)["hand to target now"] == "0.0 mm"
    assert numbers(moving)["end point to target"] == "4.0 mm"
    assert numbers(moving)["speed in the hold"] == "12 mm/s"


def test_a_movement_plays_to_its_end_and_stops_when_the_clock_is_set(moving):
    time, play = ".vmc-clock output", ".vmc-clock button"
    assert moving.inner_text(time) == "0.20 s"
    moving.select_option(".vmc-clock select", label="quarter speed")
    moving.click(play)
    moving.wait_for_selector(f"{play}:not([data-running])")
    assert moving.inner_text(time) == "0.20 s"
    moving.click(play)
    moving.fill(".vmc-clock input", "0.04")
    assert moving.get_attribute(play, "data-running") is None
    assert moving.inner_text(time) == "0.04 s"


@pytest.fixture
def playing(open_demo, window):
    """A demo that goes from step to step, in the first one's movement."""
    page = open_demo(movement, window(), elbow=Slider([1.2, 1.5], "to", play=True))
    page.wait_for_selector(".vmc-clock:not([hidden])")
    stop_clock(page)
    page.click("[data-stride] ~ .vmc-play")
    page.clock.run_for(50)
    return page


def test_a_key_on_the_clock_pauses_what_goes_from_step_to_step(playing):
    playing.press(".vmc-clock button", "Enter")
    at = playing.inner_text(".vmc-clock output")
    playing.clock.run_for(60_000)
    assert playing.inner_text("[data-stride] ~ .vmc-play") == "Play"
    assert playing.input_value("[data-stride]") == "0"
    assert playing.inner_text(".vmc-clock output") == at != "0.20 s"


def test_pause_stops_the_step_and_its_movement(playing):
    playing.click("[data-stride] ~ .vmc-play")
    at = playing.inner_text(".vmc-clock output")
    playing.clock.run_for(60_000)
    assert playing.inner_text(".vmc-clock output") == at != "0.20 s"
    assert playing.inner_text(".vmc-clock button") == "Play the movement"


def test_a_movement_that_comes_after_a_posture_is_shown_at_its_end(open_demo):
    draw = lambda moves: movement(1.2)[1] if moves else arm_scene([0, 1])  # noqa: E731 (one line)
    page = open_demo(draw, moves=[False, True])
    assert page.locator(".vmc-clock").is_hidden()
    page.get_by_role("checkbox").check()
    assert page.inner_text(".vmc-clock output") == "0.20 s"
    assert page.inner_text(".vmc-clock button") == "Play the movement"


def test_the_pointer_and_a_slider_turn_the_view_and_never_to_below(moving):
    canvas = moving.locator(".vmc-canvas")
    assert canvas.evaluate("c => getComputedStyle(c).touchAction") == "pan-y"  # a swipe scrolls
    drag(moving, middle(canvas), -100, -300, "right")
    assert moving.input_value(".vmc-turn input") == "0"
    drag(moving, middle(canvas), -100, -300)
    assert 40 <= float(moving.input_value(".vmc-turn input")) <= 60
    turned = moving.input_value(".vmc-turn input")
    moving.mouse.move(*middle(canvas))
    moving.mouse.down()
    canvas.evaluate(SECOND_FINGER)
    moving.mouse.up()
    assert moving.input_value(".vmc-turn input") == turned
    height = """(div) => {
      const { viewer, settings } = vmc["demo/scene"].viewOf(div);
      return viewer.camera.position.y - settings.camera[1][1];
    }"""
    assert moving.eval_on_selector(".vmc-scene", height) > 0


def test_a_muscle_is_named_under_the_pointer_and_chosen_by_its_name(moving):
    first = """div => {
      const view = vmc["demo/scene"].viewOf(div);
      const { top, left, width, height } = div.getBoundingClientRect();
      for (let x = -1; x < 1; x += 0.05) for (let y = -1; y < 1; y += 0.05) {
        const k = view.body.muscles.muscleAt([x, y]);
        if (k !== null) return [left + (x + 1) / 2 * width, top + (1 - y) / 2 * height,
                                view.anatomy.muscles[k].name];
      } }"""
    x, y, name = moving.eval_on_selector(".vmc-scene", first)
    moving.mouse.move(x, y)
    assert moving.inner_text(".vmc-tip") == name
    moving.mouse.click(x, y)
    chosen = moving.locator(".vmc-muscles label", has=moving.locator(":checked"))
    assert chosen.inner_text().startswith(name)
    scene = moving.query_selector(".vmc-scene")
    before = scene.evaluate(CAPTURE)
    moving.locator(".vmc-muscles input:checked").press("ArrowDown")
    assert scene.evaluate(CAPTURE) != before


def test_without_webgl_words_stand_for_the_scene_and_the_numbers_follow(open_demo, window):
    page = open_demo(movement, window(NO_WEBGL), **MOVEMENT)
    page.get_by_text("draws no 3-D picture").wait_for()
    assert page.locator(".vmc-scene p").first.inner_text() == "to 1.2"
    assert boxes(page.locator(".vmc-scene"))[0][3] < 120
    after = "(demo) => getComputedStyle(demo, '::after').content"
    assert "newer browser" not in page.eval_on_selector(".vmc-demo", after)
    page.fill(".vmc-clock input", "0")
    assert numbers(page)["elbow"] == "57.3°"


PRINT_EARLY = """let viewer;
Object.defineProperty(self, "MeshCat", { get: () => viewer, set(made) {
  viewer = made;
  dispatchEvent(new Event("beforeprint"));
} });"""


def test_a_page_printed_before_the_bones_are_there_draws_its_scene_later(open_demo, window):
    page = open_demo(movement, window(PRINT_EARLY), **MOVEMENT)
    page.wait_for_selector(".vmc-scene canvas")
    assert page.errors == []


ONE_CONTEXT = NO_WEBGL.replace('startsWith("webgl") ?', 'includes("webgl") && self.vmcAsked++ ?')


def test_a_scene_whose_viewer_fails_says_why(open_demo, window):
    """The browser has WebGL, and yet no context for the viewer."""
    page = open_demo(movement, window(f"self.vmcAsked = 0; {ONE_CONTEXT}"), **MOVEMENT)
    page.get_by_text("draws no 3-D picture").wait_for()
    assert page.locator(".vmc-scene p").first.inner_text() == "to 1.2"
    page.errors[:] = [error for error in page.errors if "WebGL" not in error]  # the viewer's


def test_a_scene_without_its_files_says_so(open_demo, window):
    reader = window()
    reader.route("**/bones.js", lambda route: route.abort())
    page = open_demo(movement, reader, **MOVEMENT)
    page.get_by_text("files of the 3-D picture did not come").wait_for()
    assert page.locator(".vmc-scene p").first.inner_text() == "to 1.2"
    for kept in (page.failed, page.errors):
        kept[:] = [one for one in kept if "bones.js" not in one]


def test_a_picture_that_the_browser_takes_away_comes_back(moving):
    get = """(div) => vmc["demo/scene"].viewOf(div).viewer.renderer.getContext()
      .getExtension("WEBGL_lose_context")"""
    for back in (
        "(_, context) => context.restoreContext()",  # by itself, when the browser gives it back
        "(div) => vmc['demo/scene'].viewOf(div).wake()",  # when the reader has scrolled away
    ):
        context = moving.query_selector(".vmc-scene").evaluate_handle(get)
        context.evaluate("context => context.loseContext()")
        moving.get_by_text("taken the 3-D picture away").wait_for()
        moving.eval_on_selector(".vmc-scene", back, context)
        moving.wait_for_selector(".vmc-scene canvas")
