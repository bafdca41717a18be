"""What a live cell puts out, readable wherever the notebook is opened: with a kernel or without."""

import re
from urllib.parse import quote

from IPython.display import HTML

from vmc_lib.show.figures import side_by_side
from vmc_lib.show.markup import with_style_sheet

_PANELS = re.compile(r'<div class="vmc-panels".*?(<svg.*?</svg>).*</div>', re.S)
_NAMESPACE = 'xmlns="http://www.w3.org/2000/svg"'
_PAPER = '<rect width="100%" height="100%" fill="#fefefe"/>'  # in a dark notebook, too


class Markup(HTML):
    """Markup with its style sheet; `words` stand for it where only plain text is shown."""

    def __init__(self, markup, words):
        super().__init__(with_style_sheet(markup))
        self.words = words

    def __repr__(self):
        return self.words


def still(alt, parts, name):
    """The pictures of a demo for readers without a kernel; where the demo `name` lives, hidden.

    `parts` are as of `pictures`, `alt` describes them. Plots become images: they share no
    identifiers with the demo's own, and remain where a notebook is not trusted, its SVG removed.
    The output that follows is hidden until the demo lives in it: JupyterLab's "model not found".
    """
    child = ".jp-OutputArea-child"
    parts = [_as_images(part) if isinstance(part, str) else part for part in parts]
    return Markup(
        f"<style>:root:has(#{name}) #{name}-still, {child}:has(#{name}-still) + "
        f"{child}:not(:has(#{name})) {{ display: none; }}</style>"
        f'<figure class="vmc-demo vmc-still" id="{name}-still">{side_by_side(parts, alt)}'
        "<figcaption>Run > Run All Cells to make it move. If it stays still: "
        "<code>pip install anywidget</code> where JupyterLab is installed.</figcaption></figure>",
        alt,
    )


def _as_images(markup):
    """The markup with each SVG in it as an `<img>`; a table of numbers stays one."""
    drawn = re.sub(r"<svg.*?</svg>", _as_image, _PANELS.sub(r"\1", markup), flags=re.S)
    return type(markup)(drawn)


def _as_image(svg):
    root, drawing = svg[0].split(">", 1)
    root = root if _NAMESPACE in root else root.replace("<svg", f"<svg {_NAMESPACE}", 1)
    data = quote(f"{root}>{_PAPER}{drawing}", safe=" !$'()*+,-./:;=?@[]^_`{|}~")
    return f'<img alt="" src="data:image/svg+xml,{data}">'
