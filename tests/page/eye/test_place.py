"""The sheet, the camera and the place in the page are those of Python."""

from base64 import b64decode

import cv2
import numpy as np
import pytest
from playwright.sync_api import Error

from book.figures.see_and_reach import place_errors
from book.figures.your_photo import place_accuracy, sheet
from page.eye.localiser import CompactLocaliser, shift_mm
from reproduce.experiments.printed_sheet import FROM_SHEET
from tests.project import sample
from tests.test_marker_sheet import (
    EYE,
    LOW,
    REFUSED,
    STRAIGHT,
    bent,
    displaced,
    draw_sheet,
    looking,
)
from vmc_lib import NoReach, marker_sheet, photos
from vmc_lib.loop import VisuomotorModel, see

SHOTS = photos.load(photos.SHEET_LEVEL, "test")
SHEET = sheet()
SKY = [280, 20, 320, 60]  # a box above the horizon of a camera that looks level
READ = """const { sheet, size } = asked;
  const { markers, camera, why } = eye.finish(eye.readSheet(photo, sheet, size));
  const bare = camera && eye.paintOver(photo, eye.sheetOutline(camera, sheet)).data;
  const text = (bytes) => Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return { ids: markers.map(({ id }) => id), camera, why, bare: bare && btoa(text(bare)) };"""


def read(ask, image):
    return ask(READ, {"sheet": SHEET, "size": [photos.WIDTH, photos.HEIGHT]}, image)


def painted(there):
    """The photo without the sheet, (400, 600, 3) whole numbers."""
    data = np.frombuffer(b64decode(there["bare"]), np.uint8)
    return data.reshape(400, 600, 4)[..., :3].astype(int)


def detected(image):
    """The ids and corners of the markers that OpenCV detects."""
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    patterns = marker_sheet.board().getDictionary()
    corners, ids, _ = cv2.aruco.ArucoDetector(patterns, parameters).detectMarkers(image)
    return [] if ids is None else ids.ravel().tolist(), [each[0].tolist() for each in corners]


def place_under(camera, photo):
    """Where a camera, as the page gives it, sees the middle of a photo's shuttlecock (3,)."""
    camera = marker_sheet.Camera(
        *(np.array(camera[name]) for name in ("focal", "centre", "rotation", "position"))
    )
    [pixel] = photo.camera.project(photo.target)
    return camera.back_project(pixel, photo.target[1])[0]


@pytest.mark.browser
@pytest.mark.parametrize("shot", SHOTS[::4], ids=lambda shot: shot.name)
def test_a_camera_from_the_same_corners_is_that_of_opencv(ask, shot):
    script = "return eye.calibrateCamera(asked.ids, asked.corners, 600, 400, asked.sheet);"
    ids, corners = detected(shot.image)
    here = marker_sheet.estimate_camera(shot.image)
    there = ask(script, {"ids": ids, "corners": corners, "sheet": SHEET})
    assert there["focal"] == pytest.approx(here.focal, rel=1e-5)
    assert np.abs(place_under(there, shot) - place_under(vars(here), shot)).max() < 1e-6  # m


@pytest.mark.browser
@pytest.mark.parametrize("shot", SHOTS[1::4], ids=lambda shot: shot.name)
def test_a_photo_with_the_sheet_gives_the_place_that_python_finds(ask, shot):
    there, (ids, _) = read(ask, shot.image), detected(shot.image)
    assert {*ids} <= {*there["ids"]}
    camera, bare = marker_sheet.remove_sheet(shot.image)
    assert (there["camera"] is None) == (camera is None)
    if camera is None:
        return
    off = place_under(there["camera"], shot) - place_under(vars(camera), shot)
    assert np.linalg.norm(off) < 2e-3
    assert np.mean(np.abs(painted(there) - bare).max(axis=2) > 2) < 0.02


@pytest.mark.browser
@pytest.mark.parametrize("name", sample(LOW, "over its edge"))
def test_a_sheet_that_reaches_behind_the_camera_is_painted_over(ask, name):
    (ahead, high), (to, low) = LOW[name]
    table = marker_sheet.TABLE
    shown = draw_sheet(looking((ahead, table + high, 0.2), (to, table + low, 0.22), 480.0))
    there = read(ask, shown)
    assert there["camera"]["focal"] == pytest.approx(480, rel=0.03)
    assert (np.abs(painted(there) - 120) < 60).all()  # no black or white is left


@pytest.mark.browser
@pytest.mark.parametrize("why", sample(REFUSED, "doubled", "cropped"))
def test_markers_that_give_no_camera_are_refused_as_in_python(ask, why):
    there = read(ask, np.ascontiguousarray(REFUSED[why]()))
    assert (there["camera"], there["why"]) == (None, marker_sheet.REFUSALS[why])


@pytest.mark.audit
@pytest.mark.browser
def test_a_lens_that_bends_straight_lines_is_refused_as_in_python(ask):
    photo = draw_sheet(EYE, size=2)
    assert read(ask, bent(photo, 0))["why"] is None
    assert read(ask, bent(photo, 0.1))["why"] == marker_sheet.REFUSALS["cropped"]


@pytest.mark.browser
def test_a_marker_that_does_not_fit_the_others_is_left_out(ask):
    there = read(ask, displaced())["camera"]["position"]
    assert there == pytest.approx(EYE.position, abs=0.04)  # soft: it trades with the focal length


@pytest.mark.browser
@pytest.mark.parametrize("turn", [0, np.pi])
def test_a_sheet_laid_upside_down_is_seen_from_beyond(ask, turn):
    there = read(ask, draw_sheet(EYE, sheets=[(turn, *STRAIGHT[1:])]))
    assert ask("return eye.fromBeyond(asked)", there["camera"]) == (turn > 0)


@pytest.mark.audit
@pytest.mark.browser
def test_markers_are_found_in_bad_light_and_none_where_there_are_none(ask):
    for change in (0.25, 1.6):
        image = np.uint8(np.clip(SHOTS[20].image * change, 0, 255))
        assert len(read(ask, image)["ids"]) >= len(detected(image)[0]) >= 8
    for shot in (*photos.load("real", "test")[:8], *photos.everyday()[:4]):
        assert read(ask, shot.image) == {"ids": [], "camera": None, "why": None, "bare": None}


@pytest.mark.browser
def test_a_place_is_that_of_the_compact_localiser(ask):
    script = """const { box, camera } = asked;
      return eye.locate(brain.localiser, photo, box, camera);"""
    for shot in SHOTS[::8]:
        box = shot.boxes["shuttlecock"]
        camera = {name: np.asarray(value).tolist() for name, value in vars(shot.camera).items()}
        there = ask(script, {"box": box.tolist(), "camera": camera}, shot.image)
        here = CompactLocaliser.load().locate(shot.image, box, shot.camera)
        assert there == pytest.approx(here, abs=1e-6)
    level = looking((0, 0, 0), (1, 0, 0), 480.0)
    camera = {name: np.asarray(value).tolist() for name, value in vars(level).items()}
    with pytest.raises(NoReach):
        CompactLocaliser.load().locate(shot.image, SKY, level)
    with pytest.raises(Error, match=r"RangeError: a ray .+ never meets the table"):
        ask(script, {"box": SKY, "camera": camera}, shot.image)


@pytest.mark.browser
@pytest.mark.parametrize("shot", sample(SHOTS[3::12], "sheet/test/015"), ids=lambda shot: shot.name)
def test_from_its_pixels_a_photo_leads_to_the_place_that_python_finds(ask, shot):
    script = """const { camera } = eye.finish(eye.readSheet(photo, asked, [600, 400]));
      const bare = eye.paintOver(photo, eye.sheetOutline(camera, asked));
      const { box } = await eye.see(brain, bare, { camera });
      return eye.locate(brain.localiser, bare, box, camera);"""
    camera, bare = marker_sheet.remove_sheet(shot.image)
    box = see(VisuomotorModel.load("real"), bare, camera).box
    here = CompactLocaliser.load().locate(bare, box, camera)
    assert np.linalg.norm(ask(script, SHEET, shot.image) - here) < 2.5e-3


def quantiles(boxes):
    """The median and the 90 % quantile of how far off places are, of so chosen boxes, m."""
    errors = []
    for shot in SHOTS:
        camera, bare = marker_sheet.remove_sheet(shot.image)
        errors.append(np.inf)
        if camera is not None:
            place = CompactLocaliser.load().locate(bare, boxes(shot, bare, camera), camera)
            errors[-1] = np.linalg.norm(place - shot.target)
    assert np.isinf(errors).sum() <= 1  # one photo shows too few markers
    return np.quantile(errors, [0.5, 0.9], method="higher")


def test_places_of_true_boxes_are_as_near_as_in_python():
    half, most = quantiles(lambda shot, bare, camera: shot.boxes["shuttlecock"])
    python = place_errors()[f"true box{FROM_SHEET}"] / 1000
    assert half == pytest.approx(np.quantile(python, 0.5, method="higher"), abs=1e-3)
    assert most == pytest.approx(np.quantile(python, 0.9, method="higher"), abs=2e-3)


@pytest.mark.audit
def test_places_in_the_page_are_as_near_as_it_says():
    model = VisuomotorModel.load("real")
    half, most = quantiles(lambda shot, bare, camera: see(model, bare, camera).box)
    told_half, told_most = place_accuracy()
    assert half == pytest.approx(told_half, abs=1e-3)
    assert most == pytest.approx(told_most, abs=2e-3)


def test_the_compact_localiser_is_near_the_whole_one():
    shift = shift_mm(SHOTS)
    assert np.median(shift) < 2.5
    assert shift.max() < 6
