"""`explore`: one declaration of an interactive demo, three render modes.

A demo is a pure function of its controls over a finite grid. In a live kernel the page's script
asks for one state after the other; in the built book (`VMC_RENDER_MODE=book`) every state is
computed once and travels in the page; in a test (`VMC_RENDER_MODE=test`) one control after the
other goes through all its values. In both, every control must matter.
"""

import gc
import itertools
import math
from functools import cache
from uuid import uuid4

import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.alt_text import alt_text
from vmc_lib.show.controls import Pad, Slider, Switch, as_control
from vmc_lib.show.data_table import data_tables
from vmc_lib.show.figures import frame, parts_of, pictures, side_by_side
from vmc_lib.show.live import Live, demo_script, exclusive_pyplot
from vmc_lib.show.numbers import Numbers
from vmc_lib.show.outputs import Markup, still
from vmc_lib.show.packed import pack_arrays, pack_json
from vmc_lib.show.palette import plot_style
from vmc_lib.show.positions import (
    address,
    along,
    first_position,
    idle_controls,
    strides,
    values_at,
)
from vmc_lib.show.render_mode import render_mode
from vmc_lib.show.scene import Scene

MOST_POSITIONS = 200
SWITCHES = '<div class="vmc-control"><div class="vmc-options">{}</div></div>'  # a row of them
SAMPLE = 25  # positions along a control, of a demo that the page works out
_demos = itertools.count(1)


def explore(draw, caption="", alt=None, in_page=None, data=None, printed=(), **controls):
    """Show what `draw` returns and let the reader move its controls.

    `draw(**values)` is a pure function that returns a picture (see `figures`). Each control is a
    `Slider`, a `Pad`, a list of strings (a choice) or `[False, True]` (a switch); a list starts at
    its first. `caption` is Markdown and says what to notice; `alt` describes the picture in words,
    as text or as a function of the same controls; a plot without it describes itself. `printed` is
    where paper shows it, a list of {control: value} moved from the start; by default there, and
    with its first slider at its other end. Returns the demo's `Numbers`, for sentences about what
    it shows. Raises ValueError for a demo that could not work: more than 200 positions, a control
    without effect, a start that is no value, an unknown picture.

    A demo may have as many positions as it likes if the book's page works them out itself:
    `in_page` is (name, ground, given), or a function that returns these, called for the book alone.
    The page's `works[name]` (page/demos) draws what `draw` does, by what it is `given` (as JSON
    takes it), on plots or photos that `ground()` returned; with `views`, it puts a pad's handle on
    several of them. Here a sample is evaluated, along each control.

    `data` are arrays, or dictionaries of them, by the names that the cell has for them: they travel
    with the book's page, whose Python could not make them, or not soon.
    """
    if not (callable(draw) and isinstance(caption, str)):
        raise ValueError(
            f"explore({draw!r}, {caption!r}, …): give the function that draws, then a caption"
        )
    controls = {name: as_control(name, spec) for name, spec in controls.items()}
    printed = [address(values, controls) for values in printed]
    positions = math.prod(len(control.values) for control in controls.values())
    if positions > MOST_POSITIONS and not in_page:
        raise ValueError(
            f"{positions} positions are too many for a page (at most {MOST_POSITIONS}): "
            "give the controls fewer values"
        )
    # in JupyterLab several notebooks share a page, and kernels start anew
    name = f"demo-{uuid4().hex[:8] if render_mode() == 'live' else next(_demos)}"

    def state(place):
        """The description and the pictures at a position of the grid."""
        values = values_at(place, controls)
        try:
            return draw_state(draw, values, name, alt, not in_page)
        except Exception as error:
            error.add_note(f"It was asked for {values}.")
            raise

    texts = {key: c.texts[c.first] for key, c in controls.items() if isinstance(c, Slider)}
    if render_mode() == "live":
        return Numbers(name, _live(state, caption, controls, name), texts)
    state = cache(state)
    sample = along(controls, SAMPLE if in_page else MOST_POSITIONS)
    every = sample if in_page else range(positions)
    places = every if render_mode() == "book" else sample
    idle = _idle(state, places, controls)
    if idle and places is not every:  # a control may matter only where another has moved
        places = every
        idle = _idle(state, places, controls)
    if idle:
        raise ValueError(f"the control {idle[0].label!r} never changes the picture")
    start, states = state(first_position(controls)), [state(place) for place in places]
    _check_pads(start[1], controls)
    for _, parts in states:
        _same_kinds(parts, start[1])
    if render_mode() == "book":
        stored = _worked_out(in_page, controls, name) if in_page else _stored(states)
        stored |= {"data": pack_arrays(data)} if data else {}
        display(HTML(_page(*start, stored, caption, controls, name, printed)))
    return Numbers(name, start[0], texts)


def draw_state(draw, values, name, alt=None, tables=True):
    """What a demo shows for these values of its controls: words, and parts (see `pictures`)."""
    with exclusive_pyplot(), plot_style():
        picture = parts_of(draw(**values))
        numbers = data_tables(picture) if tables else []  # before the figures are closed
        words = alt(**values) if callable(alt) else alt or alt_text(picture)
        return words, [*pictures(picture, name), *numbers]


def figure(picture, caption="", alt=None):
    """Show a picture that does not move, or what a function without arguments draws."""
    explore(picture if callable(picture) else lambda: picture, caption, alt)


def _idle(state, places, controls):
    return idle_controls([repr(lines(state(place)[1])) for place in places], places, controls)


def _same_kinds(parts, others):
    one, other = ([isinstance(part, Scene) for part in drawn] for drawn in (parts, others))
    if one != other:
        raise ValueError("the draw function must return the same kinds of pictures everywhere")


def _check_pads(parts, controls):
    axes = any(isinstance(part, str) and "data-axes" in part for part in parts)
    pads = [control.label for control in controls.values() if isinstance(control, Pad)]
    if pads and not axes:
        raise ValueError(
            f"the pad {pads[0]!r} has no plot or photo to lie on: draw one beside the scene, "
            "and return (figure, scene)"
        )


def lines(parts):
    """The lines of each part: a scene's messages, or a picture's markup."""
    return [part.messages() if isinstance(part, Scene) else part.split("\n") for part in parts]


def _face(alt, parts, controls, name, printed=()):
    """The pictures, and below them what the script moves them by."""
    attribute = f' data-printed="{" ".join(printed)}"' if printed else ""
    form, pairs = "", zip(controls.items(), strides(controls), strict=True)
    for switches, row in itertools.groupby(pairs, lambda pair: isinstance(pair[0][1], Switch)):
        faces = "".join(one.html(f"{name}-{key}", stride) for (key, one), stride in row)
        form += SWITCHES.format(faces) if switches else faces
    form = f'<form class="vmc-controls" autocomplete="off"{attribute}>{form}</form>'
    face = [side_by_side(parts, alt), form]
    if "<a " in face[0]:
        face.reverse()  # what chooses among links comes before them
    return "".join([*face, '<p class="vmc-spoken" aria-live="polite"></p>'])


def _moves(parts, controls):
    return controls or any(isinstance(part, Scene) for part in parts)


def _page(alt, parts, data, caption, controls, name, printed):
    """The demo as HTML: its first state to be seen at once, and compressed data for all others."""
    if not _moves(parts, controls):
        return frame(side_by_side(parts, alt), name, caption)
    data = f'<script type="application/gzip">{pack_json(data)}</script>'
    return frame(_face(alt, parts, controls, name, printed) + data, name, caption)


def _stored(states):
    """All states: a table of distinct lines, and each state as places in it.

    States have most of their lines in common (a photo is one line), so each is stored once.
    """
    table = {}

    def indices(lines):
        return [table.setdefault(line, len(table)) for line in lines]

    rows = [[indices(part) for part in ([alt], *lines(parts))] for alt, parts in states]
    return {"lines": list(table), "states": rows}


def _worked_out(in_page, controls, name):
    """What the page needs to work every state out: see `explore`."""
    work, ground, given = in_page() if callable(in_page) else in_page
    with plot_style():
        grounds = lines(pictures(ground(), name))
    axes = [axis for control in controls.values() for axis in getattr(control, "pair", [control])]
    grid = [np.asarray(axis.values).tolist() for axis in axes]
    return {"work": work, "grounds": grounds, "given": given, "grid": grid}


def _live(state, caption, controls, name):
    """The same demo in a kernel, and a still of it for when the kernel is gone; its first words."""
    alt, parts = state(first_position(controls))
    _check_pads(parts, controls)
    if not _moves(parts, controls):
        display(Markup(frame(side_by_side(parts, alt), caption=caption), alt))
        return alt
    current = alt, parts  # what the reader sees

    def answer(place):
        nonlocal current
        alt, changed = state(place)
        _same_kinds(changed, parts)
        current = alt, changed
        return [[alt], *lines(changed)]

    def keep(views):
        """Let the still show what the reader sees; of scenes in sight the browser sends a view."""
        (alt, parts), views = current, iter(views)
        views = [isinstance(part, Scene) and next(views) for part in parts]
        parts = [f'<img alt="" src="{v}">' if v else p for p, v in zip(parts, views, strict=True)]
        handle.update(still(alt, parts, name))

    face = _face(alt, parts, controls, name)
    face += '<p class="vmc-kernel" role="status"></p><p class="vmc-error" role="alert"></p>'
    scenes = [part.messages() if isinstance(part, Scene) else None for part in parts]
    handle = display(still(alt, parts, name), display_id=True)
    answers = {"state": answer, "still": keep}
    display(Live(frame(face, name), demo_script(), answers, first=[[alt], *scenes]))
    if caption:
        display(Markup(frame("", caption=caption), caption))
    _freeze_once()
    return alt


@cache
def _freeze_once():
    gc.collect()
    gc.freeze()  # or at times a picture waits until all that is loaded has been looked through
