"""The values of a demo: read, set, observed, linked and shared, as those of ipywidgets are."""

import json

import ipywidgets
import numpy as np
import pytest

from tests.pages import displayed
from tests.show.kernel import named, render
from vmc_lib.show import Choice, Pad, Slider, demo, explore, photo_view, widget
from vmc_lib.show import values as module

PHOTO = np.zeros((40, 60, 3), np.uint8)


@pytest.fixture(params=["live", "book", "test"])
def mode(request, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", request.param)
    monkeypatch.setattr(demo, "display", lambda *_, **__: None)


def one(**controls):
    return widget(named, alt=lambda **values: f"{values}", **controls)


def test_values_are_read_and_set_all_or_some(mode):
    shown = one(k=(0, 10), on=False, how=["a", "b"])
    assert shown.value == {"k": 5, "on": False, "how": "a"}
    shown.value = {"k": 2, "how": "b"}
    assert shown.value == {"k": 2, "on": False, "how": "b"}
    shown.value = {"on": True}
    assert shown.value == {"k": 2, "on": True, "how": "b"}
    assert shown.place == 2 * 4 + 1 * 2 + 1


def test_a_number_goes_to_the_nearest_stop(mode):
    draw = lambda x, at: photo_view(PHOTO, [((*at, 9, 9), f"{x}", "blue")])  # noqa: E731
    shown = widget(draw, x=Slider(np.linspace(0, 1, 11)), at=Pad([0, 1], [10, 20, 40]))
    shown.value = {"x": 0.333, "at": (0.7, 28)}
    assert shown.value["x"] == pytest.approx(0.3)
    assert shown.value["at"] == (1, 20)


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ({"j": 3}, "no control is called j: there are ['k', 'how']"),
        ({"k": 11}, "'k' cannot stand at 11: it has 0, 1, 2, …, 10"),
        ({"k": "three"}, "'k' cannot stand at 'three'"),
        ({"how": "c"}, "'how' cannot stand at 'c': it has a, b"),
        (3, "value = 3: give a dictionary, {'k': 5, 'how': 'a'}"),
    ],
)
def test_a_wrong_value_is_refused_and_changes_nothing(value, says):
    shown = one(k=(0, 10), how=["a", "b"])
    with pytest.raises(ValueError, match=r"k|how|value") as error:
        shown.value = value
    assert says in str(error.value)
    assert shown.value == {"k": 5, "how": "a"}


def test_one_value_alone_is_not_set_in_silence():
    shown, seen = one(k=(0, 10)), []
    shown.observe(lambda change: seen.append(change.new["k"]), "value")
    with pytest.raises(TypeError, match=r"write demo.value = \{'k': 3\}"):
        shown.value["k"] = 3
    with pytest.raises(TypeError, match=r"write demo.value = \{'k': 3\}"):
        shown.value.update(k=3)
    shown.value |= {"k": 3}
    assert seen == [3]


def test_demos_of_other_controls_are_not_linked_in_silence():
    with pytest.raises(ValueError, match="linked have the same controls"):
        ipywidgets.link((one(k=(0, 4)), "value"), (one(j=(0, 4)), "value"))


def test_values_are_shown_as_python_writes_them():
    drawn = lambda x, at: photo_view(PHOTO, [((*at, 9, 9), f"{x}", "blue")])  # noqa: E731
    shown = widget(drawn, x=np.linspace(0, 1, 3), at=Pad(np.arange(2.0), np.arange(2.0)))
    assert repr(shown.value) == "{'x': 0.0, 'at': (0.0, 0.0)}"


def test_values_are_observed(mode):
    shown, seen = one(k=(0, 4)), []
    shown.observe(lambda change: seen.append((change.old["k"], change.new["k"])), "value")
    shown.value = {"k": 3}
    shown.value = {"k": 3}
    shown.move(4)
    assert seen == [(2, 3), (3, 4)]


def test_one_control_is_neither_observed_nor_read_in_silence():
    shown, seen = one(k=(0, 4)), []
    with pytest.raises(ValueError, match=r"observe 'value', and read change.new\['k'\]"):
        shown.observe(seen.append, ["value", "k"])
    with pytest.raises(AttributeError, match=r"read demo.value\['k'\]"):
        _ = shown.k
    with pytest.raises(AttributeError, match="has no attribute 'j'"):
        _ = shown.j
    shown.observe(seen.append)
    shown.value = {"k": 3}
    assert "value" in {change.name for change in seen}


def test_a_control_may_be_called_value_and_share_a_slider():
    slider = ipywidgets.IntSlider(2, 0, 4)
    shown, seen = one(value=slider), []
    shown.observe(lambda change: seen.append(change.new["value"]), "value")
    slider.value = 3
    assert seen == [3]


def test_two_demos_are_linked(mode):
    one_demo, other = one(k=(0, 4)), one(k=(0, 4))
    link = ipywidgets.link((one_demo, "value"), (other, "value"))
    one_demo.value = {"k": 4}
    assert other.value == {"k": 4}
    other.value = {"k": 1}
    assert one_demo.value == {"k": 1}
    link.unlink()
    other.value = {"k": 0}
    assert one_demo.value == {"k": 1}


def test_two_demos_share_a_slider(mode):
    slider = ipywidgets.FloatSlider(0.5, min=0, max=1, step=0.25, description="load")
    demos = [one(k=slider, m=(0, 4)), one(k=slider)]
    slider.value = 0.75
    assert [shown.value["k"] for shown in demos] == [0.75, 0.75]
    demos[0].value = {"k": 0.0, "m": 3}
    assert slider.value == demos[1].value["k"] == 0.0
    slider.value = 0.3  # between stops
    assert slider.value == demos[0].value["k"] == 0.25
    assert demos[0].value["m"] == 3


def test_a_function_beside_a_demo_follows_it(mode):
    shown, seen = one(k=(0, 4)), []
    ipywidgets.interactive_output(lambda value: seen.append(value["k"]), {"value": shown})
    shown.value = {"k": 0}
    assert seen == [2, 0]


def test_a_demo_stands_in_a_box(mode):
    box = ipywidgets.HBox([one(k=(0, 4)), ipywidgets.IntSlider()])
    assert isinstance(box.children[0], ipywidgets.DOMWidget)


def test_values_travel_as_json_and_come_back(mode):
    laws = {"Hill": object(), "ours": object()}
    at = Pad([0, 1], [0.5, 2.5])
    spec = dict(x=Slider(np.linspace(0, 1, 3)), law=laws, on=True, at=at, n=(1, 3))
    shown = widget(lambda **v: photo_view(PHOTO, [((1, 1, 2 + v["n"], 9), f"{v}", "blue")]), **spec)
    sent = shown.as_json(shown.value)
    assert json.loads(json.dumps(sent)) == sent
    assert sent == {"x": 0.0, "law": "Hill", "on": True, "at": [0.0, 0.5], "n": 2}
    sent |= {"law": "ours", "at": [1.0, 2.5], "x": 0.5}
    shown.set_state({"value": sent})  # as a browser does
    assert shown.value == {"x": 0.5, "law": laws["ours"], "on": True, "at": (1, 2.5), "n": 2}


def test_what_moves_and_what_shares_is_the_state_that_a_browser_asks_for(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    shown = one(k=(0, 4), how=["a", "b"])
    assert shown.answers["state"](7)[1] == named(k=3, how="b").split("\n")
    assert shown.value == {"k": 3, "how": "b"}
    assert shown.answers["picture"](0)[1] == named(k=0, how="a").split("\n")
    assert shown.value == {"k": 3, "how": "b"}  # another view asked


def test_explore_shows_at_once_and_its_cells_last_line_shows_nothing_more(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    shown = displayed(monkeypatch, demo)
    made = widget(named, alt="a", k=(0, 4))
    assert shown == []
    cell = iter([1, 1, 2, 2])
    monkeypatch.setattr(module, "_cell", lambda: next(cell))
    made.show()
    made._ipython_display_()
    assert len(shown) == 1
    made._ipython_display_()  # in the next cell
    assert len(shown) == 2


@pytest.mark.browser
def test_controls_follow_the_kernel_in_every_view(offline, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    displayed(monkeypatch, demo)
    made = explore(
        lambda **v: f"<p>{v}</p>",
        k=Slider(range(4)), menu=Choice(range(7), "menu"), how=["a", "b", "c"], on=False,
    )  # fmt: skip
    page = offline.new_page()
    page.set_content("<main></main>")
    for kernel in ("kernel", "other"):
        render(page, made, monkeypatch, kernel)
    made.value = {"k": 2, "menu": 5, "how": "b", "on": True}
    page.evaluate(
        """(place) => [kernelModel, otherModel].forEach((model) => {
          model.traits = { place }; model.emit("change:place"); })""",
        made.place,
    )
    page.wait_for_function(
        "(words) => [...document.querySelectorAll('.vmc-picture')]"
        ".filter((one) => one.textContent === words).length === 2",
        arg=f"{dict(made.value)}",
    )
    for view in page.locator("figure > form").all():
        assert view.get_by_role("slider").input_value() == "2"
        assert view.get_by_label("menu").input_value() == "5"
        assert view.get_by_label("b", exact=True).is_checked()
        assert view.get_by_label("on", exact=True).is_checked()
    page.close()
