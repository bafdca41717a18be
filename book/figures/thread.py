"""The running thread: one photo, one arm, one miss, as far as each chapter has brought them."""

import io
from functools import cache
from types import SimpleNamespace

import numpy as np
from PIL import Image

from book.figures.loop import LOOP_STEPS, aiming_error_mm, calibrate_over_hold, moves
from vmc_lib import loop, photos
from vmc_lib.arm.arm26 import geometry
from vmc_lib.arm.kinematics import to_world
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import START
from vmc_lib.show.arm import beyond_wrist
from vmc_lib.show.palette import ON_PHOTO

SIZE = (240, 160)  # pixels of the photo's file
# By chapter: the step of chapter 1 that it is about, and the motion that it has by then
CHAPTERS = {
    1: ("first reach", None),  # its first question is how far the hand misses
    2: ("candidates", None),
    3: ("regions", None),
    4: ("after suppression", None),
    5: ("after suppression", None),
    6: ("names", None),
    7: ("names", None),
    8: ("names", None),
    9: ("first reach", "plan"),
    10: ("calibrated reach", "off-line"),
    11: ("calibrated reach", "online"),
    12: ("calibrated reach", "online"),
    13: ("calibrated reach", "online"),
    **dict.fromkeys((14, 15, 16, None), ("least squares", "whole hold")),
}
MOTIONS = {  # of the thread, by name: how each comes about
    "plan": "as planned",
    "off-line": "calibrated off-line",
    "online": "corrected before it moves",
    "whole hold": "calibrated over the whole hold",
}


@cache
def first_reach():
    """The first photo of chapter 1, what is seen in it, and the reach for its shuttlecock."""
    model, photo = loop.VisuomotorModel.load("rig"), photos.load("rig", "test")[0]
    sight, reach = loop.see_and_reach(model, photo.image, photo.camera)
    return SimpleNamespace(photo=photo, sight=sight, reach=reach)


@cache
def trained_cerebellum():
    """The `AimCorrection` that a hundred practised movements have taught."""
    template_set = templates.load()
    practice = draw_targets(template_set, 100, np.random.default_rng(11))
    return AimCorrection(template_set).update(plan(practice, template_set))


@cache
def motions():
    """The motions of the first reach, by their names in `MOTIONS`."""
    reach = first_reach().reach
    online = execute(trained_cerebellum().correct(reach.plan)).motion
    return moves(reach, online) | {"whole hold": calibrate_over_hold(reach)}


def step_of(chapter):
    """The place of a chapter's step among those of chapter 1."""
    return LOOP_STEPS.index(CHAPTERS[chapter][0])


@cache
def misses():
    """How far each motion of the thread ends from the place aimed at, by its name, in mm."""
    reach = first_reach().reach
    return {name: aiming_error_mm(reach, motion) for name, motion in motions().items()}


def words(chapter):
    """The miss by a chapter, empty before there is one; and where the thread then is."""
    step, motion = CHAPTERS[chapter]
    if motion is None:
        return "", step
    return f"{misses()[motion]:.1f} mm", f"a reach {MOTIONS[motion]}"


@cache
def photo_file():
    """The photo, small: a WebP file."""
    file = io.BytesIO()
    Image.fromarray(first_reach().photo.image).resize(SIZE).save(file, "webp", quality=70)
    return file.getvalue()


def picture(chapter, photo):
    """The photo at an address with what a chapter has made of it, and the arm: small, as SVG."""
    one, (step, name) = first_reach(), CHAPTERS[chapter]
    motion = motions().get(name)
    q, turn = (START, 0.0) if motion is None else (motion.q[-1], one.reach.turn)
    boxes = {
        "candidates": (one.sight.detections.candidates[::6], "grey"),
        "regions": (one.sight.detections.passed, "orange"),
        "after suppression": (one.sight.detections.boxes, "blue"),
    }.get(step, ([one.sight.box], "green"))
    return (
        '<svg viewBox="60 20 480 320" aria-hidden="true" fill="none" stroke-linejoin="round">'
        f'<image width="600" height="400" href="{photo}"/>{_boxes(*boxes)}'
        f"{_arm(one.photo.camera, q, turn)}</svg>"
    )


def _boxes(boxes, colour):
    path = "".join(
        f"M{x:.0f} {y:.0f}H{right:.0f}V{bottom:.0f}H{x:.0f}Z" for x, y, right, bottom in boxes
    )
    return f'<path d="{path}" stroke="{ON_PHOTO[colour]}" stroke-width="5"/>'


def _arm(camera, q, turn):
    """The arm as the photo's camera would see it: a forearm, and a hand at the model's end."""
    _, elbow, hand = to_world(geometry(q).joints, turn)
    elbow, wrist = (place - beyond_wrist(turn) for place in (elbow, hand))
    forearm, palm = (
        " ".join(f"{x:.0f},{y:.0f}" for x, y in camera.project(np.array(ends)))
        for ends in ((elbow, wrist), (wrist, hand))
    )
    return (
        f'<polyline points="{forearm}" stroke="#e9dfca" stroke-width="34" stroke-linecap="round"/>'
        f'<polyline points="{forearm}" stroke="#a33b2e" stroke-width="12"/>'
        f'<polyline points="{palm}" stroke="#e9dfca" stroke-width="24" stroke-linecap="round"/>'
    )
