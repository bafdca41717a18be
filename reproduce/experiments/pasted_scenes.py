"""Evaluation on pasted scenes: held-out shuttlecocks and decoys laid on held-out photographs.

By kind of scene (`scenes.SCENES`): pairs, a racket's strings, things that resemble a shuttlecock.
"""

from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import records
from reproduce.training.photographs import load_photographs
from reproduce.training.scenes import SCENES, paste_photos
from vmc_lib import photos
from vmc_lib.boxes import HIT_IOU, MIN_IOU, iou
from vmc_lib.loop import VisuomotorModel, see

SPLITS, COUNT = ("validation", "test"), 40  # photos of each kind of scene


def make(splits=SPLITS, count=COUNT):
    """What `results/pasted_scenes.json` holds: split -> scene -> answers of its photos.

    An answer is the likeliest box's probability of being a shuttlecock (0 where there is no box),
    and its IoU with the one that it fits best.
    """
    model = VisuomotorModel.load(photos.REAL_LEVEL)
    return {split: _by_scene(answer_photos(model, pasted_photos(split, count))) for split in splits}


load_results = partial(records, "pasted_scenes")


def pasted_photos(split, count=COUNT):
    """The `PastedPhoto`s of a split, SCENES in turn, `count` of each."""
    rng = np.random.default_rng(SPLITS.index(split))
    return paste_photos(load_photographs(split), split, count * len(SCENES), rng)


def answer_photos(model, shots):
    """A model's answers to photos, as for `make`."""
    return Parallel()(delayed(_answer)(model, photo) for photo in shots)


def _answer(model, photo):
    sight = see(model, photo.image)
    if not len(sight.probability):
        return [0.0, 0.0]
    fits = iou(sight.detections.boxes[:1], photos.boxes_of(photo, "shuttlecock"))
    return [round(float(sight.probability[0]), 4), round(float(fits.max(initial=0)), 3)]


def _by_scene(answers):
    return {name: answers[k :: len(SCENES)] for k, name in enumerate(SCENES)}


def count_answers(by_scene, threshold):
    """Scene -> (right, tight, false alarms) at a threshold of the probability."""
    counts = {}
    for name, answers in by_scene.items():
        chance, fit = np.transpose(answers)
        chosen, empty = chance > threshold, not SCENES[name][0]
        alarms = chosen.sum() if empty else (chosen & (fit <= HIT_IOU)).sum()
        counts[name] = (chosen & (fit > HIT_IOU)).sum(), (chosen & (fit >= MIN_IOU)).sum(), alarms
    return {name: tuple(map(int, three)) for name, three in counts.items()}
