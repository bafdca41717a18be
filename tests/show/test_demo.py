"""One declaration, three lives: what a demo shows, and what it refuses."""

import base64
import gc
import gzip
import json
import re
from threading import Thread
from types import SimpleNamespace
from urllib.parse import unquote
from xml.etree import ElementTree

import matplotlib.pyplot as plt
import numpy as np
import pytest

from vmc_lib.show import COLOURS, Choice, Pad, Scene, Slider, demo, explore, figure, photo_view
from vmc_lib.show import live as widgets
from vmc_lib.show.outputs import still


@pytest.fixture
def shown(monkeypatch):
    """What demos display, in order."""
    outputs = []
    monkeypatch.setattr(demo, "display", lambda *items: outputs.extend(items))
    return outputs


@pytest.fixture
def book(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "book")


def names(**values):
    """A picture that names the position of every control."""
    return f"<svg>\n<text>{list(values.values())}</text>\n</svg>"


def show(draw=names, alt="words", **controls):
    explore(draw, caption="A *caption*: $x < y$.", alt=alt, **controls)


def states(page):
    """The page's own data: for each state its alt text and its pictures."""
    data = re.search(r'<script type="application/gzip">(.*?)</script>', page.data)[1]
    data = json.loads(gzip.decompress(base64.b64decode(data)))
    return [["\n".join(data["lines"][i] for i in part) for part in row] for row in data["states"]]


def test_book_holds_every_position_and_shows_the_first(shown, book):
    controls = dict(k=Slider([1, 2, 3], "k", start=2), c=["a", "b"], on=[True, False])
    show(alt=lambda k, c, on: f"{k}{c}{on}", **controls)
    page = shown[0].data
    expected = [(k, c, on) for k in (1, 2, 3) for c in "ab" for on in (False, True)]
    assert [alt for alt, _ in states(shown[0])] == [f"{k}{c}{on}" for k, c, on in expected]
    assert [svg for _, svg in states(shown[0])] == [names(a=k, b=c, c=on) for k, c, on in expected]
    assert names(a=2, b="a", c=True) in page
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
        monkeypatch.setattr(demo, "_demos", iter([1]))
        show(draw, k=Slider([1, 2], "k"))
    assert shown[0].data == shown[1].data


def test_a_photo_that_stays_is_stored_once(shown, book):
    photo = np.random.default_rng(0).integers(0, 255, (50, 60, 3), dtype=np.uint8)
    show(lambda x: photo_view(photo, [((x, 5, x + 9, 20), "cup", "blue")]), x=Slider([1, 30], "x"))
    data = gzip.decompress(base64.b64decode(re.search(r'gzip">(.*?)<', shown[0].data)[1]))
    assert data.count(b"data:image/") == 1
    assert all("data:image/" in picture for _, picture in states(shown[0]))


def test_test_life_moves_one_control_after_the_other_and_shows_nothing(shown):
    seen = []
    k = Slider([1, 2, 3], "k", start=2)
    show(lambda k, c: seen.append((k, c)) or names(k=k, c=c), k=k, c=["a", "b"])
    assert seen == [(2, "a"), (1, "a"), (3, "a"), (2, "b")]
    assert shown == []


def test_a_control_may_matter_only_where_another_has_moved(shown):
    seen = []
    draw = lambda on, c: seen.append((on, c)) or names(c=on and c)  # noqa: E731 (a demo's one line)
    show(draw, on=[False, True], c=["a", "b"])
    assert seen == [(False, "a"), (True, "a"), (False, "b"), (True, "b")]


@pytest.fixture
def live(monkeypatch):
    """A function that shows a demo in a live kernel: what came out, and how a browser asks it."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")

    def live(*args, **controls):
        stills = []
        handle = SimpleNamespace(update=lambda still: stills.append(still.data))
        shown = []
        monkeypatch.setattr(demo, "display", lambda item, **_: shown.append(item) or handle)
        show(*args, **controls)
        still, widget, caption = shown
        stills.append(still.data)
        replies = []
        monkeypatch.setattr(widget, "send", replies.append)

        def ask(question, value):
            widget._handle_custom_msg({"id": "1", "question": question, "value": value}, [])
            return replies[-1]

        return SimpleNamespace(ask=ask, widget=widget, stills=stills, caption=caption.data)

    return live


def test_live_life_has_the_face_of_the_page_and_answers_for_each_state(live):
    shown = live(k=Slider([1, 2], "k", play=True), c=Choice("abcdef", "letter"), on=[False, True])
    page = shown.widget.page
    assert re.findall(r'data-stride="(\d+)"', page) == ["12", "2", "1"]
    assert "vmc-play" in page
    assert names(k=1, c="a", on=False) in page
    assert "<em>caption</em>" in shown.caption
    for place, values in ((17, dict(k=2, c="c", on=True)), (0, dict(k=1, c="a", on=False))):
        reply = {"id": "1", "answer": [["words"], names(**values).split("\n")]}
        assert shown.ask("state", place) == reply


def test_a_live_demo_brings_its_scripts_and_its_first_state(live):
    plot = live(k=Slider([1, 2], "k")).widget
    assert list(plot.scripts) == [path.name for path in demo.PLOT_SCRIPTS]
    assert plot.scripts["demo.js"] == (demo.STATIC / "demo.js").read_text(encoding="utf-8")
    assert plot.first == [["words"], None]  # the plot stands in the page
    scene = live(lambda k: (names(k=k), Scene()), k=Slider([1, 2], "k")).widget
    assert list(scene.scripts) == [path.name for path in demo.SCRIPTS]
    assert scene.first == [["words"], None, Scene().messages()]


def test_no_picture_waits_until_all_that_is_loaded_has_been_looked_through(live):
    gc.unfreeze()
    demo._freeze_once.cache_clear()
    live(k=Slider([1, 2], "k"))
    assert len(gc.get_objects()) < gc.get_freeze_count()


def test_what_draw_raises_is_told_with_the_values_that_it_was_asked_for(live):
    shown = live(lambda k: names(k=1 / k), k=Slider([1, 0, 2], "k"))
    error = shown.ask("state", 1)["error"]
    assert "ZeroDivisionError: division by zero" in error
    assert "{'k': 0}" in error
    assert shown.ask("state", 2)["answer"] == [["words"], names(k=0.5).split("\n")]
    shown = live(lambda on: Scene() if on else "<p></p>", on=[False, True])
    assert "same kinds" in shown.ask("state", 1)["error"]


def test_a_state_is_drawn_anew_after_an_error(live):
    scale = SimpleNamespace(of=[1, 1])
    shown = live(lambda k: names(k=1 / scale.of[k]), k=Slider([0, 1], "k"))
    scale.of = [2, 0]  # another law, wrong at 1
    assert "error" in shown.ask("state", 1)
    assert shown.ask("state", 0)["answer"][1] == names(k=0.5).split("\n")


def test_an_error_leaves_no_figure_open(live):
    def draw(k):
        fig, ax = plt.subplots()
        ax.plot([1 / k])
        return fig

    plt.close("all")
    mine = plt.figure()
    shown = live(draw, k=Slider([1, 0], "k"))
    assert "error" in shown.ask("state", 1)
    assert plt.get_fignums() == [mine.number]


def test_a_cell_does_not_end_while_another_thread_draws(live, monkeypatch):
    ended = []

    def flush():
        ended.append(True)

    flush.__module__ = "matplotlib_inline.backend_inline"
    events = SimpleNamespace(callbacks={"post_execute": [flush]})
    events.unregister = lambda name, function: events.callbacks[name].remove(function)
    events.register = lambda name, function: events.callbacks[name].append(function)
    monkeypatch.setattr(widgets, "get_ipython", lambda: SimpleNamespace(events=events))
    for _ in range(2):
        live(k=Slider([1, 2], "k"))
    [end_of_cell] = events.callbacks["post_execute"]
    with widgets.drawing():
        cell = Thread(target=end_of_cell)
        cell.start()
        cell.join(0.1)
        assert ended == []
    cell.join()
    assert ended == [True]


def stored_images(still):
    """The drawings of a still, which holds each as an image."""
    assert "<svg" not in still
    found = re.findall(r'src="data:image/svg\+xml,([^"]*)"', still)
    images = [unquote(image) for image in found]
    for image in images:
        root = ElementTree.fromstring(image)  # noqa: S314 (our own)
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
    return images


def test_where_the_kernel_is_gone_a_still_of_the_last_state_stays(live):
    shown = live(lambda k: (names(k=k), Scene()), k=Slider([1, 2], "k"))
    assert "[1]" in stored_images(shown.stills[0])[0]
    assert "Run > Run All Cells" in shown.stills[0]
    shown.ask("state", 1)
    shown.ask("still", ["data:image/png;base64,eA=="])
    assert "[2]" in stored_images(shown.stills[1])[0]
    assert 'src="data:image/png;base64,eA=="' in shown.stills[1]
    shown.ask("still", [""])  # a scene that nobody has seen yet: words
    assert len(re.findall("<img", shown.stills[2])) == 1


def test_a_still_shares_no_identifier_with_the_live_demo(live):
    def draw(k):
        fig, axes = plt.subplots(1, 2)
        for ax in axes:
            ax.plot([0, k])
        return fig, photo_view(np.zeros((4, 6, 3), np.uint8), [((1, 1, 3, 3), "a & b", "blue")])

    shown = live(draw, k=Slider([1, 2], "k"))
    assert "clip-path" in shown.widget.page
    assert len(stored_images(shown.stills[0])) == 2
    identifiers = [
        set(re.findall(r'\bid="([^"]*)"', markup))
        for markup in (shown.widget.page, shown.stills[0])
    ]
    assert identifiers[0] & identifiers[1] == set()


def test_an_output_is_words_where_only_plain_text_is_shown(live):
    shown = live(k=Slider([1, 2], "k"))
    assert repr(shown.widget) == "(an interactive demo)"
    assert repr(still("a plot", [], "demo")) == "a plot"


def test_a_pad_is_a_place_on_a_grid(shown, book):
    pad = Pad([1, 2, 3], [10, 20], labels=("ahead", "up"), start=(3, 10))
    show(lambda at, on: names(at=at, on=on), at=pad, on=[False, True])
    [page] = shown
    assert [svg for _, svg in states(page)][2:5] == [
        names(at=(1, 20), on=False), names(at=(1, 20), on=True), names(at=(2, 10), on=False)
    ]  # fmt: skip
    assert re.findall(r'data-stride="(\d+)"', page.data) == ["4", "2", "1"]
    assert names(at=(3, 10), on=False) in page.data


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
        (dict(k=Slider(range(15), "a"), m=Slider(range(14), "b")), "210 positions are too many"),
        (dict(k=3), "k=3"),
        (dict(k=["a", 1]), "k="),
        (dict(k=[False, False]), "k="),
    ],
)
@pytest.mark.parametrize("render_mode", ["live", "book", "test"])
def test_impossible_controls_are_refused_in_every_life(controls, says, render_mode, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    with pytest.raises(ValueError, match=re.escape(says)):
        show(**controls)


@pytest.mark.parametrize("render_mode", ["book", "test"])
def test_a_control_without_effect_is_refused(render_mode, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
    with pytest.raises(ValueError, match="'idle hand' never changes the picture"):
        show(lambda k, idle_hand: names(k=k), k=Slider([1, 2], "k"), idle_hand=[False, True])


def test_unknown_life_is_refused(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "afterlife")
    with pytest.raises(ValueError, match="afterlife"):
        show()


@pytest.mark.parametrize("drawn", [None, 3, "plain words", [np.eye(2)], np.zeros((2, 2, 4)), {}])
def test_an_unknown_picture_is_refused(drawn):
    with pytest.raises(ValueError, match="cannot show"):
        show(lambda k: drawn, k=Slider([1, 2], "k"))


def test_the_kinds_of_pictures_may_not_change():
    with pytest.raises(ValueError, match="same kinds"):
        show(lambda on: Scene() if on else "<p></p>", on=[False, True])


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
