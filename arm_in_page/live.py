"""The arm itself in the page: its physics runs there, in the reader's hand.

MuJoCo's WebAssembly build reads the library's own `arm26.xml`; scripts in `static` add the muscle
law, planning and calibration, and a test holds them to the Python. Their constants come from here.
"""

import base64
import gzip
import itertools
import json
from functools import partial
from importlib.metadata import version
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import HTML, display

from vmc_lib.arm import muscle
from vmc_lib.arm.dynamics import coefficients, hand
from vmc_lib.arm.engines import STOP_DAMPING, STOP_STIFFNESS
from vmc_lib.arm.kinematics import BENT, TRUNK, TRUNK_RANGE, inverse_kinematics
from vmc_lib.arm.model import F0, L0, LIMITS, MUSCLES, SLACK, STEP, XML
from vmc_lib.cerebellum.offline import GAINS, LARGEST_STEP
from vmc_lib.motor import templates
from vmc_lib.motor.inverse_dynamics import SAMPLES, spline, static_activation
from vmc_lib.motor.planning import plan
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane, plane_view
from vmc_lib.show.controls import radios, slider
from vmc_lib.show.figures import framed, pictures, side_by_side
from vmc_lib.show.live import VENDORED, Live
from vmc_lib.show.outputs import Markup, still
from vmc_lib.show.palette import STYLE
from vmc_lib.show.render_mode import STATIC as SHOW
from vmc_lib.show.render_mode import render_mode
from vmc_lib.show.scene import SCRIPTS as VIEWER

MODES = ("bench", "reach")
TRIALS = 2  # of our own calibration: off-line, the page has no more to learn
CALIBRATION = {"gains": GAINS, "trials": TRIALS, "largestStep": LARGEST_STEP}
KINEMATICS = {
    "hand": coefficients()[1].T.tolist(),
    "bent": BENT.tolist(),
    "trunk": {"axis": TRUNK.tolist(), "range": TRUNK_RANGE.tolist()},
}
STATIC = Path(__file__).parent / "static"
MUJOCO = STATIC / "vendor/mujoco.js"
VERSIONS = {"Python": version("mujoco"), "page": "3.14.0"}  # of MuJoCo
MODEL_SCRIPTS = ("vectors", "kinematics", "engine", "muscle", "arm", "arm26")
MODEL_SCRIPTS += ("templates", "planning", "calibration")
PAGE_SCRIPTS = ("whole", "drawing", "live", "bench", "reach", "start")
SCRIPTS = (  # in the order in which they need one another
    *(SHOW / name for name in ("axes.js", "handle.js")),
    *(STATIC / f"{name}.js" for name in MODEL_SCRIPTS + PAGE_SCRIPTS),
)
_ENDS = ("red", "purple")  # where the planned and the calibrated reach end
HAND = {way: f"hand, {way}" for way in ("forward", "up", "right")}
_POSE = {"shoulder": "shoulder", "elbow": "elbow", **HAND}
names = map("live-{}".format, itertools.count(1))
_ASKED = tuple(
    itertools.product((0.1, 0.9), (0.3, 0.7), (0.6, 1.3), (-0.5, 0.3))
)  # u, a, length, velocity


def live_arm(mode, caption, alt, target=(0.12, -0.42)):
    """Show the arm with its physics in the page, behind a button that starts it.

    `mode` is "bench" (six excitation sliders move the arm) or "reach" (the reader sets a target;
    the page plans, moves, shows the miss, calibrates off-line and moves again). `target` (2,), in
    the arm's plane and in m, is where the reach's target first stands. `caption` is Markdown and
    says what to notice, `alt` describes the picture in words. Raises ValueError when the mode is
    unknown or when no templates surround the target.
    """
    if mode not in MODES:
        raise ValueError(f"mode {mode!r} is unknown: choose one of {MODES}")
    name = next(names)
    if mode == "bench":
        draw, controls = _bench_view, _bench(name)
    else:
        target = np.asarray(target, float)
        draw, controls = partial(_reach_view, target), _reach(name, target)
    show(name, mode, draw, controls, given(), caption, alt)


def show(name, mode, draw, controls, data, caption, alt):
    """Show an arm named `name`: the scene and plots that `draw()` returns, controls, what it has.

    `controls` is the markup of its `form`, `data` what its scripts have from Python.
    """
    with plt.rc_context(STYLE):
        drawn = pictures(draw(), name)
    data = json.dumps(data | {"scene": drawn[0].messages()}, allow_nan=False)
    data = data.replace("<", r"\u003c")  # or the model's XML would confuse the page's
    page = (
        f'<div class="vmc-live" id="{name}" data-mode="{mode}">{side_by_side(drawn, alt)}{controls}'
        f'<script type="application/json">{data}</script></div>'
    )
    if render_mode() == "book":
        display(HTML(framed(page, caption)))
    elif render_mode() == "live":
        style = f"<style>{(STATIC / 'live.css').read_text(encoding='utf-8')}</style>"
        vendored = VENDORED | {MUJOCO.name: MUJOCO}
        widget = Live(page, "vmcStart", [*VIEWER, *SCRIPTS], vendored=vendored)
        display(still(alt, drawn, name), widget, Markup(style + framed("", caption), caption))


def given():
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
        "templateSet": experience(template_set.points, knots, SAMPLES),
        "calibration": CALIBRATION,
    }


def experience(points, knots, steps):
    """Templates as the page takes them: where they end, and the knots (N, …) of their commands."""
    packed = gzip.compress(np.float32(knots).tobytes(), mtime=0)
    return {
        "points": points.tolist(),
        "knots": base64.b64encode(packed).decode(),
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
    figure, ax = plt.subplots(figsize=(4.4, 4.4))
    plane_view(ax)
    return arm_scene(templates.START), figure


def _bench(name):
    """Six sliders."""
    rest = zip(MUSCLES, static_activation(templates.START).round(2), strict=True)
    sliders = "".join(_slider(name, muscle, muscle, (0, 1, 0.01), u) for muscle, u in rest)
    buttons = {"step": "Step 10 ms", "reset": "Reset"}
    return form("Excitation of each muscle", buttons, sliders, {"time": "time"} | _POSE)


def _reach_view(target):
    """The arm at rest before its remembered reaches, and a target."""
    balls = [
        (hand(inverse_kinematics(target)), "green"),
        *((hand(templates.START), c) for c in _ENDS),
    ]
    figure, ax = plt.subplots(figsize=(5.2, 4.4))
    plane(ax, templates.load().points)
    return arm_scene(templates.START, balls=balls), figure


def _reach(name, target):
    """A target to be set, and rules to choose from."""
    template_set = templates.load()
    plan(target, template_set)  # raises when no templates surround it
    zone = [end(template_set.points, axis=0).round(3) for end in (np.min, np.max)]
    rules = {"algorithm1": "published (Eq. 6–7)", "broydenCalibration": "ours"}
    controls = target_sliders(name, zone, target) + plans()
    controls += radios("rule", "calibration", rules, "algorithm1", {})
    tells = {"planned": "planned miss", "tries": "tries", "calibrated": "calibrated miss"}
    tells |= {"speed": "speed in the hold", "weights": "weights"} | _POSE
    return form("Target and rules", {"calibrate": "Calibrate"}, controls, tells)


def plans():
    """The two rules by which a reach may be planned, to choose from."""
    rules = {"habitualWeights": "habit (Eq. 5)", "exactWeights": "exact (Eq. 4)"}
    return radios("weights", "plan", rules, "habitualWeights", {})


def target_sliders(name, zone, target):
    """A slider for each axis of a target, in m, between the corners of its `zone` (2, axes)."""
    return "".join(
        _slider(name, key, f"target, {key}", (low, high, 0.005), at)
        for key, low, high, at in zip(HAND, *zone, target, strict=False)
    )


def form(legend, buttons, controls, tells):
    """What the reader moves, closed until the arm is started, and what the arm tells."""
    closed = "".join(
        f'<button type="button" name="{name}" disabled>{text}</button>'
        for name, text in buttons.items()
    )
    readings = "".join(
        f'<div><dt>{label}</dt><dd data-tell="{name}">–</dd></div>' for name, label in tells.items()
    )
    size = f"{MUJOCO.stat().st_size / 1e6:.1f} MB"
    physics = f"MuJoCo {VERSIONS['page']} ({size}, part of this book)"
    return (
        '<form class="vmc-live-form" autocomplete="off">'
        f'<div><button type="button" name="main">Start the arm</button>{closed}</div>'
        f'<p role="status">{physics} is loaded when you start.</p>'
        f'<fieldset disabled><legend class="vmc-spoken">{legend}</legend>{controls}</fieldset>'
        f"<dl>{readings}</dl></form>"
    )


def _slider(page, name, label, span, start):
    low, high, step = span
    own = {"name": name, "min": low, "max": high, "step": step, "value": f"{start:.3g}"}
    return slider(f"{page}-{name}", label, own["value"].replace("-", "−"), own)
