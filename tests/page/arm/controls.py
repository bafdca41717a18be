"""What a reader does with an arm in the page, and what it then says."""

import re

import numpy as np

TARGET = np.array([0.09, -0.37])  # in the arm's plane
WHOLE_ARM_TARGET = np.array([0.475, 0.105, -0.09])


def start(arm):
    arm.locator("[name=main]").click()
    arm.locator("form > fieldset:not([disabled])").wait_for()


def readout(arm, name):
    return arm.locator(f"[data-tell={name}]").inner_text()


def number(text):
    return float(re.match(r"−?[\d.]+", text)[0].replace("−", "-"))


def status(arm, beginning):
    """What the arm's status says once it begins like that."""
    return arm.locator("p[role=status]", has_text=re.compile(f"^{beginning}")).inner_text()


def set_target(arm, target):
    for name, place in zip(("forward", "up", "right"), target, strict=False):
        arm.get_by_label(f"target, {name}").fill(str(place), force=True)  # one may be folded
