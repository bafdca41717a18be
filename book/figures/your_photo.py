"""The reader's own photo, to a reach, in the page: how it looks and what it has from Python."""

import json
from base64 import b64encode
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import HTML, display

from book.figures.aiming import shore
from book.figures.see_and_reach import place_errors
from page.arm import live
from page.bundle import STATIC, widget_script
from page.eye import brain
from reproduce.experiments.printed_sheet import FROM_SHEET
from reproduce.experiments.real_world import SIZED
from vmc_lib import marker_sheet, photos
from vmc_lib.arm.kinematics import TRUNK
from vmc_lib.camera import TABLE
from vmc_lib.motor.templates import START
from vmc_lib.photos import HEIGHT, REAL_LEVEL, WIDTH
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.figures import frame, pictures
from vmc_lib.show.live import VENDORED, Live
from vmc_lib.show.outputs import still
from vmc_lib.show.palette import COLOURS, EDGE, ON_PHOTO, plot_style
from vmc_lib.show.render_mode import render_mode

NAME = "your-photo"
LENS = 26 / 43.3  # of a usual phone: focal length by the diagonal, of a picture 36 mm × 24 mm large
SLANT, NEAREST = np.pi / 4, 0.5  # of a camera that is guessed: from the horizontal; m away
HIGH = 0.025  # m above the table: about the middle of a shuttlecock
FINDINGS = {
    "camera": "camera",
    "candidates": "looked at",
    "kept": "may hold a thing",
    "followed": "followed",
    "place": "place",
    "planned": "planned miss",
    "calibrated": "corrected miss",
}
LIVE = "followed"  # told while the reader's camera runs


def your_photo(example):
    """Show what an example `Photo` with the sheet, or the reader's own, leads to in the page.

    Each stage is drawn on the photo as soon as it is known, up to the calibrated reach. The photo
    is sent nowhere.
    """
    if render_mode() == "test":
        return
    with plot_style():
        scene, plot = pictures((_scene(), _above()), NAME)
    page = _page(example, scene, plot)
    if render_mode() == "book":
        display(HTML(frame(page)))
    else:
        learnt = SimpleNamespace(read_text=lambda **_: brain.script())
        vendored = VENDORED | {live.MUJOCO.name: live.MUJOCO, "brain.js": learnt}
        display(still("A photo, an arm, a table from above.", [scene], NAME))
        display(Live(page, widget_script("eye/live_photo.js"), vendored=vendored))
        sheets = STATIC / "live.css", STATIC / "your_photo.css"
        style = "".join(f"<style>{css.read_text(encoding='utf-8')}</style>" for css in sheets)
        display(HTML(style))


def sheet():
    """What the page has of the printed sheet, as JSON takes it."""
    board = marker_sheet.board()
    ids, patterns = board.getIds().ravel().tolist(), board.getDictionary()
    cells = [patterns.generateImageMarker(i, 6)[1:-1, 1:-1] > 0 for i in ids]
    return {
        "codes": [white.astype(int).ravel().tolist() for white in cells],
        "markers": np.array(board.getObjPoints())[..., :2].tolist(),
        "axes": marker_sheet.AXES.tolist(),
        "first": marker_sheet.FIRST.tolist(),
        "page": marker_sheet.page_corners().tolist(),
        "fewest": marker_sheet.FEWEST,
        "residual": marker_sheet.RESIDUAL,
        "focals": marker_sheet.FOCALS,
        "focalSpread": marker_sheet.FOCAL_SPREAD,
        "aside": marker_sheet.ASIDE,
        "gain": marker_sheet.GAIN,
        "refusals": marker_sheet.REFUSALS,
        "near": marker_sheet.NEAR,
    }


def place_accuracy():
    """How far places from a sheet's camera are off (m): half of them at most, nine in ten."""
    millimetres = place_errors()[f"box of {REAL_LEVEL}{FROM_SHEET}{SIZED}"]
    return (np.quantile(millimetres, [0.5, 0.9], method="higher") / 1000).tolist()


def camera_guess():
    """What is supposed of a photo without the sheet: its camera, and the shuttlecock's place.

    The shuttlecock's size (m) and its place (3,) are the medians of training renders.
    """
    shots = photos.load("varied", "train")
    sizes = [shot.camera.sizes(photos.boxes_of(shot, "shuttlecock")) for shot in shots]
    place = np.median([shot.target for shot in shots], axis=0)
    return {
        "lens": LENS,
        "slant": SLANT,
        "nearest": NEAREST,
        "size": float(np.median(sizes)),
        "place": place.tolist(),
    }


def _page(example, scene, plot):
    given = live.page_constants() | {
        "views": [[2, 0]],
        "sheet": sheet(),
        "placeAccuracy": place_accuracy(),
        "guess": camera_guess(),
        "table": TABLE,
        "edge": EDGE,
        "paint": ON_PHOTO,
        "scene": scene.messages(),
    }
    data = json.dumps(given, allow_nan=False).replace("<", r"\u003c")
    photo = b64encode(example.file.read_bytes()).decode()  # its very pixels
    size = (live.MUJOCO.stat().st_size + len(brain.script())) / 1e6
    findings = "".join(
        f'<div{" hidden" * (name == LIVE)}><dt>{label}</dt><dd data-tell="{name}">–</dd></div>'
        for name, label in FINDINGS.items()
    )
    return f"""<div class="vmc-eye" id="{NAME}"><form class="vmc-live-form" autocomplete="off">
<div><button type="button" name="example">Example</button>
<button type="button" name="own">Your photo …</button>
<button type="button" name="live" hidden>Live</button>
<button type="button" name="main" disabled>Again</button>
<button type="button" name="keep" disabled>Keep this picture</button>
<input type="file" name="file" accept="image/*" aria-label="Your photo" hidden></div>
<output data-tell="found"></output>
<p role="status">Your photo stays on this device. Eye and arm ({size:.0f} MB, part of this book) are
loaded when you start.</p><fieldset disabled hidden></fieldset>
<div class="vmc-pictures"><div class="vmc-picture"><canvas width="{2 * WIDTH}"
height="{2 * HEIGHT}" hidden></canvas><svg viewBox="0 0 {WIDTH} {HEIGHT}"
width="{WIDTH}" height="{HEIGHT}" fill="none" stroke-width="3" font-size="20" role="img"
aria-label="A table with a shuttlecock and a sheet of markers."><image width="{WIDTH}"
height="{HEIGHT}" href="data:image/jpeg;base64,{photo}"/><g></g><g></g><g></g></svg></div>
<div class="vmc-picture">{scene.html("An arm above a table.")}</div>
<div class="vmc-picture">{plot}</div></div>
<p class="vmc-boxes" hidden></p><dl>{findings}</dl></form>
<script type="application/json">{data}</script></div>"""


def _scene():
    """The arm as a reach begins, above a table; balls for the place and two ends, now under it."""
    away = (0.0, -9.0, 0.0)
    return arm_scene(START, balls=[(away, colour) for colour in ("green", "red", "purple")])


def _above():
    """From above: the trunk's axis, and, shaded, where the hand can be; the page adds the sheet."""
    fig, ax = plt.subplots(figsize=(2.1, 2.1))  # inches: it fits beside the arm on a phone
    ax.fill(*shore(TABLE + HIGH), color=COLOURS["green"], alpha=0.15, lw=0)
    ax.plot(*TRUNK[::-1], "s", color=COLOURS["grey"])
    look = {"ha": "right", "va": "center", "color": COLOURS["grey"]}
    ax.annotate("trunk", TRUNK[::-1], (-6, 0), textcoords="offset points", **look)
    ax.set(xlim=(-0.35, 0.4), ylim=(-0.25, 0.5), aspect="equal", title="from above")
    ax.set_axis_off()
    return fig
