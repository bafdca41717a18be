"""One script of all that the page's eye has learnt: the shipped arrays and settings, packed.

The build writes it, and a page loads it when its reader first gives a photo: `unpack` makes
of it what `brain` returns, arrays as typed arrays.
"""

import json
from dataclasses import asdict
from functools import cache
from pathlib import Path

import numpy as np
from wasmtime import wat2wasm

from page.eye.localiser import localiser
from vmc_lib import box_selection, camera, data, photos
from vmc_lib.show.packed import pack_bytes
from vmc_lib.what import stream as ventral
from vmc_lib.where.appearance import COLOUR_SPACES, MEASURES
from vmc_lib.where.recipes import EVERY_RECIPE
from vmc_lib.where.selective_search import STRATEGIES

SCRIPT = "vendor/brain.js"  # where the built page finds it
CONVOLUTION = Path(__file__).with_name("convolution.wat")
FILES = [data.FOLDER / f"{name}.npz" for name in ("detectors", "photographs", "localisers")]
GRID = 33  # colours a side of the grid between which OpenCV interpolates Lab
OPENCV_ONE = 1 << 14  # how it stores 1 there
OPENCV_RANGE = np.array([1, 255 / 256, 255 / 256])  # its L, a and b there, in shares of ours


def brain():
    """What the eye has learnt from photographs: nested dicts and lists of arrays and numbers."""
    return {
        "detector": detector(),
        "stream": stream(),
        "selector": selector(),
        "lab": lab_grid(),
        "localiser": localiser(),
    }


def detector():
    """The `ObjectDetector` of `VisuomotorModel.load("real")`."""
    learnt, recipe = data.arrays("detectors"), EVERY_RECIPE["photographed"]
    own = f"{photos.REAL_LEVEL}/photographed/"

    strategy = asdict(STRATEGIES[recipe.strategy])
    strategy["similarities"] = [[x in used for x in MEASURES] for used in strategy["similarities"]]
    return {part: learnt[own + part] for part in ("support", "weights", "bias")} | {
        "strategy": strategy,
        "gate": recipe.gate,
        "windows": recipe.windows,
    }


def stream():
    """The `VentralStream` that ships."""
    learnt = data.arrays("photographs")
    return {
        "stages": [{part: learnt[f"{name}/{part}"] for part in "Wb"} for name in ventral.STAGES],
        "readout": learnt["readout"],
        "offsets": learnt["offsets"],
        "sigmoid": learnt["sigmoid"],
        "flips": ventral.FLIPS,
        "convolution": np.frombuffer(wat2wasm(CONVOLUTION.read_text(encoding="utf-8")), np.uint8),
    }


def selector():
    """How boxes are chosen."""
    return {
        "alike": ventral.ALIKE,
        "refined": ventral.N_REFINED,
        "looks": ventral.N_LOOKS,
        "minProbability": ventral.MIN_PROBABILITY,
        "sizes": box_selection.SIZES,
        "ratio": box_selection.SIZE_LIKELIHOOD_RATIO,
        "table": camera.TABLE,
    }


def lab_grid():
    """OpenCV's grid of Lab colours (33, 33, 33, 3), int16, as differences along its third axis."""
    steps = np.linspace(0, 1, GRID, dtype=np.float32)
    rgb = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), -1)
    lab = COLOUR_SPACES["Lab"](rgb.reshape(GRID, -1, 3)).reshape(rgb.shape)
    whole = np.round(lab * OPENCV_RANGE * OPENCV_ONE).astype(np.int16)
    return np.diff(whole, axis=2, prepend=np.int16(0))


@cache
def script():
    """The script's text: it defines `self.vmcBrain`, arrays one behind another, gzip in base64."""
    stored = bytearray()

    def store(array):
        array = np.asarray(array)
        at = len(stored)
        stored.extend(array.tobytes() + bytes(-array.nbytes % 8))
        return {"kind": array.dtype.name, "at": at, "length": array.size}

    tree = json.dumps(brain(), default=store)
    arrays = pack_bytes(bytes(stored))
    return f"self.vmcBrain = {json.dumps({'tree': tree, 'arrays': arrays})};\n"


def inputs():
    """Every file that the script is made of."""
    library = Path(photos.__file__).parent  # whose constants go in, too
    return [*Path(__file__).parent.glob("*.py"), *library.rglob("*.py"), CONVOLUTION, *FILES]
