"""What `explore` takes for a control: its own, ipywidgets' widgets, and what `interact` takes.

The values, the bounds and the start are those of ipywidgets (see its page *Using interact*); only
the face is ours. Where `interact` makes a menu of an array's or a range's numbers, ours is a slider
over them.
"""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from enum import EnumMeta
from inspect import signature
from math import floor, isfinite
from numbers import Integral

import ipywidgets
import numpy as np

from vmc_lib.show.controls import Choice, Control, Slider, Switch, is_number

STEP = 0.1  # of numbers with a point, as ipywidgets has it
MOST_STOPS = 10_001
OPTIONS = {
    "alt": "what it shows, in words: a text, or a function of the controls",
    "data": "a dictionary of arrays",
    "printed": "a list of {control: value}",
    "more": "a list of names of controls",
}
REMEDIES = {  # why a widget of ipywidgets is no control, and what to give instead
    ipywidgets.fixed: "does not move: bind it, functools.partial(draw, {name}={value!r})",
    ipywidgets.Text: "takes any text: give those to choose from, as a list",
    ipywidgets.Textarea: "takes any text: give those to choose from, as a list",
    ipywidgets.IntText: "has no bounds: give an IntSlider",
    ipywidgets.FloatText: "has no bounds: give a FloatSlider",
    ipywidgets.IntRangeSlider: "has two values: give a slider for each end",
    ipywidgets.FloatRangeSlider: "has two values: give a slider for each end",
    ipywidgets.SelectionRangeSlider: "has two values: give a slider for each end",
    ipywidgets.SelectMultiple: "has several values at once: give a Checkbox for each",
    ipywidgets.Widget: "has no list of values: give a slider, a Dropdown or a Checkbox",
}


def check_call(draw, caption, alt, data, printed, more, names):
    """ValueError for what is no function, caption or option, or for controls that it lacks."""
    if not (callable(draw) and isinstance(caption, str)):
        raise ValueError(
            f"explore({draw!r}, {caption!r}, …): give the function that draws, then a caption, "
            "and each control by the name of its argument, k=(0, 10); none is called caption"
        )
    wrong = {
        "alt": not (alt is None or isinstance(alt, str) or callable(alt)) and alt,
        "data": not (data is None or isinstance(data, Mapping)) and data,
        "printed": not _list_of(Mapping, printed) and printed,
        "more": not (_list_of(str, more) and {*more} <= {*names}) and more,
    }
    for name, value in wrong.items():
        if value is not False:
            raise ValueError(
                f"{name}={value!r} is no control but an option of `explore` ({OPTIONS[name]}): "
                "let the control have another name"
            )
    _check_arguments(draw, names)


def _list_of(kind, value):
    several = isinstance(value, Iterable) and not isinstance(value, str)
    return several and all(isinstance(one, kind) for one in value)


def _check_arguments(draw, names):
    """ValueError where the function does not take just these arguments."""
    try:
        takes = signature(draw)
    except (TypeError, ValueError):  # of some that are written in C
        return
    try:
        takes.bind(**dict.fromkeys(names))
    except TypeError as error:
        named = ", ".join(names) or "none"
        raise ValueError(
            f"the function that draws takes {takes}, and the controls are {named}: {error}"
        ) from None


def as_control(name, spec, start=None):
    """The control that `explore(..., name=spec)` asks for; ValueError when there is none.

    `start` is where the function that draws would have it, by its argument's default: it counts
    where `spec` does not say.
    """
    label = name.replace("_", " ")
    if isinstance(spec, Control):
        return spec if spec.label else replace(spec, label=label)
    if isinstance(spec, ipywidgets.Widget | ipywidgets.fixed):
        return _of_widget(name, spec, label)
    if isinstance(spec, bool | np.bool_):
        return Switch((False, True), label, bool(spec))
    if is_number(spec):
        low, high = sorted((-spec, 3 * spec)) if spec else (0, spec + 1)
        return Slider(stops(name, low, high), label, spec)
    if isinstance(spec, tuple) and len(spec) in (2, 3) and all(map(is_number, spec)):
        return _between(name, spec, label, start)
    if isinstance(spec, EnumMeta):
        spec = {one.name: one for one in spec}
    if isinstance(spec, Iterable) and not isinstance(spec, str | type):
        return _among(name, spec, label, start)
    raise ValueError(
        f"cannot make a control of {name}={spec!r}: give its bounds, (low, high) or "
        "(low, high, step), a list of values, True or False, or a Slider or a Pad"
    )


def defaults(draw):
    """The defaults of a function's arguments, by their names, as far as Python knows them."""
    try:
        arguments = signature(draw).parameters.values()
    except (TypeError, ValueError):  # of some that are written in C
        return {}
    return {one.name: one.default for one in arguments if one.default is not one.empty}


def stops(name, low, high, step=None):
    """The stops of a slider from low to high; whole where all three are whole."""
    step = step if step is not None else (1 if _whole(low, high) else STEP)
    if not (step > 0 and low < high and isfinite(high - low)):
        raise ValueError(
            f"{name} goes from {low} to {high} by {step}: give (low, high), the lower first, "
            "and a step above 0"
        )
    many = floor((high - low) / step + 1e-9) + 1
    if not 2 <= many <= MOST_STOPS:
        raise ValueError(
            f"{name} from {low} to {high} by {step} has {many} stops: give a step, "
            f"({low}, {high}, step), with which it has 2 to {MOST_STOPS}"
        )
    if _whole(low, high, step):
        return range(low, high + 1, step)
    return [float(f"{low + k * step:.12g}") for k in range(many)]


def _whole(*numbers):
    return all(isinstance(number, Integral) for number in numbers)


def _between(name, bounds, label, start):
    """A slider that starts where the function would have it, or on the stop below the middle."""
    low, high, *_ = bounds
    slider = Slider(stops(name, *bounds), label)
    if not (is_number(start) and low <= start <= slider.values[-1]):
        middle = low + ((high - low) // 2 if _whole(low, high) else (high - low) / 2)
        start = max(value for value in slider.values if value <= middle + 1e-9)
    return _standing(slider, start)


def _standing(slider, at):
    """The slider, which starts on the stop nearest to a number, or at an end."""
    at = min(max(at, slider.values[0]), slider.values[-1])
    return replace(slider, start=slider.values[slider.nearest(at)])


def _among(name, spec, label, start):
    """A slider over an array's or a range's numbers; a switch, or a choice among all else."""
    if isinstance(spec, np.ndarray) and spec.ndim != 1:
        raise ValueError(f"{name} is an array of shape {spec.shape}: give a list of values")
    values, labels = _options(spec)
    if values and all(isinstance(value, bool | np.bool_) for value in values):
        if sorted(values) != [False, True]:
            raise ValueError(f"{name}={list(values)} is no switch: give True or False, its start")
        return Switch((False, True), label, bool(values[0]))
    numbers = isinstance(spec, range | np.ndarray) and all(map(is_number, values))
    control = (Slider if numbers else Choice)(values, label, labels=labels)
    with suppress(ValueError):  # as with `interact`, a default that is none of the values is none
        return replace(control, start=start)
    return control


def _options(spec):
    """Values to choose among, and their labels where they have some: as ipywidgets reads them."""
    items = list(spec.items()) if isinstance(spec, Mapping) else list(spec)
    pairs = items and all(isinstance(item, tuple | list) and len(item) == 2 for item in items)
    if not pairs:
        return tuple(items), ()
    return tuple(value for _, value in items), tuple(str(label) for label, _ in items)


def _of_widget(name, widget, label):
    """The control of an ipywidgets' widget: its label, its values, and where it stands."""
    label = getattr(widget, "description", "") or label
    kind = type(widget)
    if issubclass(kind, ipywidgets.Checkbox | ipywidgets.ToggleButton):
        return Switch((False, True), label, widget.value)
    if issubclass(kind, _CHOICES):
        return _selection(name, Choice, widget, label)
    if issubclass(kind, ipywidgets.SelectionSlider):
        return _selection(name, Slider, widget, label)
    if issubclass(kind, ipywidgets.FloatLogSlider):
        powers = stops(name, widget.min, widget.max, widget.step)
        values = [float(f"{widget.base**power:.12g}") for power in powers]
    elif issubclass(kind, _NUMBERS):
        values = stops(name, widget.min, widget.max, widget.step)
    else:
        words = next(words for base, words in REMEDIES.items() if issubclass(kind, base))
        value = getattr(widget, "value", None)
        raise ValueError(f"{name}={kind.__name__}(…) {words.format(name=name, value=value)}")
    slider = Slider(values, label, play=issubclass(kind, ipywidgets.Play))
    return _standing(slider, widget.value)


def _selection(name, control, widget, label):
    values, labels = _options(widget.options)
    if not values:
        raise ValueError(f"{name}={type(widget).__name__}(…) has no options: give two or more")
    if widget.value is None:
        widget.value = values[0]
    return control(values, label, widget.value, labels=labels)


_CHOICES = ipywidgets.Dropdown | ipywidgets.RadioButtons | ipywidgets.Select
_CHOICES |= ipywidgets.ToggleButtons
_NUMBERS = ipywidgets.IntSlider | ipywidgets.BoundedIntText | ipywidgets.Play
_NUMBERS |= ipywidgets.FloatSlider | ipywidgets.BoundedFloatText
