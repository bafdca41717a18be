"""Closed visuomotor loop: a photo in, a reach out.

It calls the parts in the order of the signal: where (proposals, detections), what (names), then a
place on the table, the trunk's turn, a plan, the movement, its off-line calibration, and the
movement again.
"""

from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib import NoReach, photos
from vmc_lib.arm.kinematics import to_world, turn_towards
from vmc_lib.arm.simulate import Motion
from vmc_lib.box_selection import SIZE_LIKELIHOOD_RATIO, filter_by_size, scale_odds
from vmc_lib.boxes import pixels_inside
from vmc_lib.camera import Camera
from vmc_lib.cerebellum.offline import Rule, calibrate
from vmc_lib.checks import as_numbers, check_kind
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import Plan, plan
from vmc_lib.short_repr import short_repr
from vmc_lib.what.recogniser import Recogniser
from vmc_lib.what.stream import VentralStream
from vmc_lib.where.detector import Detections, ObjectDetector
from vmc_lib.where.localiser import Localiser

THRESHOLD_MARGIN = 1.0  # how far the detector's threshold is lowered for a recogniser
LOAD_MODEL = 'VisuomotorModel.load("rig")'  # the remedy where a model is missing
PHOTOGRAPHS_AS = "varied"  # the level whose localiser serves photographs, too


@dataclass(frozen=True)
class VisuomotorModel:
    """All that is learnt: where objects are, what they are, where they stand, how to reach."""

    detector: ObjectDetector
    recogniser: Recogniser | VentralStream  # of what is detected, both `select` boxes
    localiser: Localiser
    template_set: templates.TemplateSet

    __repr__ = short_repr

    @classmethod
    def load(cls, level: str) -> Self:
        """The shipped model of a level of photos.

        It was trained on that level's training photos (the CDBN on those of all levels), its
        thresholds and probabilities set on its validation photos. That of the level "real" was
        trained on renders and photographs, and locates as PHOTOGRAPHS_AS does. ValueError where no
        level has that name.
        """
        real = level == photos.REAL_LEVEL
        return cls(
            high_recall_detector(level),
            VentralStream.load() if real else Recogniser.load(level),
            Localiser.load(PHOTOGRAPHS_AS if real else level),
            templates.load(),
        )


def high_recall_detector(level: str) -> ObjectDetector:
    """The shipped detector of a level with a lower threshold: the recogniser is still to choose."""
    name = "photographed" if level == photos.REAL_LEVEL else "improved"
    detector = ObjectDetector.load(level, name)
    return replace(detector, threshold=detector.threshold - THRESHOLD_MARGIN)


@dataclass(frozen=True, eq=False)
class Sight:
    """The result of both visual pathways on an image."""

    detections: Detections
    probability: np.ndarray  # (k,): that each kept box holds a shuttlecock
    min_probability: float = 0.5  # above which a box counts as one

    def __repr__(self) -> str:
        return f"Sight({self.summary})"

    @property
    def shuttlecocks(self) -> np.ndarray:
        """The boxes (n, 4) that count as shuttlecocks, in the order of `detections`.

        That is the detector's, the best object first; after a `VentralStream` the likeliest
        shuttlecock is first.
        """
        return self.detections.boxes[self.probability > self.min_probability]

    @property
    def box(self) -> np.ndarray | None:
        """The first of them (4,), or None where there is none."""
        return self.shuttlecocks[0] if len(self.shuttlecocks) else None

    @property
    def summary(self) -> str:
        """One-line description of the result."""
        sure = [f"{100 * p:.0f} %" for p in self.probability if p > self.min_probability]
        if sure:
            found = f"{len(sure)} shuttlecocks" if len(sure) > 1 else "a shuttlecock"
            return f"{found}, {', '.join(sure)} sure"
        if not len(self.probability):
            return "nothing that looks like an object"
        count, likeliest = len(self.probability), 100 * self.probability.max()
        boxes = f"{count} box{'es' * (count > 1)}"
        return f"no shuttlecock; likeliest of {boxes}: {likeliest:.0f} %"


@dataclass(frozen=True, eq=False)
class Reach:
    """A reach for one place: before and after off-line calibration."""

    target: np.ndarray  # (3,): where the shuttlecock seems to be, m
    turn: float  # of the trunk, rad
    plan: Plan
    planned: templates.HeldMotion
    calibrated: templates.HeldMotion

    __repr__ = short_repr

    def hand(self, motion: Motion) -> np.ndarray:
        """The wrist's path (T + 1, 3) on the turned trunk, in the frame of the trunk straight."""
        check_kind("motion", motion, Motion, "reach.planned, or reach.calibrated")
        return to_world(motion.hand, self.turn)

    def distance(self, motion: templates.HeldMotion, place: ArrayLike) -> float:
        """How far the wrist is from a place (3,) over the hold, on average, m."""
        check_kind("motion", motion, templates.HeldMotion, "reach.planned, or reach.calibrated")
        return float(templates.mean_distance(to_world(motion.wrist, self.turn), place))

    def endpoint(self, motion: templates.HeldMotion) -> np.ndarray:
        """Where the wrist is on average over the hold, (3,), in the same frame."""
        check_kind("motion", motion, templates.HeldMotion, "reach.planned, or reach.calibrated")
        return to_world(motion.wrist, self.turn).mean(axis=0)


def see(model: VisuomotorModel, image: np.ndarray, camera: Camera | None = None) -> Sight:
    """Detect the objects in an image and recognise the shuttlecocks among them.

    Parameters
    ----------
    model : VisuomotorModel
    image : (400, 600, 3) uint8 array
    camera : Camera, if it is known: then boxes of another physical size than a shuttlecock's are
        left out, and the odds of the others grow by SIZE_LIKELIHOOD_RATIO (Bayes' rule)

    Returns
    -------
    Sight

    Examples
    --------
    >>> photo = photos.load("rig", "validation")[3]
    >>> see(VisuomotorModel.load("rig"), photo.image, photo.camera).summary
    'a shuttlecock, 100 % sure'
    """
    check_kind("model", model, VisuomotorModel, LOAD_MODEL)
    detections, ratio = model.detector.detect(image), 1
    if camera is not None:
        check_kind("camera", camera, Camera, "photo.camera, or None")
        detections, ratio = filter_by_size(detections, camera), SIZE_LIKELIHOOD_RATIO
    detections, probability = model.recogniser.select(image, detections)
    return Sight(detections, scale_odds(probability, ratio), model.recogniser.min_probability)


def locate(
    model: VisuomotorModel, image: np.ndarray, box: ArrayLike | None, camera: Camera | None
) -> np.ndarray:
    """Locate the shuttlecock in a box: its place in the shoulder frame.

    Parameters
    ----------
    model : VisuomotorModel
    image : (400, 600, 3) uint8 array
    box : (4,) array of (x0, y0, x1, y1) in pixels, or None
    camera : Camera, or None

    Returns
    -------
    (3,) array, m

    Raises
    ------
    vmc_lib.NoReach
        Without a box or a camera, or if the line of sight does not meet the table.
    ValueError
        For a box outside the image.
    """
    if box is None:
        raise NoReach("no shuttlecock was recognised: there is no place to reach for")
    if camera is None:
        raise NoReach("the camera is unknown, so a box has no place: give the photo's Camera")
    check_kind("model", model, VisuomotorModel, LOAD_MODEL)
    check_kind("camera", camera, Camera, "photo.camera, or None")
    pixels_inside(box, image)  # or the localiser would read its place off the image's edge
    return model.localiser.locate(image, box, camera)


def reach(
    model: VisuomotorModel, target: ArrayLike, calibration: Rule | None = "published"
) -> Reach:
    """Reach for a target: turn the trunk, plan, move, calibrate off-line, move again.

    Parameters
    ----------
    model : VisuomotorModel
    target : (3,) array, m, in the shoulder frame
    calibration : {"published", "own"}, or a function as `calibrate` takes it; None to move once

    Returns
    -------
    Reach

    Raises
    ------
    vmc_lib.NoReach
        If the target is out of reach or outside what past experience covers.

    Examples
    --------
    >>> photo = photos.load("rig", "validation")[0]
    >>> found = reach(VisuomotorModel.load("rig"), photo.target)
    >>> found.distance(found.calibrated, photo.target) < 0.05
    True
    """
    check_kind("model", model, VisuomotorModel, LOAD_MODEL)
    target = as_numbers("target", target)
    turn, point = turn_towards(target)
    habit = plan(point, model.template_set)
    if calibration is None:
        planned = execute(habit).motion
        return Reach(target, turn, habit, planned, planned)
    trials = calibrate(habit, calibration)
    return Reach(target, turn, habit, trials.movements[0].motion, trials.best_motion)


def recalibrate(reach: Reach, calibration: Rule) -> Reach:
    """The same `Reach`, its second movement calibrated by another rule, as `reach` takes it."""
    check_kind("reach", reach, Reach, "what loop.reach(model, target) returns")
    trials = calibrate(reach.plan, calibration)
    return replace(reach, calibrated=trials.best_motion)


def see_and_reach(
    model: VisuomotorModel, image: np.ndarray, camera: Camera | None
) -> tuple[Sight, Reach | None]:
    """The `Sight` of an image and the `Reach` for the first shuttlecock that can be reached.

    The reach is None where there is `NoReach` for any.
    """
    if camera is not None:
        check_kind("camera", camera, Camera, "photo.camera, or None")
    sight = see(model, image)
    for box in sight.shuttlecocks:
        with suppress(NoReach):
            return sight, reach(model, locate(model, image, box, camera))
    return sight, None
