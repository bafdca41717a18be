"""Figures of the chapter on candidates: saliency, segments, merging, recall and cost."""

from itertools import compress, product

import numpy as np

from book.figures.panels import legend_above, panels
from book.figures.where import best_so_far, in_corner, mean_colours, mosaic, nearest, overlap_curves
from reproduce import results
from reproduce.peers.window_proposals import edge_density, sliding_windows
from reproduce.training.detectors import candidates
from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.show import COLOURS, photo_view, table
from vmc_lib.where.selective_search import ALL, Hierarchy, Strategy, hierarchies, propose

SPACES = ("HSV", "Lab", "rgI", "I")
MOST = 1000  # boxes tried, a photo
PROPOSALS = ("selective search", "windows", "windows by edges")
CONTRASTS = {  # in words: what the saliency map adds up
    "all three": "lightness and both pairs of colours differ",
    "lightness": "lightness differs",
    "red and green": "red and green differ",
    "blue and yellow": "blue and yellow differ",
}


def contrasts(image):
    """How much each place differs from its surround in lightness and two colours (h, w, 3)."""
    import cv2  # not in the page

    lab = cv2.cvtColor(photos.as_float(image), cv2.COLOR_RGB2Lab)
    near, far = (cv2.GaussianBlur(lab, (0, 0), s) for s in (8, 60))
    return (near - far) ** 2


def saliency(features, gains):
    """The saliency (h, w), from 0 to 1, of feature maps (h, w, 3) with a gain each (3,)."""
    total = features @ np.float32(gains)
    return np.sqrt(total / total.max())


def most_salient(heat):
    """The most salient place (x, y) of a saliency map (h, w)."""
    return np.unravel_index(heat.argmax(), heat.shape)[::-1]


def salient_object(boxes, heat):
    """On which of named boxes the most salient place lies, in words."""
    x, y = most_salient(heat)
    for name, (x0, y0, x1, y1) in boxes.items():
        if x0 <= x <= x1 and y0 <= y <= y1:
            return f"On the {name}"
    return "Elsewhere"


def salient_objects(boxes, images, name, gains):
    """Saliency of images, by image and gains; and of one, the `salient_object` by gains."""
    parts = {key: contrasts(image) for key, image in images.items()}
    heat = {
        (key, attend): saliency(parts[key], gain)
        for key, (attend, gain) in product(images, gains.items())
    }
    return heat, {attend: salient_object(boxes, heat[name, attend]) for attend in gains}


def saliency_view(image, heat):
    """An image lit by its saliency, and its most salient place."""
    lit = np.uint8(image * (0.15 + 0.85 * heat[..., None]))
    return photo_view(lit, points=[(most_salient(heat), "", "orange")])


def saliency_in_words(heat, thing, attend):
    """What `saliency_view` draws, in words: of a photo of a `thing`, with `attend` of CONTRASTS."""
    high, wide = heat.shape
    x, y = most_salient(heat)
    return (
        f"{thing}: bright where {CONTRASTS[attend]} most from what lies around, dark elsewhere. A "
        f"circle at {x / wide:.0%} of the way to the right and {y / high:.0%} of the way down."
    )


def segments_view(image, labels):
    """An image's segments in their mean colours, and how many they are."""
    return photo_view(mosaic(image, labels), [in_corner(f"{labels.max() + 1} segments")])


def segments_in_words(name, labels, k):
    """The same in words, of a photo by its `name`, cut with a scale `k`."""
    return f"{name}, cut with k = {k} into {labels.max() + 1} segments, each in its mean colour."


def merging_parts(photo, tree):
    """What `merging_view` shows of a photo and its hierarchy, in small arrays by name."""
    labels = tree.labels.astype(np.min_scalar_type(tree.labels.max()))
    colours = mean_colours(photo.image, labels)
    rest = {"merges": np.uint16(tree.merges), "boxes": np.int16(tree.boxes)}
    return {"truth": dict(photo.boxes), "colours": colours, "labels": labels} | rest


def merging_view(truth, colours, labels, merges, boxes, percent):
    """The regions after so many of a hierarchy's merges, and the best overlap so far."""
    made, every = round(percent / 100 * len(merges)), np.float64(boxes)
    now = len(merges) + 1 + made
    newest = [(every[now - 1], "", "orange")] if made else []
    blend = mosaic(colours[labels], Hierarchy(labels, merges, boxes).after(made))
    view = photo_view(blend, newest + nearest(truth, every[:now]))
    return view, overlap_curves(best_so_far(truth, every), now)


def mean_best_overlap(photo, boxes):
    """The mean, over a photo's objects, of the best IoU that one of boxes (n, 4) reaches."""
    return iou(list(photo.boxes.values()), boxes).max(1).mean()


def grow_with_each(image):
    """The hierarchy of each colour space and choice of measures: (space, measures) -> tree."""
    switches = product([True, False], repeat=len(ALL))
    subsets = [tuple(compress(ALL, on)) for on in switches]
    trees = hierarchies(image, Strategy(SPACES, (100,), tuple(subsets)))
    return dict(zip(product(SPACES, subsets), trees, strict=True))


def overlaps_by_measure(shots):
    """`mean_best_overlap` in each photo with each measure of similarity: name -> (photos,)."""
    ways = {name: (name,) for name in ALL} | {"all four": tuple(ALL), "none": ()}
    strategy = Strategy(similarities=tuple(ways.values()))
    rows = [
        [mean_best_overlap(photo, tree.boxes) for tree in hierarchies(photo.image, strategy)]
        for photo in shots
    ]
    return dict(zip(ways, np.transpose(rows), strict=True))


def merging_in_words(truth, merges, boxes, percent, **_):
    """What `merging_view` shows, in words."""
    made = round(percent / 100 * len(merges))
    now = len(merges) + 1 + made
    best = best_so_far(truth, np.float64(boxes))
    fits = ", ".join(f"{name} {overlap[now - 1]:.2f}" for name, overlap in best.items())
    return (
        f"A photo as {len(merges) + 1 - made} segments in their mean colours, after {made} of "
        f"{len(merges)} merges; green, the best box so far for each thing: {fits}. Beside it, how "
        "these overlaps rose with each region made."
    )


def best_boxes_in_words(name, photo, boxes):
    """What `best_boxes_view` shows of a photo by its `name`, in words."""
    best = iou(list(photo.boxes.values()), boxes).max(1)
    fits = ", ".join(f"{k} {overlap:.2f}" for k, overlap in zip(photo.boxes, best, strict=True))
    return f"{name}, and the best box for each thing, with its overlap: {fits}."


def best_boxes_view(photo, boxes):
    """A photo with the best of boxes (n, 4) for each object, and their mean IoU."""
    words = in_corner(f"mean {mean_best_overlap(photo, boxes):.2f}")
    return photo_view(photo.image, [words, *nearest(photo.boxes, boxes)])


def overlap_curve(photo, boxes):
    """For each object, the best IoU among the first 1, 2, … of `MOST` boxes (objects, MOST)."""
    best = np.array(list(best_so_far(photo.boxes, boxes[:MOST]).values()))
    return np.pad(best, [(0, 0), (0, MOST - best.shape[1])], mode="edge")


def proposal_curves(shots, rng):
    """`overlap_curve` of all objects of photos, for each of the `PROPOSALS`: name -> (n, MOST)."""
    curves = []
    for photo in shots:
        windows = sliding_windows(photo.image.shape[:2], rng)
        by_edges = windows[np.argsort(-edge_density(photo.image, windows))]
        lists = candidates(photo), windows, by_edges
        curves.append([np.float32(overlap_curve(photo, boxes)) for boxes in lists])
    joined = map(np.concatenate, zip(*curves, strict=True))
    return dict(zip(PROPOSALS, joined, strict=True))


def recall_table(kinds, strategies):
    """The recall at an overlap of 0.8 that candidates allow, by kind of photo: a Markdown table."""
    rows = {
        name: [final_recall(shots, name, 0.8) for shots in kinds.values()] for name in strategies
    }
    return table(["grouping", *kinds], rows, ".2f")


def windows_ahead(curves, overlaps):
    """How much more windows in random order find than selective search does: overlap -> share."""
    ours, random = (
        np.array([(curves[name][:, -1] >= t).mean() for t in overlaps]) for name in PROPOSALS[:2]
    )
    return dict(zip(map("{:g}".format, overlaps), random - ours, strict=True))


def growth_of_time():
    """Processor time by pixels, of ours and of OpenCV: name -> (n, 2)."""
    growth = {}
    for row in results.records("bench/selective_search_growth")["rows"]:
        growth.setdefault(row["by"], []).append((row["pixels"], row["processor s"]))
    return {name: np.array(points) for name, points in growth.items()}


def final_recall(shots, strategy, overlap):
    """The share of photos' objects that a list of candidates, to its end, finds at an overlap."""
    curves = [overlap_curve(photo, candidates(photo, strategy)) for photo in shots]
    return (np.concatenate(curves)[:, -1] >= overlap).mean()


def recall_plot(curves, overlap):
    """Recall at an overlap against boxes tried, of what `proposal_curves` returned: a figure."""
    fig, ax = panels(size=(4.3, 3.4))
    for (name, best), colour in zip(curves.items(), COLOURS.values(), strict=False):
        share = (best >= np.float32(overlap)).mean(0)
        tried = np.arange(1, len(share) + 1)
        over = {"clip_on": False, "zorder": 3}  # a recall of 0 lies on the axis
        ax.semilogx(tried, share, label=f"{name} {share[-1]:.2f}", color=colour, **over)
    ax.set(xlabel="boxes tried, a photo", ylabel="recall", ylim=(0, 1.02))
    legend_above(fig, 0.75)
    return fig


def growth_plot(growth, count):
    """Processor time against pixels, name -> (n, 2), for the first photos: a log-log figure."""
    fig, ax = panels(size=(4.3, 3.4))
    for (name, points), colour in zip(growth.items(), COLOURS.values(), strict=False):
        x, y = points.T
        ax.loglog(x, x / x[2] * y[2], ":", color=colour)
        ax.loglog(x[:count], y[:count], "o-", label=name, color=colour)
    ours = next(iter(growth.values()))[:, 1]
    ax.set_title(f"ours: {ours[count - 1] / ours[2]:.1f} times as long as 600 × 400")
    ax.set(xlabel="pixels", ylabel="processor time of single (s)")
    ax.legend()
    return fig


def first_dozen(image, truth):
    """The first dozen candidates (12, 4), and which of the true boxes one of them fits by 0.5."""
    boxes = propose(image)[:12]
    return boxes, iou(truth, boxes).max(1) >= 0.5


def first_dozen_view(image, truth=None):
    """An image with its first dozen candidates; true boxes (n, 4), where known, by fit."""
    if truth is None:
        return photo_view(image, [(box, "", "blue") for box in propose(image)[:12]])
    boxes, fits = first_dozen(image, truth)
    marks = [(box, "", "blue") for box in boxes] + [in_corner(f"{fits.sum()} of {len(truth)}")]
    marks += [(box, "", "green" if fit else "red") for box, fit in zip(truth, fits, strict=True)]
    return photo_view(image, marks)
