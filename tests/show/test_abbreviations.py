"""What `explore` takes for a control: what ipywidgets takes, with ipywidgets' own meaning."""

from enum import Enum

import ipywidgets
import numpy as np
import pytest
from ipywidgets import interactive

from vmc_lib.show import Choice, Slider, Switch, explore
from vmc_lib.show.abbreviations import as_control, defaults


class Colour(Enum):
    RED = "r"
    BLUE = "b"


BOUNDS = [(0, 10), (0, 11), (-5, 5, 2), (0.0, 1.0), (0.0, 1.0, 0.25), (0, 2.0), (0, 1, 0.5)]
BOUNDS += [(np.int64(0), np.int64(4)), (-1.0, 2.0, 0.7)]


def where(control):
    """What a control starts with."""
    return control.values[control.first]


@pytest.mark.parametrize(
    "spec",
    [3, -3, 0, 2.5, 0.0, -0.4, *BOUNDS],
)
def test_numbers_and_bounds_are_the_slider_of_interact(spec):
    slider, theirs = as_control("k", spec), interactive.widget_from_abbrev(spec)
    assert isinstance(slider, Slider)
    assert slider.label == "k"
    assert slider.values[0] == pytest.approx(theirs.min)
    assert theirs.max - theirs.step < slider.values[-1] <= theirs.max + 1e-9
    np.testing.assert_allclose(np.diff(slider.values), theirs.step)
    assert abs(where(slider) - theirs.value) <= theirs.step / 2 + 1e-9
    whole = isinstance(theirs, ipywidgets.IntSlider)
    assert all(isinstance(value, int) for value in slider.values) == whole


@pytest.mark.parametrize("spec", [True, False, np.True_])
def test_a_truth_value_is_a_switch(spec):
    switch = as_control("on_land", spec)
    assert isinstance(switch, Switch)
    assert where(switch) is bool(spec)
    assert switch.label == "on land"


@pytest.mark.parametrize(
    ("spec", "values", "labels"),
    [
        (["a", "b"], ("a", "b"), ()),
        (["a", 1, None], ("a", 1, None), ()),
        ([1, 2, 4], (1, 2, 4), ()),
        ({"slow": 1, "fast": 9}, (1, 9), ("slow", "fast")),
        ([("slow", 1), ("fast", 9)], (1, 9), ("slow", "fast")),
        (Colour, (Colour.RED, Colour.BLUE), ("RED", "BLUE")),
        ((n * n for n in range(3)), (0, 1, 4), ()),
    ],
)
def test_a_list_is_a_choice(spec, values, labels):
    choice = as_control("k", spec)
    assert isinstance(choice, Choice)
    assert (choice.values, tuple(choice.labels)) == (values, labels)
    assert where(choice) == values[0]
    assert choice.texts == list(labels or map(str, values))


@pytest.mark.parametrize("spec", [range(5), range(0, 10, 3), np.linspace(0, 1, 5)])
def test_a_range_or_an_array_is_a_slider_over_its_numbers(spec):
    slider = as_control("k", spec)
    assert isinstance(slider, Slider)
    assert slider.values == tuple(spec)
    assert slider.first == 0


@pytest.mark.parametrize(
    ("widget", "kind", "values", "start"),
    [
        (ipywidgets.IntSlider(4, 0, 10, 2), Slider, range(0, 11, 2), 4),
        (ipywidgets.BoundedIntText(2, 0, 3), Slider, range(4), 2),
        (ipywidgets.FloatSlider(0.33, min=0, max=1, step=0.1), Slider, np.arange(11) / 10, 0.3),
        (ipywidgets.BoundedFloatText(0.5, min=0, max=1, step=0.5), Slider, (0, 0.5, 1), 0.5),
        (ipywidgets.FloatLogSlider(10, min=-1, max=2, step=1), Slider, (0.1, 1, 10, 100), 10),
        (ipywidgets.Play(value=2, max=3), Slider, range(4), 2),
        (ipywidgets.SelectionSlider(options=[1, 3, 9], value=3), Slider, (1, 3, 9), 3),
        (ipywidgets.Dropdown(options={"a": 1, "b": 2}, value=2), Choice, (1, 2), 2),
        (ipywidgets.Dropdown(options=["a", "b"], value=None), Choice, ("a", "b"), "a"),
        (ipywidgets.Select(options=["a", "b"]), Choice, ("a", "b"), "a"),
        (ipywidgets.RadioButtons(options=["a", "b"], value="b"), Choice, ("a", "b"), "b"),
        (ipywidgets.ToggleButtons(options=[("a", 1), ("b", 2)]), Choice, (1, 2), 1),
        (ipywidgets.Checkbox(True), Switch, (False, True), True),
        (ipywidgets.ToggleButton(value=False), Switch, (False, True), False),
    ],
    ids=lambda one: type(one).__name__ if isinstance(one, ipywidgets.Widget) else "",
)
def test_a_widget_of_ipywidgets_keeps_its_values_its_start_and_its_label(
    widget, kind, values, start
):
    control = as_control("name_of_it", widget)
    assert isinstance(control, kind)
    np.testing.assert_array_equal(control.values, values)
    assert where(control) == start
    assert control.label == "name of it"
    if hasattr(widget, "description"):
        widget.description = "its own"
        assert as_control("name", widget).label == "its own"


def test_labels_of_a_selection_stand_on_the_slider():
    slider = as_control("k", ipywidgets.SelectionSlider(options=[("low", 1), ("high", 9)]))
    assert slider.texts == ["low", "high"]
    assert not slider.continuous


def test_a_default_of_the_function_is_where_it_starts():
    start = defaults(lambda a=7, b=0.5, c="y", d=99, e="none", f=1: None)
    assert where(as_control("a", (0, 10), start["a"])) == 7
    assert where(as_control("b", (0.0, 1.0, 0.2), start["b"])) == pytest.approx(0.4)
    assert where(as_control("c", ["x", "y"], start["c"])) == "y"
    assert where(as_control("d", (0, 10), start["d"])) == 5
    assert where(as_control("e", ["x", "y"], start["e"])) == "x"
    assert where(as_control("f", ipywidgets.IntSlider(3), start["f"])) == 3
    assert defaults(max) == {}


def test_a_label_may_be_left_out():
    assert as_control("some_load", Slider([1, 2])).label == "some load"
    assert as_control("k", Slider([1, 2], "load")).label == "load"


@pytest.mark.parametrize(
    ("spec", "says"),
    [
        ("a text", "cannot make a control of k='a text': give its bounds, (low, high)"),
        (None, "cannot make a control of k=None"),
        (int, "cannot make a control of k=<class 'int'>"),
        ((10, 0), "k goes from 10 to 0 by 1: give (low, high), the lower first"),
        ((0, 10, 0), "by 0: give (low, high)"),
        ((0, 10, -1), "and a step above 0"),
        ((0.0, float("inf")), "k goes from 0.0 to inf"),
        ((0.0, 0.05), "has 1 stops: give a step, (0.0, 0.05, step)"),
        ((0.0, 1.0, 1e-6), "has 1000001 stops: give a step"),
        ([], "'k' has values (): give at least two"),
        (["one"], "'k' has values ('one',): give at least two"),
        ([False, False], "k=[False, False] is no switch: give True or False"),
        (np.eye(3), "k is an array of shape (3, 3): give a list of values"),
        (ipywidgets.Text("hi"), "k=Text(…) takes any text: give those to choose from, as a list"),
        (ipywidgets.Combobox(), "k=Combobox(…) takes any text"),
        (ipywidgets.IntText(3), "k=IntText(…) has no bounds: give an IntSlider"),
        (ipywidgets.FloatText(3), "k=FloatText(…) has no bounds: give a FloatSlider"),
        (ipywidgets.IntRangeSlider(), "has two values: give a slider for each end"),
        (ipywidgets.FloatRangeSlider(), "has two values: give a slider for each end"),
        (ipywidgets.SelectMultiple(options="ab"), "several values at once: give a Checkbox for"),
        (ipywidgets.fixed(3), "does not move: bind it, functools.partial(draw, k=3)"),
        (ipywidgets.ColorPicker(), "k=ColorPicker(…) has no list of values: give a slider, a"),
        (ipywidgets.Button(), "k=Button(…) has no list of values"),
    ],
    ids=lambda one: type(one).__name__,
)
def test_what_is_no_control_is_refused_with_a_remedy(spec, says):
    with pytest.raises(ValueError, match="k") as error:
        explore(lambda k: f"<p>{k}</p>", k=spec)
    assert says in str(error.value)


def test_an_option_is_no_name_for_a_control():
    for name, value in (("data", (0, 10)), ("alt", (0, 10)), ("printed", [1, 2])):
        with pytest.raises(ValueError, match=f"{name}=.* is no control but an option"):
            explore(lambda **_: "<p>a</p>", **{name: value})
