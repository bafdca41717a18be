"""What a reader is shown: pictures, photos with boxes on them, captions, words and tables.

A picture is a matplotlib figure, an image array, a string of SVG or HTML, an arm `Scene`, or a
tuple of these shown side by side. Colours are named, never raw.
"""

import html
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from IPython.display import Markdown, display
from markdown_it import MarkdownIt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from mdit_py_plugins.dollarmath import dollarmath_plugin

from vmc_lib.checks import check_kind
from vmc_lib.short_repr import short
from vmc_lib.show.data_table import DataTable, name_curves
from vmc_lib.show.estimate import estimate
from vmc_lib.show.markup import data_uri, image_tag, minus, number, svg
from vmc_lib.show.palette import EDGE, ON_PHOTO, least_width
from vmc_lib.show.scene import Scene

_MARKDOWN = MarkdownIt().use(
    dollarmath_plugin, renderer=lambda tex, _: rf"\({html.escape(tex.strip())}\)"
)

LETTERS = 21  # px of a photo: how large words on it are
HINTS = {  # what is returned instead of a picture, and what was meant
    "NoneType": "; end the function with `return fig`, or `return plt.gcf()`",
    "str": "; plain words are `note(text)`",
    "list": "; after `ax.plot(…)` return `ax`, for several pictures `(fig, scene)`",
    "Photo": "; give photo.image",
    "HTML": "; give its text, html.data",
    "Image": "; give np.asarray(image)",
}
_NO_WORDS = re.compile(r"(\$[^$]*\$|`[^`]*`|</?\w[^>]*>|\]\([^)]*\))")  # maths, code, tags, links


def pictures(picture, name):
    """The parts of what a draw function returned: a list of markup strings and `Scene`s.

    `name` is unique on the page and the same for all states of a demo: it salts the identifiers
    inside a plot, so that pictures share none of them but the states of one picture share all.
    """
    return [_markup(part, f"{name}-{place}") for place, part in enumerate(parts_of(picture))]


def parts_of(picture):
    """The parts of a picture, a tuple; ValueError where there is one that cannot be shown."""
    parts = picture if isinstance(picture, tuple) else (picture,)
    parts = tuple(part.figure if isinstance(part, Axes) else part for part in parts)
    for part in parts:
        markup = isinstance(part, str) and part.lstrip().startswith("<")
        if not (markup or isinstance(part, Scene | Figure | np.ndarray)):
            kind = type(part).__name__
            raise ValueError(
                f"cannot show a {kind}: return a matplotlib Figure, an image array, SVG or HTML "
                f"text, a Scene, or a tuple of these{HINTS.get(kind, '')}"
            )
    return parts


def _markup(part, salt):
    if isinstance(part, Figure):
        name_curves(part)
        return svg(part, salt)
    return image_tag(part) if isinstance(part, np.ndarray) else part


def photo_view(
    image: np.ndarray,
    boxes: Iterable[tuple[Any, str, str]] = (),
    points: Iterable[tuple[Any, str, str]] = (),
    axes: tuple[float, float, float, float] | None = None,
) -> str:
    """A photo with boxes on it, as SVG.

    `boxes` holds (box, label, colour name) with box = (x0, y0, x1, y1) in pixels; `points` holds
    ((x, y), label, colour name). Labels may be empty. `axes` is what a `Pad` reads at the photo's
    left, right, bottom and top edge: pixels, by default. ValueError for what is neither.
    """
    if not isinstance(image, np.ndarray):
        raise ValueError(f"{image!r} is no image: give an array, as photos.read_image returns it")
    boxes, points = _marks("boxes", boxes, 4), _marks("points", points, 2)
    height, width = image.shape[:2]
    left, right, bottom, top = axes or (0, width, height, 0)
    wordless = not any(label for _, label, _ in (*boxes, *points))
    shape = "" if wordless else f"{least_width(width, LETTERS)}; --ratio: {width / height:.3f}"
    return "\n".join(
        [
            f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" fill="none" '
            f'stroke-width="3" font-size="{LETTERS}" style="{shape}" '
            f'data-axes="{left} {right} {bottom} {top} 0 1 1 0">',
            f'<image width="{width}" height="{height}" href="',
            data_uri(image),
            '"/>',
            *(_rectangle(box, colour) for box, _, colour in boxes),
            *(_circle(point, colour) for point, _, colour in points),
            *_box_labels(boxes, width, height),  # words lie above marks
            *(_label(x + 11, y + 7, label, colour) for (x, y), label, colour in points),
            "</svg>",
        ]
    )


def _marks(name, given, size):
    """The boxes or the points of a photo as a list; ValueError for what is none."""
    if not np.iterable(given):
        raise ValueError(f"{name} are {given!r}: give a list of them")
    marks = list(given)
    for mark in marks:
        if not (np.iterable(mark) and len(mark) == 3 and np.shape(mark[0]) == (size,)):
            place = "(x0, y0, x1, y1)" if size == 4 else "(x, y)"
            raise ValueError(f"{name} hold {mark}: give ({place}, label, colour name)")
    return marks


def _rectangle(box, colour):
    x0, y0, x1, y1 = box
    rect = f'<rect x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0:.1f}" height="{y1 - y0:.1f}"'
    return f'{rect} {EDGE}/>{rect} stroke="{ON_PHOTO[colour]}"/>'


def _circle(point, colour):
    x, y = point
    circle = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6"'
    return f'{circle} {EDGE}/>{circle} stroke="{ON_PHOTO[colour]}"/>'


def _box_labels(boxes, width, height):
    """The boxes' labels, each above, below or inside its box: where it hides none before it."""
    labels, taken = [], []
    for (x0, y0, _, y1), label, colour in boxes:
        long = 12 * len(label) + 9 * sum(map(label.count, "%m"))  # about; these are wide
        x, low = max(min(x0, width - long), 0), min(y1 + 21, height - 7)
        near = [y for begin, y, end in taken if begin < x + long and x < end]
        places = [y0 - 7, low, y0 + 21] if y0 > 26 else [low, y0 + 21]
        y = next((y for y in places if all(abs(y - other) > 20 for other in near)), places[0])
        labels.append(_label(x, y, label, colour))
        taken += [(x, y, x + long)] * bool(label)
    return labels


def _label(x, y, text, colour):
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{ON_PHOTO[colour]}" {EDGE} '
        f'paint-order="stroke">{html.escape(text)}</text>'
    )


def margins(fig: Figure, left: float = 0.7, top: float = 0.3) -> None:
    """Leave so many inches beside and above a figure's plots: quicker than to seek their room."""
    width, height = fig.get_size_inches()
    fig.subplots_adjust(left / width, 0.5 / height, 1 - 0.2 / width, 1 - top / height)


def note(text: str) -> str:
    """A line of text as a picture (HTML), to stand beside others and to move with a demo."""
    check_kind("note", text, str, 'text, str(…) or f"{…}"')
    return f'<p class="vmc-strip">{html.escape(text)}</p>'


def inline(text):
    """A line of Markdown, maths between dollar signs, as HTML."""
    return _MARKDOWN.renderInline(text)


def frame(inside, name="", caption=""):
    """A figure element, and its caption (Markdown) if it has one."""
    caption = caption and f"<figcaption>{inline(caption)}</figcaption>"
    return f'<figure class="vmc-demo" id="{name}">{inside}{caption}</figure>'


def side_by_side(parts, alt):
    """The pictures next to each other, described by `alt` for those who do not see them.

    A table of their numbers stands folded below.
    """
    tables = [part for part in parts if isinstance(part, DataTable)]
    inner = "".join(
        f'<div class="vmc-picture">{part if isinstance(part, str) else part.html(alt)}</div>'
        for part in parts
        if part not in tables
    )
    below = "".join(
        '<details class="vmc-numbers-of"><summary>The plot\'s numbers</summary>'
        f"{numbers(table)}</details>"
        for table in tables
    )
    role = "group" if "<a " in inner else "img"  # an image's links are none to a screen reader
    return (
        f'<div class="vmc-pictures" role="{role}" aria-label="{html.escape(alt)}">{inner}</div>'
        f"{below}"
    )


def numbers(table):
    """A plot's `DataTable`, to be scrolled (HTML)."""
    named = 'role="group" aria-label="The plot\'s numbers"'
    return f'<div class="vmc-data" tabindex="0" {named}>{table}</div>'


def markdown(text: str) -> None:
    """Show Markdown; an f-string puts the run's own numbers into a sentence."""
    check_kind("Markdown", text, str, 'text, str(…) or f"{…}"')
    parts = _NO_WORDS.split(text)
    parts[::2] = map(minus, parts[::2])
    display(Markdown("".join(parts)))


def details(summary: str, text: str) -> None:
    """Show Markdown that stays folded under its summary until the reader asks for it."""
    markdown(f"<details><summary>{summary}</summary>\n\n{text}\n\n</details>")


def itemise(values: Mapping[str, Any], form: str, between: str = ", ") -> str:
    """The values of a mapping in words: each by `form`, its value and its name given to it.

    >>> itemise({"up": 0.35, "down": 1.61}, "{:.2f} {}")
    '0.35 up, 1.61 down'
    """
    return between.join(form.format(value, name) for name, value in values.items())


def table(
    heads: Sequence[str],
    rows: Iterable[Sequence[Any]] | Mapping[str, Sequence[Any]],
    form: str | None = None,
) -> str:
    """A Markdown table of column heads and rows of as many cells: text, numbers, or None.

    `rows` may map a row's name to its other cells. Numbers get three digits; draws (n,) and
    (value, low, high) are written as an `estimate`, with their 95 % interval; each as `form` says,
    if it is given. ValueError where a row has another number of cells, or a column has no head: a
    screen reader would call it nothing.
    """
    if not np.iterable(heads):
        raise ValueError(f"heads {heads!r}: give a list of texts, one for each column")
    if not all(heads):
        raise ValueError(f"every column needs a head, and {list(heads)} leaves one empty")
    rows = _rows(rows)
    lines = [heads, ["---"] * len(heads), *rows]
    if wrong := [row for row in rows if len(row) != len(heads)]:
        raise ValueError(f"the row {wrong[0]} does not have {len(heads)} cells, as {heads} has")
    return "\n".join(f"| {' | '.join(_cell(x, form) for x in line)} |" for line in lines)


def _rows(given):
    """The rows of a table as a list, their names as first cells; ValueError for what are none."""
    named = isinstance(given, Mapping)
    rows = list(given.values() if named else given) if np.iterable(given) else [given]
    if not all(map(np.iterable, rows)):
        raise ValueError(f"rows {short(given)}: give a list of rows, each a list of its cells")
    return [[name, *row] for name, row in zip(given, rows, strict=True)] if named else rows


def _cell(value, form):
    if value is None:
        return ""
    if isinstance(value, float | np.floating):
        return format(value, form) if form else number(value)
    return (
        format(estimate(value), form or "") if isinstance(value, tuple | np.ndarray) else str(value)
    )
