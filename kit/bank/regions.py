"""Regions: what is kept of many boxes, and how detections are counted."""

import numpy as np

from kit.question import between, choice, count, number, pick
from reproduce.training.detectors import best_threshold
from vmc_lib.boxes import corrections, iou, nms, vote
from vmc_lib.statistics import wilson

SIZE = 100  # pixels: the side of the boxes below


def _shifted(*shifts):
    """Square boxes, each pushed so many pixels to the right."""
    return np.array([[x, 0, x + SIZE, SIZE] for x in shifts], float)


def _tally(rng):
    """Right, wrong and missed detections, and the three in words."""
    right, wrong, missed = (
        between(rng, low, high, 1) for low, high in ((20, 60), (1, 15), (1, 20))
    )
    told = f"finds {right} things, calls {wrong} more that are none, and misses {missed}"
    return right, wrong, missed, f"A detector {told}."


def shifted_box(rng):
    share = between(rng, 0.05, 0.5, 0.05)
    return number(
        f"A box has the right size but is pushed sideways by {share:.0%} of its width. What is its "
        "IoU with the true box?",
        iou(*_shifted(0, share * SIZE)).item(),
        hint="They share 1 - d and cover 1 + d.",
    )


def shift_for_an_overlap(rng):
    wanted, width = pick(rng, 0.5, 0.6, 0.7, 0.8, 0.9), between(rng, 60, 180, 10)
    return number(
        f"A box of the right size is pushed sideways until its IoU with the true box is {wanted}. "
        f"The box is {width} pixels wide. How many pixels is that?",
        width * (1 - wanted) / (1 + wanted),
        "pixels",
        "Solve (1 - d)/(1 + d) = IoU for d, a share of the width.",
    )


def kept_by_suppression(rng):
    shifts = np.sort(10 * rng.choice(np.arange(1, 25), 4, replace=False))
    shifts, overlap = [0, *shifts.tolist()], pick(rng, 0.2, 0.3, 0.5)
    return count(
        f"Five boxes of {SIZE} × {SIZE} pixels begin at x = {shifts}, all at the same height; "
        "their scores fall from left to right. Non-maximum suppression allows an IoU of "
        f"{overlap}. How many boxes are kept?",
        len(nms(_shifted(*shifts), -np.arange(5.0), overlap)),
        "boxes",
        "The best box removes those that overlap it by more; then the best of the rest.",
    )


def second_box_kept(rng):
    shifts = [0, *np.sort(5 * rng.choice(np.arange(2, 17), 2, replace=False)).tolist(), 150]
    names, overlap = ("A", "B", "C", "D"), pick(rng, 0.3, 0.5)
    second = nms(_shifted(*shifts), -np.arange(4.0), overlap)[1]
    return choice(
        f"Four boxes of {SIZE} × {SIZE} pixels, A to D, begin at x = {shifts}, all at the same "
        "height; A scores best, then B, C, D. Non-maximum suppression allows an IoU of "
        f"{overlap}. Which box is kept after A?",
        names[1:],
        names[second],
        "The next best one that does not overlap A by more than is allowed.",
    )


def voted_edge(rng):
    shift, lag = between(rng, 5, 30, 5), pick(rng, 0.05, 0.1, 0.2)
    [box] = vote([0], _shifted(0, shift), np.array([1.0, 1.0 - lag]))
    return number(
        f"A box that begins at x = 0 is kept. One beside it, of the same {SIZE} pixels, begins at "
        f"x = {shift} and scores {lag} less; it votes with weight exp(-{lag} / 0.1), the kept box "
        "with weight 1. Where does the voted box begin?",
        box[0],
        "pixels",
        "The weighted mean of the two.",
    )


def correction_of_a_box(rng):
    shift, stretch = between(rng, -20, 20, 5) or 10, pick(rng, 0.8, 1.1, 1.25, 1.5)
    truth = _shifted(shift)
    truth[:, 2] += (stretch - 1) * SIZE
    told, k = pick(rng, ("to the right, in widths of the candidate", 0), ("in width", 2))
    return number(
        f"A candidate spans x = 0 to {SIZE}, the true box x = {truth[0, 0]:g} to {truth[0, 2]:g}. "
        f"What correction should box regression learn {told}"
        f"{' (the natural logarithm of the stretch)' if k else ''}?",
        corrections(_shifted(0), truth)[0, k],
        hint="From centre to centre over the width; the logarithm of the true width over this one.",
    )


def precision_of(rng):
    right, wrong, _, told = _tally(rng)
    return number(
        f"{told} What is its precision?",
        right / (right + wrong),
        hint="Of what it called, the share that is right.",
    )


def recall_of(rng):
    right, _, missed, told = _tally(rng)
    return number(
        f"{told} What is its recall?",
        right / (right + missed),
        hint="Of what there is, the share that it found.",
    )


def threshold_of_best_f1(rng):
    scores = np.sort(np.round(rng.uniform(-1, 1, 5), 1) + 0.01 * np.arange(5)[::-1])[::-1]
    right = np.array([1, *rng.permutation([1, 1, 0, 0])], bool)
    marks = ", ".join(
        f"{s:.2f} ({'hit' if r else 'miss'})" for s, r in zip(scores, right, strict=True)
    )
    best = best_threshold(scores, right, 3)
    return count(
        f"Five boxes score {marks}; there are 3 things to find. At the threshold with the best F1, "
        "how many boxes are taken?",
        (scores > best).sum(),
        "boxes",
        "Take the first n: F1 = 2 × hits / (n + 3). Try every n.",
    )


def how_sure_is_a_share(rng):
    n = pick(rng, 20, 40, 80, 160)
    right, end = between(rng, n // 2, n, 1), pick(rng, "lower", "upper")
    return number(
        f"A detector is right in {right} of {n} photos. Where is the {end} end of the share's 95 % "
        "interval, after Wilson?",
        wilson(right, n)[end == "upper"],
        hint="(p + z²/2n ± z √(p(1-p)/n + z²/4n²)) / (1 + z²/n), z = 1.96",
        tolerance=0.005,
    )
