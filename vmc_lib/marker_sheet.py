"""Camera calibration from a printed sheet of ArUco markers on the table.

The focal length and pose of a hand-held camera follow from where the markers appear (OpenCV's
calibration, with the focal length as the one unknown intrinsic). The sheet lies to the right of
the shuttlecock, and defines the shoulder frame.
"""

from functools import cache
from typing import Any

import numpy as np

from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import HEIGHT, WIDTH, as_rgb, read_image
from vmc_lib.short_repr import short

PAPERS = {  # mm: the page, and from its upper left corner to the first marker; right and down
    "A4": ((210, 297), (21, 34)),
    "Letter": ((216, 279), (24, 24)),
}
PAGE, MARGIN = np.array(PAPERS["A4"])
MARKER, GAP, GRID = 48, 12, (3, 4)  # mm, mm, columns and rows of markers
CORNER = np.array([0.337, TABLE, 0.12])  # the page's upper left corner, in the shoulder frame (m)
AXES = np.array([[0, 0, 1.0], [-1, 0, 0], [0, -1, 0]])  # right, down the page, into the table
FIRST = CORNER + MARGIN / 1000 @ AXES[:2]  # of the first marker
FEWEST = 3  # markers that must be detected
RESIDUAL = 1.5  # pixels of 600 × 400 (RMS) by which a camera may miss the markers' corners
FOCALS = (120, 4200)  # the shortest and the longest focal length of lenses, in such pixels
FOCAL_SPREAD = 0.2  # standard error of a focal length, over it, above which it is unknown
ASIDE = 24  # such pixels by which a lens may look past the photo's middle,
GAIN = 0.85  # and the share of a residual below which another middle explains the markers better
REFUSALS = {  # why markers give no camera, and what to do
    "mirrored": "the photo is mirrored: take it with the camera on the back",
    "doubled": "two sheets are seen: cover one",
    "cropped": "the photo is cropped, or its lens bends straight lines: "
    "take a whole one, without the widest lens",
    "uneven": "the markers do not lie as on one flat sheet: smooth it, and cover other markers",
    "focal": "the focal length does not show: take the photo more at a slant",
}
NEAR = 0.02  # m before the camera: what is nearer is not painted over


@cache
def board() -> Any:
    """The markers as OpenCV has them."""
    import cv2

    kind = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    return cv2.aruco.GridBoard(GRID, MARKER / 1000, GAP / 1000, kind)


def marker_corners() -> np.ndarray:
    """The markers' corners in the shoulder frame: (markers, 4, 3), m."""
    return FIRST + np.array(board().getObjPoints()) @ AXES


def page_corners() -> np.ndarray:
    """The page's corners in the shoulder frame, clockwise from the upper left one: (4, 3), m."""
    return CORNER + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * PAGE / 1000 @ AXES[:2]


def page_image(paper: str = "A4") -> np.ndarray:
    """The sheet on one of PAPERS, one pixel a millimetre: (height, width) uint8, black on white.

    The markers are as large on each, so that cameras from all are the same.
    """
    if not isinstance(paper, str) or paper not in PAPERS:
        raise ValueError(f"no paper is called {short(paper)}: choose from {', '.join(PAPERS)}")
    page, (right, down) = PAPERS[paper]
    picture = np.full(page[::-1], 255, np.uint8)
    wide, high = (np.array(GRID) * (MARKER + GAP) - GAP).tolist()
    picture[down : down + high, right : right + wide] = board().generateImage((wide, high))
    return picture


def remove_sheet(photo: np.ndarray) -> tuple[Camera | None, np.ndarray]:
    """The `Camera` of a photo (height, width, 3), or None, and the photo without the sheet.

    The sheet is painted over in the colour around it, so that no marker passes for an object.
    Raises ValueError where `estimate_camera` does.
    """
    import cv2

    camera, image = estimate_camera(photo), read_image(photo)
    if camera is None:
        return None, image
    outline = np.int32(np.round(camera.project(_clip(page_corners(), camera))))
    covered = cv2.fillConvexPoly(np.zeros(image.shape[:2], np.uint8), outline, 1)
    covered = cv2.dilate(covered, np.ones((9, 9)))
    around = image[cv2.dilate(covered, np.ones((15, 15))) > covered]
    bare = image.copy()
    bare[covered > 0] = np.median(around if len(around) else image.reshape(-1, 3), axis=0)
    return camera, bare


def _clip(polygon, camera):
    """The part (m, 3) of a polygon (n, 3) before a camera's near plane (Sutherland-Hodgman)."""
    depth = (polygon - camera.position) @ camera.rotation[2] - NEAR
    part = []
    for k, point in enumerate(polygon):
        if depth[k - 1] * depth[k] < 0:
            share = depth[k] / (depth[k] - depth[k - 1])
            part.append(point + share * (polygon[k - 1] - point))
        if depth[k] >= 0:
            part.append(point)
    return np.array(part)


def estimate_camera(photo: np.ndarray) -> Camera | None:
    """Estimate the `Camera` of a photo, as `photos.as_rgb` takes it, that shows the sheet.

    Markers are detected in the whole photo; the camera's pixels are those of `read_image`, 600 ×
    400. None where fewer than FEWEST markers are detected. Raises ValueError, with what to do,
    where they give no camera that can be (REFUSALS).
    """
    photo = as_rgb(photo)
    ids, corners = detect_markers(photo)
    if len(ids) < FEWEST:
        if len(detect_markers(np.ascontiguousarray(photo[:, ::-1]))[0]) >= FEWEST:
            raise ValueError(REFUSALS["mirrored"])
        return None
    if len(np.unique(ids)) < len(ids):
        raise ValueError(REFUSALS["doubled"])
    camera, residual, spread = _best_fit(ids, corners, photo.shape[:2])
    other, left, _ = calibrate_camera(ids, corners, photo.shape[:2], any_middle=True)
    aside = np.linalg.norm(other.centre - camera.centre)
    if aside > ASIDE and left < min(RESIDUAL, GAIN * residual):
        raise ValueError(REFUSALS["cropped"])
    if not (residual <= RESIDUAL and camera.position[1] > TABLE):
        raise ValueError(REFUSALS["uneven"])
    if not (FOCALS[0] <= camera.focal <= FOCALS[1] and spread <= FOCAL_SPREAD):
        raise ValueError(REFUSALS["focal"])
    return camera


def detect_markers(photo: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Detect the sheet's markers in a photo (height, width, 3): ids (n,), corners (n, 4, 2)."""
    import cv2

    if not (isinstance(photo, np.ndarray) and photo.dtype == np.uint8 and photo.ndim == 3):
        raise ValueError(f"{short(photo)} is no uint8 photo: give photos.as_rgb(…)")
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    corners, ids, _ = cv2.aruco.ArucoDetector(board().getDictionary(), parameters).detectMarkers(
        photo
    )
    if ids is None:
        return np.empty(0, int), np.empty((0, 4, 2), np.float32)
    known = np.isin(ids := ids.ravel(), board().getIds())
    return ids[known], np.concatenate(corners)[known]


def _best_fit(ids, corners, shape):
    """Calibrate from all markers; if these disagree, from all but one: it may be half covered."""
    fit = calibrate_camera(ids, corners, shape)
    if fit[1] <= RESIDUAL or len(ids) == FEWEST:
        return fit
    left = [np.arange(len(ids)) != k for k in range(len(ids))]
    return min((calibrate_camera(ids[k], corners[k], shape) for k in left), key=lambda fit: fit[1])


def calibrate_camera(
    ids: np.ndarray, corners: np.ndarray, shape: tuple[int, ...], any_middle: bool = False
) -> tuple[Camera, float, float]:
    """Calibrate the camera to which markers `ids` (n,) appear at corners (n, 4, 2) of a photo.

    `shape` is the photo's height and width. The unknowns are the camera's pose and focal length:
    the lens has no distortion, and the principal point is the photo's middle; with `any_middle`
    it is unknown, too, as in a photo that was cropped. Returns the `Camera`
    and its reprojection error (RMS), both in pixels of 600 × 400, and the standard error of its
    focal length, over it. ValueError for too few markers, and for other shapes.
    """
    import cv2

    if len(ids) < FEWEST or np.shape(corners) != (len(ids), 4, 2):
        raise ValueError(
            f"{len(ids)} markers at corners {np.shape(corners)}: give (n,) and (n, 4, 2), with "
            f"{FEWEST} markers or more"
        )
    points, pixels = board().matchImagePoints([*corners], ids)
    height, width = shape
    guess = np.array([[width, 0, width / 2], [0, width, height / 2], [0, 0, 1.0]])
    known = cv2.CALIB_USE_INTRINSIC_GUESS | cv2.CALIB_FIX_ASPECT_RATIO
    known |= cv2.CALIB_ZERO_TANGENT_DIST
    known |= cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3
    if not any_middle:
        known |= cv2.CALIB_FIX_PRINCIPAL_POINT
    size = (width, height)  # OpenCV counts from the middle of a pixel
    residual, intrinsics, _, [turn], [shift], errors, *_ = cv2.calibrateCameraExtended(
        [points], [pixels + np.float32(0.5)], size, guess, None, flags=known
    )
    rotation, focal = cv2.Rodrigues(turn)[0] @ AXES, intrinsics[0, 0]
    scale = min(WIDTH / width, HEIGHT / height)
    aside = intrinsics[:2, 2] - np.array([width, height]) / 2
    middle = np.array([WIDTH, HEIGHT]) / 2 + scale * aside
    camera = Camera(scale * focal, middle, rotation, FIRST - shift[:, 0] @ rotation)
    return camera, scale * residual, errors[:2].max() / focal
