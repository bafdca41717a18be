"""The printed sheet: cameras from its markers, in drawn pictures and in rendered photos."""

import cv2
import numpy as np
import pypdfium2
import pytest

from render import scene
from reproduce import results
from reproduce.experiments import printed_sheet
from vmc_lib import marker_sheet, photos
from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import HEIGHT, WIDTH

SHOTS = photos.load(photos.SHEET_LEVEL, "test")


def draw_sheet(eye, scale=4, size=1):
    """The sheet on a grey table, as a camera sees it: where the ray of each pixel meets its page.

    `size` is how many times as wide and high the photo is as the eye's.
    """
    print_ = cv2.resize(
        marker_sheet.page_image(), None, fx=8, fy=8, interpolation=cv2.INTER_NEAREST
    )
    shape = scale * HEIGHT, scale * WIDTH
    rays = eye.rays((np.indices(shape)[::-1].reshape(2, -1).T + 0.5) / scale)
    depth = (TABLE - eye.position[1]) / rays[:, 1]
    page = (eye.position + depth[:, None] * rays - marker_sheet.CORNER) @ marker_sheet.AXES[:2].T
    page[depth < 0] = -1  # above the horizon
    right, down = np.float32(8000 * page.T.reshape(2, *shape) - 0.5)
    big = cv2.remap(print_, right, down, cv2.INTER_LINEAR, borderValue=120)
    shape = size * WIDTH, size * HEIGHT
    return np.dstack([cv2.resize(big, shape, interpolation=cv2.INTER_AREA)] * 3)


def looking(position, at, focal):
    """A level camera at a position (m) that looks at a place (m)."""
    forward = np.subtract(at, position) / np.linalg.norm(np.subtract(at, position))
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    rotation = np.array([right, np.cross(forward, right), forward])
    return Camera(focal, np.array([WIDTH, HEIGHT]) / 2, rotation, np.array(position))


@pytest.mark.parametrize("focal", [420.0, 600.0, 800.0])
def test_camera_is_estimated(focal):
    eye = scene.look(np.array([0.2, TABLE, 0.15]), 0.8 * focal / 800, 0.9, 0.3, focal, 0.05)
    camera = marker_sheet.estimate_camera(draw_sheet(eye))
    assert camera.focal == pytest.approx(focal, rel=0.03)
    assert np.abs(camera.position - eye.position).max() < 0.02
    assert np.abs(camera.rotation - eye.rotation).max() < 0.02
    there = np.array([[0.2, TABLE, -0.05]])
    assert camera.back_project(eye.project(there)) == pytest.approx(there, abs=0.003)


LOW = {  # a camera, and what it looks at: how far ahead and above the table (m)
    "forward": ((0.15, 0.12), (0.30, 0.0)),
    "over its edge": ((0.06, 0.10), (0.25, 0.0)),
    "steeply": ((0.12, 0.05), (0.20, 0.0)),
}


@pytest.mark.parametrize("places", LOW.values(), ids=LOW)
def test_a_sheet_that_reaches_behind_the_camera_is_painted_over(places):
    (ahead, high), (to, low) = places
    eye = looking((ahead, TABLE + high, 0.2), (to, TABLE + low, 0.22), 480.0)
    shown = draw_sheet(eye)
    camera, bare = marker_sheet.remove_sheet(shown)
    assert camera.focal == pytest.approx(480, rel=0.03)
    assert camera.position == pytest.approx(eye.position, abs=0.005)
    assert marker_sheet.estimate_camera(bare) is None
    assert (np.abs(bare.astype(int) - 120) < 60).all()  # no black or white is left


def test_camera_is_none_without_the_sheet():
    image = photos.load("rig", "train")[0].image
    eye, bare = marker_sheet.remove_sheet(image)
    assert eye is None
    assert (bare == image).all()


@pytest.mark.parametrize("distance", [0.9, 2.2])
def test_markers_are_detected_in_the_whole_photo(distance):
    """In a photo twice as wide and high, a place is less than half as far off."""
    eye = scene.look(np.array([0.2, TABLE, 0.15]), distance, 0.9, 0.3, 600.0, 0.05)
    there, off = np.array([[0.2, TABLE, -0.05]]), []
    for size in (1, 2):
        camera, bare = marker_sheet.remove_sheet(draw_sheet(eye, size=size))
        assert bare.shape == (HEIGHT, WIDTH, 3)
        assert marker_sheet.estimate_camera(bare) is None
        off.append(np.linalg.norm(camera.back_project(eye.project(there)) - there))
    assert off[1] < off[0] / 2


def test_the_sheet_is_painted_over_and_nothing_else():
    shot = SHOTS[20]
    _, bare = marker_sheet.remove_sheet(shot.image)
    assert marker_sheet.estimate_camera(bare) is None
    x0, y0, x1, y1 = np.int32(shot.boxes["shuttlecock"])
    assert (bare[y0:y1, x0:x1] == shot.image[y0:y1, x0:x1]).all()
    full = np.full((400, 600, 3), 255, np.uint8)
    page = marker_sheet.page_image()[20:280, 10:200]
    full[:] = cv2.resize(page, (600, 400))[..., None]
    assert (
        marker_sheet.remove_sheet(full)[1].std(axis=(0, 1)).max() == 0
    )  # nothing but the sheet in view


def test_target_is_located_in_photos_of_unknown_cameras():
    """Half of the places within 8 mm, nine in ten within 15 mm, the box being known."""
    far = results.records("printed_sheet")[f"true box{printed_sheet.FROM_SHEET}"]
    assert len(far) == 40
    far = np.array([np.inf if mm is None else mm for mm in far])
    assert np.median(far) <= 8
    assert np.mean(far <= 15) >= 0.9


def test_shipped_results_are_repeatable():
    stored = results.records("printed_sheet")
    again = printed_sheet.make(count=4)
    assert set(again) == set(stored)
    for way, far in again.items():
        assert far == pytest.approx(stored[way][:4], abs=0.2), way


def test_the_pdf_shows_the_sheet():
    file = photos.FOLDER.parents[2] / "book/_static/sheet.pdf"
    paper = pypdfium2.PdfDocument(file)[0]
    assert np.array(paper.get_size()) * 25.4 / 72 == pytest.approx(marker_sheet.PAGE, abs=0.2)
    printed = paper.render(scale=72 / 25.4, grayscale=True).to_numpy().squeeze()
    rows = np.s_[30:265]  # the markers; words stand above and below
    assert (
        np.abs(
            cv2.resize(printed, marker_sheet.PAGE.tolist())[rows] - marker_sheet.page_image()[rows]
        ).mean()
        < 6
    )


def test_rendered_sheet_has_one_texel_a_millimetre():
    table = scene.with_sheet(np.full((2048, 2048, 3), 0.3))
    changed = np.argwhere(table[..., 0] != 0.3)
    assert np.ptp(changed, axis=0).tolist() == (marker_sheet.PAGE - 1).tolist()
    view = scene.draw_with_sheet(np.random.default_rng((3, 2, 0)))
    assert view.camera.focal == pytest.approx(SHOTS[0].camera.focal)
    assert view.target == pytest.approx(SHOTS[0].target)
