"""The reader's own camera: a shuttlecock is followed, and reached for wherever it comes to rest."""

import re
from base64 import b64encode
from io import BytesIO

import cv2
import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from tests import pages
from tests.page.arm.controls import readout, status
from tests.page.eye.test_your_photo import NEED, OURS, POINT, SHOTS, text_file
from tests.project import sample
from tools import browser
from vmc_lib.boxes import iou, pad_boxes

pytestmark = pytest.mark.browser
FOLLOW = """return eye.finish(eye.follow(brain, photo, ...asked));"""
DRAWN = """const { prototype } = CanvasRenderingContext2D, { drawImage } = prototype;
self.drawn = 0; // frames of a video: Chromium keeps a copy of each
prototype.drawImage = function (picture, ...rest) {
  self.drawn += picture instanceof HTMLVideoElement;
  return drawImage.call(this, picture, ...rest);
};"""
FILM = """delete self.VideoFrame; // as in other browsers
navigator.mediaDevices.getUserMedia = async () => {
  const picture = (self.picture = new Image()), canvas = document.createElement("canvas");
  Object.assign(canvas, { width: 600, height: 400 });
  setInterval(() => canvas.getContext("2d").drawImage(picture, 0, 0), 40);
  return (self.film = canvas.captureStream());
};"""
LATE = """navigator.mediaDevices.getUserMedia = () => new Promise((allow) => {
  const film = document.createElement("canvas").captureStream();
  self.allow = () => (allow(film), film.getTracks().map(({ readyState }) => readyState));
  self.tracks = () => film.getTracks().map(({ readyState }) => readyState);
});"""
HELD = """() => {
  const { append } = Element.prototype;
  document.head.append = (tag) => {
    if (tag.src?.endsWith("brain.js")) self.go = () => append.call(document.head, tag);
    else append.call(document.head, tag);
  };
}"""
RESTING_ELSEWHERE = """(first) =>
  document.querySelector("[role=status]").textContent.startsWith("Corrected by trial")
  && document.querySelector("[data-tell=place]").textContent !== first"""
BLANK = np.full_like(OURS.image, 128)
FAKE = "--use-fake-device-for-media-stream --use-fake-ui-for-media-stream".split()


def moved(shot, right, down):
    """A photo whose shuttlecock lies elsewhere, so many pixels away."""
    [[x0, y0, x1, y1]] = np.int32(np.round(pad_boxes(shot.boxes["shuttlecock"], 0.15)))
    hole = np.zeros(shot.image.shape[:2], np.uint8)
    hole[y0:y1, x0:x1] = 255
    image = cv2.inpaint(shot.image, hole, 5, cv2.INPAINT_TELEA)
    image[y0 + down : y1 + down, x0 + right : x1 + right] = shot.image[y0:y1, x0:x1]
    return image


def jpeg(image):
    file = BytesIO()
    Image.fromarray(image).save(file, "JPEG", quality=95)
    return file.getvalue()


def show_in_film(page, image):
    """Show an image in a page's FILM."""
    page.wait_for_function("() => self.picture")
    address = f"data:image/jpeg;base64,{b64encode(jpeg(image)).decode()}"
    page.evaluate("(address) => (picture.src = address)", address)


@pytest.mark.parametrize("shot", sample(SHOTS[4::8], "sheet/test/020"), ids=lambda shot: shot.name)
def test_a_box_follows_what_has_moved_in_it_or_beside_it(ask, shot):
    box = shot.boxes["shuttlecock"]
    camera = {name: np.asarray(value).tolist() for name, value in vars(shot.camera).items()}
    for aside in (0.3, 0.7):
        start = box + aside * np.array([1, 0, 1, 0]) * (box[2] - box[0])
        assert iou(ask(FOLLOW, [start.tolist(), camera], shot.image), box).item() > 0.6
    assert ask(FOLLOW, [box.tolist(), camera], BLANK) is None


@pytest.mark.audit
def test_the_arm_reaches_again_for_what_has_been_moved(window, site, html):
    page = pages.open_html(window(FILM, viewport={"width": 800, "height": 900}), site, html)

    page.locator("[name=live]").click()
    show_in_film(page, BLANK)
    status(page, NEED)
    show_in_film(page, OURS.image)
    status(page, "Corrected by trial")
    first = readout(page, "place")
    assert re.fullmatch(r"\d+ frames/s", readout(page, "followed"))
    for step in range(1, 9):
        show_in_film(page, moved(OURS, -6 * step, step))
    page.wait_for_function(RESTING_ELSEWHERE, arg=first)
    page.get_by_role("button", name="Stop").click()
    page.get_by_role("button", name="Example").click()
    status(page, "Corrected by trial")
    assert readout(page, "place") == first
    assert page.errors == []


def test_a_film_that_is_left_or_cut_leaves_the_page_to_photos(window, site, html, tmp_path):
    page = pages.open_html(window(FILM), site, html)
    page.evaluate(HELD)
    live, photo = page.locator("[name=live]"), tmp_path / "photo.jpg"
    live.click()
    show_in_film(page, BLANK)
    status(page, "Opening the eye")
    page.wait_for_function("() => self.go")
    photo.write_bytes(jpeg(BLANK))
    page.locator("[type=file]").set_input_files(photo)
    page.evaluate("go()")
    status(page, POINT)
    expect(live).to_have_text("Live")
    live.click()
    show_in_film(page, BLANK)
    status(page, NEED)
    page.locator("[type=file]").set_input_files(text_file(tmp_path))
    status(page, "This browser cannot read")
    expect(live).to_have_text("Live")
    live.click()
    show_in_film(page, BLANK)
    status(page, NEED)
    page.evaluate("film.getTracks().forEach((track) => track.stop())")
    assert "unplugged" in status(page, "The camera stopped")
    assert page.errors == []


def test_a_camera_allowed_after_a_photo_is_switched_off(window, site, html, tmp_path):
    page = pages.open_html(window(LATE), site, html)
    page.locator("[name=live]").click()
    photo = tmp_path / "photo.jpg"
    photo.write_bytes(jpeg(BLANK))
    page.locator("[type=file]").set_input_files(photo)
    status(page, POINT)
    assert page.evaluate("allow()") == ["live"]
    assert page.evaluate("tracks()") == ["ended"]
    assert page.locator("p[role=status]").inner_text().startswith(POINT)
    assert page.errors == []


def test_the_button_keeps_the_focus_and_asks_once_while_the_camera_is_not_allowed(
    window, site, html
):
    page = pages.open_html(window(LATE), site, html)
    live = page.locator("[name=live]")
    live.press("Enter")
    page.evaluate(pages.TWO_FRAMES)  # a browser takes the focus away when it draws
    page.evaluate("() => { navigator.mediaDevices.getUserMedia = () => { self.again = true } }")
    page.keyboard.press("Enter")
    expect(live).to_be_focused()
    assert page.evaluate("self.again") is None
    assert page.errors == []


def test_it_takes_what_the_browsers_camera_shows(chromium, site, html, tmp_path):
    film = tmp_path / "film.mjpeg"
    film.write_bytes(jpeg(OURS.image))
    options = browser.options(browser.find())
    options["args"] = [*options["args"], *FAKE, f"--use-file-for-fake-video-capture={film}"]
    films = chromium.browser_type.launch(**options)
    context = pages.patient(films.new_context, offline=True)
    context.add_init_script(DRAWN)
    page = pages.open_html(context, site, html)
    page.get_by_role("button", name="Live").click()
    assert "from the place seen" in status(page, "Corrected by trial")
    assert page.evaluate("drawn") == 0
    assert page.errors == []
    films.close()


def test_without_a_camera_a_photo_will_do(open_page, html):
    page = open_page(html)
    page.get_by_role("button", name="Live").click()
    status(page, "No camera was found. A photo will do.")
    expect(page.locator("[data-tell=followed]")).to_be_hidden()


def test_where_a_page_may_ask_no_camera_there_is_no_button(window, site, html):
    page = pages.open_html(window("delete Navigator.prototype.mediaDevices;"), site, html)
    expect(page.locator("[name=live]")).to_be_hidden()
