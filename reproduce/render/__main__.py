"""Remake the photos: `python -m reproduce.render [--only rig/test/003] [--samples 25]`.

More of a kind: `--only varied/train --count 400 --folder more`. `*` stands for any level or split.
"""

import argparse
import itertools
from fnmatch import fnmatch
from functools import partial
from pathlib import Path

import numpy as np

from reproduce.render import picture, scene
from reproduce.render.sidecar import store
from vmc_lib.photos import FOLDER, LEVELS, SHEET_LEVEL, SPLITS

COUNTS = {"train": 40, "validation": 20, "test": 40}
MORE = {("varied", "train"): 160}  # its variety asks for more to learn from


def make(level, split, number, samples, folder):
    """Write the photo of a scene in which shuttlecock and cup are in full view, and its sidecar."""
    seed = ((*LEVELS, SHEET_LEVEL).index(level), SPLITS.index(split), number)
    rng = np.random.default_rng(seed)
    draw = scene.draw_with_sheet if level == SHEET_LEVEL else partial(scene.draw, level)
    drawn, boxes = scene.draw_in_full_view(partial(draw, rng), picture.masks)
    image = picture.take(drawn, samples, int(rng.integers(2**31)))
    store(folder / level / split / f"{number:03d}.jpg", image, drawn, boxes, seed)


def main():
    """Render what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m reproduce.render", description=__doc__)
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
