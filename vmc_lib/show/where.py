"""Pictures of regions and boxes, for the chapters on the dorsal pathway."""

import numpy as np

from vmc_lib.show.figures import photo_view
from vmc_lib.where.boxes import iou


def mosaic(image, labels):
    """The image (height, width, 3) with every region of `labels` painted in its mean colour."""
    flat = labels.ravel()
    size = np.maximum(np.bincount(flat), 1)
    means = np.stack([np.bincount(flat, channel) / size for channel in image.reshape(-1, 3).T], 1)
    return np.uint8(means[labels])


def nearest(truth, boxes, colour="green"):
    """For each named true box the nearest of `boxes`, labelled with its IoU, for `photo_view`."""
    marks = []
    for name, true in truth.items():
        overlap = iou(true, boxes)[0]
        marks.append((boxes[overlap.argmax()], f"{name} {overlap.max():.2f}", colour))
    return marks


def judged(image, boxes, truth, good=0.8):
    """The image with its boxes (n, 4): green where they hold an object, red where they do not."""
    right = iou(boxes, list(truth.values())).max(1, initial=0) >= good
    return photo_view(
        image, [(b, "", "green" if r else "red") for b, r in zip(boxes, right, strict=True)]
    )


def bars(shares):
    """Named shares of one as horizontal bars, in SVG."""
    rows = []
    for place, (name, share) in enumerate(shares.items()):
        y = 28 * place + 4
        rows += [
            f'<rect x="95" y="{y}" width="220" height="18" fill="var(--vmc-line, #d3d8df)"/>',
            f'<rect x="95" y="{y}" width="{220 * share:.0f}" height="18" '
            'fill="var(--vmc-blue, #1f63b4)"/>',
            f'<text x="0" y="{y + 14}">{name}</text><text x="325" y="{y + 14}">{share:.2f}</text>',
        ]
    size = f'viewBox="0 0 370 {28 * len(shares)}" width="370" height="{28 * len(shares)}"'
    return "\n".join(
        [f'<svg {size} font-size="14" fill="var(--vmc-ink, #1c2430)">', *rows, "</svg>"]
    )
