"""Whole arm in the page: its model, its templates, and the scene and plots that show it."""

import json

import numpy as np

from book.figures.panels import panels
from book.figures.whole_arm import BONES, VIEWS, arm_data, lines, view_from
from page.arm.live import packed_templates
from reproduce.whole_arm import bones, habits, plant
from vmc_lib.show import COLOURS, props
from vmc_lib.show.scene import Scene

STRENGTH = 1.5e6  # N/m²: a drawn belly's cross-section is its force / STRENGTH (ours, for the eye)
BEFORE = 0.25  # share of each tendon before the belly (ours, by eye)
SLACK = 0.4, 0.6  # of a muscle's length at rest, at least and at most (ours: MyoArm's may be < 0)
START = habits.START @ plant.JOINT_COUPLING.T  # (18,)


def arm(past, rest):
    """The arm in its start posture, with activations (63,), and its memories (`live_whole_arm`)."""
    surfaces = json.loads(bones.FILE.read_bytes())
    _, ways = lines(START)
    still = {
        "activation": rest.tolist(),
        "frames": _frames(surfaces),
        "ways": [way.round(5).tolist() for way in ways],
    }
    return {
        "xml": plant.FILE.read_text(encoding="utf-8"),
        "joints": BONES,
        "tip": "fingertip",
        "views": [[x, y] for x, y, _ in VIEWS.values()],
        "start": START.tolist(),
        "rest": rest.tolist(),
        "step": plant.TICK,
        "held": plant.HOLD,
        "every": 1,
        "steps": plant.STEPS,
        "templateSet": packed_templates(past.points, past.excitations, plant.TICKS),
        "muscles": _bellies(),
        "bones": surfaces,
        "still": still,
    }


def _frames(surfaces):
    """Axes and place (12,) of every body that has bones."""
    data = arm_data(START)
    bodies = [data.body(name) for name in surfaces]
    return [[*body.xmat, *body.xpos] for body in bodies]


def _bellies():
    """What each muscle's belly is drawn by: name, tendon's slack in m, volume in m³ (`anatomy`)."""
    model, length = plant.MODEL, arm_data(START).ten_length
    low, high, force = model.actuator_gainprm[:, :3].T
    fibre = np.ptp(model.actuator_lengthrange, axis=1) / (high - low)
    slack = length * np.clip((model.actuator_lengthrange[:, 0] - low * fibre) / length, *SLACK)
    numbers = zip(plant.MUSCLES, slack, force / STRENGTH * (length - slack), strict=True)
    return [
        {"name": name, "slack": slack, "volume": volume, "before": BEFORE}
        for name, slack, volume in numbers
    ]


def pictures(past, target):
    """Where it is shown: a scene with a target (3,), and two views with where memories end."""
    space = Scene()
    space.look((0.61, 0.06, 0.92), at=(0.26, -0.12, 0.0))
    for k, colour in enumerate(("green", "red", "purple")):  # the target, both reaches' ends
        props.ball(space[f"goal/ball{k}"], target, colour)
        space[f"goal/ball{k}"].set_property("visible", k == 0)  # until a reach ends there
    plots = []
    for title, (x, y, label) in VIEWS.items():
        fig, ax = panels(size=(2.7, 2.3))
        ax.plot(past.points[:, x], past.points[:, y], "o", ms=2, color=COLOURS["grey"])
        view_from(ax, y, label, title)
        plots.append(fig)
    return space, *plots
