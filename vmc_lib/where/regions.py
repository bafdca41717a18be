"""Which candidates are worth a look: a classifier scores them, the best silence their neighbours.

The paper's Block 1-1, top-down part. Candidates that overlap an object by 0.8 are examples, those
that overlap none by more than 0.5 are counter-examples; a support vector machine learns the
difference from raw pixels, and non-maximum suppression leaves a few boxes. `PUBLISHED` is that
recipe; each further one of `RECIPES` adds an idea: context, gradients, looks that correct a box, a
judge of how well it fits in the end, votes. `python -m vmc_lib.where.regions` trains all of them on
every level and stores them.
"""

from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product
from pathlib import Path

import numpy as np
from sklearn.linear_model import Ridge
from sklearn.metrics.pairwise import pairwise_kernels
from sklearn.svm import SVC

from vmc_lib import photos

from .boxes import iou, nms
from .features import gradients, raw_pixels
from .selective_search import Strategy, propose

FEATURES = {
    "pixels": raw_pixels,
    "context": partial(raw_pixels, margin=0.25),
    "gradients": gradients,
}
KERNELS = ("linear", "poly", "rbf", "sigmoid")
ROIS = 4700  # counter-examples to learn from, as in the paper; a random draw where there are more
SCATTERED = 12_800  # boxes, strewn about the true ones, that a look learns from
DATA = Path(__file__).parents[1] / "data"


@dataclass(frozen=True)
class Recipe:
    """How to choose regions; the defaults are the paper's."""

    strategy: str | Strategy = "single"  # of selective search
    features: str = "pixels"  # one of FEATURES
    kernel: str = "linear"
    cost: float = 0.1  # of an example on the wrong side
    gate: float = 0.0  # candidates that score above it pass
    shaken: int = 0  # more examples of each object: its true box, shaken a little
    mirror: bool = False  # learn from the photos' mirror images too
    looks: tuple = ()  # corrections of a box; how far off, in sides, each expects it to be
    judged: bool = False  # a second machine scores the boxes where the looks have led them
    vote: bool = False  # boxes silenced by a better one still pull at its sides
    overlap: float = 0.3  # that non-maximum suppression allows

    def describe(self, image, boxes):
        """The features (n, d) of boxes (n, 4) of an image."""
        return FEATURES[self.features](image, boxes)


PUBLISHED = Recipe()
CONTEXT = replace(PUBLISHED, features="context", shaken=5, mirror=True, gate=-1)
GRADIENTS = replace(CONTEXT, features="gradients")
LOOKS = replace(GRADIENTS, strategy=Strategy(("HSV", "Lab"), (50,)), looks=(0.15, 0.1, 0.07, 0.05))
JUDGED = replace(LOOKS, judged=True)
IMPROVED = replace(JUDGED, vote=True)
RECIPES = {
    "published": PUBLISHED,
    "context": CONTEXT,
    "gradients": GRADIENTS,
    "looks": LOOKS,
    "judged": JUDGED,
    "improved": IMPROVED,
}
LEARNT = {"looks": "improved", "judged": "improved"}  # these do less with the same training
PARTS = ("gamma", "support", "weights", "bias")  # of a machine, as they are stored


@cache
def stored(name):
    """The arrays of the data file `name`.npz, by name."""
    with np.load(DATA / f"{name}.npz", allow_pickle=False) as file:
        return dict(file)


def candidates(photo, strategy="single"):
    """`propose(photo.image, strategy)`, looked up where the photo ships with its candidates."""
    name = {LOOKS.strategy: "finer"}.get(strategy, strategy)
    boxes = stored("candidates").get(f"{photo.name}/{name}")
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


@dataclass(frozen=True)
class Scene:
    """What a recipe learns from: an image, its true boxes (m, 4), its candidates (n, 4)."""

    image: np.ndarray
    truth: np.ndarray
    boxes: np.ndarray

    @property
    def overlap(self):
        """How well each candidate fits the object it fits best: (n,)."""
        return iou(self.boxes, self.truth).max(1, initial=0)

    def mirrored(self):
        """The scene in a mirror."""
        width = self.image.shape[1]
        return Scene(self.image[:, ::-1], mirrored(self.truth, width), mirrored(self.boxes, width))

    def scattered(self, times, spread, rng):
        """Each true box so many times, and boxes that stray from it by `spread` of its sides."""
        truth = np.repeat(self.truth, times, axis=0)
        return truth, corrected(truth, rng.normal(scale=spread, size=truth.shape))


def mirrored(boxes, width):
    """Boxes (n, 4) in the mirror image of an image of that width."""
    return np.stack([width - boxes[:, 2], boxes[:, 1], width - boxes[:, 0], boxes[:, 3]], axis=1)


def scenes(photos, recipe):
    """The Scenes in which a recipe learns from photos.

    A shuttlecock and a cup are the same to the "where" pathway: general objects.
    """
    plain = [
        Scene(p.image, np.array(list(p.boxes.values())), candidates(p, recipe.strategy))
        for p in photos
    ]
    return plain + [scene.mirrored() for scene in plain] if recipe.mirror else plain


def examples(photos, recipe=PUBLISHED):
    """What the classifier is to tell apart: features x (n, d), labels y (n,).

    The clear cases among the photos' candidates: IoU of 0.8 and more, 0.5 and less.
    """
    x, y = [], []
    for scene in scenes(photos, replace(recipe, mirror=False)):
        overlap = scene.overlap
        clear = (overlap >= 0.8) | (overlap <= 0.5)
        x.append(recipe.describe(scene.image, scene.boxes[clear]))
        y.append(overlap[clear] >= 0.8)
    return np.concatenate(x), np.concatenate(y)


def training_examples(scenes, recipe, rng):
    """What the classifier learns from: every example, shaken ones too, and ROIS counter-examples.

    Returns features x (n, d), labels y (n,).
    """
    x, y = [], []
    for scene in scenes:
        overlap = scene.overlap
        good, bad = scene.boxes[overlap >= 0.8], scene.boxes[overlap <= 0.5]
        bad = rng.permutation(bad)[: -(-ROIS // len(scenes))]
        _, shaken = scene.scattered(recipe.shaken, 0.05, rng)
        x.append(recipe.describe(scene.image, np.vstack([good, shaken, bad])))
        y.append(np.arange(len(x[-1])) < len(good) + len(shaken))
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


def learn_to_look(scenes, recipe, rng, penalty=30):
    """One linear map (d + 1, 4) a look, from what a box shows to its correction.

    Box regression (Girshick et al. 2014), from true boxes that were scattered on purpose; the
    later a look, the nearer it expects the box to be.
    """
    times, maps = SCATTERED // sum(len(scene.truth) for scene in scenes) + 1, []
    for spread in recipe.looks:
        x, goal = [], []
        for scene in scenes:
            truth, boxes = scene.scattered(times, spread, rng)
            x.append(recipe.describe(scene.image, boxes))
            goal.append(corrections(boxes, truth))
        ridge = Ridge(penalty).fit(np.concatenate(x), np.concatenate(goal))
        maps.append(np.vstack([ridge.coef_.T, ridge.intercept_]))
    return tuple(maps)


def look_again(recipe, maps, image, boxes):
    """The boxes (n, 4), each corrected by what it shows, once for every map."""
    for weights in maps if len(boxes) else ():
        shown = recipe.describe(image, boxes)
        boxes = corrected(boxes, shown @ weights[:-1] + weights[-1])
    return boxes


# ---------------------------------------------------------------- learning to judge a fit


@dataclass(frozen=True)
class Judge:
    """Scores how well a box fits its object, from the features' main directions."""

    axes: np.ndarray  # (d, k)
    machine: Machine  # of RBF kernel

    @classmethod
    def fit(cls, scenes, recipe, gate, maps, rng, good=0.75, keep=8000, directions=60):
        """Learn to tell fits from misfits, the classifier's blind zone (0.5 to 0.8) included.

        Fits and near misses are true boxes, scattered; other misfits are candidates, and above all
        those that pass the `gate` (a Machine) and are led by the looks to what is no object.
        """
        times, x, y = SCATTERED // sum(len(scene.truth) for scene in scenes) // 3 + 1, [], []
        for scene in scenes:
            near = [scene.scattered(times, spread, rng)[1] for spread in (0.03, 0.08, 0.15)]
            some = rng.permutation(scene.boxes)[: 2 * SCATTERED // len(scenes)]
            off = some[iou(some, scene.truth).max(1) < 0.3]
            fooled = gate.score(recipe.describe(scene.image, off)) > recipe.gate
            led = look_again(recipe, maps, scene.image, off[fooled][:25])
            boxes = np.vstack([*near, led, some[:10]])
            x.append(recipe.describe(scene.image, boxes))
            y.append(iou(boxes, scene.truth).max(1) >= good)
        x, y = np.concatenate(x), np.concatenate(y)
        some = rng.permutation(len(x))[:keep]
        x, y = x[some], y[some]
        axes = np.linalg.eigh(np.cov(x.T))[1][:, -directions:]
        return cls(axes, Machine.fit(x @ axes, y, "rbf", 10))

    def score(self, x):
        """How well boxes with features x (n, d) fit, in margins: (n,)."""
        return self.machine.score(x @ self.axes)


# ---------------------------------------------------------------- all of it together


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
    maps: tuple = ()  # of (d + 1, 4), one a look, from what a box shows to its correction
    judge: Judge | None = None
    threshold: float = 0.0  # what the boxes must score in the end

    @classmethod
    def fit(cls, photos, recipe=PUBLISHED, rng=None):
        """Learn from photos; `rng` draws counter-examples and scatters boxes.

        The threshold stays 0: see `tuned`.
        """
        rng, seen = rng or np.random.default_rng(0), scenes(photos, recipe)
        x, y = training_examples(seen, recipe, rng)
        machine = Machine.fit(x, y, recipe.kernel, recipe.cost)
        maps = learn_to_look(seen, recipe, rng)
        judge = Judge.fit(seen, recipe, machine, maps, rng) if recipe.judged else None
        return cls(recipe, machine, maps, judge)

    def doing(self, name):
        """The same training used for the recipe `name`, which does less."""
        recipe = RECIPES[name]
        return replace(self, recipe=recipe, judge=self.judge if recipe.judged else None)

    def tuned(self, photos):
        """The same finder, with the threshold that is best on photos it did not learn from.

        The published recipe has none to choose: it stays at 0.
        """
        if self.recipe == PUBLISHED:
            return self
        lenient, scores, right, wanted = replace(self, threshold=-np.inf), [], [], 0
        for scene in scenes(photos, replace(self.recipe, mirror=False)):
            found = lenient.find(scene.image, scene.boxes)
            scores.append(found.scores)
            right.append(iou(found.boxes, scene.truth).max(1, initial=0) >= 0.8)
            wanted += len(scene.truth)
        best = best_threshold(np.concatenate(scores), np.concatenate(right), wanted)
        return replace(self, threshold=best)

    @classmethod
    def load(cls, level, name="improved"):
        """The shipped finder of a level, by the name of its recipe; ValueError for another."""
        learnt, key = stored("regions"), f"{level}/{LEARNT.get(name, name)}"
        if f"{level}/{name}/threshold" not in learnt:
            raise ValueError(f"no finder {name!r} for level {level!r}: see {', '.join(RECIPES)}")
        parts = {
            part.removeprefix(f"{key}/"): value.astype(float)
            for part, value in learnt.items()
            if part.startswith(f"{key}/")
        }
        recipe, judge = RECIPES[name], None
        if recipe.judged:
            judged = Machine("rbf", *(parts[f"judge/{part}"] for part in PARTS))
            judge = Judge(parts["judge/axes"], judged)
        machine = Machine(recipe.kernel, *(parts[part] for part in PARTS))
        threshold = learnt[f"{level}/{name}/threshold"].item()
        return cls(recipe, machine, tuple(parts["maps"]), judge, threshold)

    def parts(self):
        """The arrays that `load` reads, by name."""
        arrays = {part: getattr(self.machine, part) for part in PARTS} | {"maps": self.maps}
        if self.judge:
            arrays["judge/axes"] = self.judge.axes
            arrays |= {f"judge/{part}": getattr(self.judge.machine, part) for part in PARTS}
        return arrays

    def score(self, image, boxes):
        """The classifier's score (n,) of boxes (n, 4) in an image."""
        if not len(boxes):
            return np.empty(0)
        return self.machine.score(self.recipe.describe(image, boxes))

    def look_again(self, image, boxes, looks=None):
        """The boxes (n, 4), each corrected by what it shows, `looks` times (by default all)."""
        return look_again(self.recipe, self.maps[:looks], image, boxes)

    def find(self, image, boxes=None):
        """The Regions of a uint8 image; `boxes` are its candidates, if they are known already.

        With nothing to find, `boxes` and `scores` are empty. ValueError as for `propose`.
        """
        recipe = self.recipe
        boxes = propose(image, recipe.strategy) if boxes is None else boxes
        scores = self.score(image, boxes)
        passed, passed_scores = boxes[scores > recipe.gate], scores[scores > recipe.gate]
        if recipe.looks:
            passed = self.look_again(image, passed)
            judge = self.judge or self.machine
            if len(passed):
                passed_scores = judge.score(recipe.describe(image, passed))
        good = passed_scores > self.threshold
        passed, passed_scores = passed[good], passed_scores[good]
        kept = nms(passed, passed_scores, recipe.overlap)
        best = vote(kept, passed, passed_scores) if recipe.vote else passed[kept]
        return Regions(boxes, scores, passed, passed_scores, best, passed_scores[kept])


def vote(kept, boxes, scores, warmth=0.2):
    """The boxes `kept` (indices), each the mean of all that overlap it by half or more.

    A vote weighs exp(-lag / warmth), its score lagging that much behind the kept box's (after
    Gidaris & Komodakis 2015).
    """
    weights = np.exp((scores - scores[kept, None]) / warmth)
    weights[iou(boxes[kept], boxes) < 0.5] = 0
    return weights @ boxes / weights.sum(1, keepdims=True)


def best_threshold(scores, right, wanted):
    """The threshold for scores (n,) that finds most at fewest errors: the best F1.

    right: (n,) which are hits; wanted: how many there are to hit. F1 is the harmonic mean of
    precision and recall; the threshold lies midway between the last score taken and the next
    (or is -inf, where it is best to take all).
    ValueError where there is nothing to choose from.
    """
    if not len(scores):
        raise ValueError("no score to choose a threshold from: give photos with something found")
    order = np.argsort(-scores, kind="stable")
    f1 = 2 * right[order].cumsum() / (np.arange(len(order)) + 1 + wanted)
    last = f1.argmax()
    return float(np.append(scores[order], -np.inf)[last : last + 2].mean())


def store_candidates():
    """Search every photo for candidates, and store them."""
    found = {}
    for level, split in product(photos.LEVELS, photos.SPLITS):
        for photo in photos.load(level, split):
            for name, strategy in {"single": "single", "finer": LOOKS.strategy}.items():
                found[f"{photo.name}/{name}"] = propose(photo.image, strategy).astype(np.int16)
    np.savez_compressed(DATA / "candidates.npz", **found)
    stored.cache_clear()


def store_finders():
    """Train every recipe on every level, tune all but the published one, store what they learnt."""
    learnt = {}
    for level, (name, recipe) in product(photos.LEVELS, RECIPES.items()):
        if name in LEARNT:
            continue
        finder = RegionFinder.fit(photos.load(level, "train"), recipe)
        held_out = photos.load(level, "validation")
        for part, value in finder.parts().items():
            half = np.size(value) > 10_000
            learnt[f"{level}/{name}/{part}"] = np.array(value, np.float16 if half else np.float32)
        for row in (name, *(row for row, source in LEARNT.items() if source == name)):
            learnt[f"{level}/{row}/threshold"] = finder.doing(row).tuned(held_out).threshold
    np.savez_compressed(DATA / "regions.npz", **learnt)


if __name__ == "__main__":
    store_candidates()
    store_finders()
