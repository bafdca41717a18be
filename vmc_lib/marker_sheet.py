"""Camera calibration from a printed sheet of ArUco markers on the table.

The focal length and pose of a hand-held camera follow from where the markers appear (OpenCV's
calibration, with the focal length as the one unknown intrinsic). The sheet lies to the right of
the shuttlecock, and defines the shoulder frame.
"""

from functools import cache

import numpy as np

from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import HEIGHT, WIDTH, as_rgb, read_image

PAGE = np.array([210, 297])  # mm, to the right and down: A4
MARKER, GAP, GRID = 48, 12, (3, 4)  # mm, mm, columns and rows of markers
MARGIN = np.array([21, 34])  # mm, from the page's upper left corner to the first marker
CORNER = np.array([0.337, TABLE, 0.12])  # the page's upper left corner, in the shoulder frame (m)
AXES = np.array([[0, 0, 1.0], [-1, 0, 0], [0, -1, 0]])  # right, down the page, into the table
FIRST = CORNER + MARGIN / 1000 @ AXES[:2]  # of the first marker
FEWEST = 3  # markers that must be detected
NEAR = 0.02  # m before the camera: what is nearer is not painted over


@cache
def board():
    """The markers as OpenCV has them."""
    import cv2

    kind = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    return cv2.aruco.GridBoard(GRID, MARKER / 1000, GAP / 1000, kind)


def marker_corners():
    """The markers' corners in the shoulder frame: (markers, 4, 3), m."""
    return FIRST + np.array(board().getObjPoints()) @ AXES


def page_corners():
    """The page's corners in the shoulder frame, clockwise from the upper left one: (4, 3), m."""
    return CORNER + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * PAGE / 1000 @ AXES[:2]


def page_image():
    """The sheet as an image, one pixel a millimetre: (297, 210) uint8, black on white."""
    picture = np.full(PAGE[::-1], 255, np.uint8)
    right, down = MARGIN
    wide, high = (np.array(GRID) * (MARKER + GAP) - GAP).tolist()
    picture[down : down + high, right : right + wide] = board().generateImage((wide, high))
    return picture


def remove_sheet(photo):
    """The `Camera` of a photo (height, width, 3), or None, and the photo without the sheet.

    The sheet is painted over in the colour around it, so that no marker passes for an object.
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


def estimate_camera(photo):
    """Estimate the `Camera` of a photo, as `photos.as_rgb` takes it, that shows the sheet.

    Markers are detected in the whole photo; the camera's pixels are those of `read_image`, 600 ×
    400. The unknowns are its pose and focal length: the principal point is the photo's middle, and
    the lens has no distortion. None where fewer than FEWEST markers are detected.
    """
    import cv2

    photo = as_rgb(photo)
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    corners, ids, _ = cv2.aruco.ArucoDetector(board().getDictionary(), parameters).detectMarkers(
        photo
    )
    known = [] if ids is None else np.flatnonzero(np.isin(ids, board().getIds()))
    if len(known) < FEWEST:
        return None
    points, pixels = board().matchImagePoints([corners[k] for k in known], ids[known])
    height, width = photo.shape[:2]
    guess = np.array([[width, 0, width / 2], [0, width, height / 2], [0, 0, 1.0]])
    only_focal = cv2.CALIB_USE_INTRINSIC_GUESS | cv2.CALIB_FIX_PRINCIPAL_POINT
    only_focal |= cv2.CALIB_FIX_ASPECT_RATIO | cv2.CALIB_ZERO_TANGENT_DIST
    only_focal |= cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3
    size = (width, height)  # OpenCV counts from the middle of a pixel
    _, intrinsics, _, [rotation], [shift] = cv2.calibrateCamera(
        [points], [pixels + np.float32(0.5)], size, guess, None, flags=only_focal
    )
    rotation = cv2.Rodrigues(rotation)[0]
    focal = intrinsics[0, 0] * min(WIDTH / width, HEIGHT / height)
    middle = np.array([WIDTH, HEIGHT]) / 2
    return Camera(focal, middle, rotation @ AXES, FIRST - shift[:, 0] @ rotation @ AXES)
