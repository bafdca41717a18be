"""Precision against recall as a threshold moves: in Python, and for the page to work out."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from book.figures.panels import panels
from book.figures.where import right_and_wrong
from vmc_lib.boxes import MIN_IOU, iou, nms
from vmc_lib.show.figures import photo_view
from vmc_lib.show.markup import data_uri
from vmc_lib.show.palette import COLOURS, EDGE, ON_PHOTO

LOWEST = -2.0  # no box with a lower score is looked at
SHOWN = 3  # the photo that is


class Level(NamedTuple):
    """A level: photos; of each its boxes (n, 4), scores (n,), which objects they hold (n, k)."""

    photos: list
    boxes: list
    scores: list
    holds: list

    def __hash__(self):
        return id(self.photos)


def scored_level(photos, detections):
    """A `Level` of photos and what a detector found in each, the best boxes first."""
    boxes, scores = [], []
    for one in detections:
        order = np.argsort(-one.candidate_scores, kind="stable")
        order = order[one.candidate_scores[order] > LOWEST]
        boxes.append(one.candidates[order])
        scores.append(one.candidate_scores[order])
    pairs = zip(photos, boxes, strict=True)
    holds = [iou(found, list(photo.boxes.values())) >= MIN_IOU for photo, found in pairs]
    return Level(photos, boxes, scores, holds)


@lru_cache(8)
def trace(level, overlap):
    """What suppression keeps: each photo's boxes (rows), all scores, falling, and the curve (n, 2).

    A point of the curve is the recall and the precision of all boxes up to there.
    """
    rows = [nms(b, s, overlap) for b, s in zip(level.boxes, level.scores, strict=True)]
    scores = np.concatenate([s[k] for s, k in zip(level.scores, rows, strict=True)])
    order = np.argsort(-scores, kind="stable")
    right = np.concatenate([h[k].any(1) for h, k in zip(level.holds, rows, strict=True)])[order]
    best = [
        np.where(h[k], s[k][:, None], -np.inf).max(0, initial=-np.inf)
        for s, h, k in zip(level.scores, level.holds, rows, strict=True)
    ]
    found = np.concatenate(best)[:, None] >= scores[order]
    curve = found.mean(0), right.cumsum() / np.arange(1, len(right) + 1)
    return rows, scores[order], np.transpose(curve)


def trade(level, threshold, overlap):
    """A photo with the boxes kept; precision against recall, and where the threshold stands."""
    rows, _, curve = trace(level, overlap)
    kept = rows[SHOWN][level.scores[SHOWN][rows[SHOWN]] > threshold]
    _, rates, words = _rates(level, threshold, overlap)
    fig, ax = _plot()
    ax.plot(*curve.T, color=COLOURS["blue"], gid="all thresholds")
    ax.plot(*rates, "o", color=COLOURS["red"], gid="this threshold")
    ax.set_title(words)
    photo = level.photos[SHOWN]
    return right_and_wrong(photo.image, level.boxes[SHOWN][kept], photo.boxes), fig


def trade_in_words(level, threshold, overlap):
    """The same in words."""
    count, _, words = _rates(level, threshold, overlap)
    return f"{count} boxes are kept: {words}."


def _rates(level, threshold, overlap):
    """How many boxes are kept; their recall and precision, as numbers and in words."""
    _, scores, curve = trace(level, overlap)
    count = (scores > threshold).sum()
    recall, precision = curve[count - 1] if count else (0, 0)
    words = f"precision {two_digits(precision)}, recall {two_digits(recall)}"
    return count, (recall, precision), words


def two_digits(share):
    """A share as text; halves are rounded up, as in the page."""
    return f"{share + 1e-9:.2f}"


def _plot():
    fig, ax = panels(size=(4, 3.2))
    ax.set(xlabel="recall", ylabel="precision", xlim=(0, 1.02), ylim=(0, 1.05))
    return fig, ax


def trade_in_page(levels):
    """The same for the page to work out (see `explore`), of name -> `Level`."""
    image = next(iter(levels.values())).photos[SHOWN].image
    given = {name: _given(level) for name, level in levels.items()}
    given = {"levels": given, "shown": SHOWN, "edge": EDGE, "paint": ON_PHOTO}
    return "trade", lambda: (photo_view(np.zeros_like(image)), _plot()[0]), given


def _given(level):
    """A level as the page takes it: of a photo the boxes, each with score and what it holds."""
    every = zip(level.boxes, level.scores, level.holds, strict=True)
    shots = [
        [
            [*box, score, *map(int, np.flatnonzero(held))]
            for box, score, held in zip(boxes.tolist(), scores.tolist(), holds, strict=True)
        ]
        for boxes, scores, holds in every
    ]
    objects = sum(held.shape[1] for held in level.holds)
    return {"image": data_uri(level.photos[SHOWN].image), "objects": objects, "shots": shots}
