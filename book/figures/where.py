"""Figures of segments and boxes, for the chapters on the dorsal pathway."""

import re
from base64 import b64decode
from html import escape
from io import BytesIO

import numpy as np
from IPython.display import HTML, display
from PIL import Image

from book.figures.panels import panels
from page.bundle import widget_script
from vmc_lib.boxes import MIN_IOU, iou
from vmc_lib.photos import as_rgb
from vmc_lib.show.controls import slider
from vmc_lib.show.demo import figure
from vmc_lib.show.figures import frame, photo_view
from vmc_lib.show.live import Live
from vmc_lib.show.markup import data_uri
from vmc_lib.show.outputs import still
from vmc_lib.show.palette import COLOURS, EDGE, ON_PHOTO
from vmc_lib.show.render_mode import render_mode


def mean_colours(image, labels):
    """The mean colour (n, 3) of every region of `labels` in the image (height, width, 3)."""
    flat = labels.ravel()
    size = np.maximum(np.bincount(flat), 1)
    return np.stack([np.bincount(flat, channel) / size for channel in image.reshape(-1, 3).T], 1)


def mosaic(image, labels):
    """The image (height, width, 3) with every region of `labels` painted in its mean colour."""
    return np.uint8(mean_colours(image, labels) + 1e-6)[labels]  # 3 may be 2.9999999999


def in_corner(words, colour="ink"):
    """Words in a photo's upper left corner, as a box without area for `photo_view`."""
    return (8, 0, 8, 0), words, colour


def _box(middle, size):
    half = np.divide(size, 2)
    return np.concatenate([middle - half, middle + half])


def overlap(image, thing, middle, size):
    """A photo with a thing's box, and one of a size around a middle (x, y): how much do they share?

    Green at an IoU of 0.8 or more, red at 0.5 or less.
    """
    box = _box(middle, size)
    shared = round(iou(box, thing).item(), 2)
    colour = "green" if shared >= MIN_IOU else "orange" if shared > 0.5 else "red"
    said = in_corner(f"IoU {shared:.2f}", colour)  # at the box a hand would hide it
    return photo_view(image, [(thing, "", "grey"), (box, "", colour), said])


def describe_overlap(thing, middle, size):
    """The same in words."""
    (x, y), (wide, high), shared = middle, size, iou(_box(middle, size), thing).item()
    return f"A box around {x:.0f}, {y:.0f}, {wide:.0f} × {high:.0f}: IoU {shared:.2f}."


def overlap_in_page(image, thing):
    """The same for the page to work out (see `explore`)."""
    given = {"object": thing.tolist(), "edge": EDGE, "paint": ON_PHOTO}
    return "overlap", lambda: photo_view(image), given


def nearest(truth, boxes, colour="green"):
    """For each named true box the nearest of `boxes`, labelled with its IoU, for `photo_view`."""
    marks = []
    for name, true in truth.items():
        overlap = iou(true, boxes)[0]
        marks.append((boxes[overlap.argmax()], f"{name} {overlap.max():.2f}", colour))
    return marks


def right_and_wrong(image, boxes, truth):
    """The image with its boxes (n, 4): green where they hold an object, red where they do not."""
    right = iou(boxes, list(truth.values())).max(1, initial=0) >= MIN_IOU
    return photo_view(
        image, [(b, "", "green" if r else "red") for b, r in zip(boxes, right, strict=True)]
    )


def best_so_far(truth, boxes):
    """For each named true box, the best IoU among the first 1, 2, ... of `boxes`: name → (n,)."""
    best = np.maximum.accumulate(iou(list(truth.values()), boxes), axis=1)
    return dict(zip(truth, best, strict=True))


def overlap_curves(best, now):
    """A plot of what `best_so_far` returned for the boxes up to number `now`, none later."""
    fig, ax = panels(size=(4.2, 3.2))
    for name, overlap in best.items():
        ax.plot(np.arange(1, now + 1), overlap[:now], label=f"{name} {overlap[now - 1]:.2f}")
    ax.axvline(now, color=COLOURS["ink"], lw=1)
    ax.set(xlabel="regions made", ylabel="best overlap so far", xlim=(0, len(overlap)), ylim=(0, 1))
    fig.legend(loc="upper center", ncols=2)
    return fig


SEGMENTATION = """<div class="vmc-segmentation"><div class="vmc-picture" style="display: grid;
justify-items: center">PHOTO<canvas aria-hidden="true" style="LAYER" hidden></canvas></div>
<form class="vmc-controls" autocomplete="off">SLIDERS
<div class="vmc-control"><div class="vmc-options">
<button type="button" class="vmc-play">Play</button>
<button type="button" class="vmc-play">Your photo …</button>
<button type="button" class="vmc-play" hidden>The book's photo</button>
<input type="file" accept="image/*" aria-label="Your photo" hidden></div></div></form>
<p class="vmc-strip" style="CENTRED"></p>
<p role="status" style="CENTRED"></p></div>"""
LAYER = "grid-area: 1 / 1; max-width: 100%; max-height: 80vh; height: auto"
CENTRED = "text-align: center"


def segmentation_demo(image, alt):
    """Show how an image (height, width, 3) falls into segments, which grow back, in the page.

    The reader may put a photo of their own in its place; it is looked at there and sent nowhere.
    """
    photo = f'<img alt="{escape(alt)}" src="{data_uri(image)}" style="{LAYER}">'
    scale = {"min": 4.644, "max": 9.644, "step": 0.01, "value": 6.644}  # powers of two: 25 to 800
    merged = {"min": 0, "max": 1, "step": 0.001, "value": 0}
    sliders = slider("segmentation-k", "scale k", "100", scale)
    sliders += slider("segmentation-merged", "merged", "", merged, width=9)
    parts = {"PHOTO": photo, "LAYER": LAYER, "CENTRED": CENTRED, "SLIDERS": sliders}
    page = re.sub("|".join(parts), lambda name: parts[name[0]], SEGMENTATION)
    if render_mode() == "book":
        display(HTML(frame(page)))
    elif render_mode() == "live":
        display(still(alt, [photo], "segmentation"))
        display(Live(frame(page, "segmentation"), widget_script("demos/segmentation.js")))


UPLOAD = """<div class="vmc-demo" id="upload"><form class="vmc-control">
<label>Your photo, of any size: <input type="file" accept="image/*"></label>
<span role="status"></span></form><div class="vmc-picture"></div></div>"""


def photo_upload(draw, example, alt):
    """Show `draw(example)`; in a live kernel, a button puts the reader's own photo in its place.

    `draw` takes an image of any size and returns markup. The photo stays in the kernel.
    """
    figure(draw(example), alt=alt)
    if render_mode() == "live":
        answers = {"photo": lambda sent: draw(decode_image(sent))}
        display(still("", [], "upload"))
        display(Live(UPLOAD, widget_script("demos/upload.js"), answers))


def decode_image(sent):
    """The image (height, width, 3) that a browser sent, a `data:` address."""
    with Image.open(BytesIO(b64decode(sent.partition(",")[2]))) as file:
        return as_rgb(np.array(file))
