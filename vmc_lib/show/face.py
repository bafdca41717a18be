"""What a demo looks like: its pictures, and below them its controls, as markup."""

import itertools

from vmc_lib.show.controls import Pad, Switch
from vmc_lib.show.figures import side_by_side
from vmc_lib.show.positions import strides
from vmc_lib.show.scene import Scene

SWITCHES = '<div class="vmc-control"><div class="vmc-options">{}</div></div>'  # a row of them


def lines(parts):
    """The lines of each part: a scene's messages, or a picture's markup."""
    return [part.messages() if isinstance(part, Scene) else part.split("\n") for part in parts]


def face(alt, parts, controls, name, printed=()):
    """The pictures, and below them what the script moves them by."""
    attribute = f' data-printed="{" ".join(printed)}"' if printed else ""
    form, pairs = "", zip(controls.items(), strides(controls), strict=True)
    for switches, row in itertools.groupby(pairs, lambda pair: isinstance(pair[0][1], Switch)):
        faces = "".join(one.html(f"{name}-{key}", stride) for (key, one), stride in row)
        form += SWITCHES.format(faces) if switches else faces
    form = f'<form class="vmc-controls" autocomplete="off"{attribute}>{form}</form>'
    both = [side_by_side(parts, alt), form]
    if "<a " in both[0]:
        both.reverse()  # what chooses among links comes before them
    return "".join([*both, '<p class="vmc-spoken" aria-live="polite"></p>'])


def moves(parts, controls):
    """Whether a reader has something to move: a control, or the view of a scene."""
    return controls or any(isinstance(part, Scene) for part in parts)


def check_same_kinds(parts, others):
    """ValueError where one state has a scene and another has none in its place."""
    one, other = ([isinstance(part, Scene) for part in drawn] for drawn in (parts, others))
    if one != other:
        raise ValueError("the draw function must return the same kinds of pictures everywhere")


def check_pads(parts, controls):
    """ValueError for a pad without a plot or a photo below it."""
    axes = any(isinstance(part, str) and "data-axes" in part for part in parts)
    pads = [control.label for control in controls.values() if isinstance(control, Pad)]
    if pads and not axes:
        raise ValueError(
            f"the pad {pads[0]!r} has no plot or photo to lie on: draw one beside the scene, "
            "and return (figure, scene)"
        )
