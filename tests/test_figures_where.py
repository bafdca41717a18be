"""The pictures of the dorsal pathway: overlaps that rise, and the reader's own photo."""

from base64 import b64encode

import cv2
import numpy as np
import pytest

from book.figures import where
from page.bundle import widget_script

TRUTH = {"cup": np.array([0.0, 0, 10, 10])}
BOXES = np.array([[0.0, 0, 5, 10], [50, 50, 60, 60], [0, 0, 10, 10]])


def test_the_best_so_far_never_falls():
    best = where.best_so_far(TRUTH, BOXES)
    assert best["cup"] == pytest.approx([0.5, 0.5, 1])
    axes = where.rising(best, 2).axes[0]
    assert axes.get_legend_handles_labels()[1] == ["cup 0.50"]


def test_photo_upload_is_decoded():
    red = cv2.imencode(".png", np.full((800, 1200, 3), [0, 0, 255], np.uint8))[1].tobytes()
    image = where.decode_image(f"data:image/png;base64,{b64encode(red).decode()}")
    assert image.shape == (800, 1200, 3)
    assert image[0, 0].tolist() == [255, 0, 0]


def test_upload_button_needs_a_kernel(outputs, monkeypatch):
    widgets, figures = outputs(where), []
    monkeypatch.setattr(where, "figure", lambda drawn, alt: figures.append((drawn, alt)))
    image = np.zeros((400, 600, 3), np.uint8)
    for render_mode in ("book", "test", "live"):
        monkeypatch.setenv("VMC_RENDER_MODE", render_mode)
        where.photo_upload(lambda image: "<p>drawn</p>", image, "alt")
    assert figures == [("<p>drawn</p>", "alt")] * 3
    _, button = widgets  # after the still
    assert 'type="file"' in button.page
    assert button._esm == widget_script("demos/upload.js")
