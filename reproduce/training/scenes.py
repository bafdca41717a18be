"""Scenes that fool an eye: rendered shuttlecocks and decoys composited on grounds, by kind.

Real photographs show one kind of shuttlecock, mostly alone. These show white feathers, pairs, a
racket's strings, white grounds and courts, and things that resemble a shuttlecock.
"""

import cv2
import numpy as np

from reproduce.render.cutout_atlas import UNTRAINED_COUNT, load
from reproduce.training.pasting import PastedPhoto, composite, jitter_colour, transform_cutout
from vmc_lib import photos
from vmc_lib.boxes import iou

SCENES = {  # of a photo: shuttlecocks, decoys at most, and where a racket's strings are
    "alone": (1, 0, ""),
    "pair": (2, 0, ""),
    "beside decoys": (1, 3, ""),
    "on strings": (1, 1, "behind"),
    "under strings": (1, 1, "in front"),
    "decoys alone": (0, 3, ""),
    "strings alone": (0, 2, "behind"),
}
PLAIN = 0.3  # of grounds: white, dark or a court's, not a photograph
LARGE = 0.2, 1.2  # of the photo's height: how wide a cut-out is pasted, what is empty with it
APART = 0.0  # IoU up to which things may overlap
PICTURE = photos.HEIGHT, photos.WIDTH


def paste_photos(shots, split, count, rng):
    """`PastedPhoto`s on the real photos `shots` that show no shuttlecock, SCENES in turn.

    The last UNTRAINED_COUNT cut-outs are asked: half "validation", half "test"; others "train".
    """
    grounds = [shot.image for shot in shots if "shuttlecock" not in shot.boxes]
    half = UNTRAINED_COUNT // 2
    part = {
        "train": np.s_[: -2 * half],
        "validation": np.s_[-2 * half : -half],
        "test": np.s_[-half:],
    }
    cutouts = [load(kind)[part[split]] for kind in ("shuttlecocks", "decoys")]
    scenes = list(SCENES.values())
    return [
        paste_scene(random_ground(grounds, rng), *cutouts, *scenes[i % len(scenes)], rng)
        for i in range(count)
    ]


def random_ground(grounds, rng):
    """A photograph (400, 600, 3) in 0..1, mirrored or not, darker or lighter; or a PLAIN ground."""
    if rng.random() < PLAIN:
        return plain_ground(rng)
    image = grounds[rng.integers(len(grounds))][:, :: rng.choice([-1, 1])].astype(np.float32) / 255
    return jitter_colour(image, rng).clip(0, 1)


def plain_ground(rng):
    """A smooth ground (400, 600, 3) in 0..1: white, dark or coloured, some with court lines."""
    light = rng.choice([rng.uniform(0.75, 1), rng.uniform(0.02, 0.2), rng.uniform(0.2, 0.75)])
    image = np.full((*PICTURE, 3), light * rng.uniform(0.8, 1, 3), np.float32)
    for _ in range(rng.integers(3)):
        ends = rng.uniform(-0.2, 1.2, (2, 2)) * [photos.WIDTH, photos.HEIGHT]
        draw_lines(image, ends[None], rng.uniform(8, 50), np.full(3, rng.uniform(0.7, 1)))
    grain = cv2.GaussianBlur(rng.standard_normal(PICTURE).astype(np.float32), (0, 0), 1.2)
    return jitter_colour(image + rng.uniform(0, 0.1) * grain[..., None], rng).clip(0, 1)


def paste_scene(image, shuttlecocks, decoys, count, most_decoys, strings, rng):
    """A `PastedPhoto`: cut-outs of any size, turned and lit anyhow, with shadows, on a ground.

    image: (400, 600, 3) in 0..1, written to; the strings of a racket are "behind" the things,
    "in front" of them, or nowhere.
    """
    if strings == "behind":
        draw_strings(image, rng)
    kinds = count * [shuttlecocks] + rng.integers(min(1, most_decoys), most_decoys + 1) * [decoys]
    boxes = np.empty((0, 4))
    for some in kinds:
        boxes = paste_apart(image, some[rng.integers(len(some))], boxes, rng)
    if strings == "in front":
        draw_strings(image, rng)
    named = {"shuttlecock": boxes[0]} if count else {}
    return PastedPhoto(np.uint8(255 * image.clip(0, 1) + 0.5), named, boxes[1:count], boxes[count:])


def paste_apart(image, cutout, boxes, rng):
    """Paste a cut-out in place, apart from the boxes (n, 4) of others: all boxes, its own last.

    Where the place drawn for it is taken, a smaller size and another place are drawn.
    """
    for large in np.geomspace(LARGE[1], LARGE[0], 12):
        x = transform_cutout(cutout, rng, (LARGE[0], large))
        height, width = x.shape[:2]
        top, left = rng.integers(np.subtract(PICTURE, (height, width)))
        box = np.array([left, top, left + width, top + height], float)
        if iou(box[None], boxes).max(initial=0) <= APART:
            break
    composite(image, x, (top, left), rng)
    return np.vstack([boxes, box])


def draw_strings(image, rng):
    """Draw a racket's strings and frame across a picture in place, under some perspective."""
    reach, gap = rng.uniform(0.5, 1.4) * photos.HEIGHT, rng.uniform(10, 40)
    corners = np.float32([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    angle = rng.uniform(0, 2 * np.pi)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    seen = corners * rng.uniform(0.6, 1, (4, 1)) @ turn * reach
    middle = rng.uniform(0.3, 0.7, 2) * photos.WIDTH
    project = cv2.getPerspectiveTransform(corners, np.float32(seen + middle))
    places = np.arange(-1, 1, gap / reach)
    half = 1.05 * np.sqrt(1 - places**2)
    along = np.stack([np.column_stack([places, side * half]) for side in (-1, 1)], axis=1)
    angles = np.linspace(0, 2 * np.pi, 60)
    rim = 1.05 * np.column_stack([np.cos(angles), np.sin(angles)])[None]
    dye = rng.choice([0.95, 0.85, 0.1]) * rng.uniform(0.7, 1.05, 3)
    for lines, thick, colour in (
        ([*along, *along[..., ::-1]], rng.uniform(1, 3), dye),
        (rim, gap * rng.uniform(0.5, 1.2), rng.random(3)),
    ):
        draw_lines(image, cv2.perspectiveTransform(np.float32(lines), project), thick, colour)


def draw_lines(image, lines, thick, colour):
    """Draw lines (n, points, 2), `thick` pixels wide, into a picture (400, 600, 3) in place."""
    mask, fixed = np.zeros(PICTURE, np.uint8), np.int32(np.round(16 * np.asarray(lines)))
    cv2.polylines(mask, list(fixed), False, 255, max(1, round(thick)), cv2.LINE_AA, 4)
    image += (mask / np.float32(255))[..., None] * (np.float32(colour) - image)
