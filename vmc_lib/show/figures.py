"""How things look: one palette, one plot style, and every picture as self-contained markup.

A picture is a matplotlib figure, an image array, a string of SVG or HTML, an arm `Scene`, or a
tuple of these shown side by side. Colours are named, never raw: in the page each name is a CSS
variable, so that light and dark pages both read well.
"""

import base64
import html
import io
import re
from functools import lru_cache

import cv2
import matplotlib.pyplot as plt
import numpy as np
from IPython.display import Markdown, display
from markdown_it import MarkdownIt
from matplotlib.figure import Figure
from mdit_py_plugins.dollarmath import dollarmath_plugin

from vmc_lib.show.scene import Scene

COLOURS = {
    "blue": "#1f63b4",
    "orange": "#b3560a",
    "green": "#1b7a4a",
    "red": "#c22f3a",
    "purple": "#7a4cb8",
    "grey": "#67707e",
    "ink": "#1c2430",
    "line": "#d3d8df",
    "paper": "#fefefe",
}
# On a photo the page's theme does not matter: bright strokes with a dark edge read everywhere.
ON_PHOTO = {
    "blue": "#6cb6ff",
    "orange": "#ffa94d",
    "green": "#69e09a",
    "red": "#ff7b7b",
    "purple": "#d0aaff",
    "grey": "#c8ced6",
    "ink": "#ffffff",
}
EDGE = 'stroke="#10151c" stroke-width="6" stroke-linejoin="round"'

# One look for every plot of the book, wherever in a chapter it is drawn.
plt.rcParams.update(
    {
        "figure.figsize": (5.5, 3.2),
        "figure.constrained_layout.use": True,
        "font.size": 10,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.prop_cycle": plt.cycler(
            color=[COLOURS[c] for c in ("blue", "orange", "green", "red", "purple", "grey")]
        ),
        "grid.color": COLOURS["line"],
        "legend.frameon": False,
        "lines.linewidth": 1.8,
        "image.cmap": "gray",
        "svg.fonttype": "none",
        **{f"{part}.facecolor": "none" for part in ("figure", "axes", "savefig")},
        **{
            part: COLOURS["ink"]
            for part in ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color")
        },
        "ytick.color": COLOURS["ink"],
    }
)

_NAMES = {value: name for name, value in COLOURS.items()} | {"#000000": "ink", "#ffffff": "paper"}
_SVG_ROOT = 'font-family="DejaVu Sans, Verdana, sans-serif" stroke-linejoin="round"'
_MARKDOWN = MarkdownIt().use(
    dollarmath_plugin, renderer=lambda tex, _: rf"\({html.escape(tex.strip())}\)"
)


def pictures(drawn, name):
    """The parts of what a draw function returned: a list of markup strings and `Scene`s.

    `name` is unique on the page and the same for all states of a demo: it salts the identifiers
    inside a plot, so that pictures share none of them but the states of one picture share all.
    """
    parts = drawn if isinstance(drawn, tuple) else (drawn,)
    return [_markup(part, f"{name}-{place}") for place, part in enumerate(parts)]


def _markup(picture, salt):
    if isinstance(picture, Scene):
        return picture
    if isinstance(picture, Figure):
        return _svg(picture, salt)
    if isinstance(picture, np.ndarray):
        return _image(picture)
    if isinstance(picture, str) and picture.lstrip().startswith("<"):
        return picture
    raise ValueError(
        f"cannot show a {type(picture).__name__}: return a matplotlib Figure, an image array, "
        "SVG or HTML text, a Scene, or a tuple of these"
    )


def _svg(fig, salt):
    """The figure as SVG, its text as text and its colours as CSS variables; closes the figure."""
    text = io.StringIO()
    with plt.rc_context({"svg.hashsalt": salt}):
        fig.savefig(text, format="svg", metadata={"Date": None})
    plt.close(fig)  # or the notebook would show it a second time
    svg = text.getvalue()
    least = 0.62 * 72 * fig.get_figwidth()  # on a phone a wide plot scrolls, its words stay legible
    root = f'<svg {_SVG_ROOT} {_axes(fig)} style="--least: {least:.0f}pt" '
    svg = svg[svg.index("<svg ") :].replace("<svg ", root, 1)
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->|<style.*?</style>", "", svg, flags=re.S)
    used = set(re.findall(r"#([\w.-]+)", svg))
    svg = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in used else "", svg)
    svg = re.sub(r"font-family: [^;\"]+(; )?", "", svg)
    svg = re.sub(r' d="[^"]*"', lambda d: re.sub(r"(\.\d\d)\d+", r"\1", d[0]), svg)
    svg = re.sub(r"#[0-9a-f]{6}\b", lambda colour: _variable(colour[0]), svg)
    return _stackable(re.sub(r"\n\s*", "\n", svg).strip(), fig, f"{salt}-panels")


def _axes(fig):
    """Where the first axes lie and what they measure, for a `Pad`: x, then y from bottom to top."""
    if not fig.axes:
        return ""
    box = fig.axes[0].get_position()
    numbers = (
        *fig.axes[0].get_xlim(),
        *fig.axes[0].get_ylim(),
        box.x0,
        box.x1,
        1 - box.y0,
        1 - box.y1,
    )
    return f'data-axes="{" ".join(f"{n:.5g}" for n in numbers)}"'


def _stackable(svg, fig, name):
    """A plot of two panels side by side, so that a phone shows the second below the first.

    The second is the same drawing once more, by reference; the style sheet crops both at the split.
    """
    columns = {tuple(np.round(ax.get_position().intervalx, 3)) for ax in fig.axes}
    if len(columns) != 2 or fig.legends or fig.texts:
        return svg
    split = min(columns)[1] + 0.08 / fig.get_figwidth()  # in the gap stand the second's numbers
    root, drawing = svg.split(">", 1)
    drawing = drawing.removesuffix("</svg>")
    view = re.search(r'viewBox="[^"]*"', root)[0]
    return (
        f'<div class="vmc-panels" style="--split: {split:.3f}">\n'
        f'<div>{root}><g id="{name}">{drawing}</g></svg></div>\n'
        f'<div><svg {_SVG_ROOT} {view}><use href="#{name}"/></svg></div></div>'
    )


def _variable(colour):
    name = _NAMES.get(colour)
    return f"var(--vmc-{name}, {colour})" if name else colour


def _image(image):
    """An image as an `<img>`: small ones enlarged with sharp pixels, as one must see each."""
    if image.dtype != np.uint8:
        image = np.uint8(np.clip(np.nan_to_num(image), 0, 1) * 255 + 0.5)
    if image.ndim not in (2, 3) or (image.ndim == 3 and image.shape[2] != 3) or 0 in image.shape:
        raise ValueError(f"cannot show an array of shape {image.shape}: give (h, w) or (h, w, 3)")
    height, width = image.shape[:2]
    zoom = max(1, round(260 / width))
    return (
        f'<img class="vmc-image" alt="" width="{zoom * width}" height="{zoom * height}" '
        f'src="{_data_uri(image)}">'
    )


def _data_uri(image):
    return _encode(image.tobytes(), image.shape)


@lru_cache(maxsize=64)  # the states of a demo often share a photo
def _encode(pixels, shape):
    """PNG for small or flat pictures, JPEG for photographs: whichever is shorter."""
    image = np.frombuffer(pixels, np.uint8).reshape(shape)
    bgr = image if image.ndim == 2 else image[..., ::-1]
    png = cv2.imencode(".png", bgr)[1].tobytes()
    jpeg = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, 85])[1].tobytes()
    kind, data = ("png", png) if len(png) < 12_000 or len(png) < len(jpeg) else ("jpeg", jpeg)
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def photo_view(image, boxes=(), points=(), axes=None):
    """A photo with boxes on it, as SVG.

    `boxes` holds (box, label, colour name) with box = (x0, y0, x1, y1) in pixels; `points` holds
    ((x, y), label, colour name). Labels may be empty. `axes` is what a `Pad` reads at the photo's
    left, right, bottom and top edge: pixels, unless told otherwise.
    """
    height, width = image.shape[:2]
    left, right, bottom, top = axes or (0, width, height, 0)
    marks = []
    for (x0, y0, x1, y1), label, colour in boxes:
        rect = f'x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0:.1f}" height="{y1 - y0:.1f}"'
        marks += [f'<rect {rect} {EDGE}/><rect {rect} stroke="{ON_PHOTO[colour]}"/>']
        marks += [_label(x0, y0 - 7 if y0 > 26 else y1 + 21, label, colour)]
    for (x, y), label, colour in points:
        circle = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6"'
        marks += [f'{circle} {EDGE}/>{circle} stroke="{ON_PHOTO[colour]}"/>']
        marks += [_label(x + 11, y + 7, label, colour)]
    return "\n".join(
        [
            f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" fill="none" '
            f'stroke-width="3" font-size="20" data-axes="{left} {right} {bottom} {top} 0 1 1 0">',
            f'<image width="{width}" height="{height}" href="',
            _data_uri(image),
            '"/>',
            *marks,
            "</svg>",
        ]
    )


def _label(x, y, text, colour):
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{ON_PHOTO[colour]}" {EDGE} '
        f'paint-order="stroke">{html.escape(text)}</text>'
    )


def inline(text):
    """A line of Markdown, maths between dollar signs, as HTML."""
    return _MARKDOWN.renderInline(text)


def framed(inside, caption, name=""):
    """A figure element with its caption (Markdown)."""
    caption = f"<figcaption>{inline(caption)}</figcaption>"
    return f'<figure class="vmc-demo" id="{name}">{inside}{caption}</figure>'


def side_by_side(parts, alt):
    """The pictures next to each other, described by `alt` for those who do not see them."""
    inner = "".join(
        f'<div class="vmc-picture">{part if isinstance(part, str) else part.html(alt)}</div>'
        for part in parts
    )
    return f'<div class="vmc-pictures" role="img" aria-label="{html.escape(alt)}">{inner}</div>'


def markdown(text):
    """Show Markdown; an f-string puts the run's own numbers into a sentence."""
    display(Markdown(text))
