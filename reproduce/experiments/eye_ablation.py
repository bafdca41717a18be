"""Ablation of the eye for photographs: what each of its parts brings, on validation photographs.

Written before anything was measured. A shorter eye (candidates, a gate, the stream names and
refines every box that passes, non-maximum suppression once, at the end) replaces the longer one
(box regression, a predicted IoU, suppression, votes, the stream on 48 boxes, a judge of both) if,
at a threshold chosen here,

- it chooses the right box (IoU above 0.5), and a tight one (at least 0.8), of no fewer validation
  photographs and renders of all levels together;
- it takes at most one picture more without a shuttlecock for one: validation photographs of other
  things, those of everyday things (which the stream has learnt from), and what is left of
  validation photographs where the part with the shuttlecock is cut off (`emptied`);
- its code is shorter.

Of those that do, the simplest is taken: a part stays only if without it something gets worse.
Photographs on which held-out shuttlecocks are laid are a second look. No test photo has a part in
the choice.
"""

import numpy as np

from vmc_lib import photos


def emptied(photo):
    """The largest part (height, width, 3) of a photo beside, above or below its shuttlecocks."""
    boxes = photos.boxes_of(photo, "shuttlecock")
    (x0, y0), (x1, y1) = (
        np.floor(boxes.min(0)[:2]).astype(int),
        np.ceil(boxes.max(0)[2:]).astype(int),
    )
    image = photo.image
    parts = image[:, : max(x0, 0)], image[:, x1:], image[: max(y0, 0)], image[y1:]
    return photos.read_image(max(parts, key=lambda part: part.size))
