"""Scenes as the page's scripts move them."""

import io
from base64 import b64decode, b64encode

import numpy as np
import pypdfium2
import pytest
import umsgpack
from meshcat import geometry as g
from meshcat.transformations import translation_matrix
from PIL import Image

from tests.pages import CAPTURE
from vmc_lib.show import Scene, Slider, explore, figure, photo_view, props
from vmc_lib.show.arm import arm_scene

pytestmark = pytest.mark.browser


def ball(x):
    scene = Scene()
    scene["ball"].set_object(g.Sphere(0.2), g.MeshLambertMaterial(color=0xFF0000))
    scene["ball"].set_transform(translation_matrix([x, 0.0, 0.0]))
    if x > 0.3:
        scene["box"].set_object(g.Box([0.2, 0.2, 0.2]), g.MeshLambertMaterial(color=0x0000FF))
    return scene


def test_a_scene_depends_on_its_state_alone(open_demo):
    xs = [0.0, 0.2, 0.4, 0.6]
    page = open_demo(ball, alt=lambda x: f"ball at {x}", x=Slider(xs, "x", start=0.2))
    page.wait_for_selector(".vmc-scene canvas")
    scene, seen = page.query_selector(".vmc-scene"), []
    for place in "0123210":
        page.fill("input", place)
        seen.append(scene.evaluate(CAPTURE))
    assert seen[:3] == seen[:-4:-1]
    assert len(set(seen)) == 4
    page.click(".vmc-more summary")
    page.fill(".vmc-turn input", "90")  # walk around
    assert scene.evaluate(CAPTURE) != seen[-1]
    assert page.get_attribute(".vmc-pictures", "aria-label") == "ball at 0.0"


def test_the_close_ups_shuttlecock_is_as_large_as_the_scenes(open_page):
    sizes = "() => { const { LENGTH, RIM } = vmc['demo/close_up']; return [LENGTH, RIM]; }"
    assert open_page("<h1>S</h1>").evaluate(sizes) == [props.LENGTH, props.RIM]


def test_an_arm_that_the_pages_python_draws_keeps_its_anatomy(open_demo):
    def draw(elbow):
        return arm_scene(np.radians([0, elbow]))

    page = open_demo(draw, alt="an arm", elbow=Slider([0, 90], "elbow"))
    page.wait_for_selector(".vmc-scene canvas")
    scene = page.query_selector(".vmc-scene")
    straight = scene.evaluate(CAPTURE)
    page.fill("input", "1")
    bent = scene.evaluate(CAPTURE)
    for elbow, expected in ((0, straight), (90, bent)):
        told = [line for line in draw(elbow).messages() if not line.startswith("anatomy")]
        scene.evaluate("(div, told) => vmc['demo/scene'].viewOf(div).show(told)", told)
        assert scene.evaluate(CAPTURE) == expected
    assert straight != bent


LOADS = """(_, url) => new Promise((end) =>
  new MeshCat.THREE.ImageLoader().load(url, () => end(true), null, () => end(false)))"""


def test_a_scene_asks_no_host_for_a_texture(open_demos):
    """It may be the page's Python that names it; textures that came along are drawn."""
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1), "blue").save(pixel, "PNG")
    textured = g.MeshLambertMaterial(map=g.ImageTexture(g.PngImage(pixel.getvalue())))
    scene = Scene()
    scene["ball"].set_object(g.Sphere(0.2), textured)
    [object_] = [one for one in scene.messages() if one.startswith("set_object")]
    key, data = object_.split("|")
    command = umsgpack.unpackb(b64decode(data))
    [image] = command["object"]["images"]
    page = open_demos(lambda: figure(scene, "c", "a ball"))
    page.wait_for_selector(".vmc-scene canvas")
    view = page.query_selector(".vmc-scene")
    assert view.evaluate(LOADS, image["url"])
    image["url"] = "secret.png"
    told = f"{key}|{b64encode(umsgpack.packb(command)).decode()}"
    view.evaluate("(div, told) => vmc['demo/scene'].viewOf(div).show([told])", told)
    assert not view.evaluate(LOADS, "secret.png")
    assert not any("secret" in url for url in page.asked)


LIVE = "all => all.map((scene) => Boolean(scene.querySelector('canvas')))"


def test_at_most_six_scenes_live_and_the_others_are_images(open_demos):
    page = open_demos(lambda: [figure(ball(0.1), "c", f"scene {i}") for i in range(9)])
    for _ in range(2):  # down, and up again
        for scene in page.query_selector_all(".vmc-scene"):
            scene.scroll_into_view_if_needed()
            scene.wait_for_selector("canvas")
            assert len(page.query_selector_all(".vmc-scene canvas")) <= 6
    assert len(page.query_selector_all(".vmc-scene img")) == 3
    before = page.eval_on_selector_all(".vmc-scene", LIVE)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    images = page.eval_on_selector_all(".vmc-scene img", "all => all.map(i => i.src)")
    assert len(images) == 9
    assert len(set(images)) == 1
    assert len(images[0]) > 3000
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.wait_for_function("() => document.querySelectorAll('.vmc-scene canvas').length === 6")
    assert page.eval_on_selector_all(".vmc-scene", LIVE) == before


BEFORE_AND_AFTER = """(div) => {
  const { words } = vmc["demo/scene"].viewOf(div), picture = [...div.children];
  const parts = [...document.querySelectorAll("figure *")].filter((part) => !div.contains(part));
  const tops = () => parts.map((part) => part.getBoundingClientRect().top);
  const after = tops();
  div.replaceChildren(...words);
  const before = tops();
  div.replaceChildren(...picture);
  return [before, after]; }"""


def test_a_scene_that_comes_moves_nothing(open_demos):
    """Its place is as high while words stand there."""
    page = open_demos(lambda: figure((ball(0.1), "<p>text</p>"), "c", "a ball"))
    page.wait_for_selector(".vmc-scene canvas")
    before, after = page.eval_on_selector(".vmc-scene", BEFORE_AND_AFTER)
    assert before == after


def test_a_scene_is_no_wider_than_its_place(open_demos):
    photo = np.zeros((400, 600, 3), np.uint8)
    page = open_demos(lambda: figure((photo_view(photo), ball(0.1)), "c", "a photo and a ball"))
    page.wait_for_selector(".vmc-scene canvas")
    page.eval_on_selector(".vmc-pictures", "(box) => (box.style.width = '1105px')")
    page.wait_for_function("() => document.querySelector('canvas').style.width === '545px'")
    wide = "(box) => [box.scrollWidth, Math.ceil(box.getBoundingClientRect().width)]"
    drawn, room = page.eval_on_selector(".vmc-pictures", wide)
    assert drawn <= room


def printed(page):
    """A page on paper: its words, and whether something red and something blue is on it."""
    pdf = pypdfium2.PdfDocument(page.pdf(print_background=True))
    sheets = [np.int16(sheet.render().to_numpy()).reshape(-1, 3) for sheet in pdf]
    blue, _, red = np.concatenate(sheets).T
    text = "\n".join(sheet.get_textpage().get_text_range() for sheet in pdf)
    return text, (red > blue + 60).any(), (blue > red + 60).any()


def test_paper_shows_the_state_that_the_reader_chose(open_demos):
    def declare():
        figure('<p style="height: 60em">Tall.</p>', "The scene below is not in sight.", "words")
        labels, place = ["now", "then"], Slider([0.1, 0.4], "place", play=True)
        explore(
            lambda x, label: (ball(x), f"<p>{label} at {x}</p>"),
            "A ball.",
            "alt",
            x=place,
            label=labels,
        )

    page = open_demos(declare)
    page.wait_for_function("() => window.MeshCat")
    page.fill("input", "1")
    page.evaluate("() => { document.documentElement.dataset.theme = 'dark' }")
    text, red, blue = printed(page)
    assert all(word in text for word in ("now at 0.4", "place", "A ball."))
    assert not any(word in text for word in ("then", "0.1", "Play", "turn the view"))
    assert red
    assert blue
    assert page.get_attribute("html", "data-theme") == "dark"


def test_paper_shows_the_last_state_of_an_untouched_demo(open_demo):
    place = Slider([0.1, 0.2, 0.4], "place", play=True)
    page = open_demo(lambda x: (ball(x), f"<p>now at {x}</p>"), x=place)
    page.wait_for_selector(".vmc-scene canvas")
    text, _, blue = printed(page)
    assert "now at 0.4" in text
    assert blue  # the box, which stands there at 0.4 only
    assert page.inner_text("output") == "0.1"
    assert page.inner_text(".vmc-picture p") == "now at 0.1"
