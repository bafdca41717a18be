"""Selective search beside its peers: time, memory, and how well the boxes fit what is there.

The peers are OpenCV's contrib module and PyPI's `selectivesearch`. The objects are those of 120
training and validation renders, of all levels, and of real photos: those of everyday things and the
training photographs (*quality*, which takes long: of ten photos of each at most).
Boxes under 20 pixels are dropped from every list. Recall is the share of objects with a box at
that overlap, ABO the average best overlap; "equal" cuts the lists of OpenCV and ours, photo by
photo, to the shorter one. Our ranks hold a random draw: what depends on it is a mean over ten. The
renders and everyday things had been seen when the scales of our *fast* were settled.
"""

import subprocess
import sys
import warnings
from itertools import product
from time import perf_counter, process_time

import cv2
import numpy as np

from tools.bench.report import publish
from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.where.selective_search import STRATEGIES, hierarchies, rank_boxes

cv2.setNumThreads(1)
SMALLEST, DRAWS = 20, 10
SIZES = [(150, 100), (300, 200), (600, 400), (1200, 800), (2100, 1400), (3000, 2000)]


def our_orders(image, strategy):
    """Boxes (n, 4), in the order of every draw."""
    trees = list(hierarchies(image, STRATEGIES[strategy]))
    return [rank_boxes(trees, np.random.default_rng(draw), SMALLEST) for draw in range(DRAWS)]


def opencv_orders(image, strategy):
    search = cv2.ximgproc.segmentation.createSelectiveSearchSegmentation()
    search.setBaseImage(np.ascontiguousarray(image[..., ::-1]))
    {
        "single": search.switchToSingleStrategy,
        "fast": search.switchToSelectiveSearchFast,
        "quality": search.switchToSelectiveSearchQuality,
    }[strategy]()
    return [large_boxes(search.process())]


def pypi_orders(image, _):
    """With the settings of its README; its last region, the largest, first."""
    from selectivesearch import selective_search  # here, for it would weigh on the others' memory

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        _, regions = selective_search(image, scale=500, sigma=0.9, min_size=10)
    return [large_boxes(list(dict.fromkeys(region["rect"] for region in reversed(regions))))]


def large_boxes(rects):
    """Boxes (n, 4) from those rows of x, y, width, height that are not too small."""
    rects = np.array(rects, float)
    rects = rects[(rects[:, 2:] >= SMALLEST).all(1)]
    return np.hstack([rects[:, :2], rects[:, :2] + rects[:, 2:]])


METHODS = {
    "ours": our_orders,
    "OpenCV contrib": opencv_orders,
    "PyPI selectivesearch": pypi_orders,
}
ENTRANTS = {"single": list(METHODS), "fast": list(METHODS)[:2], "quality": list(METHODS)[:2]}


def time_search(method, image, strategy):
    """What a method proposes, its wall time and its processor time (s)."""
    wall, busy = perf_counter(), process_time()
    orders = METHODS[method](image, strategy)
    return orders, perf_counter() - wall, process_time() - busy


def photo_mosaic(width, height):
    """The middle of a mosaic of 5 x 5 photos: content grows with the pixels."""
    shots = [p.image for p in photos.load("varied", "validation")[:14] + list(photos.everyday())]
    rows = [np.hstack(shots[5 * row : 5 * row + 5]) for row in range(5)]
    x, y = (3000 - width) // 2, (2000 - height) // 2
    return np.vstack(rows)[y : y + height, x : x + width].copy()


MB, SECONDS = ("MB at rest", "MB at most"), ("processor s, first", "processor s")


def process_cost(method, strategy, image, again=1):
    """What searching an image takes a process that has searched a tiny part of it before.

    MB with the image loaded, and at most; processor s of the first search, and the least that
    one of so many more takes.
    """
    code = f"""
import sys
from tools.bench.selective_search import np, time_search
memory = lambda kind: int(open("/proc/self/status").read().split(kind + ":")[1].split()[0]) >> 10
image = np.frombuffer(sys.stdin.buffer.read(), np.uint8).reshape({image.shape})
rest = memory("VmRSS")
search = lambda image: time_search({method!r}, image, {strategy!r})[2]
search(image[:100, :150].copy())
print(rest, search(image), memory("VmHWM"), min(search(image) for _ in range({again})))
"""
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, input=image.tobytes(), capture_output=True, check=True)
    rest, first, most, again = map(float, done.stdout.split())
    megabytes = dict(zip(MB, (int(rest), int(most)), strict=True))
    return megabytes, dict(zip(SECONDS, (round(first, 3), round(again, 3)), strict=True))


def overlap_scores(runs, pictures, limits):
    """Recall and ABO among the first boxes, up to its limit, of each photo's list."""
    best = [
        iou(list(photo.boxes.values()), order[:limit]).max(1, initial=0)
        for orders, photo, limit in zip(runs, pictures, limits, strict=True)
        for order in orders
    ]
    best = np.concatenate(best)
    values = (best >= 0.5).mean(), (best >= 0.8).mean(), best.mean()
    return dict(zip(("recall .5", "recall .8", "ABO"), np.round(values, 3).tolist(), strict=True))


def compare(name, pictures, strategy, costs):
    """A row for every entrant of a strategy on some photos."""
    runs = {m: [time_search(m, p.image, strategy) for p in pictures] for m in ENTRANTS[strategy]}
    count = {m: np.array([len(orders[0]) for orders, _, _ in run]) for m, run in runs.items()}
    equal = np.minimum(count["ours"], count["OpenCV contrib"])
    for method, run in runs.items():
        orders, seconds, busy = zip(*run, strict=True)
        at_equal = overlap_scores(orders, pictures, equal)
        yield {
            "photos": f"{len(pictures)} {name}",
            "strategy": strategy,
            "by": method,
            "s": round(float(np.median(seconds)), 2),
            "processor s": round(float(np.median(busy)), 2),
            **costs[strategy, method],
            "boxes": round(float(count[method].mean())),
            **overlap_scores(orders, pictures, count[method]),
            "ABO of 300": overlap_scores(orders, pictures, np.full(len(pictures), 300))["ABO"],
            **{f"{key}, equal": value for key, value in at_equal.items()},
        }


def renders():
    """Training and validation photos of all levels."""
    kinds = product(photos.LEVELS, ("train", "validation"))
    return [photo for kind in kinds for photo in photos.load(*kind)[:20]]


def real_photos():
    """Photos that no renderer made, in which something is boxed."""
    return [p for p in (*photos.everyday(), *photos.load(photos.REAL_LEVEL, "train")) if p.boxes]


def ten_of(pictures):
    """Ten of them at most, evenly spread."""
    return pictures[:: -(-len(pictures) // 10)]


def growth(method):
    """Rows for growing images: time and memory of *single*, and the powers of the pixels."""
    rows = []
    for width, height in SIZES:
        megabytes, seconds = process_cost(method, "single", photo_mosaic(width, height), again=3)
        rows.append({"by": method, "pixels": width * height, **seconds, **megabytes})
    pixels, *times = (np.log([row[key] for row in rows[1:]]) for key in ("pixels", *SECONDS))
    powers = (round(float(np.polyfit(pixels, busy, 1)[0]), 2) for busy in times)
    powers = dict(zip(("power, first", "power of the pixels"), powers, strict=True))
    return [row | powers for row in rows]


if __name__ == "__main__":
    sets = {"renders": renders(), "real photos": real_photos()}
    one = photo_mosaic(600, 400)
    costs = {
        (s, m): process_cost(m, s, one)[0] for s, entrants in ENTRANTS.items() for m in entrants
    }
    table = [
        row
        for strategy in ENTRANTS
        for name, pictures in sets.items()
        for row in compare(
            name, ten_of(pictures) if strategy == "quality" else pictures, strategy, costs
        )
    ]
    publish("selective_search", table)
    publish("selective_search_growth", growth("ours") + growth("OpenCV contrib"))
