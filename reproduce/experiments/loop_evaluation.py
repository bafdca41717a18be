"""Evaluation of the closed loop, from pixels to reach: scores, failures, lesions."""

from contextlib import suppress
from dataclasses import replace

import numpy as np
from joblib import Parallel, delayed

from reproduce import results
from vmc_lib import NoReach, photos
from vmc_lib.boxes import HIT_IOU, MIN_IOU, iou
from vmc_lib.cerebellum.offline import RULES
from vmc_lib.loop import VisuomotorModel, locate, reach, recalibrate, see
from vmc_lib.what.recogniser import Recogniser
from vmc_lib.where.detector import ObjectDetector

ARRIVED, CLOSE_BY = 0.010, 0.005  # m: a hand so near the shuttlecock has arrived, or done well
FAILURE_STAGES = ("proposals", "regions", "names", "place", "movement")  # where a reach goes wrong
LESIONS = ("none", "ventral", "dorsal", "cerebellum")
OUTCOMES = ("object", "missed", "speed")  # of a photo under a lesion


def score(photo, sight, place, reaches):
    """How it went, stage by stage, held against the photo's truth.

    proposed: a candidate overlaps the shuttlecock by 0.8; found: a kept box does; named: the chosen
    box is the shuttlecock's (more than half of the union shared); cup: it is the cup's; then
    distances in m from the true place: of the `place` found (3,), of the hand before calibration,
    and after it by each rule of `reaches` (name -> `Reach`), on average over the hold. They are NaN
    where no place was found (`place` is None), or it could not be reached for (`reaches` is empty).
    """
    errors = dict.fromkeys(("target", "planned", *RULES), np.nan)
    if place is not None:
        errors["target"] = np.linalg.norm(place - photo.target)
    for rule, made in reaches.items():
        for name, motion in (("planned", made.planned), (rule, made.calibrated)):
            errors[name] = made.distance(motion, photo.target)
    held = object_in_box(photo, sight.box)
    return {
        "proposed": _overlap(sight.detections.candidates, photo, "shuttlecock") >= MIN_IOU,
        "found": _overlap(sight.detections.boxes, photo, "shuttlecock") >= MIN_IOU,
        "named": held == "shuttlecock",
        "cup": held == "cup",
        **errors,
    }


def _overlap(boxes, photo, name):
    return iou(boxes, photo.boxes[name][None]).max(initial=0.0)


def first_failure(scores, rule="own"):
    """Where each reach went wrong first: names (n,) of `FAILURE_STAGES`, "" where it arrived.

    Without a good candidate a good box can still be found, for boxes are corrected. A place is
    wrong beyond `ARRIVED`; where all else was right, the movement is to blame.
    """
    found, named, placed = scores["found"], scores["named"], scores["target"] <= ARRIVED
    moved = np.zeros_like(found)
    broken = ~np.column_stack([found | scores["proposed"], found, named, placed, moved])
    arrived = scores[rule] <= ARRIVED
    return np.where(arrived, "", np.array(FAILURE_STAGES)[broken.argmax(axis=1)])


def evaluate(level, taught=None, folder=photos.FOLDER):
    """`evaluate_model` of the shipped model that was taught on a level, by default the photos'."""
    return evaluate_model(VisuomotorModel.load(taught or level), level, folder)


def evaluate_model(model, level, folder=photos.FOLDER):
    """`score` of every test photo of a level in `folder`, as a dictionary of arrays (n,).

    The photos go through joblib: `with parallel_config(n_jobs=…)` sends them to several cores, and
    with its "dask" backend to a cluster.
    """
    shots = photos.load(level, "test", folder)
    scores = Parallel()(delayed(_evaluate_photo)(model, photo) for photo in shots)
    return {key: np.array([s[key] for s in scores]) for key in scores[0]}


def published_model(level):
    """The shipped model of a level with the paper's own detector and read-out."""
    detector, recogniser = ObjectDetector.load(level, "published"), Recogniser.load(level, "MP2")
    return replace(VisuomotorModel.load(level), detector=detector, recogniser=recogniser)


def make_generalist(levels=photos.LEVELS, folder=photos.FOLDER):
    """What `results/generalist.json` holds: level -> `summary` of how the model of "real" fares."""
    return {level: summary(evaluate(level, photos.REAL_LEVEL, folder)) for level in levels}


def _evaluate_photo(model, photo):
    """`score` of a photo: the likeliest box alone is gone for.

    Where it cannot be reached there is no reach, though `see_and_reach` would try the next.
    """
    sight, place, reaches = see(model, photo.image), None, {}
    with suppress(NoReach):  # nothing named, or out of reach: no movement, and counted as such
        place = locate(model, photo.image, sight.box, photo.camera)
        first = reach(model, place, calibration=None)
        reaches = {name: recalibrate(first, name) for name in RULES}
    return score(photo, sight, place, reaches)


def summary(scores):
    """Shares (in [0, 1]) found, named, arrived and close by each rule; median distances in m.

    The medians leave out what there is not: a photo without a place, or without a reach.
    """
    shares = {name: float(scores[name].mean()) for name in ("found", "named", "cup")}
    medians = {name: float(np.nanmedian(scores[name])) for name in ("target", "planned", *RULES)}
    for name, distance in (("arrived", ARRIVED), ("close", CLOSE_BY)):
        shares |= {f"{name}, {rule}": float((scores[rule] <= distance).mean()) for rule in RULES}
    return shares | medians


def target_box(sight, lesion):
    """The target box (4,) under one of `LESIONS`, or None.

    Without the ventral pathway nothing has a name: it is the box of the highest score.
    """
    boxes = sight.detections.boxes
    return sight.box if lesion != "ventral" else boxes[0] if len(boxes) else None


def reach_with_lesion(model, photo, box, lesion):
    """The `Reach` for a box under one of `LESIONS`; `NoReach` as from `locate` and `reach`.

    Without the dorsal pathway nothing has a place: the hand goes where the last shuttlecock of
    the training photos was. Without a cerebellum it is not calibrated, else by Algorithm 1.
    """
    place = locate(model, photo.image, box, photo.camera)
    if lesion == "dorsal":
        place = photos.load("rig", "train")[-1].target
    return reach(model, place, None if lesion == "cerebellum" else "published")


def evaluate_lesions(level, folder=photos.FOLDER):
    """Every test photo of a level under each of `LESIONS`: three lists for each lesion.

    "object" is what the box holds that is gone for: "shuttlecock", "cup", "neither" or, with no
    box, "nothing"; "missed" is how far the hand ends from the true shuttlecock in mm, and "speed"
    how fast it still moves there in mm/s, None where there was no reach.
    """
    model = VisuomotorModel.load(level)
    shots = photos.load(level, "test", folder)
    left = Parallel()(delayed(_photo_lesions)(model, photo) for photo in shots)
    return {how: {key: [one[how][key] for one in left] for key in OUTCOMES} for how in LESIONS}


def make(levels=photos.LEVELS, folder=photos.FOLDER):
    """What `results/lesions.json` holds: `evaluate_lesions` of every level."""
    return {level: evaluate_lesions(level, folder) for level in levels}


def lesion_outcomes(lesion):
    """What each test photo's target box holds, how far the hand ends (mm), and its speed (mm/s).

    Of all levels in turn (n,), from `results/lesions.json`; NaN where there was no reach.
    """
    levels = [results.records("lesions")[level][lesion] for level in photos.LEVELS]
    held, *numbers = (np.concatenate([one[key] for one in levels]) for key in OUTCOMES)
    return held, *(values.astype(float) for values in numbers)


def _photo_lesions(model, photo):
    sight, left = see(model, photo.image), {}
    for how in LESIONS:
        box = target_box(sight, how)
        left[how] = dict.fromkeys(OUTCOMES) | {"object": object_in_box(photo, box)}
        with suppress(NoReach):
            made = reach_with_lesion(model, photo, box, how)
            missed = made.distance(made.calibrated, photo.target)
            left[how]["missed"] = round(1000 * missed, 1)
            left[how]["speed"] = round(1000 * float(made.calibrated.speed), 1)
    return left


def object_in_box(photo, box):
    """What a box (4,) holds, sharing more than half of the union: "shuttlecock", "cup", "neither".

    "nothing" when there is no box.
    """
    if box is None:
        return "nothing"
    on = (name for name in photos.CLASSES if _overlap(box[None], photo, name) > HIT_IOU)
    return next(on, "neither")
