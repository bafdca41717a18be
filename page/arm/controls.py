"""What the reader moves an arm in the page by, as markup: buttons, sliders, rules to choose."""

from importlib.metadata import version

import numpy as np

from page.bundle import STATIC
from vmc_lib.arm.model import MUSCLES
from vmc_lib.motor import templates
from vmc_lib.motor.inverse_dynamics import static_activation
from vmc_lib.show.controls import fold, radios, slider
from vmc_lib.show.markup import minus

MUJOCO = STATIC / "vendor/mujoco.js"
VERSIONS = {"Python": version("mujoco"), "page": "3.14.0"}  # of MuJoCo
HAND = {way: f"hand, {way}" for way in ("forward", "up", "right")}
_POSE = {"shoulder": "shoulder", "elbow": "elbow", **HAND}


def bench_form(name):
    """Six sliders, of which three stand behind a fold."""
    rest = zip(MUSCLES, static_activation(templates.START).round(2), strict=True)
    sliders = {muscle: _slider(name, muscle, muscle, (0, 1, 0.01), u) for muscle, u in rest}
    shown = "".join(sliders.pop(muscle) for muscle in ("TRIlong", "BIClong", "BRA"))
    sliders = shown + fold(f"<div>{''.join(sliders.values())}</div>")
    buttons = {"step": "Step 10 ms", "reset": "Reset"}
    return form("Excitation of each muscle", buttons, sliders, {"time": "time"} | _POSE)


def reach_form(name, target, mode):
    """A target to be set, and rules to choose from; or weights, in place of a rule to plan by.

    And in the mode "templates" these, to be ticked.
    """
    zone = [end(templates.load().points, axis=0).round(3) for end in (np.min, np.max)]
    rules = {"algorithm1": "published (Eq. 6–7)", "broydenCalibration": "Broyden calibration"}
    shown, folded = "".join(target_sliders(name, zone, target)), plans()
    if mode == "weights":  # the target is dragged, or set behind the fold
        shown, folded = _weights(name), shown
    rule = "broydenCalibration" if mode == "templates" else "algorithm1"  # a kept reach then hits
    folded += radios("rule", "calibration", rules, rule, {})
    controls = shown + fold(f"<div>{folded}</div>")
    tells = {"planned": "planned miss", "tries": "tries", "calibrated": "calibrated miss"}
    tells |= {"speed": "speed in the hold"}
    buttons = {"calibrate": "Calibrate"}
    if mode == "weights":
        tells |= {"planned": "miss before calibration", "sum": "sum of the weights"}
        buttons |= {"plan": "Plan's weights"}
    if mode == "templates":
        controls += _templates()
        buttons |= {"keep": "Keep as a template", "all": "First templates again"}
    return form("Target and rules", buttons, controls, tells)


def _templates():
    """A box to tick for each template, folded: its dot on the plot does the same."""
    places = (np.round(templates.load().points, 3) + 0.0).tolist()  # no −0
    boxes = "".join(
        f'<label><input type="checkbox" name="template" checked> {place}</label>'
        for place in (minus(f"{x:.3f}, {y:.3f}") for x, y in places)
    )
    return (
        '<details class="vmc-numbers-of"><summary>The templates, one by one</summary>'
        '<fieldset class="vmc-control"><legend>forward, up (m)</legend>'
        f'<div class="vmc-options">{boxes}</div></fieldset></details>'
    )


def _weights(name):
    """A slider for the weight of the nearest template in each quadrant, and habit to begin with.

    Two by two they stand as the quadrants do; its name says which of the plan's weights it is.
    """
    places = {1: "upper left", 0: "upper right", 2: "lower left", 3: "lower right"}
    sliders = (
        _slider(name, f"weight-{k}", f"weight, {where}", (-0.25, 1, 0.005), 0.25)
        for k, where in places.items()
    )
    return "".join(sliders) + '<input type="hidden" name="weights" value="habitualWeights">'


def plans():
    """The two rules by which a reach may be planned, to choose from."""
    rules = {"habitualWeights": "habit (Eq. 5)", "exactWeights": "exact (Eq. 4)"}
    return radios("weights", "plan", rules, "habitualWeights", {})


def target_sliders(name, zone, target):
    """A slider for each axis of a target, in m, between the corners of its `zone` (2, axes).

    Its stops are 1 mm apart, and the target is one of them.
    """
    low, high = zone
    spans = zip(HAND, np.round(low + np.mod(target - low, 0.001), 4), high, target, strict=False)
    return [_slider(name, way, f"target, {way}", (*ends, 0.001), at) for way, *ends, at in spans]


def form(legend, buttons, controls, tells):
    """What the reader moves, closed until the arm is started, and what the arm tells."""
    closed = "".join(
        f'<button type="button" name="{name}" disabled>{text}</button>'
        for name, text in buttons.items()
    )
    size = f"{MUJOCO.stat().st_size / 1e6:.1f} MB"
    physics = f"MuJoCo {VERSIONS['page']} ({size}, part of this book)"
    return (
        '<form class="vmc-live-form" autocomplete="off">'
        f'<div><button type="button" name="main">Start the arm</button>{closed}</div>'
        f'<p role="status">{physics} is loaded when you start.</p>'
        f'<fieldset disabled><legend class="vmc-spoken">{legend}</legend>{controls}</fieldset>'
        f"{readings(tells)}</form>"
    )


def readings(tells):
    """What an arm tells: a list of the labels of its numbers by name, each without a number yet."""
    rows = "".join(
        f'<div><dt>{label}</dt><dd data-tell="{name}">–</dd></div>' for name, label in tells.items()
    )
    return f"<dl>{rows}</dl>"


def _slider(page, name, label, span, start):
    low, high, step = span
    own = {"name": name, "min": low, "max": high, "step": step, "value": f"{start:.4g}"}
    return slider(f"{page}-{name}", label, minus(own["value"]), own)
