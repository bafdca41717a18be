"""The whole loop: a photo in, a reach out. It calls the parts in the order of the signal.

where: proposals → detections; what: names; then a place on the table, the trunk's turn, a plan, the
movement, its off-line calibration, and the movement again. No mathematics of its own.
"""

from dataclasses import dataclass, replace

import numpy as np

from vmc_lib import NoReach, photos
from vmc_lib.arm.kinematics import to_world, turn_towards
from vmc_lib.arm.simulate import Motion
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration, calibrate
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import Plan, plan
from vmc_lib.what.judge import RIGHT_SIZE, SURE, likelier, sized, weighed
from vmc_lib.what.recogniser import NameClassifier, Recogniser
from vmc_lib.what.stream import VentralStream
from vmc_lib.where.detector import Detections, ObjectDetector
from vmc_lib.where.localiser import Localiser

# Set on validation photos: how much lower than the detector's its threshold is, and how much boxes
# may overlap that a stream is still to tighten
NAMING_MARGIN, OVERLAP = 1.0, 0.6
PHOTOGRAPHS_AS = "varied"  # the level whose places serve for photographs too
RULES = {"published": algorithm_1, "own": broyden_calibration}  # of off-line calibration


@dataclass(frozen=True)
class VisuomotorModel:
    """What photos and past reaches have taught: where objects are, their names, how to move."""

    detector: ObjectDetector
    recogniser: Recogniser | VentralStream
    localiser: Localiser
    template_set: templates.TemplateSet
    judge: NameClassifier | None = None  # of what `weighed` gives; without, the recogniser decides

    @classmethod
    def load(cls, level):
        """The shipped model of a level of photos.

        What was learnt from that level's training photos, its thresholds and probabilities set on
        its validation photos; but the CDBN has learnt from the training photos of all levels. A box
        may score NAMING_MARGIN less than the detector alone asks, for the recogniser is still to
        choose among the boxes. That of the level "real" has learnt from renders and photographs,
        places things as PHOTOGRAPHS_AS does, and weighs what both pathways say.
        """
        real = level == photos.REAL_LEVEL
        return cls(
            lenient_detector(level),
            VentralStream.load() if real else Recogniser.load(level),
            Localiser.load(PHOTOGRAPHS_AS if real else level),
            templates.load(),
            NameClassifier.load("photographs", "judge") if real else None,
        )


def lenient_detector(level):
    """The shipped detector of a level, NAMING_MARGIN more lenient than alone.

    In photographs it also keeps boxes that overlap by up to OVERLAP.
    """
    if level == photos.REAL_LEVEL:
        detector = ObjectDetector.load(level, "photographed")
        detector = replace(detector, recipe=replace(detector.recipe, overlap=OVERLAP))
    else:
        detector = ObjectDetector.load(level)
    return replace(detector, threshold=detector.threshold - NAMING_MARGIN)


@dataclass(frozen=True, eq=False)
class Sight:
    """What both visual pathways made of an image."""

    detections: Detections
    probability: np.ndarray  # (k,): that each kept box holds a shuttlecock
    sure: float = 0.5  # the probability above which it is said so

    @property
    def shuttlecocks(self):
        """The boxes (n, 4) that are said to hold one, the best first."""
        return self.detections.boxes[self.probability > self.sure]

    @property
    def box(self):
        """The best of them (4,), or None where there is none."""
        return self.shuttlecocks[0] if len(self.shuttlecocks) else None

    @property
    def told(self):
        """What was seen, in words."""
        sure = [f"{chance:.0%}" for chance in self.probability if chance > self.sure]
        if sure:
            return f"{len(sure)} shuttlecock{'s' * (len(sure) > 1)} ({', '.join(sure)} sure)"
        if not len(self.probability):
            return "nothing that looks like an object"
        count, likeliest = len(self.probability), self.probability.max()
        return f"no shuttlecock, but {count} thing{'s' * (count > 1)}; likeliest {likeliest:.0%}"


@dataclass(frozen=True, eq=False)
class Reach:
    """A reach for one place: before and after off-line calibration."""

    target: np.ndarray  # (3,): where the shuttlecock seems to be, m
    turn: float  # of the trunk, rad
    plan: Plan
    planned: Motion
    calibrated: Motion

    def hand(self, motion):
        """The wrist's path (T + 1, 3) on the turned trunk, in the frame of the trunk straight."""
        return to_world(motion.hand, self.turn)


def see(model, image, camera=None):
    """`Sight` of an image (400, 600, 3): where are objects, and which is a shuttlecock?

    A `Camera` tells how large things are: then boxes of another size than a shuttlecock's are left
    out, and the odds of the others grow by RIGHT_SIZE (Bayes' rule).
    """
    found, times = model.detector.detect(image), 1
    if camera is not None:
        found, times = sized(found, camera), RIGHT_SIZE
    if model.judge is None:
        return Sight(found, likelier(model.recogniser.chance(image, found.boxes), times))
    boxes, told = weighed(found, model.recogniser, image)
    chance = likelier(model.judge.probability(told), times)
    best = np.argsort(-chance, kind="stable")
    judged = replace(found, boxes=boxes[best], scores=told[best, 0])
    return Sight(judged, chance[best], SURE)


def locate(model, image, box, camera):
    """The place (3,) of a shuttlecock seen in `box` (4,), in m.

    `NoReach` when there is no box, and when the camera is unknown (None).
    """
    if box is None:
        raise NoReach("no shuttlecock was recognised: there is no place to reach for")
    if camera is None:
        raise NoReach("the camera is unknown, so a box has no place: give the photo's Camera")
    return model.localiser.locate(image, box, camera)


def reach(model, target, calibration=algorithm_1):
    """`Reach` for a place (3,): plan, move, calibrate (unless that is None), move again.

    `NoReach` when the place is out of reach or outside what past experience covers.
    """
    turn, point = turn_towards(target)
    habit = plan(point, model.template_set)
    if calibration is None:
        planned = execute(habit).motion
        return Reach(target, turn, habit, planned, planned)
    trials = calibrate(calibration, habit)
    return Reach(target, turn, habit, trials.movements[0].motion, trials.best_motion)


def recalibrated(reach, calibration):
    """The same `Reach`, its second movement calibrated by a rule of `RULES`."""
    return replace(reach, calibrated=calibrate(calibration, reach.plan).best_motion)
