"""Evaluation on photographs and on another renderer's scenes: detection, naming, false alarms."""

from joblib import Parallel, delayed

from reproduce.results import records
from reproduce.training.photographs import load_photographs
from vmc_lib import photos
from vmc_lib.boxes import HIT_IOU, MIN_IOU, iou
from vmc_lib.loop import VisuomotorModel, see
from vmc_lib.statistics import wilson

MODELS, SPLITS = ("varied", "real"), ("validation", "test")
SIZED = ", size counts"  # where the camera is known
FEW = 64  # boxes, as many as the detector of `varied` keeps of a test photo, the mean
QUESTIONS = {  # about which photos, and what has to be so
    "shuttlecocks named, in their true boxes": (
        "shuttlecock",
        lambda result: result["chance"] > 0.5,
    ),
    "cups called a shuttlecock": ("cup", lambda result: result["chance"] > 0.5),
    "a good candidate": ("shuttlecock", lambda result: result["candidate"] >= MIN_IOU),
    "a box on the shuttlecock": ("shuttlecock", lambda result: result["kept"] > HIT_IOU),
    "a good box": ("shuttlecock", lambda result: result["kept"] >= MIN_IOU),
    "the chosen box is the shuttlecock's": ("shuttlecock", lambda result: result["fit"] > HIT_IOU),
    "and fits well": ("shuttlecock", lambda result: result["fit"] >= MIN_IOU),
    "photos of a cup with a false alarm": ("cup", lambda result: result["chosen"] is not None),
    "photos of neither with one": ("neither", lambda result: result["chosen"] is not None),
}


def load_results(model, split):
    """What `examine` found in each photo of a split, by the photo's name."""
    return records("real_world")[model][split]


def count_answers(found):
    """Question -> (how many, of how many), of what `load_results` gives."""
    counts = {}
    for question, (kind, holds) in QUESTIONS.items():
        right = [holds(result) for result in found.values() if result["holds"] == kind]
        if right:
            counts[question] = sum(right), len(right)
    return counts


def count_choices(found):
    """Of the photos with a shuttlecock: how many got a wrong box, none, and none though one fit.

    A box fits where a kept one lies on the shuttlecock; `found` as for `count_answers`.
    """
    results = [result for result in found.values() if result["holds"] == "shuttlecock"]
    silent = [result for result in results if result["chosen"] is None]
    wrong = sum(result["chosen"] is not None and result["fit"] <= HIT_IOU for result in results)
    return wrong, len(silent), sum(result["kept"] > HIT_IOU for result in silent)


def share_text(count, of):
    """A share as text, with its 95 % interval (Wilson)."""
    low, high = wilson(count, of)
    return f"{count} of {of} ({low:.0%} to {high:.0%})"


def make(folder=photos.FOLDER, models=MODELS, splits=SPLITS):
    """What `results/real_world.json` holds: model -> split -> photo -> what `examine` found."""
    found = {}
    for name in models:
        model = VisuomotorModel.load(name)
        found[name] = {
            split: _examine_all(model, load_photographs(split, folder)) for split in splits
        }
    return found


def make_elsewhere(folder, models=MODELS):
    """What `results/elsewhere.json` holds: model -> photo -> what `examine` found.

    Of the scenes of `render.elsewhere`, by another renderer, of which no model has seen one; each
    model once more where it knows the camera, and so how large things are.
    """
    shots, found = photos.load("varied", "test", folder), {}
    for name in models:
        model = VisuomotorModel.load(name)
        found[name] = _examine_all(model, shots)
        found[name + SIZED] = _examine_all(model, shots, sized=True)
    return found


def _examine_all(model, shots, sized=False):
    results = Parallel()(delayed(examine)(model, photo, sized) for photo in shots)
    return {photo.name: one for photo, one in zip(shots, results, strict=True)}


def examine(model, photo, sized=False):
    """What a model makes of a photo; `sized`: also of how large things are, as its camera tells.

    holds: "shuttlecock", "cup" or "neither"; chance: that its true box holds a shuttlecock, to the
    recogniser; candidate, kept, few: how well (IoU) the best candidate, the best kept box and the
    best of the FEW of the highest scores fit it; boxes: how many are kept;
    chosen: the box (4,) that the loop takes for a shuttlecock; fit: how well that fits one.
    """
    found = model.detector.detect(photo.image)
    sight = see(model, photo.image, photo.camera if sized else None)
    holds = next(iter(photo.boxes), "neither")
    chosen = [] if sight.box is None else sight.box
    record = {"holds": holds, "chosen": None if sight.box is None else _rounded(sight.box)}
    if holds == "neither":
        return record
    truth = photo.boxes[holds]
    chance = model.recogniser.box_probability(photo.image, truth[None])
    return record | {
        "chance": round(float(chance[0]), 4),
        "candidate": _best(found.candidates, [truth]),
        "kept": _best(found.boxes, [truth]),
        "few": _best(found.boxes[:FEW], [truth]),
        "boxes": len(found.boxes),
        "fit": _best(chosen, photos.boxes_of(photo, "shuttlecock")),
    }


def _best(boxes, truth):
    return round(float(iou(boxes, truth).max(initial=0)), 3)


def _rounded(box):
    return [round(float(edge), 1) for edge in box]
