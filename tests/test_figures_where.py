"""The pictures of the dorsal pathway: overlaps that rise, and the reader's own photo."""

from datetime import UTC, datetime

import cv2
import numpy as np
import pytest
from ipywidgets import FileUpload, VBox

from book.figures import where

TRUTH = {"cup": np.array([0.0, 0, 10, 10])}
BOXES = np.array([[0.0, 0, 5, 10], [50, 50, 60, 60], [0, 0, 10, 10]])


def test_the_best_so_far_never_falls():
    best = where.best_so_far(TRUTH, BOXES)
    assert best["cup"] == pytest.approx([0.5, 0.5, 1])
    axes = where.rising(best, 2).axes[0]
    assert axes.get_legend_handles_labels()[1] == ["cup 0.50"]


def upload(content, name="mine.png"):
    facts = {"type": "image/png", "size": len(content), "last_modified": datetime.now(UTC)}
    return ({"name": name, "content": memoryview(content), **facts},)


def test_a_photo_of_the_readers_is_drawn():
    red = cv2.imencode(".png", np.full((400, 600, 3), [0, 0, 255], np.uint8))[1].tobytes()
    shown = where.drawn(lambda image: str(image[0, 0].tolist()), upload(red))
    assert shown == "[255, 0, 0]"


@pytest.mark.parametrize("content", [b"", b"no picture"])
def test_a_file_that_is_no_photo_is_named(content):
    assert where.drawn(str, upload(content)).startswith("<p>mine.png is not an image")


def test_a_file_name_is_shown_and_never_run():
    name = "<img src=x onerror=alert(1)>.jpg"
    shown = where.drawn(str, upload(b"no picture", name))
    assert shown.startswith("<p>&lt;img src=x onerror=alert(1)&gt;.jpg is not an image")
    assert "<" not in shown.removeprefix("<p>").removesuffix("</p>")


def test_the_button_is_there_only_where_a_kernel_answers(monkeypatch):
    shown, figures = [], []
    monkeypatch.setattr(where, "display", shown.append)
    monkeypatch.setattr(where, "figure", lambda *parts: figures.append(parts))
    image = np.zeros((400, 600, 3), np.uint8)
    for render_mode in ("book", "test", "live"):
        monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
        where.your_own(lambda image: "<p>drawn</p>", image, "caption", "alt")
    assert figures == [("<p>drawn</p>", "caption", "alt")] * 3
    assert len(shown) == 1
    assert isinstance(shown[0], VBox)
    button, view = shown[0].children
    assert isinstance(button, FileUpload)
    button.value = upload(b"no picture")
    assert "not an image" in view.value
