"""The loop as pictures: what the eye sees beside what the arm does, one step after the other."""

from functools import cache

import numpy as np

from book.figures.lens import lens
from book.figures.panels import panels
from book.figures.reaching import norm_mm
from vmc_lib.arm.kinematics import ON_AXIS, to_world
from vmc_lib.boxes import iou
from vmc_lib.cerebellum.offline import RULES, gauss_newton_calibration
from vmc_lib.loop import recalibrate
from vmc_lib.motor.templates import START
from vmc_lib.show import dot_plot, note
from vmc_lib.show.arm import EVERY, arm_scene, beyond_wrist
from vmc_lib.show.figures import photo_view
from vmc_lib.show.palette import COLOURS, EDGE, ON_PHOTO
from vmc_lib.statistics import wilson

SEEING = ("a photo", "candidates", "regions", "after suppression", "names")
LOOP_STEPS = (*SEEING, "first reach", "calibrated reach", "least squares")
TURNED = 500  # ms: by then the trunk has turned
FOREARM = 0.02  # m, the radius of a forearm that is a rod
AHEAD = [[0, 0, 0.06], [0.5, 0, 0.06]]  # m, along the plane in which the hand moves
LIFT_RADIUS = 0.01  # m from a shuttlecock's true middle: within it a hand is drawn to lift it
SLOW_MOTION = (0.8, 1.0)  # s: of a reach, in a film: the last moments before the hold
THROUGH = " (on its way the forearm passes through the cup: the model feels no things)"
LOOP_STAGES = (*SEEING, "place", "plan", "off-line", "online")
STAGE_OF = {"first reach": "plan", "calibrated reach": "off-line"}  # of a step


KINDS = {"rig": "photo", "free": "a moved camera,", "varied": "a hard photo,"}  # by level


def photo_name(level, n):
    """What readers call the n-th test photo of a level, from 1: "photo 1", "a hard photo, 2"."""
    return f"{KINDS[level]} {n}"


def moves(reach, online=None):
    """The motions of a reach by the stage that makes them; none where there is no reach.

    `online` is the `Motion` of the plan as the cerebellum corrected it before moving.
    """
    if reach is None:
        return {}
    return {"plan": reach.planned, "off-line": reach.calibrated, "online": online}


@cache
def calibrate_over_hold(reach):
    """The motion of a reach after least squares over its whole hold."""
    return recalibrate(reach, gauss_newton_calibration).calibrated


def motion_at(step, reach, online=None):
    """The motion that a step or a stage of a movement shows."""
    if step == "least squares":
        return calibrate_over_hold(reach)
    return moves(reach, online)[STAGE_OF.get(step, step)]


def aiming_error_mm(reach, motion):
    """How far the hand is from the place aimed at, on average over the hold, in mm."""
    return 1000 * reach.distance(motion, reach.target)


def draw_step(step, photo, sight, reach, online=None):
    """A step or a stage: what the eye has made of the photo, and where the arm is by then.

    Where nothing was recognised, `reach` is None: the arm stays as it was. `online` as in `moves`.
    """
    if step in SEEING or reach is None:
        boxes = _boxes(sight, step if step in SEEING else "names")
        return photo_view(photo.image, boxes), arm_scene(START, photo=photo)
    if step == "place":
        place = photo.camera.project(reach.target)[0]
        boxes, points = [(sight.box, "shuttlecock", "green")], [(place, "", "green")]
        view = photo_view(photo.image, boxes, points)
        view = view.replace("</svg>", lens(photo, sight.box, reach) + "</svg>")
        balls = [(reach.target, "green")]
        return view, arm_scene(START, turn=reach.turn, photo=photo, balls=balls)
    return draw_movement(photo, sight.box, reach, motion_at(step, reach, online))


def step_view(step, *journey):
    """A step or a stage (see `draw_step`): photo, arm, and the same in words."""
    return *draw_step(step, *journey), note(describe_step(step, *journey))


def draw_movement(photo, box, reach, motion, label="shuttlecock", colour="green"):
    """The chosen box, the place reached for, the hand on its way and a `lens`; and the arm."""
    hand, turn = reach.hand(motion), _turns(reach, motion)
    [place] = photo.camera.project(reach.target[None])
    view = photo_view(photo.image, [(box, label, colour)], [(place, "", "green")])
    moving = _moving(photo.camera.project(hand[::EVERY]), "orange")
    view = view.replace("</svg>", moving + lens(photo, box, reach, motion) + "</svg>")
    end = reach.endpoint(motion)
    lifted = bool(reach.distance(motion, photo.target) < LIFT_RADIUS)
    scene = arm_scene(
        motion,
        turn=turn,
        photo=photo,
        balls=[(reach.target, "green")],
        grasp=lifted,
        end=(end, motion.speed),
    )
    miss = {"mm": round(aiming_error_mm(reach, motion), 4), "end": end.round(5).tolist()}
    miss |= {"lifted": lifted, "stands": photo.pose == "standing", "slow": SLOW_MOTION}
    scene.tell("miss", miss)
    return view, scene


def _turns(reach, motion):
    """How far the trunk has turned (T,), in rad, millisecond by millisecond."""
    return reach.turn * np.minimum(1, np.arange(len(motion.q)) / TURNED)


def meets_cup(photo, reach, motion):
    """Whether the scene shows the forearm, a rod, within the photo's cup at some moment."""
    from vmc_lib.arm.arm26 import geometry
    from vmc_lib.show import props

    moments = zip(motion.q[::EVERY], _turns(reach, motion)[::EVERY], strict=True)
    rods = np.array([to_world(geometry(q).joints[1:], turn) for q, turn in moments])
    away = (
        np.linspace(rods[:, 0], rods[:, 1], 30) - props.cup_foot(photo) - beyond_wrist(reach.turn)
    )
    radius, height = np.add(props.MUG, FOREARM)
    return bool(((np.hypot(away[..., 0], away[..., 2]) < radius) & (away[..., 1] < height)).any())


def _moving(places, colour):
    """A ring in a photo that is at places (n, 2), in pixels, as the scene's clock goes."""
    ring = f'<circle r="7" {EDGE}/><circle r="7" stroke="{ON_PHOTO[colour]}"/>'
    x, y = places[-1].round(1)
    course = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    return f'<g data-course="{course}" transform="translate({x} {y})">{ring}</g>\n'


def from_above(photo, reach, turned):
    """Eye, shoulder, arm and target from above, before or after the trunk's turn (a figure).

    Each frame has its colour: the eye's is blue, the trunk's purple, the arm's dark.
    """
    from vmc_lib.arm.arm26 import geometry

    q, turn = (reach.planned.q[-1], reach.turn) if turned else (START, 0.0)
    shoulder, ahead = to_world(AHEAD, turn)
    plane = [([shoulder, ahead], "--", "grey", "the arm's plane")] if turned else []
    parts = (
        ([photo.camera.position, photo.target], ":", "blue", ""),
        *plane,
        ([ON_AXIS, to_world([[0, 0, 0]], turn)[0]], "-", "purple", ""),
        (to_world(geometry(q).joints, turn), "o-", "ink", "" if turned else "hand"),
        ([ON_AXIS], "s", "purple", "trunk's axis"),
        ([to_world([[0, 0, 0]], turn)[0]], "o", "ink", "shoulder"),
        ([photo.camera.position], "^", "blue", "eye"),
        ([photo.target], "*", "green", "shuttlecock"),
    )
    aside = f"the trunk {'has turned' if turned else 'will turn'} by {np.degrees(reach.turn):.0f}°"
    return above(parts, aside, (-0.65, 0.4), (-0.5, 0.6))


def chain_plots(summaries, count):
    """How often each step of the loop succeeds in `count` photos, and its distances: dot plots.

    Of the ledger's summaries, level -> name -> number.
    """
    steps = "found", "named", *(f"arrived, {rule}" for rule in RULES)
    right = {
        level: {step: (one[step], *wilson(one[step] * count, count)) for step in steps}
        for level, one in summaries.items()
    }
    away = {
        level: {name: 1000 * one[name] for name in ("target", "planned", *RULES)}
        for level, one in summaries.items()
    }
    return (
        dot_plot(right, f"share of {count} photos", None, (0, 1.02)),
        dot_plot(away, "median distance (mm)", None, (0, None)),
    )


def above(parts, title, xlim, ylim):
    """Things seen from above (a figure): each part is (places (n, 3), style, colour, label)."""
    fig, ax = panels(size=(4.2, 4))
    for places, style, colour, label in parts:
        x, _, z = np.transpose(places)
        ax.plot(z, x, style, color=COLOURS[colour], ms=9)
        at = z[-1], x[-1]
        left = style in "^s"  # there no line runs
        look = {"ha": "right" if left else "left", "color": COLOURS[colour]}
        ax.annotate(label, at, (-8, -10) if left else (7, 4), textcoords="offset points", **look)
    ax.set(xlim=xlim, ylim=ylim, aspect="equal", title=title)
    ax.set(xlabel="to the right (m)", ylabel="forward (m)")
    return fig


def describe_end(photo, reach, motion, aim="the place seen"):
    """Where a motion ends, in words: both distances, and how fast the hand still moves."""
    seen, true = (1000 * reach.distance(motion, p) for p in (reach.target, photo.target))
    return (
        f"over the hold the hand is {seen:.1f} mm from {aim}, {true:.1f} mm from the true "
        f"one, and moves at {1000 * motion.speed:.0f} mm/s"
        f"{THROUGH if meets_cup(photo, reach, motion) else ''}"
    )


def _boxes(sight, step):
    detections = sight.detections
    return {
        "a photo": [],
        "candidates": [(box, "", "grey") for box in detections.candidates],
        "regions": [(box, "", "orange") for box in detections.passed],
        "after suppression": [(box, "", "blue") for box in detections.boxes],
        "names": named_boxes(sight),
    }[step]


def named_boxes(sight):
    """For `photo_view`: each kept box with its chance of a shuttlecock, by rising chance."""
    rising = sorted(zip(sight.probability, sight.detections.boxes.tolist(), strict=True))
    return [
        (box, f"shuttlecock {p:.0%}", "green")
        if p > sight.min_probability
        else (box, f"{p:.0%}", "blue")
        for p, box in rising
    ]


def likeliest_elsewhere(photo, sight):
    """The highest chance of a shuttlecock among kept boxes that do not touch it; 0 without any."""
    apart = iou(sight.detections.boxes, photo.boxes["shuttlecock"])[:, 0] == 0
    return sight.probability[apart].max(initial=0)


def describe_step(step, photo, sight, reach, online=None):
    """A step or a stage in words, with its numbers."""
    if step in SEEING:
        candidates, passed, boxes = sight.detections.counts.values()
        return {
            "a photo": "A photo of a table with a shuttlecock and a cup; the arm waits.",
            "candidates": f"{candidates} candidate boxes cover the photo; the arm waits.",
            "regions": f"{passed} boxes are left, many for each thing; the arm waits.",
            "after suppression": f"{boxes} boxes are left; the arm waits.",
            "names": "Each box carries its probability of holding a shuttlecock; the arm waits.",
        }[step]
    words = "nothing was recognised; the arm waits"
    if reach and step == "place":
        words = f"{norm_mm(reach.target - photo.target):.1f} mm from the true shuttlecock"
    elif reach:
        words = describe_end(photo, reach, motion_at(step, reach, online))
    return f"{step.capitalize()}: {words}."
