"""Selective search, *single*, with each of OpenCV's segmentation settings put into ours.

Ours is as published (Uijlings et al. 2013): k is 100, no patch stays under k pixels, a pixel has
eight neighbours, and hue counts as much as saturation. OpenCV's defaults: 200, 100 pixels, four
neighbours, and a hue from 0 to 180 beside a saturation from 0 to 255. Each is put in alone, then
all at once. Of the two lists of boxes of a photo, the longer is cut to the other's length.
"""

import cv2
import numpy as np

from tools.bench.report import publish
from tools.bench.selective_search import DRAWS, SMALLEST, opencv_orders, real_photos, renders
from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, iou
from vmc_lib.where.appearance import COLOUR_SPACES, colour_codes, describe, texture_codes
from vmc_lib.where.segmentation import merge_segments, pixel_edges, pixel_offsets, sort_by_weight
from vmc_lib.where.selective_search import ALL, grow, rank_boxes

PATCH = 100  # pixels: the smallest, of ours and of OpenCV's
SCALE, FOUR, HUE = {"k": 200}, {"neighbours": 4}, {"narrow_hue": True}
CUTS = {
    "ours": {},
    "k 200, patches from 100 pixels": SCALE,
    "four neighbours": FOUR,
    "hue from 0 to 180": HUE,
    "all three": SCALE | FOUR | HUE,
}


def cut(image, k=100, neighbours=8, narrow_hue=False):
    """The `Hierarchy` of an image, segmented with these settings."""
    rgb = photos.as_float(image)
    channels = COLOUR_SPACES["HSV"](rgb)
    if narrow_hue:
        channels[..., 0] *= 180 / 255
    smooth = cv2.GaussianBlur(channels, (0, 0), 0.8)
    height, width = image.shape[:2]
    edges = pixel_edges(smooth)
    edges = sort_by_weight(edges[edges % 4 < neighbours // 2])
    labels = merge_segments(edges, pixel_offsets(width), height * width, k / 255, PATCH)
    labels = labels.reshape(height, width)
    codes = colour_codes(channels), texture_codes(channels)
    return grow(labels, describe(labels, *codes), ALL)


def recall_difference(image, truth, opencv_boxes, **settings):
    """How many boxes there are, and for each object our recall at IoU 0.8 less OpenCV's, (n,)."""
    tree = cut(image, **settings)
    orders = [rank_boxes([tree], np.random.default_rng(draw), SMALLEST) for draw in range(DRAWS)]
    equal = min(len(orders[0]), len(opencv_boxes))
    ours, peers = (
        [iou(truth, order[:equal]).max(1, initial=0) >= MIN_IOU for order in lists]
        for lists in (orders, [opencv_boxes])
    )
    return len(orders[0]), np.mean(ours, axis=0) - peers[0]


def bootstrap_over_photos(differences, rng):
    """The mean over all objects of photos (a list of arrays), and its 95 % interval over photos."""
    picks = rng.integers(0, len(differences), (2000, len(differences)))
    means = [np.concatenate([differences[i] for i in pick]).mean() for pick in picks]
    return np.concatenate(differences).mean(), *np.percentile(means, [2.5, 97.5])


if __name__ == "__main__":
    rows = []
    for name, pictures in {"renders": renders(), "real photos": real_photos()}.items():
        shots = [
            (p.image, list(p.boxes.values()), opencv_orders(p.image, "single")[0]) for p in pictures
        ]
        for cut_name, settings in CUTS.items():
            counts, differences = zip(
                *(recall_difference(*shot, **settings) for shot in shots), strict=True
            )
            mean, *interval = bootstrap_over_photos(differences, np.random.default_rng(0))
            rows.append(
                {
                    "photos": f"{len(pictures)} {name}",
                    "cut": cut_name,
                    "boxes": round(np.mean(counts)),
                    "recall .8 at equal count, less OpenCV's": round(mean, 3),
                    "95 %": " to ".join(f"{x:.3f}" for x in interval),
                }
            )
    publish("cuts", rows)
