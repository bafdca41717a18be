"""Questions on regions: what is kept of many boxes, and how detections are counted."""

import numpy as np

from kit.bank.drawing import points
from kit.question import choice, count, numeric, picture, steps, successes
from reproduce.training.detectors import best_threshold
from vmc_lib.boxes import encode_deltas, iou, nms, vote
from vmc_lib.statistics import wilson

SIZE = 100  # pixels: the side of the boxes below
RIGHT, WRONG, MISSED = steps(20, 60, 1), steps(1, 15, 1), steps(1, 20, 1)


def boxes_at(*starts):
    """Square boxes that begin at these pixels from the left, (n, 4)."""
    return np.array([[x, 0, x + SIZE, SIZE] for x in starts], float)


def five_starts(rng):
    return [0, *np.sort(10 * rng.choice(np.arange(1, 25), 4, replace=False)).tolist()]


def four_starts(rng):
    return [0, *np.sort(5 * rng.choice(np.arange(2, 17), 2, replace=False)).tolist(), 150]


@numeric(hint="They share 1 - d and cover 1 + d.")
def shifted_box(share=steps(0.05, 0.5, 0.05)):
    """A box has the right size but is pushed sideways by {share:.0%} of its width. What is its IoU
    with the true box?"""
    return iou(*boxes_at(0, share * SIZE)).item()


@numeric("pixels", "Solve (1 - d)/(1 + d) = IoU for d, a share of the width.")
def shift_for_an_overlap(overlap=(0.5, 0.6, 0.7, 0.8, 0.9), width=steps(60, 180, 10)):
    """A box of the right size is pushed sideways until its IoU with the true box is {overlap}. The
    box is {width} pixels wide. How many pixels is that?"""
    return width * (1 - overlap) / (1 + overlap)


@count("boxes", "The best box removes those that overlap it by more; then the best of the rest.")
def kept_by_suppression(starts=five_starts, overlap=(0.2, 0.3, 0.5)):
    """Five boxes of {SIZE} × {SIZE} pixels begin at x = {starts}, all at the same height; their
    scores fall from left to right. Non-maximum suppression allows an IoU of {overlap}. How many
    boxes are kept?"""
    return len(nms(boxes_at(*starts), -np.arange(5.0), overlap))


@choice("B", "C", "D", hint="The next best one that does not overlap A by more than is allowed.")
def second_box_kept(starts=four_starts, overlap=(0.3, 0.5)):
    """Four boxes of {SIZE} × {SIZE} pixels, A to D, begin at x = {starts}, all at the same height;
    A scores best, then B, C, D. Non-maximum suppression allows an IoU of {overlap}. Which box is
    kept after A?"""
    return nms(boxes_at(*starts), -np.arange(4.0), overlap)[1] - 1


@numeric("pixels", "The weighted mean of the two.")
def voted_edge(shift=steps(5, 30, 5), lag=(0.05, 0.1, 0.2)):
    """A box that begins at x = 0 is kept. One beside it, of the same {SIZE} pixels, begins at x =
    {shift} and scores {lag} less; it votes with weight exp(-{lag} / 0.1), the kept box with weight
    1. Where does the voted box begin?"""
    return vote([0], boxes_at(0, shift), np.array([1.0, 1.0 - lag]))[0][0]


@numeric(
    hint="From centre to centre over the width; the logarithm of the true width over this one."
)
def correction_of_a_box(
    shift=steps(-20, 20, 5, zero=10),
    stretch=(0.8, 1.1, 1.25, 1.5),
    part=(
        ("to the right, in widths of the candidate", 0),
        ("in width (the natural logarithm of the stretch)", 2),
    ),
):
    """A candidate spans x = 0 to {SIZE}, the true box x = {shift} to {end:g}. What correction
    should box regression learn {part[0]}?"""
    truth = boxes_at(shift)
    truth[:, 2] += (stretch - 1) * SIZE
    return encode_deltas(boxes_at(0), truth)[0, part[1]], {"end": truth[0, 2]}


@numeric(hint="Of what it called, the share that is right.")
def precision_of(right=RIGHT, wrong=WRONG, missed=MISSED):
    """A detector finds {right} things, calls {wrong} more that are none, and misses {missed}. What
    is its precision?"""
    return right / (right + wrong)


@numeric(hint="Of what there is, the share that it found.")
def recall_of(right=RIGHT, wrong=WRONG, missed=MISSED):
    """A detector finds {right} things, calls {wrong} more that are none, and misses {missed}. What
    is its recall?"""
    return right / (right + missed)


def falling_scores(rng):
    return np.sort(np.round(rng.uniform(-1, 1, 5), 1) + 0.01 * np.arange(5)[::-1])[::-1]


def hits(rng):
    return np.array([1, *rng.permutation([1, 1, 0, 0])], bool)


@count("boxes", "Take the first n: F1 = 2 × hits / (n + 3). Try every n.")
def threshold_of_best_f1(scores=falling_scores, right=hits):
    """Five boxes score {marks}; there are 3 things to find. At the threshold with the best F1, how
    many boxes are taken?"""
    marks = (f"{s:.2f} ({'hit' if r else 'miss'})" for s, r in zip(scores, right, strict=True))
    return (scores > best_threshold(scores, right, 3)).sum(), {"marks": ", ".join(marks)}


@numeric(
    hint="(p + z²/2n ± z √(p(1-p)/n + z²/4n²)) / (1 + z²/n), z = 1.96",
    tolerance=0.005,
)
def how_sure_is_a_share(photos=successes((20, 40, 80, 160)), end=("lower", "upper")):
    """A detector is right in {photos[0]} of {photos[1]} photos. Where is the {end} end of the
    share's 95 % interval, after Wilson?"""
    return wilson(*photos)[end == "upper"]


def draw_scores(rng):
    """Scores of twelve boxes, one each tenth from -0.55 on, and which are hits; (12, 2)."""
    right = rng.random(12) < np.linspace(0.25, 0.9, 12)
    return np.column_stack([np.arange(12) / 10 - 0.55, right])


def score_line(axes, boxes):
    """Twelve boxes by their score, from left to right, a tenth apart, the first at -0.55. Hits (1)
    and misses (0): {hits}."""
    for right, mark in ((1, "C0o"), (0, "C1x")):
        scores = boxes[boxes[:, 1] == right, 0]
        axes.plot(scores, np.full(len(scores), right), mark, ms=8)
    axes.set(yticks=[0, 1], yticklabels=["miss", "hit"], ylim=(-0.5, 1.5), xlabel="score")
    axes.set_xticks(np.arange(-6, 7) / 10)
    axes.grid(alpha=0.4)


@picture(score_line)
@count("hits", "Count the hits between the two thresholds.")
def hits_lost(boxes=draw_scores, low=steps(-0.6, 0.1, 0.1), rise=steps(0.2, 0.5, 0.1)):
    """Boxes above the threshold are called. It rises from {low:g} to {high:g}. How many hits are
    lost?"""
    between = (boxes[:, 0] > low) & (boxes[:, 0] < low + rise)
    words = {"high": low + rise, "hits": boxes[:, 1].astype(int)}
    return (between & (boxes[:, 1] == 1)).sum(), words


def f1(detectors):
    """F1 scores (n,): the harmonic mean of recall and precision, of `detectors` (n, 2)."""
    recall, precision = detectors.T
    return 2 * precision * recall / (precision + recall)


def four_detectors(rng):
    """Recall and precision of four detectors, (4, 2), of which one has clearly the best F1."""
    recall = rng.permutation([0.3, 0.5, 0.7, 0.9])
    detectors = np.column_stack([recall, np.round(1.15 - recall + rng.uniform(-0.2, 0.2, 4), 1)])
    best, second = np.sort(f1(detectors))[:-3:-1]
    return detectors if best > second + 0.03 and detectors.max() <= 1 else four_detectors(rng)


def precision_recall(axes, detectors):
    """Precision against recall, a point each. A: recall {detectors[0][0]}, precision
    {detectors[0][1]}; B: {detectors[1][0]}, {detectors[1][1]}; C: {detectors[2][0]},
    {detectors[2][1]}; D: {detectors[3][0]}, {detectors[3][1]}."""
    points(axes, dict(zip("ABCD", detectors, strict=True)), "recall", "precision")
    axes.set(aspect="auto", xlim=(0, 1.05), ylim=(0, 1.1))


@picture(precision_recall)
@choice(*"ABCD", hint="2 P R / (P + R): one that is large cannot make up for one that is small.")
def best_f1_of_four(detectors=four_detectors):
    """Four detectors on the same photos. Which one has the best F1?"""
    return np.argmax(f1(detectors))
