"""The controls of a demo: what the reader moves.

Each knows its values and its face, the same in the built page and in a live kernel.
"""

import html
import itertools
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from vmc_lib.show.markup import number

MENU = 6  # a choice among this many or more is a menu, not a row of buttons
MOST_SHOWN = 2000  # texts between a slider's stops that are measured


@dataclass(frozen=True)
class Control:
    """A labelled choice among finitely many values; `start` is the first shown.

    Without a `label` it bears the name that `explore` knows it by. `labels` are what the reader
    sees for each value, by default the value with its unit.
    """

    values: Sequence
    label: str = ""
    start: Any = None
    unit: str = ""
    labels: Sequence[str] = field(default=(), kw_only=True)

    def __post_init__(self):
        if not isinstance(self.values, Iterable):
            raise ValueError(
                f"the values {self.values!r} are no list: give all that the control has, as "
                "range(6), [1, 2, 4] or np.linspace(0, 1, 11)"
            )
        values = tuple(self.values)
        if len(values) < 2:
            name = f"the control {self.label!r}" if self.label else "a control"
            raise ValueError(f"{name} has values {values}: give at least two")
        object.__setattr__(self, "values", values)
        if self.labels and len(self.labels) != len(values):
            raise ValueError(f"labels {self.labels} of {len(values)} values: give one for each")
        if isinstance(self.start, str) and _numbers(*values):
            raise ValueError(
                f"{self.label!r} cannot stand at {self.start!r}, which is no number: a unit is "
                f"given as unit={self.start!r}"
            )
        if self.start is not None:
            _ = self.first  # raises when `start` is none of the values

    @property
    def first(self) -> int:
        """The position of the starting value."""
        return 0 if self.start is None else self.place_of(self.start)

    def place_of(self, value: Any) -> int:
        """The place of a value among the control's own; ValueError where it is none of them."""
        for place, own in enumerate(self.values):
            same = np.isclose(own, value) if _numbers(own, value) else own == value
            if own is value or (isinstance(same, bool | np.bool_) and same):
                return place
        texts = self.texts if len(self.values) <= MENU else [*self.texts[:3], "…", self.texts[-1]]
        raise ValueError(f"{self.label!r} cannot stand at {value!r}: it has {', '.join(texts)}")

    def nearest(self, value: Any) -> int:
        """The place of the value that a reader's hand would come to rest at."""
        return self.place_of(value)

    def html(self, name: str, stride: int) -> str:
        """Its face: markup named `name`; a value's place counts `stride` times.

        Demos count their positions in mixed radix, and the page's script adds up the places.
        """
        raise NotImplementedError

    @property
    def texts(self) -> list[str]:
        """The values as the reader sees them, with their unit."""
        return list(self.labels) or [self.text(value) for value in self.values]

    def text(self, value: Any) -> str:
        """A value with its unit."""
        unit = self.unit if self.unit in ("", "°") else f" {self.unit}"
        return f"{_text(value)}{unit}"


@dataclass(frozen=True)
class Slider(Control):
    """A slider over `values`; `play=True` adds a button that walks through them.

    With `play="unasked"` it does so by itself, once, when the demo comes into view: unless the
    reader has asked the browser for less motion. Where the page works them out, or Python runs in
    it, values that lie between these can be chosen, too; with a number for `between` only its
    multiples, with `between=False` none.
    """

    play: bool | str = False
    between: bool | float = True

    def __post_init__(self):
        if isinstance(self.values, str):
            raise ValueError(
                f"the values {self.values!r} of a slider are text: give a list, as range(6)"
            )
        super().__post_init__()
        if _numbers(*self.values) and not self.labels:
            steps = np.diff(self.values)
            if not (np.all(steps > 0) or np.all(steps < 0)):
                raise ValueError(
                    f"the values {self.texts} go up and down: give them in order, as "
                    "range(0, 10, 2) or np.linspace(0, 1, 11)"
                )

    def nearest(self, value: Any) -> int:
        """The place of the stop nearest to a number; ValueError beyond the slider's ends."""
        numbers = [one for one in self.values if _numbers(one, value)]
        if len(numbers) < len(self.values) or not min(numbers) <= value <= max(numbers):
            return self.place_of(value)
        return int(np.abs(np.subtract(numbers, value)).argmin())

    def value_at(self, place: float) -> Any:
        """The value at a place along `values`, which may lie between two; whole where these are."""
        low = min(int(place), len(self.values) - 2)
        one, other = self.values[low : low + 2]
        if place in (low, low + 1):
            return other if place > low else one
        value = one + (place - low) * (other - one)
        if all(isinstance(v, int) for v in self.values):
            return round(value)
        return value if self.between is True else round(value / self.between) * self.between

    @property
    def continuous(self) -> bool:
        """Whether it has values between its own."""
        whole = all(isinstance(v, int) for v in self.values)
        numbers = all(map(is_number, self.values)) and not self.labels
        return bool(
            self.between and numbers and not (whole and np.ptp(self.values) < len(self.values))
        )

    def html(self, name: str, stride: int) -> str:
        texts, last = self.texts, len(self.values) - 1
        text, data = texts[self.first], json.dumps(texts, ensure_ascii=False)
        along = {"min": 0, "max": last, "value": self.first}
        state = {"data-stride": stride, "data-texts": data, "aria-valuetext": text}
        unasked = " data-unasked" * (self.play == "unasked")
        state |= {"data-between": ""} if self.continuous else {}
        play = f'<button type="button" class="vmc-play"{unasked}>Play</button>'
        shown = texts
        if self.continuous:  # between its own, too
            steps = np.linspace(0, last, min(10 * last, MOST_SHOWN) + 1).round(1)
            shown = [self.text(self.value_at(step)) for step in steps]
        widest = max(len(text) + 0.6 * sum(c in "mwMW%" for c in text) for text in shown)
        return slider(name, self.label, text, along | state, play if self.play else "", widest)


@dataclass(frozen=True)
class Choice(Control):
    """One of a few alternatives: buttons, or a menu when there are many."""

    def html(self, name: str, stride: int) -> str:
        if len(self.values) >= MENU:
            options = "".join(
                f'<option value="{i}"{" selected" * (i == self.first)}>{html.escape(text)}</option>'
                for i, text in enumerate(self.texts)
            )
            return (
                f'<div class="vmc-control"><label for="{name}">{html.escape(self.label)}</label>'
                f'<select id="{name}" data-stride="{stride}">{options}</select></div>'
            )
        options, own = dict(enumerate(self.texts)), {"data-stride": stride}
        return radios(name, self.label, options, self.first, own)


@dataclass(frozen=True)
class Switch(Control):
    """On or off."""

    def __post_init__(self):
        super().__post_init__()
        if len(self.values) != 2 or isinstance(self.values[0], str):
            raise ValueError(f"a switch between {self.values}: give (False, True), or a Choice")

    def html(self, name: str, stride: int) -> str:
        own = f'type="checkbox" name="{name}" data-stride="{stride}"{" checked" * self.first}'
        return f"<label><input {own}>{html.escape(self.label)}</label>"


class Pad(Control):
    """A place (x, y) on a grid, dragged over the first plot or photo; two sliders are its twin.

    Its values are pairs, in the units of the plot's axes or in the photo's pixels. `xs` and `ys`
    are all of them, as range(0, 601, 100), not bounds; `between` as a slider's.
    """

    pair: list[Slider]

    def __init__(
        self,
        xs: Sequence[float],
        ys: Sequence[float],
        labels: tuple[str, str] = ("x", "y"),
        start: tuple[float | None, float | None] = (None, None),
        unit: str = "",
        between: bool | float = True,
    ) -> None:
        if not all(np.iterable(pair) and len(pair) == 2 for pair in (labels, start)):
            raise ValueError(f"a pad has two labels and two starts, not {labels} and {start}")
        for numbers in (xs, ys):
            if np.iterable(numbers) and not all(map(is_number, numbers)):
                raise ValueError(f"a pad along {numbers!r}: give numbers, as range(0, 600, 100)")
        parts = zip((xs, ys), labels, start, strict=True)
        pair = [Slider(v, label, first, unit, between=between) for v, label, first in parts]
        object.__setattr__(self, "pair", pair)
        super().__init__(tuple(itertools.product(xs, ys)), " and ".join(labels), unit=unit)

    @property
    def first(self) -> int:
        x, y = self.pair
        return x.first * len(y.values) + y.first

    def nearest(self, value: Any) -> int:
        x, y = self.pair
        if np.shape(value) != (2,):
            raise ValueError(f"{self.label!r} cannot stand at {value!r}: give both, (x, y)")
        return x.nearest(value[0]) * len(y.values) + y.nearest(value[1])

    def html(self, name: str, stride: int) -> str:
        x, y = self.pair
        grid = html.escape(json.dumps([[float(value) for value in s.values] for s in self.pair]))
        twins = x.html(f"{name}-x", stride * len(y.values)) + y.html(f"{name}-y", stride)
        return f'<div class="vmc-pad" data-grid="{grid}">{twins}</div>'


def slider(name, label, text, attributes, after="", width=0):
    """A range input named `name` as markup: before it its label, behind it the value as `text`.

    `attributes` are the input's own, by name; `after` is markup that follows. The value has room
    for `width` letters: nothing moves under the reader's hand when another one is shown.
    """
    return (
        f'<div class="vmc-control"><label for="{name}">{html.escape(label)}</label>'
        f'<input type="range" id="{name}"{_markup(attributes)}>'
        f'<output for="{name}" style="--widest: {max(width, 5)}ch">{html.escape(text)}</output>'
        f"{after}</div>"
    )


def fold(inside):
    """Minor controls (HTML) behind a quiet fold, "more"."""
    return f'<details class="vmc-more"><summary>more</summary>{inside}</details>'


def radios(name, label, options, chosen, attributes):
    """A row of radio buttons as markup: `options` are their texts by value, one is `chosen`.

    `attributes` are those that every button has, by name.
    """
    buttons = "".join(
        f'<label><input type="radio" name="{name}" value="{value}"{_markup(attributes)}'
        f"{' checked' * (value == chosen)}>{html.escape(text)}</label>"
        for value, text in options.items()
    )
    return (
        f'<fieldset class="vmc-control"><legend>{html.escape(label)}</legend>'
        f'<div class="vmc-options">{buttons}</div></fieldset>'
    )


def _markup(attributes):
    return "".join(f' {name}="{html.escape(str(value))}"' for name, value in attributes.items())


def is_number(value):
    """Whether it is a number, and no truth value."""
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)


def _numbers(*values):
    return all(map(is_number, values))


def _text(value):
    return number(value, 4) if is_number(value) else str(value)
