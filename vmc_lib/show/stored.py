"""A demo in the built page: its first state to be seen, and what its other states come from."""

import numpy as np

from vmc_lib.show.face import face, lines, moves
from vmc_lib.show.figures import frame, pictures, side_by_side
from vmc_lib.show.packed import pack_json
from vmc_lib.show.palette import plot_style


def page(alt, parts, data, caption, controls, name, printed, more):
    """The demo as HTML: its first state to be seen at once, and compressed data for all others."""
    if not moves(parts, controls):
        return frame(side_by_side(parts, alt), name, caption)
    data = f'<script type="application/gzip">{pack_json(data)}</script>'
    return frame(face(alt, parts, controls, name, printed, more) + data, name, caption)


def all_states(states):
    """All states: a table of distinct lines, and each state as places in it.

    States have most of their lines in common (a photo is one line), so each is stored once.
    """
    table = {}

    def indices(lines):
        return [table.setdefault(line, len(table)) for line in lines]

    rows = [[indices(part) for part in ([alt], *lines(parts))] for alt, parts in states]
    return {"lines": list(table), "states": rows}


def recipe(in_page, controls, name):
    """What the page needs to work every state out: see `explore`."""
    work, ground, given = in_page() if callable(in_page) else in_page
    with plot_style():
        grounds = lines(pictures(ground(), name))
    axes = [axis for control in controls.values() for axis in getattr(control, "pair", [control])]
    grid = [np.asarray(axis.values).tolist() for axis in axes]
    return {"work": work, "grounds": grounds, "given": given, "grid": grid}
