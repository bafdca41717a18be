"""Sidecar files of the photos: boxes, camera, target and pose as JSON."""

import json

import numpy as np
from PIL import Image


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
