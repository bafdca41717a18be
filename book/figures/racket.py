"""One photograph with a racket: which boxes its strings draw to them, with and without edges."""

from functools import cache

import numpy as np

from book.figures.where import in_corner
from vmc_lib import photos
from vmc_lib.boxes import HIT_IOU, iou
from vmc_lib.show.figures import photo_view

NAME = "real/test/017"  # riyaznizar1997, CC BY 4.0 (see CREDITS.md); nothing was tuned on it
HEAD = np.array([50, 0, 310, 235])  # a box around the racket's head, drawn by hand
STRINGS, FLOOR = (70, 20, 290, 185), (0, 235, 220, 400)  # pieces as large, of either alone
BLUR = 6  # pixels


@cache
def racket():
    """The `Photo` with a racket."""
    return next(shot for shot in photos.load("real", "test") if shot.name == NAME)


def blur_strings(image):
    """An image in which the racket's head is blurred, so that its strings have no edges."""
    import cv2  # not in the page

    x0, y0, x1, y1 = HEAD
    blurred = image.copy()
    blurred[y0:y1, x0:x1] = cv2.GaussianBlur(image, (0, 0), BLUR)[y0:y1, x0:x1]
    return blurred


def without_colour(image):
    """An image (h, w, 3) in grey."""
    return np.repeat(image.mean(axis=2, keepdims=True), 3, axis=2).astype(np.uint8)


def images():
    """The photograph as it is, and with its strings blurred, by name."""
    return {"as they are": racket().image, "blurred": blur_strings(racket().image)}


def within(boxes, piece):
    """Which of boxes (n, 4) lie within a piece (4,) of the photograph: (n,)."""
    return (boxes[:, :2] >= piece[:2]).all(1) & (boxes[:, 2:] <= piece[2:]).all(1)


def in_head(boxes):
    """Which of boxes (n, 4) lie within the racket's head: (n,)."""
    return within(boxes, HEAD)


def on_shuttlecock(boxes):
    """Which of boxes (n, 4) lie on the shuttlecock: (n,)."""
    return iou(racket().boxes["shuttlecock"], boxes)[0] > HIT_IOU


def count(boxes):
    """How many of boxes (n, 4) lie in the racket's head, on the shuttlecock, and elsewhere."""
    inside, right = in_head(boxes).sum(), on_shuttlecock(boxes).sum()
    return int(inside), int(right), len(boxes) - int(inside + right)


def racket_view(image, boxes, elsewhere=True):
    """The photo with boxes (n, 4): red in the racket's head, green on the shuttlecock, else blue.

    Those `elsewhere` may be left out.
    """
    kinds = ("red", in_head(boxes)), ("green", on_shuttlecock(boxes))
    rest = ~np.logical_or(*(which for _, which in kinds)) & elsewhere
    marks = [
        (box, "", colour) for colour, which in (("blue", rest), *kinds) for box in boxes[which]
    ]
    head, right, _ = count(boxes)
    return photo_view(image, [*marks, in_corner(f"racket {head}, shuttlecock {right}")])


def racket_in_words(boxes):
    """What `racket_view` shows, in words."""
    head, right, rest = count(boxes)
    return (
        f"A racket and a shuttlecock on a floor of granite. Of {len(boxes)} boxes {head} lie in "
        f"the racket's head, {right} on the shuttlecock, {rest} elsewhere."
    )
