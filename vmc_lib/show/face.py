"""What a demo looks like: its pictures, and below them its controls, as markup."""

import itertools

from vmc_lib.show.controls import Pad, Switch, fold
from vmc_lib.show.data_table import DataTable
from vmc_lib.show.figures import numbers, side_by_side
from vmc_lib.show.positions import strides
from vmc_lib.show.scene import Scene

SWITCHES = '<div class="vmc-control"><div class="vmc-options">{}</div></div>'  # a row of them


def lines(parts):
    """The lines of each part: a scene's messages, or a picture's markup."""
    return [part.messages() if isinstance(part, Scene) else part.split("\n") for part in parts]


def face(alt, parts, controls, name, printed=(), more=()):
    """The pictures, and below them what the script moves them by.

    Behind a fold stand the controls that are named in `more`, and the plots' numbers.
    """
    attribute = f' data-printed="{" ".join(printed)}"' if printed else ""
    pairs = list(zip(controls.items(), strides(controls), strict=True))
    shown, folded = (
        _rows([pair for pair in pairs if (pair[0][0] in more) == behind], name)
        for behind in (False, True)
    )
    tables = [part for part in parts if isinstance(part, DataTable)]
    form = f'<form class="vmc-controls" autocomplete="off"{attribute}>{shown}</form>'
    both = [side_by_side([part for part in parts if part not in tables], alt), form]
    if "<a " in both[0]:
        both.reverse()  # what chooses among links comes before them
    minor = f'<form class="vmc-controls" autocomplete="off">{folded}</form>'
    behind = fold(minor + "".join(map(numbers, tables)))
    return "".join([*both, behind, '<p class="vmc-spoken" aria-live="polite"></p>'])


def _rows(pairs, name):
    """The faces of ((key, control), stride) pairs; switches that follow each other share a row."""
    faces = ""
    for switches, row in itertools.groupby(pairs, lambda pair: isinstance(pair[0][1], Switch)):
        inside = "".join(one.html(f"{name}-{key}", stride) for (key, one), stride in row)
        faces += SWITCHES.format(inside) if switches else inside
    return faces


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
