"""The arm itself in the page: its physics runs there, in the reader's hand.

MuJoCo's WebAssembly build reads the library's own `arm26.xml`; scripts in `static` add the muscle
law, planning and calibration, and a test holds them to the Python. Their constants come from here.
"""

import base64
import itertools
import json
from pathlib import Path

import matplotlib.pyplot as plt
import mujoco
import numpy as np
from IPython.display import HTML, display

from vmc_lib.arm import muscle
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.model import F0, L0, LIMITS, MUSCLES, SLACK, STEP, XML
from vmc_lib.arm.simulate import STOP_DAMPING, STOP_STIFFNESS
from vmc_lib.cerebellum.offline import GAINS, LARGEST_STEP
from vmc_lib.motor import templates
from vmc_lib.motor.inverse_dynamics import SAMPLES, hold, spline
from vmc_lib.motor.planning import plan
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.controls import radios, slider
from vmc_lib.show.demo import still_of
from vmc_lib.show.figures import framed, pictures, side_by_side
from vmc_lib.show.live import STATIC as SHOW
from vmc_lib.show.live import VENDORED, Live
from vmc_lib.show.markup import styled
from vmc_lib.show.palette import STYLE
from vmc_lib.show.plane import plane, plane_view
from vmc_lib.show.render_mode import render_mode
from vmc_lib.show.scene import SCRIPTS as VIEWER

MODES = ("bench", "reach")
TRIALS = 2  # of our own calibration: off-line, the page has no more to learn
STATIC = Path(__file__).parent / "static"
MUJOCO = STATIC / "vendor/mujoco.js"
VERSIONS = {"Python": mujoco.__version__, "page": "3.14.0"}  # of MuJoCo
MODEL_SCRIPTS = ("vectors", "engine", "muscle", "arm", "templates", "planning", "calibration")
PAGE_SCRIPTS = ("drawing", "live", "bench", "reach", "start")
SCRIPTS = (  # in the order in which they need one another
    *(SHOW / name for name in ("axes.js", "handle.js")),
    *(STATIC / f"{name}.js" for name in MODEL_SCRIPTS + PAGE_SCRIPTS),
)
_ENDS = ("red", "purple")  # where the planned and the calibrated reach end
_POSE = {
    "shoulder": "shoulder",
    "elbow": "elbow",
    **{way: f"hand, {way}" for way in ("forward", "up", "right")},
}
_made = itertools.count(1)
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
    name = f"live-{next(_made)}"
    with plt.rc_context(STYLE):
        parts = _bench(name) if mode == "bench" else _reach(name, np.asarray(target, float))
    scene, plot, form = parts
    data = json.dumps(given() | {"scene": scene.messages()}, allow_nan=False)
    data = data.replace("<", r"\u003c")  # or the model's XML would confuse the page's
    drawn = pictures((scene, plot), name)
    page = (
        f'<div class="vmc-live" id="{name}" data-mode="{mode}">{side_by_side(drawn, alt)}{form}'
        f'<script type="application/json">{data}</script></div>'
    )
    if render_mode() == "book":
        display(HTML(framed(page, caption)))
    elif render_mode() == "live":
        style = f"<style>{(STATIC / 'live.css').read_text()}</style>"
        mujoco_js = {MUJOCO.name: MUJOCO}
        widget = Live(page, "vmcStart", [*VIEWER, *SCRIPTS], vendored=VENDORED | mujoco_js)
        display(HTML(style + styled(still_of(alt, drawn, name))), widget, HTML(framed("", caption)))


def given():
    """What the page has from Python, as JSON takes it: the model, constants, past experience."""
    template_set = templates.load()
    knots = np.float32(np.linalg.pinv(spline()) @ template_set.excitations)
    return {
        "xml": XML,
        "muscles": MUSCLES,
        "F0": F0.tolist(),
        "L0": L0.tolist(),
        "slack": SLACK.tolist(),
        "limits": LIMITS.tolist(),
        "step": STEP,
        "stop": {"stiffness": STOP_STIFFNESS, "damping": STOP_DAMPING},
        "muscle": {
            "tauActivation": muscle.TAU_ACTIVATION,
            "tauDeactivation": muscle.TAU_DEACTIVATION,
            "maxVelocity": muscle.MAX_VELOCITY,
            "velocityRange": muscle.VELOCITY_RANGE,
            "answers": _answers(),
        },
        "start": templates.START.tolist(),
        "rest": hold(templates.START).tolist(),
        "templateSet": {
            "points": template_set.points.tolist(),
            "knots": base64.b64encode(knots.tobytes()).decode(),
            "shape": knots.shape,
            "steps": SAMPLES,
        },
        "calibration": {"gains": GAINS, "trials": TRIALS, "largestStep": LARGEST_STEP},
    }


def _answers():
    """What Python's muscle answers now: a page that answers otherwise has another law."""
    return [
        (u, a, *rest, float(muscle.activation_rate(u, a)), float(muscle.force(a, *rest, 1.0)))
        for u, a, *rest in _ASKED
    ]


def _bench(name):
    """The arm at rest, the plane it moves in, and six sliders."""
    scene = arm_scene(templates.START)
    rest = zip(MUSCLES, hold(templates.START).round(2), strict=True)
    sliders = "".join(_slider(name, muscle, muscle, (0, 1, 0.01), u) for muscle, u in rest)
    buttons = {"step": "Step 10 ms", "reset": "Reset"}
    form = _form("Excitation of each muscle", buttons, sliders, {"time": "time"} | _POSE)
    figure, ax = plt.subplots(figsize=(4.4, 4.4))
    plane_view(ax)
    return scene, figure, form


def _reach(name, target):
    """The arm at rest before its remembered reaches, and a target to be set."""
    template_set = templates.load()
    plan(target, template_set)  # raises when no templates surround it
    balls = [
        (hand(inverse_kinematics(target)), "green"),
        *((hand(templates.START), c) for c in _ENDS),
    ]
    scene = arm_scene(templates.START, balls=balls)
    figure, ax = plt.subplots(figsize=(5.2, 4.4))
    plane(ax, template_set.points)
    low, high = (end(template_set.points, axis=0).round(3) for end in (np.min, np.max))
    sliders = "".join(
        _slider(name, key, f"target, {key}", (low[k], high[k], 0.005), target[k])
        for k, key in enumerate(("forward", "up"))
    )
    rules = {"algorithm1": "published (Eq. 6–7)", "broydenCalibration": "ours"}
    plans = {"habitualWeights": "habit (Eq. 5)", "exactWeights": "exact (Eq. 4)"}
    choices = radios("weights", "plan", plans, "habitualWeights", {})
    choices += radios("rule", "calibration", rules, "algorithm1", {})
    tells = {"planned": "planned miss", "tries": "tries", "calibrated": "calibrated miss"}
    tells |= {"weights": "weights"} | _POSE
    form = _form("Target and rules", {"calibrate": "Calibrate"}, sliders + choices, tells)
    return scene, figure, form


def _form(legend, buttons, controls, tells):
    """What the reader moves, closed until the arm is started, and what the arm tells."""
    closed = "".join(
        f'<button type="button" name="{name}" disabled>{text}</button>'
        for name, text in buttons.items()
    )
    told = "".join(
        f'<div><dt>{label}</dt><dd data-tell="{name}">–</dd></div>' for name, label in tells.items()
    )
    size = f"{MUJOCO.stat().st_size / 1e6:.1f} MB"
    physics = f"MuJoCo {VERSIONS['page']} ({size}, part of this book)"
    return (
        '<form class="vmc-live-form" autocomplete="off">'
        f'<div><button type="button" name="main">Start the arm</button>{closed}</div>'
        f'<p role="status">{physics} is loaded when you start.</p>'
        f'<fieldset disabled><legend class="vmc-spoken">{legend}</legend>{controls}</fieldset>'
        f"<dl>{told}</dl></form>"
    )


def _slider(page, name, label, span, start):
    low, high, step = span
    own = {"name": name, "min": low, "max": high, "step": step, "value": f"{start:.3g}"}
    return slider(f"{page}-{name}", label, own["value"].replace("-", "−"), own)
