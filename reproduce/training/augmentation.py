"""Data augmentation of crops: flips, colour, exposure, blur, noise, JPEG, occlusion.

A network that has met one kind of picture learns that kind. So each time a box is learnt from, it
looks different: turned, mirrored, in another light, behind another filter, blurred, noisy,
compressed, partly hidden.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from vmc_lib.boxes import decode_deltas, encode_deltas, iou, jitter_boxes, pad_boxes
from vmc_lib.what.stream import MARGIN, WIDTH

STRAYS = 0.05, 0.12, 0.2  # in sides: how far a box lies from the shuttlecock's, by turns
TINT = 0.2  # of a colour's strength, as a logarithm


@dataclass(frozen=True)
class Augmentation:
    """Strengths of the augmentation; at 0 a crop stays as it is."""

    stray: float = 0.08  # of the edges of other boxes than a shuttlecock's, in sides
    quarters: bool = True  # any quarter turn, mirrored or not
    colour: float = 1.0  # of the light, in TINT
    light: float = 0.4  # of the exposure's exponent, as a logarithm, and of a shade across
    blur: float = 1.2  # pixels of the crop
    noise: float = 0.04
    compress: float = 0.3  # share of crops that are saved as a poor JPEG
    hide: float = 0.2  # share of crops of which something hides a part


ALL = Augmentation()


def augment(image, box, holds, rng, augmentation=ALL):
    """An augmented crop of a box (4,) of an image, or of a box near it.

    holds: whether it holds a shuttlecock, from which the box then strays. Returns the picture
    (WIDTH, WIDTH, 3) in 0..1; how well the box fits, an IoU, or 0; and the corrections (4,) that
    would mend it.
    """
    box, fit, lack = box[None], 0.0, np.zeros(4)
    near = jitter_boxes(box, augmentation.stray, rng)
    if holds:
        near = decode_deltas(box, rng.normal(0, rng.choice(STRAYS), (1, 4)))
        fit, lack = iou(near, box)[0, 0], encode_deltas(near, box)[0]
    x = crop_in_colour(image, pad_boxes(near, MARGIN), 2 * WIDTH)
    x, lack = quarter_turn(x, lack, rng) if augmentation.quarters else (x, lack)
    x = x * np.exp(rng.normal(0, TINT * augmentation.colour, 3)).astype(np.float32)
    return simulate_camera(np.ascontiguousarray(x), rng, augmentation), fit, lack


def simulate_camera(x, rng, augmentation=ALL):
    """A picture (n, n, 3) relit, occluded, blurred, noisy and compressed, WIDTH pixels wide."""
    x = relight(x, augmentation, rng)
    if rng.random() < augmentation.hide:
        x = occlude(x, rng)
    x = cv2.resize(x, (WIDTH, WIDTH), interpolation=cv2.INTER_AREA)
    sigma = augmentation.blur * rng.random() ** 2
    if sigma > 0.2:
        x = cv2.GaussianBlur(x, (0, 0), sigma)
    x = x + augmentation.noise * rng.random() ** 2 * rng.standard_normal(x.shape)
    if rng.random() < augmentation.compress:
        x = compress_jpeg(x, int(rng.integers(20, 80)))
    return np.float32(x.clip(0, 1))


def crop_in_colour(image, box, width):
    """Crop of a box in colour, (width, width, 3) in 0..1; beyond the image, edges repeat."""
    (x0, y0), (x1, y1) = np.round(np.reshape(box, (2, 2))).astype(int)
    columns = np.arange(x0, max(x1, x0 + 4)).clip(0, image.shape[1] - 1)
    rows = np.arange(y0, max(y1, y0 + 4)).clip(0, image.shape[0] - 1)
    part = image[rows][:, columns]
    how = cv2.INTER_AREA if min(part.shape[:2]) > width else cv2.INTER_LINEAR
    return cv2.resize(part, (width, width), interpolation=how).astype(np.float32) / 255


def quarter_turn(x, lack, rng):
    """A random quarter turn and flip of a picture, and of its box deltas (4,)."""
    for _ in range(rng.integers(4)):
        x, lack = np.rot90(x), lack[[1, 0, 3, 2]] * [1, -1, 1, 1]
    return (x[:, ::-1], lack * [-1, 1, 1, 1]) if rng.random() < 0.5 else (x, lack)


def relight(x, augmentation, rng):
    """A picture under a random gradient of light and another exposure (gamma)."""
    ramp = np.linspace(-0.5, 0.5, len(x), dtype=np.float32)
    right, down = augmentation.light * rng.uniform(-1, 1, 2)
    shade = np.exp(right * ramp + down * ramp[:, None])
    x = x * shade[..., None]
    return (x / max(x.max(), 1e-3)) ** np.exp(augmentation.light * rng.standard_normal())


def occlude(x, rng):
    """Random occlusion: up to a third of a picture behind a band of stripes, mostly at a side."""
    n, x = len(x), x.copy()
    depth = int(n * rng.uniform(0.05, 0.35))
    start = 0 if rng.random() < 0.7 else int(rng.uniform(0, n - depth))
    stripes = rng.random(3) + 0.1 * rng.standard_normal((depth, 1, 3))
    np.rot90(x, rng.integers(4))[start : start + depth] = stripes
    return x


def compress_jpeg(x, quality):
    """JPEG compression of a picture (n, n, 3) in 0..1 at a quality."""
    _, code = cv2.imencode(
        ".jpg", np.uint8(255 * x.clip(0, 1)), [cv2.IMWRITE_JPEG_QUALITY, quality]
    )
    return cv2.imdecode(code, cv2.IMREAD_COLOR) / np.float32(255)
