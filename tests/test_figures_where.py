"""The pictures of the dorsal pathway: overlaps that rise, and the reader's own photo."""

from base64 import b64encode

import cv2
import numpy as np
import pytest

from book.figures import racket, regions, where
from page.bundle import bundle, widget_script
from tests import pages
from vmc_lib.show.palette import ON_PHOTO

TRUTH = {"cup": np.array([0.0, 0, 10, 10])}
BOXES = np.array([[0.0, 0, 5, 10], [50, 50, 60, 60], [0, 0, 10, 10]])


def test_the_best_so_far_never_falls():
    best = where.best_so_far(TRUTH, BOXES)
    assert best["cup"] == pytest.approx([0.5, 0.5, 1])
    axes = where.overlap_curves(best, 2).axes[0]
    assert axes.get_legend_handles_labels()[1] == ["cup 0.50"]


class Astray:
    """A detector whose box regression takes every box to one place."""

    def __init__(self, box):
        self.box = np.array([box])

    def regress(self, image, boxes, rounds):
        return self.box if rounds else boxes


IMAGE = np.zeros((20, 20, 3), np.uint8)


@pytest.mark.parametrize(("wide", "colour"), [(7.98, "orange"), (8, "green")])
def test_a_corrected_box_is_green_from_an_overlap_of_eight_tenths(wide, colour):
    """Not from 0.798, which is 0.80 in two digits."""
    shown = regions.regressed_view(Astray([0, 0, wide, 10]), IMAGE, TRUTH["cup"], (5, 5), 1)
    assert "IoU 0.80" in shown
    assert [name for name in ("green", "orange") if ON_PHOTO[name] in shown] == [colour]


def test_a_box_starts_as_far_on_one_side_as_on_the_other():
    for middle, said in ((-1, 5), "began 0.6 left<"), ((11, 5), "began 0.6 right<"):
        _, shared = regions.regress(Astray(None), IMAGE, TRUTH["cup"], middle, 0)
        assert shared == pytest.approx(3.5 / (9 + 10 - 3.5) * 9 / 10, abs=0.03)
        assert said in regions.regressed_view(Astray(None), IMAGE, TRUTH["cup"], middle, 0)


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


UPLOAD = """(script) => {
  const box = document.body;
  box.innerHTML = "<input type=file><p role=status></p><div class=vmc-picture></div>";
  const answer = () => new Promise((resolve) => (self.resolve = resolve));
  (0, eval)(script)({})["demos/upload"].start(box, answer);
}"""


@pytest.mark.browser
def test_a_late_answer_leaves_what_is_said_of_a_later_file(window, tmp_path):
    files = tmp_path / "photo.png", tmp_path / "words.txt"
    cv2.imwrite(str(files[0]), np.zeros((4, 6, 3), np.uint8))
    files[1].write_text("no picture", encoding="utf-8")
    page = window().new_page()
    page.evaluate(UPLOAD, bundle("demos/upload.js"))
    chosen, status = page.locator("input"), page.get_by_role("status")
    chosen.set_input_files(files[0])
    page.wait_for_function("() => self.resolve")
    chosen.set_input_files(files[1])
    page.wait_for_function("() => document.body.innerText.includes('words.txt')")
    page.evaluate("() => resolve('<p>drawn</p>')")
    page.evaluate(pages.TWO_FRAMES)
    assert "cannot read words.txt" in status.inner_text()
    assert page.get_by_text("drawn").count() == 0


@pytest.mark.browser
def test_a_photo_can_be_chosen_again_while_it_is_looked_at(window, tmp_path):
    photo = tmp_path / "photo.png"
    cv2.imwrite(str(photo), np.zeros((4, 6, 3), np.uint8))
    page = window().new_page()
    page.evaluate(UPLOAD, bundle("demos/upload.js"))
    page.locator("input").set_input_files(photo)
    page.wait_for_function("() => self.resolve")
    assert page.locator("input").input_value() == ""


def test_boxes_of_the_racket_are_counted_by_where_they_lie():
    true = racket.racket().boxes["shuttlecock"]
    boxes = np.array([[60, 10, 90, 40], [100, 50, 330, 90], true, true + 300], float)
    assert racket.count(boxes) == (1, 1, 2)
    assert "Of 4 boxes 1 lie in the racket's head, 1 on" in racket.racket_in_words(boxes)
    image = racket.racket().image
    drawn = {
        every: racket.racket_view(image, boxes, every).count("<rect") for every in (True, False)
    }
    assert drawn[True] - drawn[False] == 2 * 2  # each has an edge


def test_only_the_rackets_head_is_blurred():
    clear, blurred = racket.images().values()
    x0, y0, x1, y1 = racket.HEAD
    changed = (clear != blurred).any(axis=2)
    assert changed[y0:y1, x0:x1].mean() > 0.9
    changed[y0:y1, x0:x1] = False
    assert not changed.any()
    assert np.ptp(racket.without_colour(clear), axis=2).max() == 0
