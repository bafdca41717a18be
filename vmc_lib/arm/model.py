"""The arm's parameters, as its MuJoCo model has them: OpenSim's arm26 (`arm26.xml`).

Postures q are (shoulder, elbow) in radians; (0, 0) hangs straight down, positive lifts the hand
forward and bends the elbow. Positions are metres in the shoulder frame: origin at the shoulder
joint, x forward, y up, z to the right.
"""

from importlib.resources import files
from xml.etree import ElementTree

import numpy as np

from vmc_lib.checks import is_within
from vmc_lib.data import read_only
from vmc_lib.short_repr import short

XML = (files("vmc_lib.arm") / "arm26.xml").read_text(encoding="utf-8")
_MODEL = ElementTree.fromstring(XML)  # noqa: S314 (MuJoCo would take a tenth of a second)


def _numbers(path, attribute):
    """The numbers in an attribute of every element at a path of the model."""
    rows = [element.get(attribute).split() for element in _MODEL.findall(path)]
    return read_only(np.squeeze(np.array(rows, float)))


MUSCLES = tuple(tendon.get("name") for tendon in _MODEL.findall("tendon/spatial"))
F0, L0, SLACK = (_numbers(f"custom/numeric[@name='{n}']", "data") for n in ("F0", "L0", "slack"))
LIMITS = _numbers("worldbody//joint", "range")  # (2, 2): lowest and highest angle of each joint
DAMPING = read_only(np.repeat(_numbers("default/joint", "damping"), 2))  # N m s: skin and joints
STEP = _numbers("option", "timestep").item()  # s


def check_load(load: float) -> None:
    """Raise ValueError where a `load` in kg cannot be held."""
    if not is_within(load, 0, 10):
        raise ValueError(f"a load of {short(load)} kg cannot be held; choose 0 to 10")
