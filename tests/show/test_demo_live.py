"""Demos in a live kernel: what they answer to a page, and the still that stays without it."""

import gc
import importlib
import os
import re
import sys
import time
from threading import Thread
from types import SimpleNamespace
from urllib.parse import unquote
from xml.etree import ElementTree

import matplotlib.pyplot as plt
import numpy as np
import pytest
from IPython.core.interactiveshell import InteractiveShell

from page.bundle import widget_script
from tests.pages import displayed
from tests.show.kernel import named, show
from vmc_lib.show import Choice, Scene, Slider, demo, photo_view
from vmc_lib.show import live as widgets
from vmc_lib.show.outputs import still


@pytest.fixture
def live(monkeypatch):
    """A function that shows a demo in a live kernel: what came out, and how a browser asks it."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")

    def live(*args, **controls):
        stills = []
        handle = SimpleNamespace(update=lambda still: stills.append(still.data))
        shown = displayed(monkeypatch, demo, handle)
        widget = show(*args, **controls)
        still, bundle, caption = shown
        assert widget.model_id in repr(bundle)
        stills.append(still.data)
        replies, channel = [], widget._channel
        monkeypatch.setattr(channel, "send", replies.append)

        def ask(question, value):
            channel._handle_custom_msg({"id": "1", "question": question, "value": value}, [])
            return replies[-1]

        return SimpleNamespace(ask=ask, widget=widget, stills=stills, caption=caption.data)

    return live


def test_a_live_demo_has_the_pages_markup_and_answers_for_each_state(live):
    shown = live(k=Slider([1, 2], "k", play=True), c=Choice("abcdef", "letter"), on=[False, True])
    page = shown.widget.page
    assert re.findall(r'data-stride="(\d+)"', page) == ["12", "2", "1"]
    assert "vmc-play" in page
    assert named(k=1, c="a", on=False) in page
    assert "<em>caption</em>" in shown.caption
    for place, values in ((17, dict(k=2, c="c", on=True)), (0, dict(k=1, c="a", on=False))):
        reply = {"id": "1", "answer": [["words"], named(**values).split("\n")]}
        assert shown.ask("state", place) == reply


def test_a_live_demo_brings_its_script_and_its_first_state(live):
    plot = live(k=Slider([1, 2], "k")).widget
    assert plot._esm == widget_script("demo/live.js")
    assert plot.first == [["words"], None]  # the plot stands in the page
    scene = live(lambda k: (named(k=k), Scene()), k=Slider([1, 2], "k")).widget
    assert scene.first == [["words"], None, Scene().messages()]


def test_an_edited_module_counts_when_a_demo_is_moved(live, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    file = tmp_path / "edited_module.py"
    file.write_text("def law(k):\n    return 2 * k", encoding="utf-8")
    edited = importlib.import_module("edited_module")
    monkeypatch.setitem(sys.modules, "edited_module", edited)
    shell = InteractiveShell()
    shell.run_line_magic("load_ext", "autoreload")
    shell.run_line_magic("autoreload", "2")
    monkeypatch.setattr(widgets, "get_ipython", lambda: shell)
    seconds = iter([0, 5, 5.1, 6])
    monkeypatch.setattr(widgets, "monotonic", lambda: next(seconds))
    shown = live(lambda k: named(k=edited.law(k)), k=Slider([1, 2], "k"))
    assert shown.ask("state", 1)["answer"] == [["words"], named(k=4).split("\n")]
    for factor, stands in ((3, 3), (4, 3), (4, 4)):  # the second is within the same second
        file.write_text(f"def law(k):\n    return {factor} * k", encoding="utf-8")
        os.utime(file, times=(later := time.time() + 10 * factor, later))
        answer = shown.ask("state", 1)["answer"]
        assert answer == [["words"], named(k=2 * stands).split("\n")]


def test_garbage_collection_skips_what_is_loaded_before_a_demo(live):
    gc.unfreeze()
    demo._freeze_once.cache_clear()
    live(k=Slider([1, 2], "k"))
    assert len(gc.get_objects()) < gc.get_freeze_count()


def test_an_error_in_draw_is_shown_with_the_values_of_the_controls(live):
    shown = live(lambda k: named(k=1 / k), k=Slider([-1, 0, 2], "k"))
    error = shown.ask("state", 1)["error"]
    assert "ZeroDivisionError: division by zero" in error
    assert "{'k': 0}" in error
    assert shown.ask("state", 2)["answer"] == [["words"], named(k=0.5).split("\n")]
    shown = live(lambda on: Scene() if on else "<p></p>", on=[False, True])
    assert "same kinds" in shown.ask("state", 1)["error"]


def test_a_state_is_drawn_anew_after_an_error(live):
    scale = SimpleNamespace(of=[1, 1])
    shown = live(lambda k: named(k=1 / scale.of[k]), k=Slider([0, 1], "k"))
    scale.of = [2, 0]  # another law, wrong at 1
    assert "error" in shown.ask("state", 1)
    assert shown.ask("state", 0)["answer"][1] == named(k=0.5).split("\n")


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
    with widgets.exclusive_pyplot():
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


def test_a_still_of_the_last_state_stays_without_a_kernel(live):
    shown = live(lambda k: (named(k=k), Scene()), k=Slider([1, 2], "k"))
    assert "[1]" in stored_images(shown.stills[0])[0]
    assert "Run > Run All Cells" in shown.stills[0]
    shown.ask("state", 1)
    shown.ask("still", ["data:image/png;base64,eA=="])
    assert "[2]" in stored_images(shown.stills[1])[0]
    assert 'src="data:image/png;base64,eA=="' in shown.stills[1]
    shown.ask("still", [""])  # a scene that nobody has seen yet: words
    assert len(re.findall("<img", shown.stills[2])) == 1


def test_a_stills_numbers_are_folded_as_the_demos_are(live):
    """A table that stood open once made Notebook 7 lock the demo in a scrolling box."""

    def draw(k):
        fig, ax = plt.subplots()
        ax.plot([0, k])
        return fig

    shown = live(draw, alt=None, k=Slider([1, 2], "k"))
    for markup in (shown.widget.page, shown.stills[0]):
        assert markup.count("<table") == len(re.findall("<details[^$]*?<table", markup)) == 1


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
