"""The arm itself in the page: its physics runs there, in the reader's hand.

MuJoCo's WebAssembly build reads the library's own `arm26.xml`; modules here add the muscle
law, planning and calibration, and a test holds them to the Python. Their constants come from here.
"""

import itertools
import json
from functools import partial

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import HTML, display

from page.arm.controls import MUJOCO, bench_form, reach_form
from page.bundle import STATIC, widget_script
from vmc_lib.arm import muscle
from vmc_lib.arm.arm26 import geometry
from vmc_lib.arm.dynamics import coefficients, hand
from vmc_lib.arm.engines import STOP_DAMPING, STOP_STIFFNESS
from vmc_lib.arm.kinematics import BENT, TRUNK, TRUNK_RANGE, inverse_kinematics
from vmc_lib.arm.model import F0, L0, LIMITS, MUSCLES, SLACK, STEP, XML
from vmc_lib.cerebellum.offline import GAINS, LARGEST_STEP
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.inverse_dynamics import SAMPLES, spline, static_activation
from vmc_lib.motor.planning import plan
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane, plane_view
from vmc_lib.show.figures import frame, pictures, side_by_side
from vmc_lib.show.live import VENDORED, Live
from vmc_lib.show.outputs import still
from vmc_lib.show.packed import pack_bytes
from vmc_lib.show.palette import plot_style
from vmc_lib.show.render_mode import render_mode

REACHES = (
    "A right arm before a table has reached for a target; beside it the plane that it moves in, "
    "with remembered reaches as dots"
)
MODES = {  # what a reader can do, and the picture in words
    "bench": "A right arm of six muscles before a table, and its posture seen from the side.",
    "reach": f"{REACHES}.",
    "templates": f"{REACHES}.",
    "weights": f"{REACHES}, four of them weighted.",
}
TRIALS = 2  # of our own calibration: off-line, the page has no more to learn
CALIBRATION = {"gains": GAINS, "trials": TRIALS, "largestStep": LARGEST_STEP}
KINEMATICS = {
    "hand": coefficients()[1].T.tolist(),
    "bent": BENT.tolist(),
    "trunk": {"axis": TRUNK.tolist(), "range": TRUNK_RANGE.tolist()},
}
LENS = {"at": (0.345, -0.39), "radius": 0.075, "times": 3}  # m, in the arm's plane
_ENDS = ("red", "purple")  # where the planned and the calibrated reach end
PHOTO_1 = (0.1306, -0.4089)  # m, in the arm's plane: the shuttlecock of book.figures.thread
names = map("live-{}".format, itertools.count(1))
# u, a, length, velocity
_ASKED = tuple(itertools.product((0.1, 0.9), (0.3, 0.7), (0.6, 1.3), (-0.5, 0.3)))


def live_arm(mode, target=PHOTO_1, law=""):
    """Show the arm with its physics in the page, loaded when the reader first asks for it.

    `mode` is "bench" (six excitation sliders move the arm) or "reach" (the reader sets a target;
    the page plans, moves, shows the miss, calibrates off-line and moves again) or "weights" (the
    same, and the four weights of the plan are set by hand) or "templates" (the same as "reach", and
    templates are taken away, put back and added). `target` (2,), in the arm's plane and in m, is
    where the reach's target first stands, and for which a first reach is there from the start.
    `law` names the chapter's function of Eq. 5, which a reader can change: the book's page then
    plans by it. ValueError when the mode is unknown or when no templates surround the target.
    """
    if mode not in MODES:
        raise ValueError(f"mode {mode!r} is unknown: choose one of {[*MODES]}")
    name = next(names)
    data = page_constants()
    if mode == "bench":
        draw, controls = _bench_view, bench_form(name)
    else:
        target = np.asarray(target, float)
        movement = execute(plan(target, templates.load()))  # raises when none surround it
        draw, controls = partial(_reach_view, movement), reach_form(name, target, mode)
        data |= {"first": first_reach(movement), "lens": LENS}
    show(name, mode, draw, controls, data, MODES[mode], law)


def show(name, mode, draw, controls, data, alt, law=""):
    """Show an arm named `name`: the scene and plots that `draw()` returns, controls, what it has.

    `controls` is the markup of its `form`, `data` what its scripts have from Python.
    """
    with plot_style():
        drawn = pictures(draw(), name)
    data = json.dumps(data | {"scene": drawn[0].messages()}, allow_nan=False)
    data = data.replace("<", r"\u003c")  # or the model's XML would confuse the page's
    named = f'id="{name}" data-mode="{mode}"' + f' data-law="{law}"' * bool(law)
    page = (
        f'<div class="vmc-live" {named}>{side_by_side(drawn, alt)}{controls}'
        f'<script type="application/json">{data}</script></div>'
    )
    if render_mode() == "book":
        display(HTML(frame(page)))
    elif render_mode() == "live":
        style = f"<style>{(STATIC / 'live.css').read_text(encoding='utf-8')}</style>"
        vendored = VENDORED | {MUJOCO.name: MUJOCO}
        widget = Live(page, widget_script("arm/start.js"), vendored=vendored)
        display(still(alt, drawn, name), widget, HTML(style))


def page_constants():
    """What the page has from Python, as JSON takes it: the model, constants, past experience."""
    template_set = templates.load()
    knots = np.linalg.pinv(spline()) @ template_set.excitations
    return {
        "xml": XML,
        "joints": ["humerus", "forearm"],
        "tip": "hand",
        "views": [[0, 1]],
        "muscles": MUSCLES,
        "F0": F0.tolist(),
        "L0": L0.tolist(),
        "slack": SLACK.tolist(),
        "limits": LIMITS.tolist(),
        "kinematics": KINEMATICS,
        "step": STEP,
        "held": round(templates.HOLD / STEP),
        "every": templates.EVERY,
        "stop": {"stiffness": STOP_STIFFNESS, "damping": STOP_DAMPING},
        "muscle": {
            "tauActivation": muscle.TAU_ACTIVATION,
            "tauDeactivation": muscle.TAU_DEACTIVATION,
            "maxVelocity": muscle.MAX_VELOCITY,
            "velocityRange": muscle.VELOCITY_RANGE,
            "answers": _answers(),
        },
        "start": templates.START.tolist(),
        "rest": static_activation(templates.START).tolist(),
        "templateSet": packed_templates(template_set.points, knots, SAMPLES),
        "calibration": CALIBRATION,
    }


def first_reach(movement):
    """A reach as the page would have made it: what it shows before the physics is there."""
    motion, ten = movement.motion, slice(None, None, 10)  # of its moments the path has one
    return {
        "weights": movement.plan.weights.tolist(),
        "reached": movement.endpoint.tolist(),
        "error": float(movement.error),
        "speed": float(movement.speed),
        "goal": hand(inverse_kinematics(movement.plan.target)).tolist(),
        "hand": motion.wrist.mean(axis=0).tolist(),
        "path": motion.hand[ten].round(4).tolist(),
        "q": motion.q[-1].tolist(),
        "activation": motion.activation[-1].tolist(),
        "joints": geometry(motion.q[-1]).joints.tolist(),
    }


def packed_templates(points, knots, steps):
    """Templates as the page takes them: where they end, and the knots (N, …) of their commands."""
    return {
        "points": points.tolist(),
        "knots": pack_bytes(np.float32(knots).tobytes()),
        "shape": knots.shape,
        "steps": steps,
    }


def _answers():
    """What Python's muscle answers now: a page that answers otherwise has another law."""
    return [
        (u, a, *rest, float(muscle.activation_rate(u, a)), float(muscle.force(a, *rest, 1.0)))
        for u, a, *rest in _ASKED
    ]


def _bench_view():
    """The arm at rest, and the plane it moves in."""
    figure, ax = plt.subplots(figsize=(4.1, 3.4))
    plane_view(ax)
    return arm_scene(templates.START), figure


def _reach_view(movement):
    """The arm at the end of a reach, its target, its remembered reaches, room for a magnifier."""
    target, end = (hand(inverse_kinematics(p)) for p in (movement.plan.target, movement.endpoint))
    balls = [(target, "green"), *((end, colour) for colour in _ENDS)]
    figure, ax = plt.subplots(figsize=(4.2, 2.5), layout="none")
    plane(ax, movement.plan.template_set.points)
    ax.set_position((0.18, 0.19, 0.51, 0.79))
    motion = movement.motion
    return arm_scene(motion.q[-1], motion.activation[-1], balls=balls), figure
