"""Object detector: a classifier scores candidates, non-maximum suppression keeps the best.

The paper's Block 1-1, top-down part: a support vector machine tells examples from counter-examples
by their raw pixels, and non-maximum suppression leaves a few boxes. The recipe `PUBLISHED` is that,
and `SINGLE` with one hierarchy of candidates; each further one of `RECIPES` adds an idea: context,
gradients, box regression, a prediction of the final IoU, votes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.boxes import as_boxes, nms, vote
from vmc_lib.checks import check_count
from vmc_lib.data import arrays
from vmc_lib.photos import EVERY_LEVEL
from vmc_lib.short_repr import short_repr
from vmc_lib.where.box_regression import RBFRidge, regress
from vmc_lib.where.recipes import EVERY_RECIPE, TRAINED_AS, Recipe
from vmc_lib.where.selective_search import propose
from vmc_lib.where.svm import PARTS, KernelSVM


@dataclass(frozen=True, eq=False)
class Detections:
    """Boxes of one image after each step of the detector (the paper's Fig. 6)."""

    candidates: np.ndarray  # (n, 4) of selective search
    candidate_scores: np.ndarray  # (n,)
    passed: np.ndarray  # (m, 4) above the threshold, after any box regression; then windows
    boxes: np.ndarray  # (k, 4) left by non-maximum suppression, the best first
    scores: np.ndarray  # (k,)

    __repr__ = short_repr

    @property
    def counts(self) -> dict[str, int]:
        """How many boxes each step leaves."""
        steps = self.candidates, self.passed, self.boxes
        return dict(zip(("candidates", "passed", "kept"), map(len, steps), strict=True))


@dataclass(frozen=True)
class ObjectDetector:
    """A trained recipe: finds the few boxes of an image that hold an object."""

    recipe: Recipe
    svm: KernelSVM
    regressions: tuple = ()  # of RBFRidge: box regression, round by round
    iou_predictor: RBFRidge | None = None  # of a box with its object
    threshold: float = 0.0  # the final score above which boxes are kept

    __repr__ = short_repr

    @classmethod
    def load(cls, level: str, name: str = "improved") -> Self:
        """The shipped detector of a level, by the name of its recipe; ValueError for another."""
        learnt, key = arrays("detectors"), f"{level}/{TRAINED_AS.get(str(name), name)}"
        if f"{level}/{name}/threshold" not in learnt:
            trained = [one for one in EVERY_RECIPE if f"{level}/{one}/threshold" in learnt]
            known = ", ".join(trained or EVERY_LEVEL)
            raise ValueError(f"no detector {name!r} for level {level!r}: choose from {known}")
        parts: dict[str, Any] = {
            part.removeprefix(f"{key}/"): value.astype(float)
            for part, value in learnt.items()
            if part.startswith(f"{key}/")
        }

        def ridge(called):
            return RBFRidge(*(parts[f"{called}/{field.name}"] for field in fields(RBFRidge)))

        recipe = EVERY_RECIPE[name]
        svm = KernelSVM(recipe.kernel, *(parts[part] for part in PARTS))
        regressions = tuple(ridge(f"regression {i}") for i in range(len(recipe.regressions)))
        predictor = ridge("iou predictor") if recipe.predicts_iou else None
        return cls(recipe, svm, regressions, predictor, learnt[f"{level}/{name}/threshold"].item())

    def parts(self) -> dict[str, np.ndarray]:
        """The arrays that `load` reads, by name."""
        parts = {part: getattr(self.svm, part) for part in PARTS}
        ridges = {f"regression {i}": ridge for i, ridge in enumerate(self.regressions)}
        if self.iou_predictor:
            ridges["iou predictor"] = self.iou_predictor
        for called, ridge in ridges.items():
            parts |= {f"{called}/{part}": value for part, value in vars(ridge).items()}
        return parts

    def score(self, image: np.ndarray, boxes: ArrayLike) -> np.ndarray:
        """Classifier scores (n,) of boxes (n, 4) in an image."""
        return self.svm.score(self.recipe.describe(image, boxes))

    def regress(
        self, image: np.ndarray, boxes: np.ndarray, rounds: int | None = None
    ) -> np.ndarray:
        """Refine boxes (n, 4) by box regression, `rounds` times (by default all)."""
        if rounds is not None:
            check_count("rounds", rounds)
        return regress(self.recipe, self.regressions[:rounds], image, boxes)

    def detect(self, image: np.ndarray, boxes: ArrayLike | None = None) -> Detections:
        """Detect objects.

        Parameters
        ----------
        image : (height, width, 3) uint8 array
        boxes : (n, 4) candidates in pixels, if they are known; else `propose` finds them

        Returns
        -------
        Detections, empty where nothing is found

        Raises
        ------
        ValueError
            As `propose` and `as_boxes` do.

        Examples
        --------
        >>> blank = np.zeros((400, 600, 3), np.uint8)
        >>> ObjectDetector.load("rig").detect(blank).counts
        {'candidates': 1, 'passed': 0, 'kept': 0}
        """
        recipe = self.recipe
        boxes = propose(image, recipe.strategy) if boxes is None else as_boxes(boxes)
        scores = self.score(image, boxes)
        passed, passed_scores = boxes[scores > recipe.gate], scores[scores > recipe.gate]
        if recipe.regressions:
            passed = self.regress(image, passed)
            score = self.iou_predictor.predict if self.iou_predictor else self.svm.score
            passed_scores = score(recipe.describe(image, passed))
        good = passed_scores > self.threshold
        windows = window_grid(*image.shape[:2], recipe.windows)
        passed = np.vstack([passed[good], windows])
        passed_scores = np.append(passed_scores[good], self.score(image, windows))
        kept = nms(passed, passed_scores, recipe.overlap)
        best = vote(kept, passed, passed_scores) if recipe.vote else passed[kept]
        return Detections(boxes, scores, passed, best, passed_scores[kept])


def window_grid(height: int, width: int, sides: Sequence[float]) -> np.ndarray:
    """Sliding windows (n, 4) over an image: squares a third of a side apart, cut at its edges."""
    windows = [np.empty((0, 4))]
    for side in sides:
        x, y = (np.arange(-side / 6, size - 5 * side / 6 + 1, side / 3) for size in (width, height))
        corners = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
        windows.append(np.hstack([corners, corners + side]))
    return np.vstack(windows).clip(0, [width, height] * 2)
