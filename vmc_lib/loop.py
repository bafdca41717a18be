"""The whole loop: a photo in, a reach out. It calls the parts in the order of the signal.

where: proposals → regions; what: names; then a place on the table, the trunk's turn, a plan, the
movement, its off-line calibration, and the movement again. No mathematics of its own.
"""

from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from joblib import Parallel, delayed

from . import photos
from .arm.posture import to_world, turn_towards
from .arm.simulate import Motion
from .cerebellum.offline import calibrate, published
from .motor import templates
from .motor.planning import Plan, plan
from .what.crops import crop
from .what.recogniser import Recogniser
from .where.boxes import iou
from .where.place import Locator
from .where.regions import RegionFinder, Regions

FOUND = 0.8  # IoU at which a box counts as the object's (Section IV A)
NEAR, CLOSE = 0.010, 0.005  # m: a hand this near the shuttlecock has arrived, or done well
LENIENCE = 1.0  # how much less a box must score to be named; chosen on the validation photos
RULES = {"published": published, "own": calibrate}  # of off-line calibration
STAGES = ("proposals", "regions", "names", "place", "movement")  # where a reach can go wrong


@dataclass(frozen=True)
class Brain:
    """What one level's training photos have taught: where to look, what it is, how to move."""

    finder: RegionFinder
    recogniser: Recogniser
    locator: Locator
    library: templates.Library

    @classmethod
    def load(cls, level):
        """The brain of a level: it has learnt from that level's training photos alone.

        It asks less of a box than the finder alone does: what is no shuttlecock gets no name.
        """
        finder = RegionFinder.load(level)
        lenient = replace(finder, threshold=finder.threshold - LENIENCE)
        locator = Locator.fit(photos.load(level, "train"), np.random.default_rng(0))
        return cls(lenient, Recogniser.load(level), locator, templates.load())


@dataclass(frozen=True)
class Sight:
    """What both visual pathways made of an image."""

    regions: Regions
    probability: np.ndarray  # (k,): that each kept box holds a shuttlecock

    @property
    def box(self):
        """The best-scored box (4,) that likely holds a shuttlecock, or None where none does."""
        named = np.flatnonzero(self.probability > 0.5)
        return self.regions.boxes[named[0]] if len(named) else None


@dataclass(frozen=True)
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


def see(brain, image):
    """`Sight` of an image (400, 600, 3): where are objects, and which is a shuttlecock?"""
    regions = brain.finder.find(image)
    crops = np.array([crop(image, box) for box in regions.boxes])
    return Sight(regions, brain.recogniser.probability(crops))


def locate(brain, image, box, camera):
    """The place (3,) of a shuttlecock seen in `box` (4,); ValueError when there is no box."""
    if box is None:
        raise ValueError("no shuttlecock was recognised: there is no place to reach for")
    return brain.locator.find(image, box, camera)


def reach(brain, target, calibration=published):
    """`Reach` for a place (3,): plan, move, calibrate (unless that is None), move again.

    ValueError when the place is out of reach or outside what past experience covers.
    """
    turn, point = turn_towards(target)
    habit = plan(point, brain.library)
    planned = habit.move()
    first = Reach(target, turn, habit, planned, planned)
    return recalibrated(first, calibration) if calibration else first


def recalibrated(reach, calibration):
    """The same `Reach`, its second movement calibrated by a rule of `RULES`."""
    habit = reach.plan
    return replace(reach, calibrated=habit.with_weights(calibration(habit).best).move())


def score(photo, sight, place, reaches):
    """How it went, stage by stage, held against the photo's truth.

    proposed: a candidate overlaps the shuttlecock by 0.8; found: a kept box does; named: the chosen
    box is the shuttlecock's (more than half of the union shared); cup: it is the cup's; then
    distances in m from the true place: of the `place` found (3,), of the hand before calibration,
    and after it by each rule of `reaches` (name -> `Reach`). They are NaN where no place was found
    (`place` is None), or where it could not be reached for (`reaches` is empty).
    """
    ends = {} if place is None else {"target": place}
    for rule, reach in reaches.items():
        ends |= {"planned": reach.hand(reach.planned)[-1], rule: reach.hand(reach.calibrated)[-1]}
    errors = {
        name: np.linalg.norm(ends[name] - photo.target) if name in ends else np.nan
        for name in ("target", "planned", *RULES)
    }
    chosen = np.empty((0, 4)) if sight.box is None else sight.box[None]
    return {
        "proposed": _overlap(sight.regions.candidates, photo, "shuttlecock") >= FOUND,
        "found": _overlap(sight.regions.boxes, photo, "shuttlecock") >= FOUND,
        "named": _overlap(chosen, photo, "shuttlecock") > 0.5,
        "cup": _overlap(chosen, photo, "cup") > 0.5,
        **errors,
    }


def _overlap(boxes, photo, name):
    return iou(boxes, photo.boxes[name][None]).max(initial=0.0)


def first_failure(scores, rule="own"):
    """Where each reach went wrong first: names (n,) from `STAGES`, "" where the hand arrived.

    Without a good candidate a good box can still be found, for boxes are corrected. A place is
    wrong beyond `NEAR`; where all else was right, the movement is to blame.
    """
    found, named, placed = scores["found"], scores["named"], scores["target"] <= NEAR
    moved = np.zeros_like(found)
    broken = ~np.column_stack([found | scores["proposed"], found, named, placed, moved])
    arrived = scores[rule] <= NEAR
    return np.where(arrived, "", np.array(STAGES)[broken.argmax(axis=1)])


def trial(level, split="test"):
    """`score` of every photo of a level and split, as a dictionary of arrays (n,).

    The photos go through joblib: `with parallel_config(n_jobs=…)` sends them to several cores, and
    with its "dask" backend to a cluster.
    """
    brain = Brain.load(level)
    scores = Parallel()(delayed(_tried)(brain, photo) for photo in photos.load(level, split))
    return {key: np.array([s[key] for s in scores]) for key in scores[0]}


def _tried(brain, photo):
    sight, place, reaches = see(brain, photo.image), None, {}
    with suppress(ValueError):  # nothing named, or out of reach: no movement, and counted as such
        place = locate(brain, photo.image, sight.box, photo.camera)
        first = reach(brain, place, calibration=None)
        reaches = {name: recalibrated(first, rule) for name, rule in RULES.items()}
    return score(photo, sight, place, reaches)


def summary(scores):
    """Shares (in [0, 1]) found, named, arrived and close by each rule; median distances in m.

    The medians leave out what there is not: a photo without a place, or without a reach.
    """
    shares = {name: float(scores[name].mean()) for name in ("found", "named", "cup")}
    medians = {name: float(np.nanmedian(scores[name])) for name in ("target", "planned", *RULES)}
    for name, distance in (("arrived", NEAR), ("close", CLOSE)):
        shares |= {f"{name}, {rule}": float((scores[rule] <= distance).mean()) for rule in RULES}
    return shares | medians
