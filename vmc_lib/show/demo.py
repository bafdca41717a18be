"""`explore`: one declaration of an interactive demo, three lives.

A demo is a pure function of its controls over a finite grid. In a live kernel, widgets call the
function; in the built book (`VMC_LIFE=book`) every position is computed once and travels in the
page; in a test (`VMC_LIFE=test`) every position is evaluated and every control must matter.
"""

import base64
import gzip
import html
import itertools
import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from IPython.display import HTML, display

from vmc_lib.show.figures import framed, pictures, side_by_side
from vmc_lib.show.scene import Scene, widget

MOST_POSITIONS = 200
_demos = itertools.count(1)


@dataclass(frozen=True)
class Control:
    """A labelled choice among finitely many values; `start` is the first shown."""

    values: Sequence
    label: str
    start: Any = None
    unit: str = ""

    def __post_init__(self):
        values = tuple(self.values)
        if len(values) < 2:
            raise ValueError(f"the control {self.label!r} has values {values}: give at least two")
        object.__setattr__(self, "values", values)
        if self.start is not None:
            _ = self.first  # raises when `start` is none of the values

    @property
    def first(self):
        """The position of the starting value."""
        if self.start is None:
            return 0
        for place, value in enumerate(self.values):
            if value == self.start or (_is_number(value) and np.isclose(value, self.start)):
                return place
        raise ValueError(f"{self.label!r} cannot start at {self.start!r}: not in {self.values}")

    def read(self, widgets):
        """The value that the control's widgets stand at."""
        return widgets[0].value

    @property
    def texts(self):
        unit = self.unit if self.unit in ("", "°") else f" {self.unit}"
        return [f"{_text(value)}{unit}" for value in self.values]


@dataclass(frozen=True)
class Slider(Control):
    """A slider over `values`; `play=True` adds a button that walks through them."""

    play: bool = False

    def html(self, name, stride):
        texts = html.escape(json.dumps(self.texts, ensure_ascii=False))
        play = '<button type="button" class="vmc-play" aria-pressed="false">Play</button>'
        return (
            f'<div class="vmc-control"><label for="{name}">{html.escape(self.label)}</label>'
            f'<input type="range" id="{name}" min="0" max="{len(self.values) - 1}" '
            f'value="{self.first}" data-stride="{stride}" data-texts="{texts}" '
            f'aria-valuetext="{html.escape(self.texts[self.first])}">'
            f'<output for="{name}">{html.escape(self.texts[self.first])}</output>'
            f"{play if self.play else ''}</div>"
        )

    def widget(self):
        import ipywidgets as widgets

        options = list(zip(self.texts, self.values, strict=True))
        slider = widgets.SelectionSlider(
            options=options, index=self.first, description=self.label, style=_WIDE
        )
        if not self.play:
            return [slider], slider
        play = widgets.Play(value=self.first, max=len(options) - 1, interval=250)
        widgets.jslink((play, "value"), (slider, "index"))
        return [slider], widgets.HBox([slider, play])


@dataclass(frozen=True)
class Choice(Control):
    """One of a few alternatives: buttons, or a menu when there are many."""

    def html(self, name, stride):
        label, many = html.escape(self.label), len(self.values) > 5
        if many:
            options = "".join(
                f'<option value="{i}"{" selected" * (i == self.first)}>{html.escape(text)}</option>'
                for i, text in enumerate(self.texts)
            )
            return (
                f'<div class="vmc-control"><label for="{name}">{label}</label>'
                f'<select id="{name}" data-stride="{stride}">{options}</select></div>'
            )
        radios = "".join(
            f'<label><input type="radio" name="{name}" value="{i}" data-stride="{stride}"'
            f"{' checked' * (i == self.first)}>{html.escape(text)}</label>"
            for i, text in enumerate(self.texts)
        )
        return f'<fieldset class="vmc-control"><legend>{label}</legend>{radios}</fieldset>'

    def widget(self):
        import ipywidgets as widgets

        kind = widgets.Dropdown if len(self.values) > 5 else widgets.RadioButtons
        options = list(zip(self.texts, self.values, strict=True))
        chosen = kind(options=options, index=self.first, description=self.label, style=_WIDE)
        return [chosen], chosen


@dataclass(frozen=True)
class Switch(Control):
    """On or off."""

    def html(self, name, stride):
        return (
            f'<div class="vmc-control"><label><input type="checkbox" data-stride="{stride}"'
            f"{' checked' * self.first}>{html.escape(self.label)}</label></div>"
        )

    def widget(self):
        import ipywidgets as widgets

        box = widgets.Checkbox(bool(self.first), description=self.label, indent=False)
        return [box], box


class Pad(Control):
    """A place (x, y) on a grid, dragged over the first plot or photo; two sliders are its twin.

    Its values are pairs, in the units of the plot's axes or in the photo's pixels.
    """

    def __init__(self, xs, ys, labels=("x", "y"), start=(None, None), unit=""):
        pair = [Slider(v, *rest, unit) for v, *rest in zip((xs, ys), labels, start, strict=True)]
        object.__setattr__(self, "pair", pair)
        super().__init__(tuple(itertools.product(xs, ys)), " and ".join(labels), unit=unit)

    @property
    def first(self):
        x, y = self.pair
        return x.first * len(y.values) + y.first

    def html(self, name, stride):
        x, y = self.pair
        grid = html.escape(json.dumps([[float(value) for value in s.values] for s in self.pair]))
        twins = x.html(f"{name}-x", stride * len(y.values)) + y.html(f"{name}-y", stride)
        return f'<div class="vmc-pad" data-grid="{grid}">{twins}</div>'

    def widget(self):
        import ipywidgets as widgets

        (x, shown_x), (y, shown_y) = (slider.widget() for slider in self.pair)
        return [*x, *y], widgets.VBox([shown_x, shown_y])

    def read(self, widgets):
        return tuple(widget.value for widget in widgets)


_WIDE = {"description_width": "initial"}
_SPOKEN = '<span role="status" style="position: absolute; clip-path: inset(50%)">{}</span>'


def _is_number(value):
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)


def _text(value):
    return f"{value:.4g}".replace("-", "−") if _is_number(value) else str(value)


def _control(name, spec):
    label = name.replace("_", " ")
    if isinstance(spec, Control):
        return spec
    if isinstance(spec, (list, tuple)):
        if not spec or all(isinstance(value, str) for value in spec):
            return Choice(spec, label)
        if sorted(spec, key=bool) == [False, True] and all(isinstance(v, bool) for v in spec):
            return Switch((False, True), label, start=spec[0])
    raise ValueError(
        f"cannot make a control of {name}={spec!r}: give a Slider, a list of strings, "
        "or [False, True]"
    )


def explore(draw, caption, alt, **controls):
    """Show what `draw` returns and let the reader move its controls.

    `draw(**values)` is a pure function that returns a picture (see `figures`). Each control is a
    `Slider`, a `Pad`, a list of strings (a choice) or `[False, True]` (a switch); a list starts at
    its first. `caption` is Markdown and says what to notice; `alt` describes the picture in words,
    as text or as a function of the same controls. Raises ValueError for a demo that could not
    work: more than 200 positions, a control without effect, a start that is no value, an unknown
    picture.
    """
    controls = {name: _control(name, spec) for name, spec in controls.items()}
    positions = math.prod(len(control.values) for control in controls.values())
    if positions > MOST_POSITIONS:
        raise ValueError(
            f"{positions} positions are too many for a page (at most {MOST_POSITIONS}): "
            "give the controls fewer values"
        )
    describe = alt if callable(alt) else lambda **values: alt
    life = os.environ.get("VMC_LIFE", "live")
    if life == "live":
        _live(draw, caption, describe, controls)
    elif life in ("book", "test"):
        name = f"demo-{next(_demos)}"
        states = _evaluate(draw, describe, controls, name)
        if life == "book":
            display(HTML(_page(states, caption, controls, name)))
    else:
        raise ValueError(f"VMC_LIFE={life!r}: must be 'live', 'book' or 'test'")


def figure(picture, caption, alt):
    """Show a picture that does not move, in the same frame as the demos."""
    explore(lambda: picture, caption, alt)


def _evaluate(draw, describe, controls, name):
    """Every state in turn, as (alt, parts); the last control changes fastest."""
    states = []
    for values in itertools.product(*(control.values for control in controls.values())):
        chosen = dict(zip(controls, values, strict=True))
        parts = pictures(draw(**chosen), name)
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

    rows = [
        [
            places([alt]),
            *(places(p.split("\n") if isinstance(p, str) else p.messages()) for p in parts),
        ]
        for alt, parts in states
    ]
    data = json.dumps({"lines": list(table), "states": rows}, separators=(",", ":"))
    return base64.b64encode(gzip.compress(data.encode(), mtime=0)).decode()


def _live(draw, caption, describe, controls):
    """The same demo in a kernel: ipywidgets call `draw`."""
    import ipywidgets as widgets

    name = f"demo-{next(_demos)}"
    made = {key: control.widget() for key, control in controls.items()}
    views, alt = [], widgets.HTML()

    def show(_=None):
        values = {key: controls[key].read(sources) for key, (sources, _) in made.items()}
        parts = pictures(draw(**values), name)
        if not views:
            views.extend(widget() if isinstance(p, Scene) else widgets.HTML() for p in parts)
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
