"""Training object detectors: SVM, box regression and IoU prediction, from labelled candidates.

Candidates that overlap an object by 0.8 are examples, those that overlap none by more than 0.5 are
counter-examples. A shuttlecock and a cup are the same here: general objects. The numbers of box
regression and IoU prediction were chosen on 120 validation photos a level, of which 20 ship.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, NEGATIVE_IOU, decode_deltas, encode_deltas, iou
from vmc_lib.data import arrays, read_only
from vmc_lib.where.box_regression import RBFRidge, regress
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import EVERY_RECIPE, PHOTOGRAPHED, PUBLISHED, SINGLE
from vmc_lib.where.selective_search import propose
from vmc_lib.where.svm import KernelSVM

ROIS = 4700  # counter-examples to learn from, as in the paper; a random draw where there are more
JITTER = 0.05  # how far, in sides, the examples are jittered
REGRESSION_CENTRES, PREDICTION_CENTRES = 1000, 2000  # jittered boxes that are kept as centres

UNFIT, FIT = 0.5, 0.9  # IoU up to which a box is worth 0, and from which it is worth 1
BACKGROUND = 0.3  # IoU under which a box shows no object
JITTERS = (0.03, 0.08, 0.15)  # in sides: how far the predictor's boxes are jittered
HARD_NEGATIVES, EASY_NEGATIVES = 25, 10  # further candidates a photo: mined ones, any ones
MINED = 51_200  # candidates of all photos among which the hard ones are sought


@cache
def candidates(photo, strategy=PUBLISHED.strategy):
    """`propose(photo.image, strategy)`, looked up where the photo ships with its candidates.

    Found once, shared, and so read-only.
    """
    shipped = arrays("candidates") if photos.FOLDER in photo.file.parents else {}
    boxes = shipped.get(f"{photo.name}/{strategy}")
    return read_only(propose(photo.image, strategy) if boxes is None else boxes.astype(float))


@dataclass(frozen=True, eq=False)
class TrainingImage:
    """A photo to learn from: its pixels, true boxes and candidates."""

    pixels: np.ndarray  # (height, width, 3)
    truth: np.ndarray  # (m, 4) true boxes
    candidates: np.ndarray  # (n, 4)

    @property
    def overlap(self):
        """How well each candidate fits the object it fits best, (n,)."""
        return iou(self.candidates, self.truth).max(1, initial=0)

    def mirror(self):
        """The same image in a mirror."""
        width = self.pixels.shape[1]
        boxes = (
            np.stack([width - x1, y0, width - x0, y1], axis=1)
            for x0, y0, x1, y1 in (self.truth.T, self.candidates.T)
        )
        return TrainingImage(self.pixels[:, ::-1], *boxes)

    def sample_near_boxes(self, times, spread, rng):
        """Each true box so many times, and boxes moved and stretched from it by about `spread`."""
        truth = np.repeat(self.truth, times, axis=0)
        return truth, decode_deltas(truth, rng.normal(scale=spread, size=truth.shape))


def training_images(shots, recipe):
    """The `TrainingImage`s of photos for a recipe: one each, one more mirrored if it asks so."""
    plain = [
        TrainingImage(
            shot.image,
            np.reshape([*shot.boxes.values(), *shot.more], (-1, 4)),
            candidates(shot, recipe.strategy),
        )
        for shot in shots
    ]
    return plain + [image.mirror() for image in plain] if recipe.mirror else plain


def labelled_candidates(shots, recipe=PUBLISHED):
    """Clearly labelled candidates: features x (n, d), labels y (n,).

    The clear cases among the photos' candidates: IoU of 0.8 and more, 0.5 and less.
    """
    x, y = [], []
    for image in training_images(shots, replace(recipe, mirror=False)):
        overlap = image.overlap
        clear = (overlap >= MIN_IOU) | (overlap <= NEGATIVE_IOU)
        x.append(recipe.describe(image.pixels, image.candidates[clear]))
        y.append(overlap[clear] >= MIN_IOU)
    return np.concatenate(x), np.concatenate(y)


def svm_training_set(images, recipe, rng):
    """SVM training set: positives, jittered positives and ROIS sampled negatives.

    Of `TrainingImage`s. Returns features x (n, d), labels y (n,).
    """
    x, y = [], []
    for image in images:
        overlap = image.overlap
        good, bad = image.candidates[overlap >= MIN_IOU], image.candidates[overlap <= NEGATIVE_IOU]
        bad = rng.permutation(bad)[: -(-ROIS // len(images))]
        _, jittered = image.sample_near_boxes(recipe.jittered, JITTER, rng)
        x.append(recipe.describe(image.pixels, np.vstack([good, jittered, bad])))
        y.append(np.arange(len(x[-1])) < len(good) + len(jittered))
    return np.concatenate(x), np.concatenate(y)


def fit_box_regression(images, recipe, rng):
    """One `RBFRidge` a round, of the correction (4,) that a box needs by what it shows.

    Box regression (Girshick et al. 2014) on training images; the later the round, the nearer it
    expects the box to be.
    """
    times, rounds = recipe.boxes // sum(len(image.truth) for image in images) + 1, []
    for spread in recipe.regressions:
        x, goal = [], []
        for image in images:
            truth, boxes = image.sample_near_boxes(times, spread, rng)
            x.append(recipe.describe(image.pixels, boxes))
            goal.append(encode_deltas(boxes, truth))
        x, goal = np.concatenate(x), np.concatenate(goal)
        rounds.append(RBFRidge.fit(x, goal, REGRESSION_CENTRES, rng))
    return tuple(rounds)


def fit_iou_predictor(images, recipe, svm, regressions, rng):
    """An `RBFRidge` of how well a box fits its object: 0 up to IoU UNFIT, rising to 1 at FIT.

    It learns from true boxes, jittered, so that IoUs of 0.5 to 0.8, which the `svm` never learnt
    from, are among them; from candidates; and from hard negatives: candidates that show no object
    and yet pass the `svm`, as the regressions then correct them.
    """
    total = sum(len(image.truth) for image in images)
    times, x, y = 2 * recipe.boxes // total // len(JITTERS) + 1, [], []
    for image in images:
        near = [image.sample_near_boxes(times, spread, rng)[1] for spread in JITTERS]
        some = rng.permutation(image.candidates)[: MINED // len(images)]
        off = some[iou(some, image.truth).max(1, initial=0) < BACKGROUND]
        passed = svm.score(recipe.describe(image.pixels, off)) > recipe.gate
        led = regress(recipe, regressions, image.pixels, off[passed][:HARD_NEGATIVES])
        boxes = np.vstack([*near, led, some[:EASY_NEGATIVES]])
        x.append(recipe.describe(image.pixels, boxes))
        y.append(np.interp(iou(boxes, image.truth).max(1, initial=0), (UNFIT, FIT), (0, 1)))
    return RBFRidge.fit(np.concatenate(x), np.concatenate(y), PREDICTION_CENTRES, rng)


def fit_detector(shots, recipe=PUBLISHED, rng=None):
    """An `ObjectDetector` that learns from photos; `rng` draws counter-examples, jitters boxes.

    Its threshold stays 0: see `with_best_threshold`.
    """
    rng, images = rng or np.random.default_rng(0), training_images(shots, recipe)
    x, y = svm_training_set(images, recipe, rng)
    svm = KernelSVM.fit(x, y, recipe.kernel, recipe.cost)
    regressions = fit_box_regression(images, recipe, rng)
    predictor = None
    if recipe.predicts_iou:
        predictor = fit_iou_predictor(images, recipe, svm, regressions, rng)
    return ObjectDetector(recipe, svm, regressions, predictor)


def with_recipe(detector, name):
    """The same detector under the recipe `name`, which uses fewer of its parts."""
    recipe = EVERY_RECIPE[name]
    predictor = detector.iou_predictor if recipe.predicts_iou else None
    return replace(detector, recipe=recipe, iou_predictor=predictor)


def best_threshold(scores, right, wanted):
    """The threshold for scores (n,) that finds most at fewest errors: the best F1.

    right: (n,) which are hits, or the chance of each; wanted: how many there are to hit. F1 is the
    harmonic mean of precision and recall; the threshold lies midway between the last score taken
    and the next lower one (or is -inf, where it is best to take all).
    ValueError where there is nothing to choose from.
    """
    if not len(scores):
        raise ValueError("no score to choose a threshold from: give photos with something found")
    order = np.argsort(-scores, kind="stable")
    taken, left = scores[order], np.append(scores[order][1:], -np.inf)
    f1 = 2 * right[order].cumsum() / (np.arange(len(order)) + 1 + wanted)
    last = np.where(left < taken, f1, -1).argmax()  # no line divides equal scores
    return float((taken[last] + left[last]) / 2)


def with_best_threshold(detector, shots):
    """The same detector with the score threshold of best F1 on validation photos.

    The published recipe, its variant and that of photographs have none to choose: it stays at 0.
    """
    if detector.recipe in (PUBLISHED, SINGLE, PHOTOGRAPHED):
        return detector
    lenient, scores, right, wanted = replace(detector, threshold=-np.inf), [], [], 0
    for image in training_images(shots, replace(detector.recipe, mirror=False)):
        found = lenient.detect(image.pixels, image.candidates)
        scores.append(found.scores)
        right.append(iou(found.boxes, image.truth).max(1, initial=0) >= MIN_IOU)
        wanted += len(image.truth)
    best = best_threshold(np.concatenate(scores), np.concatenate(right), wanted)
    return replace(detector, threshold=best)
