"""The positions of a demo's controls: a grid of all their values, the last control's fastest.

A position is one number, the sum of each control's place among its values times its stride.
"""

import math
from dataclasses import replace

import numpy as np

from vmc_lib.show.controls import Pad


def strides(controls):
    """How much each control's place counts in a position: the last moves by one."""
    return np.cumprod([1, *(len(c.values) for c in reversed(controls.values()))])[-2::-1].tolist()


def first_position(controls):
    """The position where all controls stand at their start."""
    pairs = zip(controls.values(), strides(controls), strict=True)
    return sum(control.first * stride for control, stride in pairs)


def values_at(position, controls):
    """{name: value} of the controls at a position."""
    return {
        name: control.values[position // stride % len(control.values)]
        for (name, control), stride in zip(controls.items(), strides(controls), strict=True)
    }


def position(values, controls):
    """The position of {name: value}, each the nearest that its control has.

    ValueError for the name of no control, or a value beyond what its control has.
    """
    if unknown := values.keys() - controls.keys():
        raise ValueError(
            f"no control is called {', '.join(unknown)}: there are {list(controls)}; demos that "
            "are linked have the same controls"
        )
    pairs = zip(controls.items(), strides(controls), strict=True)
    return sum(control.nearest(values[name]) * stride for (name, control), stride in pairs)


def along(controls, most):
    """The positions where all controls begin, and where one has moved: at most so many of each."""
    positions = [first_position(controls)]
    for control, stride in zip(controls.values(), strides(controls), strict=True):
        steps = range(0, len(control.values), math.ceil(len(control.values) / most))
        positions += [positions[0] + (step - control.first) * stride for step in steps]
    return positions


def idle_controls(looks, positions, controls):
    """The controls that change no picture: positions that differ in one of them alone look alike.

    `looks` are the pictures at these positions, as text.
    """
    idle = []
    for control, stride in zip(controls.values(), strides(controls), strict=True):
        others = [(p // stride // len(control.values), p % stride) for p in positions]
        if len(set(zip(others, looks, strict=True))) == len(set(others)):
            idle.append(control)
    return idle


def address(values, controls):
    """Where controls stand, as a page's address says it (`address.js`) and as markup.

    Those that `values` ({name: value}) leaves out stand at their start; of pads nothing is said.
    """
    if unknown := values.keys() - controls.keys():
        raise ValueError(f"no control is called {unknown}: there are {list(controls)}")
    moved = controls | {name: replace(controls[name], start=v) for name, v in values.items()}
    stand = (f"{name}={one.first}" for name, one in moved.items() if not isinstance(one, Pad))
    return "&amp;".join(stand)
