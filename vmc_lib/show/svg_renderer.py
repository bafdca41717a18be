"""matplotlib's SVG renderer with cached text metrics: each font and word is measured once.

To lay a plot out, matplotlib asks some hundred times how large its words are.
"""

import io
from functools import lru_cache

from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.cbook import is_math_text
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.textpath import text_to_path


class _CachedRenderer(RendererSVG):
    def __init__(self, *args, **named):
        super().__init__(*args, **named)
        self._text2path = text_to_path  # one for all pictures: it knows the maths it has read

    def get_text_width_height_descent(self, s, prop, ismath):
        return _size(s, prop.copy(), ismath)

    def _get_font_height_metrics(self, prop):  # matplotlib 3.11 asks, before it reads the file
        return _height(prop.copy())


class _Canvas(FigureCanvasSVG):
    def get_renderer(self):  # the layout measures with the renderer that draws
        return self.renderer


def figure_svg(fig):
    """A figure as SVG, the very text that matplotlib's own canvas writes."""
    canvas, text, dpi = _Canvas(fig), io.StringIO(), fig.dpi
    fig.dpi = 72  # points
    canvas.renderer = _CachedRenderer(
        *72 * fig.get_size_inches(), text, image_dpi=dpi, metadata={"Date": None}
    )
    fig.draw(canvas.renderer)
    canvas.renderer.finalize()
    return text.getvalue()


def text_width(words):
    """How wide a plot's words stand on a line, in inches."""
    return _size(words, FontProperties(), is_math_text(words))[0] / 72


def wrap(words, width):
    """A plot's words in lines of at most so many inches, where no word or formula is longer."""
    first, *rest = [words] if is_math_text(words) else words.split(" ")
    lines = [first]
    for word in rest:
        longer = f"{lines[-1]} {word}"
        if text_width(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return "\n".join(lines)


@lru_cache(4096)
def _size(s, prop, ismath):
    """Width, height and descent of a line of text, in points."""
    return text_to_path.get_text_width_height_descent(s, prop, ismath)


@lru_cache(256)
def _height(prop):
    """Ascent, descent and line gap of a font, in points; None where its file says nothing."""
    font = get_font(findfont(prop))
    if not (metrics := font.get_sfnt_table("OS/2")):
        return None, None, None
    em = prop.get_size_in_points() / font.get_sfnt_table("head")["unitsPerEm"]
    return (
        em * metrics["sTypoAscender"],
        -em * metrics["sTypoDescender"],
        em * metrics["sTypoLineGap"],
    )
