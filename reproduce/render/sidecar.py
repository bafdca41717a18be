"""Sidecar files of the photos: boxes, camera, target and pose as JSON."""

import json

import numpy as np
from PIL import Image

from vmc_lib.photos import CLASSES

VISIBLE = 0.96  # the least share of shuttlecock and cup that nothing else hides


def in_full_view(draw, masks):
    """A scene of `draw()` in which shuttlecock and cup are in full view, and the boxes around them.

    Draws until one is. `masks` gives, by name, a thing's mask alone and among the others.
    """
    while True:
        scene = draw()
        visibility = masks(scene)
        if all(part.sum() >= VISIBLE * whole.sum() for whole, part in visibility.values()):
            return scene, {name: box(visibility[name][1]) for name in CLASSES}


def box(mask):
    """The smallest box (x0, y0, x1, y1) around a mask."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return [int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1]


def store(path, image, scene, boxes, seed):
    """Write a photo and its sidecar."""
    camera = {key: np.asarray(value).tolist() for key, value in vars(scene.camera).items()}
    truth = {
        "boxes": boxes,
        "camera": camera,
        "target": scene.target.tolist(),
        "turn": scene.turn,
        "pose": scene.pose,
        "seed": seed,
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(image).save(path, quality=90)
    path.with_suffix(".json").write_text(
        json.dumps(truth, indent=1) + "\n", encoding="utf-8", newline="\n"
    )
