"""Demos in the book and in tests: what they show, and what they refuse."""

import json
import re
from types import MappingProxyType

import matplotlib.pyplot as plt
import numpy as np
import pytest

from tests.pages import book_html, displayed
from tests.show.kernel import named, show
from vmc_lib.show import COLOURS, Pad, Scene, Slider, demo, figure, photo_view
from vmc_lib.show.packed import unpack_bytes


@pytest.fixture
def shown(monkeypatch):
    """What demos display, in order."""
    return displayed(monkeypatch, demo)


def states(page):
    """The page's own data: for each state its alt text and its pictures."""
    data = re.search(r'<script type="application/gzip">(.*?)</script>', page.data)[1]
    data = json.loads(unpack_bytes(data))
    return [["\n".join(data["lines"][i] for i in part) for part in row] for row in data["states"]]


def test_book_holds_every_position_and_shows_the_first(shown, book):
    controls = dict(k=Slider([1, 2, 3], "k", start=2), c=["a", "b"], on=[True, False])
    show(alt=lambda k, c, on: f"{k}{c}{on}", **controls)
    page = shown[0].data
    expected = [(k, c, on) for k in (1, 2, 3) for c in "ab" for on in (False, True)]
    assert [alt for alt, _ in states(shown[0])] == [f"{k}{c}{on}" for k, c, on in expected]
    assert [svg for _, svg in states(shown[0])] == [named(a=k, b=c, c=on) for k, c, on in expected]
    assert named(a=2, b="a", c=True) in page
    assert 'aria-label="2aTrue"' in page
    # mixed radix, last control fastest: what the page's script multiplies positions with
    assert re.findall(r'data-stride="(\d+)"', page) == ["4", "2", "2", "1"]
    assert "<em>caption</em>" in page
    assert r"\(x &lt; y\)" in page


def test_book_page_is_the_same_in_every_build(shown, book, monkeypatch):
    def draw(k):
        fig, ax = plt.subplots()
        ax.fill_between([0, 1], [0, k])
        return fig

    for _ in range(2):
        monkeypatch.setattr(demo, "names", iter([1]))
        show(draw, k=Slider([1, 2], "k"))
    assert shown[0].data == shown[1].data


def test_a_plot_looks_the_same_whatever_the_readers_own_settings():
    def draw():
        fig, ax = plt.subplots()
        ax.plot([0, 1])
        ax.set_title("$x_1$")
        return fig

    usual = demo.draw_state(draw, {}, "demo")
    with plt.rc_context({"text.usetex": True, "lines.marker": "o", "xtick.labelsize": 20}):
        assert demo.draw_state(draw, {}, "demo") == usual


def test_a_photo_that_stays_is_stored_once(shown, book):
    photo = np.random.default_rng(0).integers(0, 255, (50, 60, 3), dtype=np.uint8)
    show(lambda x: photo_view(photo, [((x, 5, x + 9, 20), "cup", "blue")]), x=Slider([1, 30], "x"))
    data = unpack_bytes(re.search(r'gzip">(.*?)<', shown[0].data)[1])
    assert data.count(b"data:image/") == 1
    assert all("data:image/" in picture for _, picture in states(shown[0]))


def test_in_a_test_one_control_moves_after_the_other_and_nothing_is_shown(shown):
    seen = []
    k = Slider([1, 2, 3], "k", start=2)
    show(lambda k, c: seen.append((k, c)) or named(k=k, c=c), k=k, c=["a", "b"])
    assert seen == [(2, "a"), (1, "a"), (3, "a"), (2, "b")]
    assert shown == []


def test_a_control_may_have_an_effect_only_after_another_moved(shown):
    seen = []
    draw = lambda on, c: seen.append((on, c)) or named(c=on and c)  # noqa: E731 (a demo's one line)
    show(draw, on=[False, True], c=["a", "b"])
    assert seen == [(False, "a"), (True, "a"), (False, "b"), (True, "b")]


def test_a_pad_is_a_place_on_a_grid(shown, book):
    def plot(**values):
        return named(**values).replace("<svg", '<svg data-axes="0 1 0 1 0 1 0 1"')

    pad = Pad([1, 2, 3], [10, 20], labels=("ahead", "up"), start=(3, 10))
    show(plot, at=pad, on=[False, True])
    [page] = shown
    assert [svg for _, svg in states(page)][2:5] == [
        plot(at=(1, 20), on=False), plot(at=(1, 20), on=True), plot(at=(2, 10), on=False)
    ]  # fmt: skip
    assert re.findall(r'data-stride="(\d+)"', page.data) == ["4", "2", "1"]
    assert plot(at=(3, 10), on=False) in page.data


def test_figure_has_no_controls(shown, book):
    figure(np.eye(3), caption="An eye.", alt="a diagonal")
    assert "<form" not in shown[0].data
    assert "<img" in shown[0].data


def test_a_still_scene_carries_its_messages(shown, book):
    figure((Scene(), "<p>beside</p>"), caption="c", alt="a scene")
    [[alt, scene, beside]] = states(shown[0])
    assert alt == "a scene"
    assert scene.startswith("camera|")
    assert beside == "<p>beside</p>"


@pytest.mark.parametrize(
    ("controls", "says"),
    [
        (dict(k=[]), "'k' has values (): give at least two"),
        (dict(k="plain words"), "cannot make a control of k='plain words'"),
        (dict(k=[False, False]), "k=[False, False] is no switch"),
    ],
)
@pytest.mark.parametrize("render_mode", ["live", "book", "test"])
def test_impossible_controls_are_refused_in_every_render_mode(
    controls, says, render_mode, monkeypatch
):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    with pytest.raises(ValueError, match=re.escape(says)):
        show(**controls)


def test_as_many_positions_as_a_page_can_store(monkeypatch):
    many = dict(k=Slider(range(15), "a"), m=Slider(range(14), "b"))
    for mode in ("book", "test"):
        monkeypatch.setenv("VMC_RENDER_MODE", mode)
        with pytest.raises(ValueError, match="210 positions are too many for a page"):
            show(**many)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")  # where none is stored
    monkeypatch.setattr(demo, "display", lambda *_, **__: None)
    assert show(**many).value == {"k": 0, "m": 0}


@pytest.mark.parametrize("render_mode", ["book", "test"])
def test_a_control_without_effect_is_refused(render_mode, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    with pytest.raises(ValueError, match="'idle hand' never changes the picture"):
        show(lambda k, idle_hand: named(k=k), k=Slider([1, 2], "k"), idle_hand=[False, True])


def test_an_unknown_render_mode_is_refused(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "afterlife")
    with pytest.raises(ValueError, match="afterlife"):
        show()


def test_an_error_says_in_plain_numbers_what_was_asked_for():
    with pytest.raises(ZeroDivisionError) as error:
        demo.widget(lambda n: f"<p>{1 // int(n)}</p>", n=Slider(np.linspace(0, 1, 3)))
    assert error.value.__notes__ == ["It was asked for {'n': 0.0}."]


@pytest.mark.parametrize("drawn", [None, 3, "plain words", [np.eye(2)], {}])
def test_an_unknown_picture_is_refused_before_its_words_are_asked_for(drawn):
    with pytest.raises(ValueError, match="cannot show"):
        show(lambda k: drawn, alt=None, k=Slider([1, 2], "k"))


def test_an_array_that_is_no_image_is_refused():
    with pytest.raises(ValueError, match="cannot show an array of shape"):
        show(lambda k: np.zeros((2, 2, 4)), k=Slider([1, 2], "k"))


@pytest.mark.parametrize("render_mode", ["live", "book", "test"])
def test_a_pad_without_axes_is_refused(render_mode, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    with pytest.raises(ValueError, match="'x and y' has no plot or photo to lie on"):
        show(lambda place: (Scene(), named(place=place)), place=Pad([0, 1], [0, 1]))


def test_what_is_no_function_or_no_caption_is_named():
    with pytest.raises(ValueError, match=r"explore.*, 3, ….: give the function .*, then a caption"):
        demo.explore(named, 3, k=Slider([1, 2], "k"))
    with pytest.raises(ValueError, match=r"explore.'A caption.', .*: give the function that"):
        demo.explore("A caption.", named, k=Slider([1, 2], "k"))


def test_the_kinds_of_pictures_may_not_change():
    with pytest.raises(ValueError, match="same kinds"):
        show(lambda on: Scene() if on else "<p></p>", on=[False, True])


def test_what_paper_shows_is_a_place_of_the_controls(shown, book):
    controls = {"k": Slider([1, 2], "k"), "on": [False, True]}
    show(printed=[MappingProxyType({"k": 2}), {"on": True}], **controls)
    assert 'data-printed="k=1&amp;on=0 k=0&amp;on=1"' in shown[0].data
    for wrong in ({"k": 3}, {"j": 1}):
        with pytest.raises(ValueError, match=r"cannot stand at 3|no control is called"):
            show(printed=[wrong], **controls)


def test_labels_are_escaped(shown, book):
    show(k=Slider([1, 2], "a < b & c"), c=["<i>", "&"])
    assert "a &lt; b &amp; c" in shown[0].data
    assert "&lt;i&gt;" in shown[0].data


def test_plots_use_the_palette(shown, book):
    plt.close("all")  # what other tests left open
    fig, ax = plt.subplots()
    ax.plot([1, 2], color=COLOURS["red"])
    figure(fig, caption="c", alt="a")
    svg = shown[0].data
    assert "var(--vmc-red" in svg
    assert "var(--vmc-ink" in svg
    assert not re.findall(r"[:\"]\s*#(?:000000|ffffff|1c2430)", svg)
    assert plt.get_fignums() == []


def test_some_controls_stand_behind_a_fold(monkeypatch):
    draw = lambda a, b: f"<p>{a} {b}</p>"  # noqa: E731 (one line)
    markup = book_html(demo, lambda: demo.explore(draw, more=["b"], a=[1, 2], b=[3, 4]))
    shown, folded = markup.split('<details class="vmc-more">')
    assert ('-a"' in shown, '-b"' in shown) == (True, False)
    assert ('-a"' in folded, '-b"' in folded) == (False, True)
    for wrong in (["c"], "b"):
        with pytest.raises(ValueError, match="more="):
            demo.explore(draw, more=wrong, a=[1, 2], b=[3, 4])


def test_explore_is_a_decorator_too():
    @demo.explore(alt="", k=(0, 4))
    def squared(k):
        return f"<p>{k**2}</p>"

    assert squared.value == {"k": 2}
