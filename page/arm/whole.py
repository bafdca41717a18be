"""A whole arm in the page: a target in space, and a reach of all muscles that MuJoCo runs there."""

from page.arm.controls import form, plans, readings, target_sliders
from page.arm.live import CALIBRATION, names, show
from vmc_lib.show.controls import fold

TELLS = {
    "planned": "planned miss",
    "tries": "corrections",
    "calibrated": "corrected miss",
    "speed": "speed in the hold",
    "weights": "weights",
}
FOLDED = {"active": "muscles above 5 %"}  # the chapter asks how many, below


def live_whole_arm(arm, draw, zone, target, alt):
    """Show a whole arm with its physics in the page, behind a button that starts it.

    `arm` is what the page has of it, as JSON takes it: the model's `xml`, its `start` and the
    activations of `rest`, the seconds of a `step` and how often physics is stepped in it (`steps`),
    how many of these the hold lasts (`held`) and how many lie between two looks at it (`every`),
    the bodies at its `joints` and the site of its `tip`; the `templateSet` (see
    `packed_templates`); `muscles`, `bones` and how all lies at first, `still`. `draw()` returns its
    scene and plots, each of which shows two of three axes (`views`). The reader sets a target
    within `zone` (2, 3), in m; it first stands at `target` (3,). `alt` describes it all in words.
    """
    name = next(names)
    rule = '<input type="hidden" name="rule" value="broydenCalibration">'
    forward, *others = target_sliders(name, zone, target)
    controls = "".join(others) + fold(f"<div>{forward}{plans()}</div>{readings(FOLDED)}") + rule
    controls_form = form("Target and plan", {"calibrate": "Correct"}, controls, TELLS)
    data = arm | {"calibration": CALIBRATION, "goal": list(map(float, target))}
    show(name, "reach", draw, controls_form, data, alt)
