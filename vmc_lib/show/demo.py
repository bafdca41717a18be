"""`explore`: one declaration of an interactive demo, three render modes.

A demo is a pure function of its controls over a finite grid. In a live kernel, widgets call the
function; in the built book (`VMC_RENDER_MODE=book`) every position is computed once and travels
in the page; in a test (`VMC_RENDER_MODE=test`) every position is evaluated and every control must
matter.
"""

import base64
import gzip
import html
import itertools
import json
import math

import ipywidgets as widgets
import matplotlib.pyplot as plt
import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.controls import as_control
from vmc_lib.show.figures import framed, pictures, side_by_side
from vmc_lib.show.palette import STYLE
from vmc_lib.show.render_mode import render_mode
from vmc_lib.show.scene import Scene, SceneView

MOST_POSITIONS = 200
_SPOKEN = '<span role="status" style="position: absolute; clip-path: inset(50%)">{}</span>'
_demos = itertools.count(1)


def explore(draw, caption, alt, **controls):
    """Show what `draw` returns and let the reader move its controls.

    `draw(**values)` is a pure function that returns a picture (see `figures`). Each control is a
    `Slider`, a `Pad`, a list of strings (a choice) or `[False, True]` (a switch); a list starts at
    its first. `caption` is Markdown and says what to notice; `alt` describes the picture in words,
    as text or as a function of the same controls. Raises ValueError for a demo that could not
    work: more than 200 positions, a control without effect, a start that is no value, an unknown
    picture.
    """
    controls = {name: as_control(name, spec) for name, spec in controls.items()}
    positions = math.prod(len(control.values) for control in controls.values())
    if positions > MOST_POSITIONS:
        raise ValueError(
            f"{positions} positions are too many for a page (at most {MOST_POSITIONS}): "
            "give the controls fewer values"
        )
    describe = alt if callable(alt) else lambda **values: alt
    if render_mode() == "live":
        return _live(draw, caption, describe, controls)
    name = f"demo-{next(_demos)}"
    states = _evaluate(draw, describe, controls, name)
    if render_mode() == "book":
        display(HTML(_page(states, caption, controls, name)))


def figure(picture, caption, alt):
    """Show a picture that does not move, or what a function without arguments draws."""
    explore(picture if callable(picture) else lambda: picture, caption, alt)


def _evaluate(draw, describe, controls, name):
    """Every state in turn, as (alt, parts); the last control changes fastest."""
    states = []
    for values in itertools.product(*(control.values for control in controls.values())):
        chosen = dict(zip(controls, values, strict=True))
        parts = _drawn(draw, chosen, name)
        states.append((describe(**chosen), parts))
    kinds = {tuple(isinstance(part, Scene) for part in parts) for _, parts in states}
    if len(kinds) > 1:
        raise ValueError("the draw function must return the same kinds of pictures everywhere")
    looks = {}  # equal pictures get equal numbers
    grid = [looks.setdefault(repr([_lines(p) for p in parts]), len(looks)) for _, parts in states]
    grid = np.reshape(grid, [len(control.values) for control in controls.values()])
    for axis, control in enumerate(controls.values()):
        if (grid == grid.take([0], axis)).all():
            raise ValueError(f"the control {control.label!r} never changes the picture")
    return states


def _drawn(draw, values, name):
    with plt.rc_context(STYLE):
        return pictures(draw(**values), name)


def _lines(part):
    return part.messages() if isinstance(part, Scene) else part.split("\n")


def _page(states, caption, controls, name):
    """The demo as HTML: its first state to be seen at once, and all states as compressed data."""
    strides = np.cumprod([1, *(len(c.values) for c in reversed(controls.values()))])[-2::-1]
    first = sum(c.first * int(s) for c, s in zip(controls.values(), strides, strict=True))
    form = "".join(
        control.html(f"{name}-{key}", int(stride))
        for (key, control), stride in zip(controls.items(), strides, strict=True)
    )
    alt, parts = states[first]
    inside = side_by_side(parts, alt)
    if controls or any(isinstance(part, Scene) for part in parts):
        inside += f'<form class="vmc-controls" autocomplete="off">{form}</form>'
        inside += '<p class="vmc-spoken" aria-live="polite"></p>'
        inside += f'<script type="application/gzip">{_pack(states)}</script>'
    return framed(inside, caption, name)


def _pack(states):
    """All states as gzip in base64: a table of distinct lines, and each state as places in it.

    States have most of their lines in common (a photo is one line), so each is stored once.
    """
    table = {}

    def places(lines):
        return [table.setdefault(line, len(table)) for line in lines]

    rows = [[places([alt]), *(places(_lines(part)) for part in parts)] for alt, parts in states]
    data = json.dumps({"lines": list(table), "states": rows}, separators=(",", ":"))
    return base64.b64encode(gzip.compress(data.encode(), mtime=0)).decode()


def _live(draw, caption, describe, controls):
    """The same demo in a kernel: ipywidgets call `draw`."""
    name = f"demo-{next(_demos)}"
    made = {key: control.widget() for key, control in controls.items()}
    views, alt = [], widgets.HTML()

    def show(_=None):
        values = {key: controls[key].read(sources) for key, (sources, _) in made.items()}
        parts = _drawn(draw, values, name)
        if not views:
            views.extend(SceneView() if isinstance(p, Scene) else widgets.HTML() for p in parts)
        for view, part in zip(views, parts, strict=True):
            if isinstance(part, Scene):
                view.messages = part.messages()
            else:
                view.value = part
        alt.value = _SPOKEN.format(html.escape(describe(**values)))

    show()
    for sources, _ in made.values():
        for source in sources:
            source.observe(show, "value")
    row = widgets.Layout(display="flex", flex_flow="row wrap", align_items="center")
    display(
        widgets.VBox([widgets.Box(views, layout=row), *(shown for _, shown in made.values()), alt]),
        HTML(framed("", caption)),
    )
