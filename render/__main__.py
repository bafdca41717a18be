"""Remake the photos: `python -m render [--only rig/test/003] [--samples 25]`.

More of a kind: `--only varied/train --count 400 --folder more`. `*` stands for any level or split.
"""

import argparse
import itertools
import json
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
from PIL import Image

from render import picture, scene
from vmc_lib.photos import CLASSES, FOLDER, LEVELS, SHEET_LEVEL, SPLITS

COUNTS = {"train": 40, "validation": 20, "test": 40}
MORE = {("varied", "train"): 160}  # its variety asks for more to learn from
SHOWN = 0.96  # the least share of shuttlecock and cup that nothing else hides


def box(mask):
    """The smallest box (x0, y0, x1, y1) around a mask."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return [int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1]


def make(level, split, number, samples, folder):
    """Draw scenes until shuttlecock and cup are in full view; write the photo and its sidecar."""
    seed = ((*LEVELS, SHEET_LEVEL).index(level), SPLITS.index(split), number)
    rng = np.random.default_rng(seed)
    while True:
        drawn = scene.draw_with_sheet(rng) if level == SHEET_LEVEL else scene.draw(level, rng)
        masks = picture.masks(drawn)
        if all(seen.sum() >= SHOWN * whole.sum() for whole, seen in masks.values()):
            break
    image = picture.take(drawn, samples, int(rng.integers(2**31)))
    camera = {key: np.asarray(value).tolist() for key, value in vars(drawn.camera).items()}
    truth = {
        "boxes": {name: box(masks[name][1]) for name in CLASSES},
        "camera": camera,
        "target": drawn.target.tolist(),
        "turn": drawn.turn,
        "pose": drawn.pose,
        "seed": seed,
    }
    path = folder / level / split / f"{number:03d}.jpg"
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(image).save(path, quality=90)
    path.with_suffix(".json").write_text(json.dumps(truth, indent=1) + "\n")


def main():
    """Render what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m render", description=__doc__)
    parser.add_argument("--only", default="", help="a level, level/split or level/split/number")
    parser.add_argument("--samples", type=int, default=25, help="light paths a pixel")
    parser.add_argument("--first", type=int, default=0, help="the number of the first photo")
    parser.add_argument(
        "--count", type=int, help="photos of each kind; by default, as many as ship"
    )
    parser.add_argument("--sheet", action="store_true", help="those with the printed sheet instead")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where to write them")
    arguments = parser.parse_args()
    kinds = [(SHEET_LEVEL, "test")] if arguments.sheet else itertools.product(LEVELS, SPLITS)
    for level, split in kinds:
        count = arguments.count or MORE.get((level, split), COUNTS[split])
        for number in range(arguments.first, arguments.first + count):
            if fnmatch(f"{level}/{split}/{number:03d}", f"{arguments.only}*"):
                make(level, split, number, arguments.samples, arguments.folder)


if __name__ == "__main__":
    main()
