"""Exercises of the chapter on regions."""

import numpy as np

from vmc_lib.boxes import iou
from vmc_lib.grading import Exercise


def svm_cost(w, b, x, y, C):
    short = 1 - y * (x @ w + b)  # of the margin, for each example
    return w @ w / 2 + C * np.maximum(short, 0).sum()


def _line_and_examples(rng):
    n, d = rng.integers([3, 2], [7, 4])
    x, y = rng.normal(size=(n, d)), rng.choice([-1, 1], n)
    return rng.normal(size=d), rng.normal(), x, y, rng.choice([0.1, 1, 10])


SVM_COST = Exercise(
    svm_cost,
    _line_and_examples,
    {
        "You charge for the wrong side only. An example inside the margin costs as well: its "
        "$y f$ should be 1 at least.": lambda w, b, x, y, C: (
            w @ w / 2 + C * np.maximum(-y * (x @ w + b), 0).sum()
        ),
        "Examples far on the right side lower the cost now. They cost nothing: no cost is "
        "below 0.": lambda w, b, x, y, C: w @ w / 2 + C * (1 - y * (x @ w + b)).sum(),
        "You count the examples that cost. Each costs the more, the farther it is from where it "
        "should be.": lambda w, b, x, y, C: w @ w / 2 + C * (y * (x @ w + b) < 1).sum(),
        "The term for a wide margin is missing: $\\lVert w \\rVert^2 / 2$.": (
            lambda w, b, x, y, C: svm_cost(w, b, x, y, C) - w @ w / 2
        ),
        "You took the mean over the examples; the cost is their sum.": lambda w, b, x, y, C: (
            svm_cost(w, b, x, y, C / len(y))
        ),
    },
)


def soft_nms(overlaps, scores):
    scores, waiting = scores.copy(), np.ones(len(scores), bool)
    while waiting.any():
        best = np.where(waiting, scores, -1).argmax()
        waiting[best] = False
        scores[waiting] *= 1 - overlaps[best, waiting]
    return scores


def _boxes_and_scores(rng):
    corner = rng.integers(0, 60, (n := rng.integers(3, 6), 2))
    boxes = np.hstack([corner, corner + rng.integers(40, 80, (n, 2))])
    return iou(boxes, boxes), rng.permutation(np.arange(1, 10))[:n] / 10  # no two alike


SOFT_NMS = Exercise(
    soft_nms,
    _boxes_and_scores,
    {
        "The more two boxes overlap, the more is to be taken away: multiply by one minus the "
        "overlap.": lambda overlaps, scores: soft_nms(1 - overlaps, scores),
        "You went by the old scores. A box that was weakened has its turn later: look for the "
        "best anew each time.": lambda overlaps, scores: (
            scores * np.where(scores > scores[:, None], 1 - overlaps, 1).prod(axis=1)
        ),
        "Every box weakens every other one now. Only those that wait are weakened, never a box "
        "that had its turn.": lambda overlaps, scores: (
            scores * (1 - overlaps + np.eye(len(scores))).prod(axis=1)
        ),
        "A box overlaps itself by 1 and so weakened itself to zero. Take it from those that "
        "wait first.": lambda overlaps, scores: 0 * scores,
        "Only the best box of all had a turn. Go on with the best of those that wait.": (
            lambda overlaps, scores: np.where(
                scores == scores.max(), scores, scores * (1 - overlaps[scores.argmax()])
            )
        ),
    },
)
