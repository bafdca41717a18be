"""Plots and images as markup that carries everything it needs: SVG with text, `<img>` with data."""

import base64
import io
import re
from functools import cache, lru_cache

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import AutoLocator, FixedLocator, MaxNLocator, NullLocator
from PIL import Image

from vmc_lib.show.palette import COLOURS, STYLE, css, least_width, plot_style
from vmc_lib.show.render_mode import STATIC, render_mode
from vmc_lib.show.svg_renderer import figure_svg

_NAMED = {code: css(name) for name, code in COLOURS.items()}
_NAMED |= {"#000000": css("ink"), "#ffffff": css("paper")}
_HYPHEN = re.compile(r"(?<![\w)-])-(?=\.?\d|inf\b)")  # that Python writes before a number
_CURVE = re.compile(r'<g id="curve:([^"]*)">\s*<path')
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_STEPS = MaxNLocator(5, steps=[1, 2, 5, 10])
_SVG_ROOT = 'font-family="DejaVu Sans, Verdana, sans-serif" stroke-linejoin="round"'


def with_style_sheet(markup):
    """The markup, in a live kernel with its style sheet: there is no page that has it."""
    return _style_sheet() + markup if render_mode() == "live" else markup


def minus(text):
    """Text in which the hyphen that Python writes before a number is a minus: −0.5, (−1, 2)."""
    return _HYPHEN.sub("−", text)


def number(value, digits=3):
    """A number in words, of so many digits: −0.5, 1200 (not 1.2e+03), 3·10⁻⁸ (not 3e-08)."""
    text, _, power = f"{float(f'{value:.{digits}g}'):g}".partition("e")
    times = f"·10{str(int(power)).translate(_RAISED)}" if power else ""
    return minus(text) + times


@cache
def _style_sheet():
    sheets = (STATIC / f"{name}.css" for name in ("demo", "scene"))
    return f"<style>{''.join(sheet.read_text(encoding='utf-8') for sheet in sheets)}</style>"


def svg(fig, salt):
    """The figure as SVG, its text as text and its colours as CSS variables; closes the figure."""
    _set_ticks(fig)
    with plot_style(**{"svg.hashsalt": salt}):
        svg = figure_svg(fig)
    plt.close(fig)  # or the notebook would show it a second time
    width, height = fig.get_size_inches()
    shape = f"{least_width(72 * width, STYLE['font.size'])}; --ratio: {width / height:.3f}"
    root = f'<svg {_SVG_ROOT} {_axes(fig)} style="{shape}" '
    svg = svg[svg.index("<svg ") :].replace("<svg ", root, 1)
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->|<style.*?</style>", "", svg, flags=re.S)
    svg = _CURVE.sub(r'<g>\n<path data-curve="\1"', svg)
    used = set(re.findall(r"#([\w.-]+)", svg))
    svg = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in used else "", svg)
    svg = re.sub(r"font-family: [^;\"]+(; )?", "", svg)
    svg = re.sub(r">[^<>]*</t", lambda words: minus(words[0]), svg)
    svg = re.sub(r' d="[^"]*"', lambda d: re.sub(r"(\.\d\d)\d+", r"\1", d[0]), svg)
    svg = re.sub(r"#[0-9a-f]{6}\b", lambda code: _NAMED.get(code[0], code[0]), svg)
    return _stackable(re.sub(r"\n\s*", "\n", svg).strip(), fig, f"{salt}-panels")


def _set_ticks(fig):
    """At most five steps on an axis, known before it is drawn: a third of its time went there."""
    for axis in (axis for ax in fig.axes for axis in (ax.xaxis, ax.yaxis)):
        low, high = sorted(axis.get_view_interval())
        if isinstance(locator := axis.get_major_locator(), AutoLocator):
            ticks = _STEPS.tick_values(low, high)
            visible = np.abs(ticks - (low + high) / 2) <= (0.5 + 1e-9) * (high - low)
            axis.set_ticks(np.clip(ticks[visible], low, high))
        if axis.get_scale() == "log" and (high > 10 * low or isinstance(locator, FixedLocator)):
            axis.set_minor_locator(NullLocator())  # they bear no numbers


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
    bars = any(ax.get_label() == "<colorbar>" for ax in fig.axes)  # they stay beside their panel
    if len(columns) != 2 or bars or fig.legends or fig.texts:
        return svg
    left = [ax for ax in fig.axes if ax.get_position().x0 < min(columns)[1]]
    last = any(np.isclose(ax.get_xticks(), ax.get_xlim()[1]).any() for ax in left)
    past = 0.15 if last else 0.08  # inches: half of a last number, before those of the second
    width, height = fig.get_size_inches()
    split = min(columns)[1] + past / width
    root, drawing = svg.split(">", 1)
    drawing = drawing.removesuffix("</svg>")
    view = re.search(r'viewBox="[^"]*"', root)[0]
    return (
        f'<div class="vmc-panels" style="--split: {split:.3f}; --ratio: {width / height:.3f}">\n'
        f'<div>{root}><g id="{name}">{drawing}</g></svg></div>\n'
        f'<div><svg {_SVG_ROOT} {view}><use href="#{name}"/></svg></div></div>'
    )


def image_tag(image):
    """An image as an `<img>`: small ones enlarged with sharp pixels, as one must see each."""
    if image.dtype.kind in "iu" and image.dtype != np.uint8:
        raise ValueError(f"{image.dtype} has no known range: give uint8, or floats in 0..1")
    if image.dtype != np.uint8:
        image = np.uint8(np.clip(np.nan_to_num(image), 0, 1) * 255 + 0.5)
    if image.ndim not in (2, 3) or (image.ndim == 3 and image.shape[2] != 3) or 0 in image.shape:
        raise ValueError(f"cannot show an array of shape {image.shape}: give (h, w) or (h, w, 3)")
    height, width = image.shape[:2]
    zoom = max(1, round(260 / width))
    return (
        f'<img class="vmc-image" alt="" width="{zoom * width}" height="{zoom * height}" '
        f'src="{data_uri(image)}">'
    )


def data_uri(image):
    """An image (height, width) or (height, width, 3) of uint8 as a `data:` address."""
    return _encode(image.tobytes(), image.shape)


@lru_cache(maxsize=64)  # the states of a demo often share a photo
def _encode(pixels, shape):
    """PNG for small or flat pictures, WebP for photographs: whichever is shorter."""
    image = np.frombuffer(pixels, np.uint8).reshape(shape)
    try:
        import cv2
    except ImportError:  # in the page
        png = io.BytesIO()
        Image.fromarray(image).save(png, "png", compress_level=1)
        return f"data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"
    bgr = image if image.ndim == 2 else image[..., ::-1]
    png = cv2.imencode(".png", bgr)[1].tobytes()
    webp = cv2.imencode(".webp", bgr, [cv2.IMWRITE_WEBP_QUALITY, 70])[1].tobytes()
    kind, data = ("png", png) if len(png) < 12_000 or len(png) < len(webp) else ("webp", webp)
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
