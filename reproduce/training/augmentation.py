"""Data augmentation of crops: flips, colour, exposure, blur, noise, JPEG, occlusion.

A network that has met one kind of picture learns that kind. So each time a box is learnt from, it
looks different: turned, mirrored, in another light, behind another filter, blurred, noisy,
compressed, partly hidden.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from vmc_lib.boxes import decode_deltas, encode_deltas, iou, jitter_boxes, pad_boxes
from vmc_lib.photos import crops
from vmc_lib.what.stream import MARGIN, WIDTH

STRAYS = 0.05, 0.12, 0.2  # in sides: how far a box lies from the shuttlecock's, by turns
TINT = 0.2  # of a colour's strength, as a logarithm
GAPS = 0.1, 0.4  # between strings, in sides of a crop


@dataclass(frozen=True)
class Augmentation:
    """Strengths of the augmentation; at 0 a crop keeps all but its brightness.

    For `relight` brings the brightest of any crop to 1. And whatever these are, a shuttlecock's box
    strays by STRAYS: how to correct it is learnt from there.
    """

    stray: float = 0.08  # of the edges of other boxes than a shuttlecock's, in sides
    quarters: bool = True  # any quarter turn, mirrored or not
    colour: float = 1.0  # of the light, in TINT
    light: float = 0.4  # of the exposure's exponent, as a logarithm, and of a shade across
    blur: float = 1.2  # pixels of the crop
    noise: float = 0.04
    compress: float = 0.3  # share of crops that are saved as a poor JPEG
    hide: float = 0.2  # share of crops of which something hides a part
    strings: float = 0.15  # share of crops that lie under a grid of strings


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
    [x] = crops(image, pad_boxes(near, MARGIN), WIDTH)
    x, lack = quarter_turn(x, lack, rng) if augmentation.quarters else (x, lack)
    x = x * np.exp(rng.normal(0, TINT * augmentation.colour, 3)).astype(np.float32)
    return simulate_camera(np.ascontiguousarray(x), rng, augmentation), fit, lack


def simulate_camera(x, rng, augmentation=ALL):
    """A picture (n, n, 3) under strings, relit, occluded, blurred, noisy and compressed."""
    if rng.random() < augmentation.strings:
        x = draw_grid(x, rng)
    x = relight(x, augmentation, rng)
    if rng.random() < augmentation.hide:
        x = occlude(x, rng)
    sigma = augmentation.blur * rng.random() ** 2
    if sigma > 0.2:
        x = cv2.GaussianBlur(x, (0, 0), sigma)
    x = x + augmentation.noise * rng.random() ** 2 * rng.standard_normal(x.shape)
    if rng.random() < augmentation.compress:
        x = compress_jpeg(x, int(rng.integers(20, 80)))
    return np.float32(x.clip(0, 1))


def quarter_turn(x, lack, rng):
    """A random quarter turn and flip of a picture, and of its box deltas (4,)."""
    for _ in range(rng.integers(4)):
        x, lack = np.rot90(x), lack[[1, 0, 3, 2]] * [1, -1, 1, 1]
    return (x[:, ::-1], lack * [-1, 1, 1, 1]) if rng.random() < 0.5 else (x, lack)


def relight(x, augmentation, rng):
    """A picture under a random gradient of light and another exposure (gamma), its maximum 1."""
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


def draw_grid(x, rng):
    """A picture (n, n, 3) under a grid of lines, as of a racket's strings, seen at a slant."""
    n, angle = len(x), rng.uniform(0, np.pi)
    gap, thick = n * np.exp(rng.uniform(*np.log(GAPS))), rng.uniform(0.3, 1.6)
    down, right = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j]
    hidden = np.zeros((n, n))
    for turn in angle, angle + np.pi / 2 + rng.normal(0, 0.1):
        across = right * np.cos(turn) + down * np.sin(turn)
        across = n / 2 * across * (1 + rng.uniform(-0.3, 0.3) * (right + down)) / gap
        off = gap * np.abs((across + rng.random()) % 1 - 0.5)
        hidden = np.maximum(hidden, (thick / 2 + 0.5 - off).clip(0, min(1, thick)))
    colour = rng.choice([0.95, 0.8, 0.1]) * rng.uniform(0.7, 1.05, 3)
    return np.float32(x + hidden[..., None] * (colour - x))


def compress_jpeg(x, quality):
    """JPEG compression of a picture (n, n, 3) in 0..1 at a quality."""
    _, code = cv2.imencode(
        ".jpg", np.uint8(255 * x.clip(0, 1)), [cv2.IMWRITE_JPEG_QUALITY, quality]
    )
    return cv2.imdecode(code, cv2.IMREAD_COLOR) / np.float32(255)
