"""Which candidates are worth a look: a classifier scores them, the best silence their neighbours.

The paper's Block 1-1, top-down part. Candidates that overlap an object by 0.8 are examples, those
that overlap none by more than 0.5 are counter-examples; a support vector machine learns the
difference from raw pixels, and non-maximum suppression leaves a few boxes. `PUBLISHED` is that
recipe. `IMPROVED` sees gradients and a margin too, looks again at each box to correct it, and lets
neighbours vote. `python -m vmc_lib.where.regions` trains both on every level and stores them.
"""

from dataclasses import dataclass, replace
from functools import cache
from itertools import product
from pathlib import Path

import numpy as np
from sklearn.linear_model import Ridge
from sklearn.metrics.pairwise import pairwise_kernels
from sklearn.svm import SVC

from vmc_lib import photos

from .boxes import iou, nms
from .features import gradients, raw_pixels
from .selective_search import propose

FEATURES = {"raw": raw_pixels, "gradients": gradients}
KERNELS = ("linear", "poly", "rbf", "sigmoid")
DATA = Path(__file__).parents[1] / "data"


@dataclass(frozen=True)
class Recipe:
    """How to choose regions; the defaults are the paper's."""

    strategy: str = "single"  # of selective search
    features: tuple = ("raw",)
    kernel: str = "linear"
    cost: float = 0.1  # of an example on the wrong side
    gate: float = 0.0  # candidates that score above it pass
    looks: int = 0  # how often a box is corrected by what it shows
    threshold: float = 0.0  # what the boxes must score in the end
    overlap: float = 0.3  # that non-maximum suppression allows
    vote: bool = False  # boxes silenced by a better one still pull at its sides
    mirror: bool = False  # learn from the photos' mirror images too

    def describe(self, image, boxes):
        """The features (n, d) of boxes (n, 4) of an image."""
        return np.hstack([FEATURES[name](image, boxes) for name in self.features])


PUBLISHED = Recipe()
RICHER = Recipe(features=("raw", "gradients"), mirror=True)
LOOKING = replace(RICHER, gate=-1, looks=3)
IMPROVED = replace(LOOKING, vote=True)
RECIPES = {"published": PUBLISHED, "gradients": RICHER, "looks": LOOKING, "improved": IMPROVED}
PARTS = ("gamma", "support", "weights", "bias", "maps")  # of a finder, as they are stored


@cache
def stored(name):
    """The arrays of the data file `name`.npz, by name."""
    with np.load(DATA / f"{name}.npz", allow_pickle=False) as file:
        return dict(file)


def candidates(photo, strategy="single"):
    """`propose(photo.image, strategy)`, looked up where the photo ships with its candidates."""
    boxes = stored("candidates").get(f"{photo.name}/{strategy}")
    return propose(photo.image, strategy) if boxes is None else boxes.astype(float)


# ---------------------------------------------------------------- learning to tell


@dataclass(frozen=True)
class Machine:
    """A kernel machine: score(x) = Σ weights · K(support, x) + bias."""

    kernel: str
    gamma: float
    support: np.ndarray  # (s, d)
    weights: np.ndarray  # (s,)
    bias: float

    @classmethod
    def fit(cls, x, y, kernel="linear", cost=0.1):
        """A support vector machine for features x (n, d) and labels y (n,), true or false.

        ValueError for an unknown kernel, and where one of the two labels has no example.
        """
        if kernel not in KERNELS:
            raise ValueError(f"kernel {kernel!r} is none of {', '.join(KERNELS)}")
        if len(np.unique(y)) < 2:
            raise ValueError("a classifier needs examples and counter-examples: give more photos")
        svc = SVC(C=cost, kernel=kernel, gamma="scale", cache_size=500).fit(x, y)
        support, weights = svc.support_vectors_, svc.dual_coef_[0]
        if kernel == "linear":  # then the sum is one term: a weight for each feature
            support, weights = (weights @ support)[None], np.ones(1)
        return cls(kernel, svc._gamma, support, weights, svc.intercept_[0])

    def score(self, x):
        """How far each row of x (n, d) lies on the examples' side, in margins: (n,)."""
        shape = {"gamma": self.gamma, "degree": 3, "coef0": 0.0}
        alike = pairwise_kernels(x, self.support, self.kernel, filter_params=True, **shape)
        return alike @ self.weights + self.bias


def scenes(photos, recipe):
    """What a recipe learns from, scene by scene: an image, its true boxes, its candidates.

    A shuttlecock and a cup are the same to the "where" pathway: general objects.
    """
    for photo in photos:
        truth, boxes = np.array(list(photo.boxes.values())), candidates(photo, recipe.strategy)
        yield photo.image, truth, boxes
        if recipe.mirror:
            width = photo.image.shape[1]
            yield photo.image[:, ::-1], mirrored(truth, width), mirrored(boxes, width)


def mirrored(boxes, width):
    """Boxes (n, 4) in the mirror image of an image of that width."""
    return np.stack([width - boxes[:, 2], boxes[:, 1], width - boxes[:, 0], boxes[:, 3]], axis=1)


def examples(photos, recipe=PUBLISHED):
    """Training data of the classifier: features x (n, d), labels y (n,)."""
    x, y = [], []
    for image, truth, boxes in scenes(photos, recipe):
        overlap = iou(boxes, truth).max(1)
        clear = (overlap >= 0.8) | (overlap <= 0.5)
        x.append(recipe.describe(image, boxes[clear]))
        y.append(overlap[clear] >= 0.8)
    return np.concatenate(x), np.concatenate(y)


# ---------------------------------------------------------------- learning to correct a box


def corrections(boxes, truth):
    """How to move (in sides) and stretch (as logarithms) each box to its true box: (n, 4)."""
    sides, true_sides = boxes[:, 2:] - boxes[:, :2], truth[:, 2:] - truth[:, :2]
    way = (truth[:, :2] + truth[:, 2:] - boxes[:, :2] - boxes[:, 2:]) / 2
    return np.hstack([way / sides, np.log(true_sides / sides)])


def corrected(boxes, corrections):
    """Boxes (n, 4) moved and stretched by corrections (n, 4)."""
    sides = boxes[:, 2:] - boxes[:, :2]
    centre = (boxes[:, :2] + boxes[:, 2:]) / 2 + corrections[:, :2] * sides
    half = sides * np.exp(corrections[:, 2:]) / 2
    return np.hstack([centre - half, centre + half])


def learn_to_look(photos, recipe, rng, scattered=1600, spread=0.15, penalty=10):
    """One linear map (d + 1, 4) a look, from what a box shows to its correction.

    Box regression (Girshick et al. 2014), from about `scattered` boxes near each kind of object,
    off by `spread` of a side; each look learns from the boxes that the look before it leaves.
    """
    images, truth, _ = zip(*scenes(photos, recipe), strict=True)
    truth = [np.repeat(true, scattered // len(truth), axis=0) for true in truth]
    boxes = [corrected(true, rng.normal(scale=spread, size=true.shape)) for true in truth]
    maps = []
    for _ in range(recipe.looks):
        x = [recipe.describe(*pair) for pair in zip(images, boxes, strict=True)]
        goal = [corrections(*pair) for pair in zip(boxes, truth, strict=True)]
        ridge = Ridge(penalty).fit(np.concatenate(x), np.concatenate(goal))
        maps.append(np.vstack([ridge.coef_.T, ridge.intercept_]))
        boxes = [corrected(b, ridge.predict(shown)) for b, shown in zip(boxes, x, strict=True)]
    return tuple(maps)


# ---------------------------------------------------------------- the two together


@dataclass(frozen=True)
class Regions:
    """What the search of one image came to, step by step (the paper's Fig. 6)."""

    candidates: np.ndarray  # (n, 4) of selective search
    candidate_scores: np.ndarray  # (n,)
    passed: np.ndarray  # (m, 4) boxes above the threshold, after their corrections if any
    passed_scores: np.ndarray  # (m,)
    boxes: np.ndarray  # (k, 4) left by non-maximum suppression, the best first
    scores: np.ndarray  # (k,)

    @property
    def counts(self):
        """How many boxes each step leaves."""
        steps = self.candidates, self.passed, self.boxes
        return dict(zip(("candidates", "passed", "kept"), map(len, steps), strict=True))


@dataclass(frozen=True)
class RegionFinder:
    """A trained recipe: finds the few boxes of an image that hold an object."""

    recipe: Recipe
    machine: Machine
    maps: tuple  # of (d + 1, 4), one a look, from what a box shows to its correction

    @classmethod
    def fit(cls, photos, recipe=PUBLISHED, rng=None):
        """Learn from photos; `rng` scatters their true boxes, to learn corrections from."""
        machine = Machine.fit(*examples(photos, recipe), recipe.kernel, recipe.cost)
        return cls(recipe, machine, learn_to_look(photos, recipe, rng or np.random.default_rng(0)))

    @classmethod
    def load(cls, level, name="improved"):
        """The shipped finder of a level, by the name of its recipe; ValueError for another."""
        learnt = stored("regions")
        if f"{level}/{name}/bias" not in learnt:
            raise ValueError(f"no finder {name!r} for level {level!r}: see {', '.join(RECIPES)}")
        *machine, maps = (learnt[f"{level}/{name}/{part}"].astype(float) for part in PARTS)
        return cls(RECIPES[name], Machine(RECIPES[name].kernel, *machine), tuple(maps))

    def score(self, image, boxes):
        """The classifier's score (n,) of boxes (n, 4) in an image."""
        if not len(boxes):
            return np.empty(0)
        return self.machine.score(self.recipe.describe(image, boxes))

    def look_again(self, image, boxes, looks=None):
        """The boxes (n, 4), each corrected by what it shows, `looks` times (by default all)."""
        for weights in self.maps[:looks]:
            boxes = corrected(
                boxes, self.recipe.describe(image, boxes) @ weights[:-1] + weights[-1]
            )
        return boxes

    def find(self, image, boxes=None):
        """The Regions of a uint8 image; `boxes` are its candidates, if they are known already.

        With nothing to find, `boxes` and `scores` are empty. ValueError as for `propose`.
        """
        recipe = self.recipe
        boxes = propose(image, recipe.strategy) if boxes is None else boxes
        scores = self.score(image, boxes)
        passed, passed_scores = boxes[scores > recipe.gate], scores[scores > recipe.gate]
        if self.maps:
            passed = self.look_again(image, passed)
            passed_scores = self.score(image, passed)
            good = passed_scores > recipe.threshold
            passed, passed_scores = passed[good], passed_scores[good]
        kept = nms(passed, passed_scores, recipe.overlap)
        best = vote(passed[kept], passed, passed_scores) if recipe.vote else passed[kept]
        return Regions(boxes, scores, passed, passed_scores, best, passed_scores[kept])


def vote(kept, boxes, scores):
    """Each kept box replaced by the mean of the boxes that overlap it by half or more.

    A vote weighs as its score exceeds the lowest (after Gidaris & Komodakis 2015).
    """
    weights = np.where(iou(kept, boxes) >= 0.5, scores - scores.min(initial=0) + 1e-6, 0)
    return weights @ boxes / weights.sum(1, keepdims=True)


def store_candidates():
    """Search every photo for candidates, and store them."""
    found = {}
    for level, split in product(photos.LEVELS, photos.SPLITS):
        for photo in photos.load(level, split):
            found[f"{photo.name}/single"] = propose(photo.image).astype(np.int16)
    np.savez_compressed(DATA / "candidates.npz", **found)
    stored.cache_clear()


def store_finders():
    """Train every recipe on every level, and store what they learnt."""
    learnt = {}
    for level, (name, recipe) in product(photos.LEVELS, RECIPES.items()):
        finder = RegionFinder.fit(photos.load(level, "train"), recipe)
        parts = vars(finder.machine) | {"maps": finder.maps}
        for part in PARTS:
            learnt[f"{level}/{name}/{part}"] = np.array(parts[part], np.float32)
    np.savez_compressed(DATA / "regions.npz", **learnt)


if __name__ == "__main__":
    store_candidates()
    store_finders()
