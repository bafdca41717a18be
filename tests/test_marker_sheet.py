"""The printed sheet: cameras from its markers, in drawn pictures and in rendered photos."""

import cv2
import numpy as np
import pypdfium2
import pytest

from reproduce import results
from reproduce.experiments import printed_sheet
from reproduce.render import scene
from tests.project import sample
from tools.sheet import FILES
from vmc_lib import marker_sheet, photos
from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import HEIGHT, WIDTH

SHOTS = photos.load(photos.SHEET_LEVEL, "test")


STRAIGHT = (0, 0, 0, 1)  # how a sheet lies: turned (rad), to the right and down (mm), as large


def draw_sheet(eye, scale=4, size=1, sheets=(STRAIGHT,), ground=120, paper="A4"):
    """Sheets on a grey table, or a photo, as a camera sees them: where each pixel's ray meets them.

    `size` is how many times as wide and high the photo is as the eye's.
    """
    shape = scale * HEIGHT, scale * WIDTH
    rays = eye.rays((np.indices(shape)[::-1].reshape(2, -1).T + 0.5) / scale)
    depth = (TABLE - eye.position[1]) / rays[:, 1]
    table = (eye.position + depth[:, None] * rays - marker_sheet.CORNER) @ marker_sheet.AXES[:2].T
    big = np.full((HEIGHT, WIDTH, 3), ground, np.uint8)
    big = cv2.resize(big, shape[::-1], interpolation=cv2.INTER_NEAREST)
    for sheet in sheets:
        big = _lay(big, 1000 * table, depth > 0, paper, *sheet)
    return cv2.resize(big, (size * WIDTH, size * HEIGHT), interpolation=cv2.INTER_AREA)


def _lay(photo, table, ahead, paper, turn, right, down, large):
    """A photo with a sheet that lies on its table; `table` has the place of each pixel, in mm."""
    page, margin = np.array(marker_sheet.PAPERS[paper])
    print_ = marker_sheet.page_image(paper)
    print_ = cv2.resize(print_, None, fx=8, fy=8, interpolation=cv2.INTER_NEAREST)
    back = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    middle = marker_sheet.PAGE / 2
    place = (table - middle - [right, down]) @ back / large + middle - marker_sheet.MARGIN + margin
    on = (ahead & np.all((place > 0) & (place < page), axis=1)).reshape(photo.shape[:2])
    x, y = np.float32(8 * place.T.reshape(2, *on.shape) - 0.5)
    drawn = cv2.remap(print_, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.where(on[..., None], drawn[..., None], photo)


def looking(position, at, focal):
    """A level camera at a position (m) that looks at a place (m)."""
    forward = np.subtract(at, position) / np.linalg.norm(np.subtract(at, position))
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    rotation = np.array([right, np.cross(forward, right), forward])
    return Camera(focal, np.array([WIDTH, HEIGHT]) / 2, rotation, np.array(position))


@pytest.mark.parametrize("focal", sample([420.0, 600.0, 800.0], 600.0))
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


@pytest.mark.parametrize("name", sample(LOW, "over its edge"))
def test_a_sheet_that_reaches_behind_the_camera_is_painted_over(name):
    (ahead, high), (to, low) = LOW[name]
    eye = looking((ahead, TABLE + high, 0.2), (to, TABLE + low, 0.22), 480.0)
    shown = draw_sheet(eye)
    camera, bare = marker_sheet.remove_sheet(shown)
    assert camera.focal == pytest.approx(480, rel=0.03)
    assert camera.position == pytest.approx(eye.position, abs=0.005)
    assert marker_sheet.estimate_camera(bare) is None
    assert (np.abs(bare.astype(int) - 120) < 60).all()  # no black or white is left


EYE = scene.look(np.array([0.2, TABLE, 0.15]), 0.9, 0.9, 0.3, 600.0, 0.05)
OTHER = scene.look(np.array([0.2, TABLE, 0.15]), 0.9, 0.9, 0.0, 600.0, 0.05)
ABOVE = looking((0.19, TABLE + 0.8, 0.2), (0.19, TABLE, 0.201), 600.0)
REFUSED = {  # photos with markers of which no camera can be estimated
    "mirrored": lambda: draw_sheet(EYE)[:, ::-1],
    "doubled": lambda: draw_sheet(EYE, sheets=[STRAIGHT, (0.1, -230, 0, 1)]),
    "cropped": lambda: draw_sheet(EYE, size=2)[:, 240:],
    "uneven": lambda: np.hstack([draw_sheet(EYE)[:, :370], draw_sheet(OTHER)[:, 370:]]),
    "focal": lambda: draw_sheet(ABOVE),
}


def bent(photo, by):
    """A photo by a lens that bends straight lines: less far from the middle, by a share there."""
    height, width, _ = photo.shape
    from_middle = np.indices((height, width))[::-1].T - np.array([width, height]) / 2
    far = np.square(from_middle).sum(axis=-1, keepdims=True) / (width**2 + height**2) * 4
    x, y = np.float32(from_middle * (1 + by * far) + np.array([width, height]) / 2).T
    return cv2.remap(photo, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def displaced(marker=4, by=12):
    """A drawn sheet of which one marker stands elsewhere, so many pixels to the right."""
    photo, corners = draw_sheet(EYE), EYE.project(marker_sheet.marker_corners()[marker])
    x0, y0, x1, y1 = np.int32([*corners.min(0) - 4, *corners.max(0) + 4])
    photo[y0:y1, x0 + by : x1 + by] = photo[y0:y1, x0:x1].copy()
    return photo


def test_a_marker_that_does_not_fit_the_others_is_left_out():
    camera = marker_sheet.estimate_camera(displaced())
    there = np.array([[0.2, TABLE, -0.05]])
    assert camera.back_project(EYE.project(there)) == pytest.approx(there, abs=0.005)


@pytest.mark.parametrize("why", sample(REFUSED, "doubled", "focal"))
def test_markers_that_give_no_camera_are_refused_with_what_to_do(why):
    with pytest.raises(ValueError, match=marker_sheet.REFUSALS[why]):
        marker_sheet.remove_sheet(REFUSED[why]())


def test_a_lens_that_bends_straight_lines_is_refused_with_what_to_do():
    photo = draw_sheet(EYE, size=2)
    assert marker_sheet.estimate_camera(bent(photo, 0)) is not None
    for by in (0.1, 0.2):
        with pytest.raises(ValueError, match=marker_sheet.REFUSALS["cropped"]):
            marker_sheet.estimate_camera(bent(photo, by))


EVEN = {"all around": np.s_[80:-80, 120:-120], "above": np.s_[160:], "below": np.s_[:-160]}


@pytest.mark.parametrize("crop", EVEN.values(), ids=EVEN)
def test_a_crop_that_leaves_the_lens_in_the_middle_across_does_no_harm(crop):
    """The focal length and the tilt make up for it."""
    photo, there = draw_sheet(EYE, size=2), np.array([[0.2, TABLE, -0.05]])
    rows, columns = np.indices(photo.shape[:2])
    part = np.ascontiguousarray(photo[crop])
    camera = marker_sheet.estimate_camera(part)
    corner = columns[crop][0, 0], rows[crop][0, 0]
    size = np.array(part.shape[1::-1])
    scale = min(np.array([WIDTH, HEIGHT]) / size)
    pixel = scale * (2 * EYE.project(there) - corner - size / 2) + np.array([WIDTH, HEIGHT]) / 2
    assert camera.back_project(pixel) == pytest.approx(there, abs=0.003)


def test_a_wide_lens_gives_the_place():
    eye = scene.look(np.array([0.2, TABLE, 0.15]), 0.5, 0.9, 0.3, 260.0, 0.05)
    there = np.array([[0.2, TABLE, -0.05]])
    camera = marker_sheet.estimate_camera(draw_sheet(eye, size=2))
    assert camera.focal == pytest.approx(260, rel=0.03)
    assert camera.back_project(eye.project(there)) == pytest.approx(there, abs=0.003)


@pytest.mark.parametrize("shot", SHOTS[::4], ids=lambda shot: shot.name)
def test_no_whole_photo_counts_as_cropped(shot):
    assert marker_sheet.estimate_camera(shot.image) is not None


def test_camera_is_none_without_the_sheet():
    image = photos.load("rig", "train")[0].image
    eye, bare = marker_sheet.remove_sheet(image)
    assert eye is None
    assert (bare == image).all()


@pytest.mark.parametrize("distance", sample([0.9, 2.2], 0.9))
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
    near = looking((0.15, TABLE + 0.12, 0.225), (0.19, TABLE, 0.225), 390.0)  # the sheet alone
    assert marker_sheet.remove_sheet(draw_sheet(near))[1].std(axis=(0, 1)).max() == 0


def test_target_is_located_in_photos_of_unknown_cameras():
    """Half of the places within 8 mm, nine in ten within 15 mm, the box being known."""
    far = results.records("printed_sheet")[f"true box{printed_sheet.FROM_SHEET}"]
    assert len(far) == 40
    far = np.array([np.inf if mm is None else mm for mm in far])
    assert np.median(far) <= 8
    assert np.mean(far <= 15) >= 0.9


@pytest.mark.audit
def test_shipped_results_are_repeatable():
    stored = results.records("printed_sheet")
    again = printed_sheet.make(count=4)
    assert set(again) == set(stored)
    for way, far in again.items():
        assert far == pytest.approx(stored[way][:4], abs=0.2), way


@pytest.mark.parametrize("paper", marker_sheet.PAPERS)
def test_the_pdf_shows_the_sheet(paper):
    page, (_, down) = marker_sheet.PAPERS[paper]
    sheet = pypdfium2.PdfDocument(FILES[paper])[0]
    assert np.array(sheet.get_size()) * 25.4 / 72 == pytest.approx(page, abs=0.2)
    printed = sheet.render(scale=72 / 25.4, grayscale=True).to_numpy().squeeze()
    rows = np.s_[down - 4 : down + 232]  # the markers; words stand above and below
    drawn = marker_sheet.page_image(paper)
    assert np.abs(cv2.resize(printed, page)[rows] - np.float32(drawn[rows])).mean() < 6


def test_a_sheet_on_letter_paper_is_as_good():
    """It is painted over, too, though a little wider than one of A4."""
    camera, bare = marker_sheet.remove_sheet(draw_sheet(EYE, paper="Letter"))
    there = np.array([[0.2, TABLE, -0.05]])
    assert camera.back_project(EYE.project(there)) == pytest.approx(there, abs=0.003)
    assert bare.std(axis=(0, 1)).max() == 0


def test_rendered_sheet_has_one_texel_a_millimetre():
    table = scene.with_sheet(np.full((2048, 2048, 3), 0.3))
    changed = np.argwhere(table[..., 0] != 0.3)
    assert np.ptp(changed, axis=0).tolist() == (marker_sheet.PAGE - 1).tolist()
    view = scene.draw_with_sheet(np.random.default_rng((3, 2, 0)))
    assert view.camera.focal == pytest.approx(SHOTS[0].camera.focal)
    assert view.target == pytest.approx(SHOTS[0].target)
