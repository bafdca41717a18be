"""Non-maximum suppression, one box a step: in Python, and for the page to work out."""

from book.figures.where import in_corner
from vmc_lib.boxes import iou
from vmc_lib.show.figures import photo_view
from vmc_lib.show.palette import EDGE, ON_PHOTO


def rounds_of(boxes, overlap):
    """Each step's best box and the boxes that it suppresses, by their places: the best come first.

    `boxes` (n, 4) come by falling score.
    """
    waiting, rounds = list(range(len(boxes))), []
    while waiting:
        best, *rest = waiting
        shared = iou(boxes[best], boxes[rest])[0] if rest else []
        gone = [i for i, share in zip(rest, shared, strict=True) if share > overlap]
        waiting = [i for i in rest if i not in gone]
        rounds.append((best, gone))
    return rounds


def suppression(image, boxes, step, overlap):
    """A photo after so many steps: kept boxes, those that the last one suppressed, and the rest."""
    done = rounds_of(boxes, overlap)[:step]
    kept, gone = [best for best, _ in done], [i for _, some in done for i in some]
    now = done[-1][1] if step == len(done) > 0 else []  # else there was nothing left to do
    rest = [i for i in range(len(boxes)) if i not in {*kept, *gone}]
    kinds = (rest, "grey"), (now, "red"), (kept, "green")
    marks = [(boxes[i], "", colour) for some, colour in kinds for i in some]
    return photo_view(image, [*marks, in_corner(_words(kept, gone, rest))])


def _words(kept, gone, rest):
    return f"{len(kept)} kept, {len(gone)} suppressed, {len(rest)} wait"


def suppression_in_page(image, boxes):
    """The same for the page to work out (see `explore`)."""
    given = {"boxes": boxes.tolist(), "edge": EDGE, "paint": ON_PHOTO}
    return "suppression", lambda: photo_view(image), given
