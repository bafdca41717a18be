"""Ablation of the eye for photographs: what each of its parts brings, on validation pictures.

Candidates that pass a gate, sliding windows, a stream that names and refines them, non-maximum
suppression: a part stays only if without it something gets worse. The pictures: renders and
photographs of validation, counter-examples, what is left of photographs where the part with the
shuttlecock is cut off (`largest_empty_part`), and pasted scenes. No test photo has a part in the
choice.
"""

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.pasted_scenes import pasted_photos
from reproduce.results import records
from reproduce.training.photographs import load_photographs
from vmc_lib import photos
from vmc_lib.boxes import HIT_IOU, MIN_IOU, iou
from vmc_lib.loop import VisuomotorModel
from vmc_lib.what.stream import FLIPS, N_LOOKS, N_REFINED, VentralStream

SCENES_EACH = 20  # pasted scenes of each kind
N_BEST = 100  # boxes, of the best detector scores
COUNTED = "right", "tight", "found", "alarms"


@dataclass(frozen=True, eq=False)
class MemoisedStream(VentralStream):
    """A stream that looks once at each box of one picture."""

    memory: dict = field(default_factory=dict)

    def predict(self, image, boxes, flips=FLIPS[:1]):
        """As the stream's, of one and the same image."""
        if not len(boxes):
            return super().predict(image, boxes, flips)
        keys = [(box.tobytes(), tuple(flips)) for box in boxes]
        new = [i for i, key in enumerate(keys) if key not in self.memory]
        outputs = zip(*super().predict(image, boxes[new], flips), strict=True)
        self.memory.update(zip([keys[i] for i in new], outputs, strict=True))
        return tuple(map(np.array, zip(*map(self.memory.get, keys), strict=True)))


class Unmoved(MemoisedStream):
    """A stream that names boxes and leaves them where they are."""

    def predict(self, *given):
        """As the stream's, without deltas."""
        log_odds, deltas = super().predict(*given)
        return log_odds, 0 * deltas


class BestBoxes(MemoisedStream):
    """A stream that looks at the N_BEST boxes of the best detector scores alone."""

    def select(self, image, detections, **settings):
        """As the stream's, of fewer boxes."""
        return super().select(
            image, replace(detections, boxes=detections.boxes[:N_BEST]), **settings
        )


WITHOUT = {  # what is left out -> how the stream chooses, its class, and among which boxes
    "nothing": ({}, MemoisedStream, "all"),
    "flips": ({"flips": FLIPS[:1]}, MemoisedStream, "all"),
    "refinement": ({}, Unmoved, "all"),
    "sliding windows": ({}, MemoisedStream, "candidates"),
    "candidates": ({}, MemoisedStream, "windows"),
    f"all boxes but {N_BEST}": ({}, BestBoxes, "all"),
    "suppression before refinement": ({"alike": 1.0}, MemoisedStream, "all"),
    "half of the boxes refined": ({"refined": N_REFINED // 2}, MemoisedStream, "all"),
    "the last look": ({"looks": N_LOOKS - 1}, MemoisedStream, "all"),
}


def largest_empty_part(photo):
    """The largest part of a photo beside, above or below its shuttlecocks, (400, 600, 3)."""
    boxes, image = photos.boxes_of(photo, "shuttlecock"), photo.image
    x0, y0 = np.floor(boxes[:, :2].min(0).clip(0)).astype(int)
    x1, y1 = np.ceil(boxes[:, 2:].max(0)).astype(int)
    parts = image[:, :x0], image[:, x1:], image[:y0], image[y1:]
    return photos.read_image(max(parts, key=lambda part: part.size))


def pictures(folder=photos.FOLDER, each=SCENES_EACH):
    """(image, true boxes (n, 4) of shuttlecocks) of every picture that is asked."""
    renders, real = photos.load_levels("validation", folder), load_photographs("validation", folder)
    shots = [*renders, *real, *pasted_photos("validation", each)]
    asked = [(shot.image, photos.boxes_of(shot, "shuttlecock")) for shot in shots]
    cut = [shot for shot in real if "shuttlecock" in shot.boxes]
    return asked + [(largest_empty_part(shot), np.empty((0, 4))) for shot in cut]


def make(folder=photos.FOLDER, count=None):
    """What `results/eye_ablation.json` holds: what is left out -> counts, and `asked`: of how many.

    "right", "tight" of the pictures with a shuttlecock, "found" of all shuttlecocks, "alarms" of
    pictures without; `count` of either are asked, by default all.
    """
    model = VisuomotorModel.load(photos.REAL_LEVEL)
    some = pictures(folder, SCENES_EACH if count is None else count)
    shown, empty = ([one for one in some if bool(len(one[1])) == has][:count] for has in (1, 0))
    found = Parallel()(delayed(_answers)(model, *one) for one in shown + empty)
    sums = {name: sum((one[name] for one in found), Counter()) for name in WITHOUT}
    totals = len(shown), len(shown), sum(len(truth) for _, truth in shown), len(empty)
    asked = dict(zip(COUNTED, totals, strict=True))
    return {"asked": asked, **{name: {key: s[key] for key in COUNTED} for name, s in sums.items()}}


load_results = partial(records, "eye_ablation")


def _answers(model, image, truth):
    """What is left out -> a Counter of what the eye's answer is, for one picture."""
    found, memory, answers = _detections(model.detector, image), {}, {}
    for name, (settings, kind, boxes) in WITHOUT.items():
        stream = kind(**vars(model.recogniser), memory=memory)
        chosen, probability = stream.select(image, found[boxes], **settings)
        fits = iou(chosen.boxes[probability > stream.min_probability], truth)
        best, each = fits[:1].max(initial=0), fits.max(0, initial=0)
        alarm = len(fits) and not len(truth)
        counts = best > HIT_IOU, best >= MIN_IOU, (each > HIT_IOU).sum(), alarm
        answers[name] = Counter(dict(zip(COUNTED, map(int, counts), strict=True)))
    return answers


def _detections(detector, image):
    """The `Detections` of all boxes that pass, of candidates alone, and of windows alone."""
    found = detector.detect(image)
    without_windows = replace(detector, recipe=replace(detector.recipe, windows=()))
    return {
        "all": found,
        "candidates": without_windows.detect(image, found.candidates),
        "windows": detector.detect(image, found.candidates[:0]),
    }
