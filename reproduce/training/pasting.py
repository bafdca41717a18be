"""Cut-and-paste augmentation: rendered shuttlecocks composited on photographs, with boxes.

A renderer's shuttlecock on a renderer's table teaches renders. On a photograph, what is around it
is real, and nothing but the shuttlecock tells it apart from there.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from reproduce.render.cutout_atlas import WIDTH
from vmc_lib import photos

MIN_ALPHA = 0.4  # of light that a cut-out keeps off what is behind: from there it has an edge


@dataclass(frozen=True, eq=False)
class PastedPhoto:
    """A photograph on which things were laid, as a `Photo`; `decoys` (n, 4) are no shuttlecocks."""

    image: np.ndarray
    boxes: dict
    more: np.ndarray
    decoys: np.ndarray
    name, camera = "pasted", None


def composite(image, cutout, corner, rng):
    """Composite a cut-out (h, w, 4), lit anyhow, with a shadow, into an image in place."""
    (height, width), (top, left) = cutout.shape[:2], corner
    colour, alpha = jitter_colour(cutout[..., :3], rng), cutout[..., 3:]
    image *= 1 - shadow(alpha[..., 0], corner, rng)[..., None]
    there = image[top : top + height, left : left + width]
    there += alpha * (colour - there)


def transform_cutout(cutout, rng, large):
    """A cut-out as floats (h, w, 4), turned by any angle, sharp or soft, without its margin.

    With the margin it is as wide as a share of the photo's height between two, `large`.
    """
    width = photos.HEIGHT * np.exp(rng.uniform(*np.log(large)))
    scale, size = width / WIDTH, int(1.5 * width)
    matrix = cv2.getRotationMatrix2D((WIDTH / 2, WIDTH / 2), rng.uniform(0, 360), scale)
    matrix[:, 2] += (size - WIDTH) / 2
    x = cutout.astype(np.float32) / 255
    x[..., :3] *= x[..., 3:]  # or what is transparent would bleed into the edge
    if scale < 1:  # or it would fall into dots
        x = cv2.GaussianBlur(x, (0, 0), 0.4 / scale)
    x = cv2.warpAffine(x, matrix, (size, size))
    x = cv2.GaussianBlur(x, (0, 0), 0.3 + 1.5 * max(scale, 0.5) * rng.random() ** 2)
    x[..., :3] /= np.maximum(x[..., 3:], 1e-3)
    rows, columns = (np.flatnonzero(x[..., 3].max(axis) > MIN_ALPHA) for axis in (1, 0))
    part = x[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    return part[: photos.HEIGHT - 1, : photos.WIDTH - 1]


def jitter_colour(colour, rng):
    """Colour jitter of a picture (h, w, 3): brighter or darker, warmer or colder, uneven."""
    gain = np.exp(rng.normal(0, 0.25) + rng.normal(0, 0.06, 3))
    slope = 1 + rng.uniform(-0.4, 0.4) * np.linspace(-1, 1, len(colour))
    return np.float32(colour * gain * slope[:, None, None])


def shadow(mask, corner, rng):
    """How much light (400, 600) a thing takes from the photo, whose mask (h, w) is at a corner."""
    dark = np.zeros((photos.HEIGHT, photos.WIDTH), np.float32)
    there = dark[corner[0] : corner[0] + len(mask), corner[1] : corner[1] + len(mask[0])]
    there[:] = rng.uniform(0, 0.7) * mask
    away = np.float32([[1, 0, 0], [0, 1, 0]])
    away[:, 2] = rng.normal(0, 0.08, 2) * len(mask)
    moved = cv2.warpAffine(dark, away, dark.shape[::-1])
    return cv2.GaussianBlur(moved, (0, 0), rng.uniform(0.02, 0.12) * len(mask) + 1)
