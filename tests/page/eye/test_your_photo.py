"""The reader's own photo in the page: to a corrected reach, or else in words what is missing."""

import re
from base64 import b64decode
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from book.figures import your_photo
from book.figures.your_photo import camera_guess
from page.arm.live import TRIALS
from tests import pages
from tests.page.arm.controls import number, readout, status
from tests.show.kernel import render
from tests.test_colour_profile import swapped_profile
from tests.test_marker_sheet import draw_sheet
from vmc_lib import photos
from vmc_lib.box_selection import SIZES
from vmc_lib.boxes import pad_boxes
from vmc_lib.camera import Camera
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.loop import VisuomotorModel, locate, reach, recalibrate, see
from vmc_lib.marker_sheet import remove_sheet

pytestmark = pytest.mark.browser
SHOTS = photos.load(photos.SHEET_LEVEL, "test")
OURS = SHOTS[20]
UNREADABLE = "This browser cannot read .*: save it, or a phone's HEIC, as a JPEG or PNG."
NEED = "To reach, the arm needs the printed sheet: "
POINT = "Point at a box, and the arm reaches for what is in it."
AGAIN = "Another photo may do"
NOTHING = "No shuttlecock;|Nothing that looks like an object"
REFUSED = "Two sheets|The photo is cropped"
END = f"Corrected by trial|Out of reach|{NEED}|{REFUSED}|{POINT}|{AGAIN}|This browser"
LOOKS = """() => {
  const eye = vmc["eye/your_photo"].YourPhoto.prototype, { look } = eye;
  self.looks = []; // at one photo after the other: promises of their ends
  eye.look = function (picture) {
    const end = look.call(this, picture);
    self.looks.push(end);
    return end;
  };
  const { main } = eye;
  self.kept = []; // as each reach begins: whether a picture can be kept
  eye.main = function () {
    self.kept.push(!this.form.elements.keep.disabled);
    return main.call(this);
  };
}"""

HELD = """() => {
  const read = createImageBitmap;
  self.createImageBitmap = (file) => new Promise((done) => {
    self.createImageBitmap = read;
    self.go = () => read(file).then(done);
  });
}"""


@pytest.fixture(scope="module")
def page(offline, site, html):
    page = pages.open_html(offline, site, html)
    page.locator(".vmc-eye[data-ready]").wait_for()
    page.evaluate(LOOKS)
    yield page
    page.close()
    assert page.errors == page.failed == []


def clear_status(page):
    """Take the status away, lest what is waited for has been there before."""
    page.locator("p[role=status]").evaluate("(it) => (it.textContent = '')")


def give(page, file):
    """Choose a file, and wait for what it leads to: the status in words."""
    clear_status(page)
    page.locator("[type=file]").set_input_files(file)
    return status(page, END)


def found(page):
    """What the page says that was found."""
    return page.locator("[data-tell=found]").inner_text()


def keep_picture(page, file):
    """Keep a page's picture of the reach in a file: its pixels (height, width, 3)."""
    with page.expect_download() as kept:
        page.get_by_role("button", name="Keep this picture").click()
    kept.value.save_as(file)
    return np.array(Image.open(file))


def difference(image, other):
    """Where two images (h, w, 3) differ visibly: (h, w)."""
    return np.abs(image.astype(int) - other).max(2) > 40


def test_our_photo_leads_to_a_corrected_reach_and_its_picture(page, tmp_path):
    assert len(page.locator("main").inner_text().split()) < 120
    assert sheets_from_above(page) == 1
    assert not page.get_by_text("followed").is_visible()
    page.asked.clear()
    page.get_by_role("button", name="Example").click()
    said = status(page, "Corrected by trial")
    assert found(page) == "A shuttlecock, 100 % sure."
    assert "from the place seen" in said
    assert sheets_from_above(page) == 1
    half, most = (1000 * error for error in your_photo.place_accuracy())
    assert f"right to {half:.0f} mm, in nine of ten to {most:.0f} mm" in said
    model = VisuomotorModel.load("real")
    camera, bare = remove_sheet(OURS.image)
    target = locate(model, bare, see(model, bare, camera).box, camera)
    made = reach(model, target)
    high = 100 * (camera.position[1] - your_photo.TABLE)  # soft: it trades with the focal length
    assert number(readout(page, "camera")) == pytest.approx(high, rel=0.05)
    assert "12 markers" in readout(page, "camera")
    ahead, aside = map(float, re.findall(r"(\d+) cm", readout(page, "place")))
    assert [ahead, aside] == pytest.approx(np.abs(100 * target[[0, 2]]), abs=1.3)
    planned = 1000 * made.distance(made.planned, made.target)
    assert number(readout(page, "planned")) == pytest.approx(planned, abs=2)
    own = recalibrate(made, lambda plan: broyden_calibration(plan, TRIALS))
    left = 1000 * own.distance(own.calibrated, own.target)
    assert number(readout(page, "calibrated")) == pytest.approx(left, abs=1)
    assert left < 0.3 * planned
    assert [url for url in page.asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert not any(page.evaluate("() => kept"))  # nor when the physics had just come
    image = keep_picture(page, tmp_path / "reach.jpg")
    assert image.shape == (860, 1200, 3)
    photo = np.array(Image.fromarray(OURS.image).resize((1200, 800)))
    arm = difference(image[:800], photo)
    assert 0.03 < arm.mean() < 0.5
    x, y = np.int32(2 * OURS.camera.project(OURS.target[None])[0])
    assert arm[y - 60 : y + 60, x - 60 : x + 60].mean() > 0.15  # the hand
    assert not arm[:200].any()  # it comes from below
    assert (image[800:] < 100).any()  # a line on what it is


def test_the_page_may_send_nothing(page):
    """Its policy refuses what a script would send, by a request or in a picture's address."""
    for sends in ("fetch(url).catch(() => {})", "Object.assign(new Image(), { src: url })"):
        script = """() => new Promise((settle) => {
          const url = "https://example.org/?photo", done = ({ blockedURI }) => settle(blockedURI);
          addEventListener("securitypolicyviolation", done, { once: true });
          %s;
        })"""
        assert page.evaluate(script % sends) == "https://example.org/?photo"
    assert all("Content Security Policy" in error for error in page.errors)
    page.errors.clear()
    page.failed.clear()


def has_arm(page):
    """Whether an arm is drawn into our photo."""
    photo = page.locator(".vmc-picture canvas").first.evaluate("(it) => it.toDataURL()")
    image = Image.open(BytesIO(b64decode(photo.partition(",")[2]))).convert("RGB")
    ours = Image.fromarray(OURS.image).resize(image.size)
    return difference(np.array(image), np.array(ours)).mean() > 0.03


@pytest.mark.audit
def test_the_reader_points_at_another_box(page):
    """The arm then reaches for that; what is out of reach is said, and no arm is in the photo."""
    page.get_by_role("button", name="Example").click()
    status(page, "Corrected by trial")
    before, out = readout(page, "place"), 0
    boxes = page.locator(".vmc-boxes button")
    assert boxes.first.get_attribute("aria-pressed") == "true"
    for n in range(1, boxes.count()):
        clear_status(page)
        boxes.nth(n).press("Enter")
        said, chance = status(page, "Corrected by trial|Out of reach"), boxes.nth(n).inner_text()
        assert readout(page, "place") != before
        assert ("can be where it is shaded" in said) == said.startswith("Out of reach")
        assert found(page) == f"The box chosen: a shuttlecock, {chance} sure."
        assert has_arm(page) == said.startswith("Corrected")
        out += not has_arm(page)
    assert out


def test_the_example_stands_first_and_alone_is_the_main_red(page):
    buttons = page.locator(".vmc-live-form > div > button:visible").all()
    assert [button.inner_text() for button in buttons[:2]] == ["Example", "Your photo …"]
    grounds = [
        button.evaluate("(it) => getComputedStyle(it).backgroundColor") for button in buttons
    ]
    red, green, blue = map(int, re.findall(r"\d+", grounds[0])[:3])
    assert red > 1.3 * max(green, blue)
    assert grounds.count(grounds[0]) == 1


def sheets_from_above(page):
    """How often the plot from above names the sheet."""
    return page.locator("svg[data-axes] text", has_text="sheet").count()


def promises(page):
    """Whether a page says that the arm reaches."""
    return "the arm reaches" in page.locator(".vmc-eye").inner_text()


def assert_nothing_found(page, said):
    """Assert that a photo without sheet and shuttlecock is met with plain words."""
    assert re.match(NOTHING, found(page))
    assert said.startswith(POINT if found(page).startswith("No shuttlecock") else AGAIN)
    assert promises(page) == found(page).startswith("No shuttlecock")


def test_in_a_photo_without_the_sheet_the_arm_reaches_for_a_guess(page):
    """What was found is said first, then that nothing is measured; of a box chosen, its chance."""
    shot = next(shot for shot in photos.load("real", "test") if shot.boxes)
    said = give(page, shot.file)
    assert "from the place guessed" in said
    assert sheets_from_above(page) == 0
    assert "so the place is a guess, the same for every photo without one." in said
    assert "part of a larger photo, from 50 cm away, held at 45°" in said
    choices = page.locator(".vmc-boxes button")
    assert re.fullmatch(r"A shuttlecock, \d+ % sure\.", found(page))
    assert "0 markers seen, 3 needed" in readout(page, "camera")
    assert page.locator(".vmc-boxes button.vmc-green").count() >= 1
    clear_status(page)
    choices.last.click()
    assert choices.last.get_attribute("aria-pressed") == "true"
    assert "so the place is a guess" in status(page, "Corrected by trial")
    assert found(page) == f"The box chosen: a shuttlecock, {choices.last.inner_text()} sure."
    assert readout(page, "place") == "a guess"


@pytest.mark.parametrize("box", [(100, 80, 140, 110), (50, 20, 500, 390)], ids=["far", "near"])
def test_a_guessed_camera_sees_the_place_in_the_box_as_large_as_a_shuttlecock(ask, box):
    guess = camera_guess()
    script = "return eye.guessCamera(...asked);"
    camera = Camera(**ask(script, [box, guess, [300, 200], 721]))
    x0, y0, x1, y1 = box
    place = np.array(guess["place"])
    np.testing.assert_allclose(camera.project(place[None])[0], [(x0 + x1) / 2, (y0 + y1) / 2])
    across = guess["size"] * camera.rotation[0]
    left, right = camera.project(np.array([place - across / 2, place + across / 2]))
    assert right[0] - left[0] == pytest.approx(np.sqrt((x1 - x0) * (y1 - y0)))
    assert camera.focal >= guess["lens"] * 721
    assert np.linalg.norm(camera.position - place) >= guess["nearest"]


GUESSED = """const [box, guess, selector] = asked;
return eye.guessWords(guess, eye.guessCamera(box, guess, [300, 200], 721), selector);"""


def test_where_a_usual_lens_would_be_too_near_no_distance_is_stated_by_it(ask):
    """The photo is then said to be a part of one; the other distance follows the box."""
    guess, selector = camera_guess(), {"sizes": list(SIZES)}
    near, far = (
        ask(GUESSED, [box, guess, selector]) for box in ((50, 20, 500, 390), (270, 185, 330, 215))
    )
    assert "would be nearer than 50 cm" in near
    assert "taken as part of a larger photo, from 50 cm away" in near
    assert "±" not in near
    away = guess["lens"] * 721 * guess["size"] / np.sqrt(60 * 30)
    spread = 100 * np.ptp(SIZES) / sum(SIZES)
    assert f"is {100 * away:.0f} cm from the camera, ± {spread:.0f} %" in far
    assert "a part of" not in far


@pytest.mark.audit
def test_where_nothing_is_a_shuttlecock_the_reader_may_choose(page):
    assert_nothing_found(page, give(page, photos.everyday()[0].file))


def write(folder, image):
    """The file of an image."""
    Image.fromarray(image).save(folder / "photo.png")
    return folder / "photo.png"


def test_of_two_sheets_one_is_to_be_covered(page, tmp_path):
    two = draw_sheet(OURS.camera, sheets=[(0.2, -130, 300, 1)], ground=OURS.image)
    assert give(page, write(tmp_path, two)).startswith("Two sheets are seen: cover one.")
    assert found(page) == "A shuttlecock, 100 % sure."  # no sheet is taken for one
    assert "unknown: " in readout(page, "camera")
    assert not promises(page)


def test_a_sheet_laid_upside_down_is_asked_about(page, tmp_path):
    _, bare = remove_sheet(OURS.image)
    turned = draw_sheet(OURS.camera, sheets=[(np.pi, 0, 0, 1)], ground=bare)
    assert give(page, write(tmp_path, turned)).endswith(
        "Does the sheet’s arrow point away from you?"
    )


WORDS = """const sheet = { fewest: 3 }, { sight, count, camera, seen } = asked;
const read = { markers: Array(seen), camera };
return vmc["eye/photo_words"].nextWords(sight, count, read, sheet);"""


def test_the_arm_is_promised_where_it_can_reach(ask):
    """Never where too little of a sheet is seen; by one, sizes are doubted of what is none."""
    nothing, box = {"boxes": [], "box": None}, [0, 0, 1, 1]
    things, shuttlecock = {"boxes": [box], "box": None}, {"boxes": [box], "box": box}
    for sight, count, camera, seen, says in (
        (nothing, 0, None, 0, "Another photo"),
        (nothing, 1, None, 0, "Another photo"),
        (nothing, 0, {}, 3, "Another photo"),
        (things, 1, None, 2, NEED),
        (shuttlecock, 1, None, 2, NEED),
        (things, 1, None, 0, f"{POINT}$"),
        (shuttlecock, 1, None, 0, "Planning the reach"),
        (shuttlecock, 1, {}, 3, "Planning the reach"),
        (things, 1, {}, 3, "Point at a box.* not 100 mm long, sizes and places are wrong"),
    ):
        said = ask(WORDS, {"sight": sight, "count": count, "camera": camera, "seen": seen})
        assert re.match(says, said)
        assert ("the arm reaches" in said) == says.startswith("Point")


@pytest.mark.audit
def test_the_shuttlecock_in_reach_is_taken_first(page, tmp_path):
    """Here the second, which is paler; a copy of it, which the page likes best, is too far."""
    x0, y0, x1, y1 = np.int32(np.round(pad_boxes(OURS.boxes["shuttlecock"], 0.15)))[0]
    two, ours = OURS.image.copy(), OURS.image[y0:y1, x0:x1]
    two[20 : 20 + y1 - y0, 40 : 40 + x1 - x0] = ours
    two[y0:y1, x0:x1] = 0.5 * ours + 0.5 * np.median(ours, axis=(0, 1))
    assert give(page, write(tmp_path, two)).startswith("Corrected by trial")
    assert found(page).startswith("2 shuttlecocks, ")
    pressed = page.locator(".vmc-boxes button[aria-pressed=true]")
    assert pressed.get_attribute("data-box") == "1"
    place = readout(page, "place")
    page.locator(".vmc-boxes button").first.click()
    assert status(page, "Out of reach")
    point_at(page, 1)  # in the photo
    assert status(page, "Corrected by trial")
    assert pressed.get_attribute("data-box") == "1"
    assert readout(page, "place") == place


def point_at(page, number):
    """Click in the middle of a box in the photo."""
    box = page.locator(f".vmc-picture [data-box='{number}'] rect").first.bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)


def sideways(folder):
    """Our photo as a phone saves it that was turned: on its side, and a word on how to turn it."""
    turn = Image.Exif()
    turn[0x0112] = 6
    Image.fromarray(np.rot90(OURS.image)).save(folder / "turned.png", exif=turn)
    return folder / "turned.png"


def other_colours(folder):
    """Our photo with red and green swapped, and a profile that swaps them back."""
    image = Image.fromarray(np.ascontiguousarray(OURS.image[..., [1, 0, 2]]))
    image.save(folder / "profile.png", icc_profile=swapped_profile())
    return folder / "profile.png"


@pytest.mark.audit
@pytest.mark.parametrize("save_as", [sideways, other_colours])
def test_a_photo_as_phones_save_it_gives_the_same_place(page, tmp_path, save_as):
    """As ours, and as the same file gives in Python."""
    page.get_by_role("button", name="Example").click()
    status(page, "Corrected by trial")
    place = readout(page, "place")
    file = save_as(tmp_path)
    assert np.abs(photos.read_image(file) - OURS.image.astype(int)).mean() < 1
    assert give(page, file).startswith("Corrected by trial")
    assert found(page) == "A shuttlecock, 100 % sure."
    assert readout(page, "place") == place


@pytest.mark.audit
def test_a_photo_that_was_cropped_has_no_place_and_is_asked_for_whole(page, tmp_path):
    whole = draw_sheet(OURS.camera, size=2, ground=remove_sheet(OURS.image)[1])
    assert give(page, write(tmp_path, whole)).startswith("Corrected by trial")
    cropped = np.ascontiguousarray(whole[:, 200:])
    said = give(page, write(tmp_path, cropped))
    assert said.startswith(
        "The photo is cropped, or its lens bends straight lines: take a whole one"
    )
    assert found(page).startswith("A shuttlecock, ")
    assert readout(page, "place") == "–"
    with pytest.raises(ValueError, match="the photo is cropped"):
        remove_sheet(cropped)


@pytest.mark.audit
def test_a_sheet_shrunk_to_a5_is_told_by_the_shuttlecocks_size(page, tmp_path):
    a5 = draw_sheet(OURS.camera, sheets=[(0, 0, 0, 0.71)], ground=remove_sheet(OURS.image)[1])
    camera, bare = remove_sheet(a5)
    box = see(VisuomotorModel.load("real"), bare, camera).box
    size = camera.sizes(box[None]).item()
    assert size > SIZES[1]
    says = f"By the sheet it is {100 * size:.0f} cm large, as no shuttlecock is: measure the sheet"
    assert says in give(page, write(tmp_path, a5))


def text_file(folder):
    """A file that is no photo, whatever its name says."""
    (folder / "words.jpg").write_text("no picture", encoding="utf-8")
    return folder / "words.jpg"


def test_what_cannot_be_read_is_said_last(page, tmp_path):
    page.evaluate("() => (looks.length = 0)")
    page.get_by_role("button", name="Example").click()
    page.wait_for_function("() => looks.length")
    give(page, text_file(tmp_path))
    page.evaluate("() => Promise.all(looks)")  # the eye has stopped
    assert re.fullmatch(UNREADABLE, page.locator("p[role=status]").inner_text())
    assert readout(page, "camera") == "–"
    assert page.locator("[data-box]:visible").count() == 0


def test_the_example_chosen_last_is_shown_though_a_file_is_read_slowly(page, tmp_path):
    page.evaluate("() => (looks.length = 0)")
    page.evaluate(HELD)
    page.locator("[type=file]").set_input_files(save(tmp_path, "slow.png"))
    page.wait_for_function("() => self.go")
    page.get_by_role("button", name="Example").click()
    page.wait_for_function("() => looks.length")
    page.evaluate("() => go()")
    page.evaluate(pages.TWO_FRAMES)
    assert page.evaluate("() => looks.length") == 1
    give(page, text_file(tmp_path))  # which ends it


PASTE = """(field) => {
  const main = document.querySelector("main"), clipboardData = new DataTransfer();
  clipboardData.setData("text/plain", "return 1");
  clipboardData.items.add(new File(["no picture"], "pasted.png", { type: "image/png" }));
  const read = createImageBitmap;
  let taken = false;
  self.createImageBitmap = (file) => ((taken = true), read(file));
  main.insertAdjacentHTML("beforeend", field);
  main.lastChild.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
  main.lastChild.remove();
  self.createImageBitmap = read;
  return taken;
}"""


def test_what_is_pasted_where_one_writes_is_no_photo(page):
    """Some programs copy text with a picture of it."""
    clear_status(page)
    for field in ("<textarea></textarea>", "<input>", "<p contenteditable></p>"):
        assert not page.evaluate(PASTE, field)
    for field in ("<input type=range>", "<p></p>"):
        assert page.evaluate(PASTE, field)
    assert re.fullmatch(UNREADABLE, status(page, "This browser"))


def save(folder, name, mode="RGB", size=(60, 40), **options):
    Image.new(mode, size).save(folder / name, **options)
    return folder / name


@pytest.mark.audit
def test_no_file_is_met_with_silence(page, tmp_path):
    heic = tmp_path / "phone.heic"
    heic.write_bytes(b"\0\0\0\x18ftypheic\0\0\0\0mif1heic")
    for file in (text_file(tmp_path), heic):
        assert re.fullmatch(UNREADABLE, give(page, file))
    turned = Image.Exif()
    turned[0x0112] = 6
    for file in (
        save(tmp_path, "dot.png", size=(1, 1)),
        save(tmp_path, "line.png", size=(3000, 1)),
        save(tmp_path, "large.jpg", size=(8000, 6000)),
        save(tmp_path, "grey.jpg", "L"),
        save(tmp_path, "four.jpg", "CMYK"),
        save(tmp_path, "deep.png", "I;16"),
        save(tmp_path, "turned.jpg", size=(400, 600), exif=turned),
    ):
        assert_nothing_found(page, give(page, file))
    assert margin(page) == BLACK  # the right way up it fills the picture
    page.locator("[type=file]").set_input_files(tmp_path / "large.jpg")  # slow to read, and then
    give(page, tmp_path / "grey.jpg")  # another
    assert margin(page) == BLACK


BLACK = [0, 0, 0]


def margin(page):
    """The colour of the photo's picture at its left edge: grey beside what is not as wide."""
    pixel = "(it) => [...it.getContext('2d').getImageData(2, 400, 1, 1).data].slice(0, 3)"
    return page.locator(".vmc-picture canvas").first.evaluate(pixel)


@pytest.mark.audit
def test_in_a_kernel_it_is_the_same_page(monkeypatch, window):
    shown = pages.displayed(monkeypatch, your_photo)
    for mode in ("live", "test"):
        monkeypatch.setenv("VMC_RENDER_MODE", mode)
        your_photo.your_photo(OURS)
        assert len(shown) == 3
    page = pages.observe(window().new_page())
    render(page, shown[1], monkeypatch)
    page.locator("[name=example]").click()
    assert "from the place seen" in status(page, "Corrected by trial")
    assert page.errors == []
