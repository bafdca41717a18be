"""A fresh test set: two hundred new photos a level, for what forty are too few to tell.

No answer is of a photo that had a part in a choice: what the first hundred said of Table I led to
the sizes, the cost and the threshold of its context, so its rows are of the second hundred alone.
The answers ship; the photos do not, but the step `fresh_photos` renders them anew.
"""

from dataclasses import replace

import numpy as np

from reproduce import results
from reproduce.experiments import hmax_draws, recognition
from reproduce.experiments.cdbn_sensitivity import SPLITS, VARIATIONS, train_variations
from reproduce.experiments.localisation import (
    TABLE_1_KERNELS,
    TRAININGS,
    detect_photos,
    train_classifiers,
)
from reproduce.experiments.recognition import confusion_counts, rates_of_counts, share_interval
from reproduce.training.detectors import (
    candidates,
    fit_detector,
    labelled_candidates,
    with_best_threshold,
)
from vmc_lib import photos, show
from vmc_lib.boxes import MIN_IOU, area, iou
from vmc_lib.what.cdbn import N_W, PATCHES
from vmc_lib.what.recogniser import READ_OUTS
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import PUBLISHED, RECIPES

FRESH = 140  # number of the first photo that had no part in Table I
KERNELS, DETECTORS = ("linear", "rbf"), ("single", "improved")
NETWORK_SEEDS = tuple(seed for n_w, seed in VARIATIONS if n_w == N_W)
CEILING, UNCORRECTED = "candidates", "improved, boxes not corrected"


def coverage(boxes, truth):
    """The share of each true box (m, 4) that each box (n, 4) covers, (n, m)."""
    sides = np.minimum(boxes[:, None, 2:], truth[:, 2:]) - np.maximum(
        boxes[:, None, :2], truth[:, :2]
    )
    return sides.clip(0).prod(axis=-1) / area(truth)


READINGS = {  # how well boxes fit objects, by what "overlapped region" and "properest box" may be
    "IoU": lambda boxes, truth, every: iou(boxes, truth),
    "coverage of the truth": lambda boxes, truth, every: coverage(boxes, truth),
    "the best candidate as truth": lambda boxes, truth, every: iou(
        boxes, every[iou(every, truth).argmax(axis=0)]
    ),
}


def load_results():
    """Question -> level -> (right, wrong, missed): counts.

    "linear" and "rbf" are rows of Table I with context, means over as many trainings as there;
    "single" and "improved" of Table II; (read-out, seed) of Table III. (When the exam was held, the
    published recipe was "single".) Of the published recipe, on the rig: (kernel, seed) of Table I,
    (reading, seed) of Table II, and as CEILING the objects that have a good candidate. UNCORRECTED,
    on the rig, is "improved" without box regression and votes.
    """
    kept = results.records("fresh_test_set")
    return {tuple(q) if isinstance(q, list) else q: levels for q, levels in kept}


def wilson_rates(right, wrong, missed):
    """Precision and recall, and the 95 % interval of each (Wilson): ((share, low, high), …).

    NaN where nothing is called an object. The intervals take the counts as independent, which those
    of several boxes on one object are not, and leave out the luck of training.
    """
    return tuple(share_interval(right, n) for n in (right + wrong, right + missed))


def table_1():
    """Table I, the published recipe on the rig: kernel -> (trainings, 2), precision and recall."""
    return {kernel: rates_by_seed(kernel) for kernel in TABLE_1_KERNELS}


def rates_by_seed(question):
    """Likewise of a kernel, or for Table II of one of the READINGS: (trainings, 2)."""
    counts = load_results()
    return np.array([rates_of_counts(counts[question, seed]["rig"]) for seed in range(TRAININGS)])


def markdown_table(*questions):
    """Answers as Markdown: precision / recall on every level, each with its interval."""
    counts, rows = load_results(), []
    for question in questions:
        cells = [question if isinstance(question, str) else "{}, seed {}".format(*question)]
        for level in photos.LEVELS:
            parts = wilson_rates(*counts[question][level])
            cells.append(
                " / ".join(f"{share:.3f} ({low:.2f}–{high:.2f})" for share, low, high in parts)
            )
        rows.append(cells)
    return show.table(["asked", *photos.LEVELS], rows)


def mean_errors(level):
    """Crops of a level named wrong by each read-out of the CDBN, the mean over NETWORK_SEEDS."""
    counts = load_results()
    return {
        name: np.mean([sum(counts[name, seed][level][1:]) for seed in NETWORK_SEEDS])
        for name in READ_OUTS
    }


def make(exam, folder=photos.FOLDER, trainings=TRAININGS, seeds=NETWORK_SEEDS, patches=PATCHES):
    """What `results/fresh_test_set.json` holds: every question put to the test photos in `exam`.

    What is trained for it learns from the photos in `folder`. ValueError for a photo that ships.
    """
    found = {}
    for level in photos.LEVELS:
        shots = photos.load(level, "test", exam)
        shipped = {photo.name for photo in photos.load(level, "test")}
        if known := shipped & {photo.name for photo in shots}:
            raise ValueError(f"{exam} holds photos that ship, no exam: delete {sorted(known)}")
        fresh = fresh_photos(level, exam)
        rows = kernel_counts(level, "context", KERNELS, fresh, folder, trainings)
        answers = dict(zip(KERNELS, np.mean(rows, axis=0).tolist(), strict=True))
        answers |= detector_counts(level, exam)
        if level == "rig":
            answers |= published_counts(level, fresh, shots, folder, trainings)
            answers |= uncorrected_counts(level, exam, folder)
        for question, counts in answers.items():
            found.setdefault(question, {})[level] = counts
    trained = train_variations([(N_W, seed) for seed in seeds], folder, exam, patches)
    for (_, seed), (_, counts) in trained.items():
        for j, name in enumerate(READ_OUTS):
            named = counts[:, j, SPLITS.index("test"), :3].tolist()
            found[name, seed] = dict(zip(photos.LEVELS, named, strict=True))
    return list(found.items())


def fresh_photos(level, exam):
    """The second hundred test photos of a level in `exam`: none had a part in a choice."""
    return [shot for shot in photos.load(level, "test", exam) if shot.seed[-1] >= FRESH]


def make_names(exam):
    """What `results/fresh_names.npz` holds: `recognition.probabilities` for the second hundred.

    And on the rig those of each draw of HMAX.
    """
    kept, learnt = {}, recognition.load_classifiers()
    for level in photos.LEVELS:
        shots = fresh_photos(level, exam)
        found, kept[f"{level}/fresh"] = recognition.probabilities(level, shots, *learnt)
        kept |= {f"{level}/{method}/fresh": chances for method, chances in found.items()}
        if level == "rig":
            kept["rig/HMAX draws/fresh"] = hmax_draws.probabilities(shots)
    return kept


def kernel_counts(level, recipe_name, kernels, shots, folder=photos.FOLDER, trainings=TRAININGS):
    """The answers of Table I's kernels, with a recipe, on photos of a level.

    (trainings, kernels, 3), as lists.
    """
    x, truth = labelled_candidates(shots, RECIPES[recipe_name])
    return [
        [
            confusion_counts(svm.score(x), truth, threshold)[:3]
            for svm, threshold in train_classifiers(level, recipe_name, kernels, seed, folder)
        ]
        for seed in range(trainings)
    ]


def published_counts(level, fresh, shots, folder=photos.FOLDER, trainings=TRAININGS):
    """The answers of the published recipe: Table I on `fresh` photos, Table II on `shots`."""
    rows = kernel_counts(level, "published", TABLE_1_KERNELS, fresh, folder, trainings)
    found = {
        (kernel, seed): rows[seed][k]
        for k, kernel in enumerate(TABLE_1_KERNELS)
        for seed in range(trainings)
    }
    every, lessons = list(map(candidates, shots)), photos.load(level, "train", folder)
    truth = _true_boxes(shots)
    for seed in range(trainings):
        detector = fit_detector(lessons, PUBLISHED, np.random.default_rng(seed))
        kept = [detector.detect(p.image, b).boxes for p, b in zip(shots, every, strict=True)]
        for reading, fit in READINGS.items():
            found[reading, seed] = _box_counts(map(fit, kept, truth, every))
    return found | {CEILING: _box_counts(map(iou, every, truth))}


def _true_boxes(shots):
    return [np.array(list(photo.boxes.values())) for photo in shots]


def _box_counts(fits):
    """Objects reached, wrong boxes and objects missed, by how well boxes fit, photo by photo."""
    good = [fit >= MIN_IOU for fit in fits]
    right, reached = (np.concatenate([pairs.any(axis) for pairs in good]) for axis in (1, 0))
    return tuple(map(int, (reached.sum(), (~right).sum(), (~reached).sum())))


def detector_counts(level, exam=photos.FOLDER):
    """The answers of Table II's detectors on the test photos of a level in the folder `exam`."""
    return {name: _final_box_counts(level, name, exam) for name in DETECTORS}


def uncorrected_counts(level, exam=photos.FOLDER, folder=photos.FOLDER):
    """Likewise of the improved detector that corrects no box: what it keeps are candidates.

    Its threshold is chosen anew, as its own was, on the validation photos in `folder`.
    """
    shipped = ObjectDetector.load(level)
    other = replace(shipped, recipe=replace(shipped.recipe, vote=False), regressions=())
    other = with_best_threshold(other, photos.load(level, "validation", folder))
    return {UNCORRECTED: _final_box_counts(level, other, exam)}


def _final_box_counts(level, detector, exam):
    kept = [detections.boxes for detections in detect_photos(level, "test", detector, exam)]
    return _box_counts(map(iou, kept, _true_boxes(photos.load(level, "test", exam))))
