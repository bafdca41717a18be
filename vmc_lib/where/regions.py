"""Which candidates are worth a look: a classifier scores them, the best silence their neighbours.

The paper's Block 1-1, top-down part: a support vector machine tells examples from counter-examples
by their raw pixels, and non-maximum suppression leaves a few boxes. The recipe `PUBLISHED` is that;
each further one of `RECIPES` adds an idea: context, gradients, looks that correct a box, a judge of
how well it fits in the end, votes. `python -m vmc_lib.where.regions` searches every photo for
candidates, trains every recipe on every level, and stores them.
"""

from collections import ChainMap
from dataclasses import dataclass, fields, replace
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from vmc_lib import photos

from ..data import FOLDER, arrays
from .boxes import as_boxes, iou, nms, vote
from .lessons import lessons, store_candidates, training_examples
from .looks import Estimate, learn_to_judge, learn_to_look, look_again
from .machine import PARTS, Machine, best_threshold
from .recipes import PUBLISHED, RECIPES, TRAINED_AS, Recipe
from .selective_search import propose


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
    looks: tuple = ()  # of Estimates: how to correct a box
    judge: Estimate | None = None  # of how well a box fits
    threshold: float = 0.0  # what the boxes must score in the end

    @classmethod
    def fit(cls, shots, recipe=PUBLISHED, rng=None):
        """Learn from photos; `rng` draws counter-examples and scatters boxes.

        The threshold stays 0: see `tuned`.
        """
        rng, seen = rng or np.random.default_rng(0), lessons(shots, recipe)
        x, y = training_examples(seen, recipe, rng)
        machine = Machine.fit(x, y, recipe.kernel, recipe.cost)
        looks = learn_to_look(seen, recipe, rng)
        judge = learn_to_judge(seen, recipe, machine, looks, rng) if recipe.judged else None
        return cls(recipe, machine, looks, judge)

    def used_as(self, name):
        """The same training, used for the recipe `name`, which does less."""
        recipe = RECIPES[name]
        return replace(self, recipe=recipe, judge=self.judge if recipe.judged else None)

    def tuned(self, shots):
        """The same finder, with the threshold that is best on photos it did not learn from.

        The published recipe has none to choose: it stays at 0.
        """
        if self.recipe == PUBLISHED:
            return self
        lenient, scores, right, wanted = replace(self, threshold=-np.inf), [], [], 0
        for lesson in lessons(shots, replace(self.recipe, mirror=False)):
            found = lenient.find(lesson.image, lesson.boxes)
            scores.append(found.scores)
            right.append(iou(found.boxes, lesson.truth).max(1, initial=0) >= 0.8)
            wanted += len(lesson.truth)
        best = best_threshold(np.concatenate(scores), np.concatenate(right), wanted)
        return replace(self, threshold=best)

    @classmethod
    def load(cls, level, name="improved"):
        """The shipped finder of a level, by the name of its recipe; ValueError for another."""
        learnt, key = arrays("regions"), f"{level}/{TRAINED_AS.get(name, name)}"
        if f"{level}/{name}/threshold" not in learnt:
            raise ValueError(f"no finder {name!r} for level {level!r}: see {', '.join(RECIPES)}")
        parts = {
            part.removeprefix(f"{key}/"): value.astype(float)
            for part, value in learnt.items()
            if part.startswith(f"{key}/")
        }

        def estimate(called):
            return Estimate(*(parts[f"{called}/{field.name}"] for field in fields(Estimate)))

        recipe = RECIPES[name]
        machine = Machine(recipe.kernel, *(parts[part] for part in PARTS))
        looks = tuple(estimate(f"look {i}") for i in range(len(recipe.looks)))
        judge = estimate("judge") if recipe.judged else None
        return cls(recipe, machine, looks, judge, learnt[f"{level}/{name}/threshold"].item())

    def parts(self):
        """The arrays that `load` reads, by name."""
        parts = {part: getattr(self.machine, part) for part in PARTS}
        estimates = {f"look {i}": look for i, look in enumerate(self.looks)}
        if self.judge:
            estimates["judge"] = self.judge
        for called, estimate in estimates.items():
            parts |= {f"{called}/{part}": value for part, value in vars(estimate).items()}
        return parts

    def score(self, image, boxes):
        """The classifier's score (n,) of boxes (n, 4) in an image."""
        return self.machine.score(self.recipe.describe(image, boxes))

    def look_again(self, image, boxes, looks=None):
        """The boxes (n, 4), each corrected by what it shows, `looks` times (by default all)."""
        return look_again(self.recipe, self.looks[:looks], image, boxes)

    def find(self, image, boxes=None):
        """The Regions of a uint8 image; `boxes` are its candidates, if they are known already.

        With nothing to find, `boxes` and `scores` are empty. ValueError as for `propose`, and
        `as_boxes`.
        """
        recipe = self.recipe
        boxes = propose(image, recipe.strategy) if boxes is None else as_boxes(boxes)
        scores = self.score(image, boxes)
        passed, passed_scores = boxes[scores > recipe.gate], scores[scores > recipe.gate]
        if recipe.looks:
            passed = self.look_again(image, passed)
            passed_scores = (self.judge or self.machine.score)(recipe.describe(image, passed))
        good = passed_scores > self.threshold
        passed, passed_scores = passed[good], passed_scores[good]
        kept = nms(passed, passed_scores, recipe.overlap)
        best = vote(kept, passed, passed_scores) if recipe.vote else passed[kept]
        return Regions(boxes, scores, passed, passed_scores, best, passed_scores[kept])


def trained(level, name):
    """What `load` reads of the recipe `name`, and of those that are TRAINED_AS it, on a level."""
    finder = RegionFinder.fit(photos.load(level, "train"), RECIPES[name])
    held_out, learnt = photos.load(level, "validation"), {}
    for part, value in finder.parts().items():
        half = np.size(value) > 10_000
        learnt[f"{level}/{name}/{part}"] = np.array(value, np.float16 if half else np.float32)
    for row in (name, *(row for row, source in TRAINED_AS.items() if source == name)):
        learnt[f"{level}/{row}/threshold"] = finder.used_as(row).tuned(held_out).threshold
    return learnt


def store_finders():
    """Train every recipe on every level, tune all but the published one, store what they learnt."""
    names = [name for name in RECIPES if name not in TRAINED_AS]
    jobs = [delayed(trained)(level, name) for level, name in product(photos.LEVELS, names)]
    np.savez_compressed(FOLDER / "regions.npz", **ChainMap(*Parallel(n_jobs=-1)(jobs)))


if __name__ == "__main__":
    store_candidates()
    store_finders()
