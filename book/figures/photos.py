"""Figures of the page about the photos."""

import cv2
import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.camera import TABLE
from vmc_lib.show import photo_view
from vmc_lib.show.palette import COLOURS


def contact_sheet(shots, columns=8, size=(120, 80)):
    """Many photos on one, small: an image array (see `image_grid`)."""
    small = [cv2.resize(shot.image, size, interpolation=cv2.INTER_AREA) for shot in shots]
    return image_grid(small, columns)


def image_grid(images, columns, zoom=1):
    """Images of one size in rows; a last row that is not full is left out."""
    rows = range(0, len(images) - columns + 1, columns)
    grid = np.vstack([np.hstack(images[row : row + columns]) for row in rows])
    return grid.repeat(zoom, axis=0).repeat(zoom, axis=1)


def side_view(shot, found):
    """The ray from the eye through `found` (3,), from the side, and the true target: a figure.

    To the right: distance from the eye over the table, counted from the target; up: height (mm).
    """
    eye = shot.camera.position

    def seen(points):
        across = np.hypot(*(points - eye)[:, [0, 2]].T) - np.hypot(*(shot.target - eye)[[0, 2]])
        return 1000 * across, 1000 * (points[:, 1] - TABLE)

    fig, ax = plt.subplots(figsize=(4.4, 3.1))
    ax.axhline(0, color=COLOURS["grey"])
    ax.plot(*seen(eye + np.array([[0.8], [1.2]]) * (found - eye)), "--", color=COLOURS["blue"])
    ax.plot(*seen(found[None]), "o", color=COLOURS["blue"], label="believed")
    ax.plot(*seen(shot.target[None]), "*", ms=13, color=COLOURS["orange"], label="true")
    ax.set(xlim=(-40, 40), ylim=(-6, 70), xlabel="further from the eye (mm)", ylabel="height (mm)")
    ax.set_title(f"{1000 * np.linalg.norm(found - shot.target):.0f} mm apart")
    ax.legend(loc="upper right")
    return fig


def believed_place(shot, height):
    """Where the middle of the shuttlecock's box is (3,), m, at a height (mm) over the table."""
    box = shot.boxes["shuttlecock"]
    return shot.camera.back_project((box[:2] + box[2:]) / 2, TABLE + height / 1000)[0]


def height_views(shot, height):
    """The photo with its box, and from the side where a believed height (mm) puts it."""
    boxed = photo_view(shot.image, [(shot.boxes["shuttlecock"], "", "green")])
    return boxed, side_view(shot, believed_place(shot, height))


def longer_sides(shots):
    """The longer side of the shuttlecock's box in each photo, (n,), pixels."""
    boxes = np.array([shot.boxes["shuttlecock"] for shot in shots])
    return (boxes[:, 2:] - boxes[:, :2]).max(axis=1)


def cutout_sheet(cutouts):
    """Cut-outs (n, w, w, 4), 0 to 255, on grey, in rows of 12, half as large: an image, uint8."""
    grey = np.array([0.36, 0.38, 0.42])
    colour, opaque = np.split(cutouts / 255, [3], axis=-1)
    tiles = opaque * colour + (1 - opaque) * grey
    rows = tiles.reshape(-1, 12, *tiles.shape[1:]).swapaxes(1, 2)
    return np.uint8(255 * rows.reshape(-1, 12 * tiles.shape[2], 3))[::2, ::2]
