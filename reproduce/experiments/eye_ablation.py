"""Ablation of the eye for photographs: what each of its parts brings, on validation pictures.

Candidates that pass a gate, sliding windows, a stream that names and refines them, non-maximum
suppression: a part stays only if without it something gets worse. The pictures: renders and
photographs of validation, counter-examples, what is left of photographs where the part with the
shuttlecock is cut off (`emptied`), and pasted scenes. No test photo has a part in the choice.
"""

from collections import Counter
from dataclasses import replace
from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.pasted_scenes import pasted_photos
from reproduce.results import records
from reproduce.training.photographs import load_photographs
from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, iou
from vmc_lib.loop import Sight, VisuomotorModel
from vmc_lib.what.stream import FLIPS, N_LOOKS, N_REFINED, VentralStream

SCENES_EACH = 20  # pasted scenes of each kind
N_BEST = 100  # boxes, of the best detector scores
COUNTED = "right", "tight", "alarms"


class Unmoved(VentralStream):
    """A stream that names boxes and leaves them where they are."""

    def predict(self, *given):
        """As the stream's, without deltas."""
        log_odds, deltas = super().predict(*given)
        return log_odds, 0 * deltas


class BestBoxes(VentralStream):
    """A stream that looks at the N_BEST boxes of the best detector scores alone."""

    def select(self, image, detections, **settings):
        """As the stream's, of fewer boxes."""
        return super().select(
            image, replace(detections, boxes=detections.boxes[:N_BEST]), **settings
        )


WITHOUT = {  # what is left out -> how the stream chooses, its class, and among which boxes
    "nothing": ({}, VentralStream, "all"),
    "flips": ({"flips": FLIPS[:1]}, VentralStream, "all"),
    "refinement": ({}, Unmoved, "all"),
    "sliding windows": ({}, VentralStream, "candidates"),
    "candidates": ({}, VentralStream, "windows"),
    f"all boxes but {N_BEST}": ({}, BestBoxes, "all"),
    "half of the boxes refined": ({"refined": N_REFINED // 2}, VentralStream, "all"),
    "the last look": ({"looks": N_LOOKS - 1}, VentralStream, "all"),
}


def emptied(photo):
    """The largest part of a photo beside, above or below its shuttlecocks, (400, 600, 3)."""
    boxes, image = photos.boxes_of(photo, "shuttlecock"), photo.image
    x0, y0 = np.floor(boxes[:, :2].min(0).clip(0)).astype(int)
    x1, y1 = np.ceil(boxes[:, 2:].max(0)).astype(int)
    parts = image[:, :x0], image[:, x1:], image[:y0], image[y1:]
    return photos.read_image(max(parts, key=lambda part: part.size))


def pictures(folder=photos.FOLDER, each=SCENES_EACH):
    """(image, true boxes (n, 4) of shuttlecocks) of every picture that is asked."""
    renders = [shot for level in photos.LEVELS for shot in photos.load(level, "validation", folder)]
    real = load_photographs("validation", folder)
    shots = [*renders, *real, *pasted_photos("validation", each)]
    asked = [(shot.image, photos.boxes_of(shot, "shuttlecock")) for shot in shots]
    cut = [shot for shot in real if "shuttlecock" in shot.boxes]
    return asked + [(emptied(shot), np.empty((0, 4))) for shot in cut]


def make(folder=photos.FOLDER, count=None):
    """What `results/eye_ablation.json` holds: what is left out -> counts, and `asked`: of how many.

    "right", "tight" of the pictures with a shuttlecock, "alarms" of those without; `count` of
    either are asked, by default all.
    """
    model = VisuomotorModel.load(photos.REAL_LEVEL)
    asked = pictures(folder, SCENES_EACH if count is None else count)
    kinds = [[one for one in asked if bool(len(one[1])) == has][:count] for has in (True, False)]
    found = Parallel()(delayed(_answers)(model, *one) for kind in kinds for one in kind)
    sums = {name: sum((one[name] for one in found), Counter()) for name in WITHOUT}
    totals = dict(zip(("right", "alarms"), map(len, kinds), strict=True))
    return {"asked": totals, **{name: {key: s[key] for key in COUNTED} for name, s in sums.items()}}


load_results = partial(records, "eye_ablation")


def _answers(model, image, truth):
    """What is left out -> a Counter of what the eye's answer is, for one picture."""
    found, answers = _detections(model.detector, image), {}
    for name, (settings, kind, boxes) in WITHOUT.items():
        stream = kind(**vars(model.recogniser))
        chosen = stream.select(image, found[boxes], **settings)
        box = Sight(*chosen, stream.min_probability).box
        fit = iou(box, truth).max(initial=0) if box is not None else 0
        alarm = box is not None and not len(truth)
        answers[name] = Counter(right=int(fit > 0.5), tight=int(fit >= MIN_IOU), alarms=int(alarm))
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
