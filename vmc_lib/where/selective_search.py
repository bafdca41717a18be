"""Selective search: object candidates by hierarchical grouping of segments.

The most similar neighbours merge, again and again; every region on the way, from a patch of cork to
the whole table, is a candidate (Uijlings et al. 2013; the paper's Block 1-1, bottom-up part).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from itertools import chain
from numbers import Integral

import numpy as np

from vmc_lib.checks import as_numbers, check_count, check_kind, check_rng, is_within
from vmc_lib.compiled import compiled
from vmc_lib.photos import as_float
from vmc_lib.short_repr import short
from vmc_lib.where.appearance import (
    COLOUR_SPACES,
    MEASURES,
    Appearance,
    colour_codes,
    describe,
    merge_regions,
    similarity,
    texture_codes,
)
from vmc_lib.where.segmentation import find, segmentations


@dataclass(frozen=True)
class Hierarchy:
    """Hierarchical grouping of one segmentation into one region."""

    labels: np.ndarray  # (height, width) the n segments, 0 to n - 1
    merges: np.ndarray  # (n - 1, 2) the two regions merged at each step; step t makes region n + t
    boxes: np.ndarray  # (2n - 1, 4) around every region, in the order in which they are made

    def after(self, steps: int) -> np.ndarray:
        """Labels (height, width) after so many merges; a region keeps its number until merged."""
        n = len(self.merges) + 1
        check_count("steps", steps)
        if steps >= n:
            raise ValueError(f"steps = {steps}: this hierarchy has {n - 1} merges")
        into = np.arange(n + steps)
        for new in reversed(range(n, n + steps)):
            into[self.merges[new - n]] = into[new]
        return into[self.labels]


def adjacent_regions(labels: np.ndarray) -> np.ndarray:
    """Pairs (m, 2) of regions that share a border, each pair once, the lower number first."""
    labels = np.asarray(labels)
    if labels.ndim != 2 or labels.dtype.kind not in "iu":
        raise ValueError(f"labels {labels.dtype} {labels.shape}: give what segment(…) returns")
    n = labels.max() + 1
    sides = (labels[:, :-1], labels[:, 1:]), (labels[:-1], labels[1:])
    pairs = np.hstack([[one[one != other], other[one != other]] for one, other in sides])
    return np.stack(np.divmod(np.unique(pairs.min(0) * n + pairs.max(0)), n), axis=1)


def grow(labels: np.ndarray, appearance: Appearance, measures: tuple[bool, ...]) -> Hierarchy:
    """Hierarchical grouping: merge the two most similar neighbours until one region is left.

    The Appearance describes the segments in `labels`; its empty rows are filled. `measures` are the
    names that count of MEASURES (with none, the lowest numbers merge first). A merged region's row
    follows from its two parts' rows, so no step reads a pixel, and a heap has the best pair at
    hand: n segments cost about n log n.
    """
    used = tuple(name in measures for name in MEASURES)
    merges = _merge_all(appearance, adjacent_regions(labels), used)
    return Hierarchy(labels, merges, appearance.boxes.copy())


@compiled
def _merge_all(regions, pairs, measures):
    """Which two regions each step merges, (n - 1, 2); fills the empty rows of an Appearance."""
    total = len(regions.size)
    parent, last_seen = np.arange(total), np.zeros(total, np.int64)
    neighbours = [[i for i in range(0)] for _ in range(total)]  # so that numba knows their type
    for i, j in pairs:
        neighbours[i].append(j)
        neighbours[j].append(i)
    first = similarity(regions, pairs, measures)
    queue = [(-first[p], pairs[p, 0], pairs[p, 1]) for p in range(len(pairs))]
    heapify(queue)
    merges = np.empty((total // 2, 2), np.int64)
    for new in range(total - len(merges), total):
        _, i, j = heappop(queue)
        while parent[i] != i or parent[j] != j:  # one of the two has been merged away since
            _, i, j = heappop(queue)
        merges[new - total] = i, j
        merge_regions(regions, i, j, new)
        parent[i] = parent[j] = new
        for k in neighbours[i] + neighbours[j]:
            k = find(parent, k)  # by now
            if k != new and last_seen[k] != new:
                last_seen[k] = new
                neighbours[new].append(k)
        around = np.full((len(neighbours[new]), 2), new)
        for p, k in enumerate(neighbours[new]):
            around[p, 0] = k
        scores = similarity(regions, around, measures)
        for p, k in enumerate(neighbours[new]):
            heappush(queue, (-scores[p], k, new))
    return merges


ALL, COLOURLESS = MEASURES, MEASURES[1:]


@dataclass(frozen=True)
class Strategy:
    """Which hierarchies to grow: one for every colour space, scale and set of MEASURES.

    ValueError for a name that is none of COLOUR_SPACES, or of MEASURES, for a scale that is no
    finite number above 0, and where any of the three is empty.
    """

    colours: tuple = ("HSV",)
    k: tuple = (100,)  # scales of the segmentation
    similarities: tuple = (ALL,)

    def __post_init__(self) -> None:
        for names in (self.colours, self.similarities, *self.similarities):
            if not isinstance(names, tuple | list):
                raise ValueError(f"{names!r} in {self}: give names in a tuple, as ({names!r},)")
        named = (self.colours, COLOUR_SPACES), (chain(*self.similarities), MEASURES)
        for names, known in named:
            for name in names:
                if name not in known:
                    raise ValueError(f"{name!r} is none of {', '.join(known)}")
        scales = as_numbers("k", self.k)
        if scales.ndim != 1 or not (np.isfinite(scales) & (scales > 0)).all():
            raise ValueError(f"k = {self.k}: give a tuple of finite numbers above 0")
        if not (len(self.colours) and len(scales) and len(self.similarities)):
            raise ValueError(f"{self} grows no hierarchy: give one of each or more")


# Uijlings et al. (2013). Their fast has k of 50 and 100: ours makes shorter lists, as good
# at equal length on training and further validation photos. "diverse" and "finer" are ours: the
# first is what the paper's words ask for, its k fitted on training photos to the paper's 130 boxes
# (with ALL alone and as many boxes, fewer objects of the rig's validation photos have a good one).
STRATEGIES = {
    "single": Strategy(),
    "fast": Strategy(("HSV", "Lab"), (75, 150), (ALL, COLOURLESS)),
    "quality": Strategy(
        ("HSV", "Lab", "rgI", "H", "I"),
        (50, 100, 150, 300),
        (ALL, COLOURLESS, ("fill",), ("size",)),
    ),
    "diverse": Strategy(("HSV", "Lab"), (155,), (ALL, COLOURLESS)),
    "finer": Strategy(("HSV", "Lab"), (50,)),
}


def hierarchies(image: np.ndarray, strategy: Strategy) -> Iterator[Hierarchy]:
    """Grow every Hierarchy of a Strategy on an image, one by one."""
    check_kind("strategy", strategy, Strategy, "one of STRATEGIES, by its name")
    rgb = as_float(image)
    for colour in strategy.colours:
        channels = COLOUR_SPACES[colour](rgb)
        codes = colour_codes(channels), texture_codes(channels)
        for labels in segmentations(channels, strategy.k):
            appearance = describe(labels, *codes)
            for similarities in strategy.similarities:
                yield grow(labels, appearance, similarities)


def rank_boxes(
    trees: Iterable[Hierarchy], rng: np.random.Generator, smallest: float = 20
) -> np.ndarray:
    """Pool and rank the boxes (n, 4) of several hierarchies, none twice.

    Each hierarchy ranks its regions from the last made (the largest) down; a rank is then
    multiplied by a number drawn from `rng`, so that neither large boxes nor one hierarchy come
    all first (Uijlings et al. 2013). Boxes narrower or lower than `smallest` pixels
    are left out.
    """
    check_rng(rng)
    if not is_within(smallest, -np.inf, np.inf):
        raise ValueError(f"smallest = {short(smallest)}: give pixels, as 20")
    boxes, ranks = [], []
    for tree in trees:
        n = len(tree.boxes)
        boxes.append(tree.boxes)
        ranks.append(np.arange(n, 0, -1) * rng.random(n))
    if not boxes:
        raise ValueError("there is no hierarchy to rank boxes of: give one or more")
    boxes = np.concatenate(boxes)[np.argsort(np.concatenate(ranks))]
    _, first = np.unique(boxes, axis=0, return_index=True)
    boxes = boxes[np.sort(first)]
    return boxes[(boxes[:, 2:] - boxes[:, :2] >= smallest).all(1)]


def propose(
    image: np.ndarray,
    strategy: str | Strategy = "single",
    rng: np.random.Generator | int | None = None,
) -> np.ndarray:
    """Object candidates of an image by selective search.

    Parameters
    ----------
    image : array as `photos.as_float` takes it, of any size
    strategy : name of one of STRATEGIES, or a Strategy
    rng : numpy.random.Generator of the ranks, or its seed; without, every call ranks alike

    Returns
    -------
    (n, 4) array of (x0, y0, x1, y1), pixels, as `rank_boxes` orders them; a blank image gives one
    box, one with a side under 20 pixels none

    Raises
    ------
    ValueError
        For an unknown strategy, and for an array that is no image.

    References
    ----------
    Uijlings et al. (2013), Selective search for object recognition.

    Examples
    --------
    >>> propose(np.zeros((40, 60, 3))).tolist()
    [[0.0, 0.0, 60.0, 40.0]]
    """
    if not isinstance(strategy, Strategy):
        if not isinstance(strategy, str) or strategy not in STRATEGIES:
            raise ValueError(f"strategy {strategy!r} is none of {', '.join(STRATEGIES)}")
        strategy = STRATEGIES[strategy]
    if isinstance(rng, str | float) or (isinstance(rng, Integral) and rng < 0):
        raise ValueError(
            f"rng {short(rng)}: give a seed, 0 or more, or np.random.default_rng(seed)"
        )
    rng = np.random.default_rng(0 if rng is None else rng)
    return rank_boxes(hierarchies(image, strategy), rng)
