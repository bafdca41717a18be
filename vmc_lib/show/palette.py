"""Named colours, on the page and on photos, and the style of every plot.

In the page each name is a CSS variable, so that light and dark pages both read well.
"""

import matplotlib.pyplot as plt


class Palette(dict):
    """Colours by name; ValueError for a name that none has."""

    def __missing__(self, name):
        raise ValueError(f"no colour is called {name!r}: choose from {', '.join(self)}")


COLOURS = Palette(
    blue="#1f63b4",
    orange="#b3560a",
    green="#1b7a4a",
    red="#c22f3a",
    purple="#7a4cb8",
    grey="#67707e",
    ink="#1c2430",
    line="#d3d8df",
    paper="#fefefe",
)
# On a photo the page's theme does not matter: bright strokes with a dark edge read everywhere.
ON_PHOTO = Palette(
    blue="#6cb6ff",
    orange="#ffa94d",
    green="#69e09a",
    red="#ff7b7b",
    purple="#d0aaff",
    grey="#c8ced6",
    ink="#ffffff",
)
LEGIBLE = 11  # px
EDGE = 'stroke="#10151c" stroke-width="6" stroke-linejoin="round"'


def css(name):
    """A named colour as CSS: the page's own, or else that of `COLOURS`."""
    return f"var(--vmc-{name}, {COLOURS[name]})"


def least_width(width, size):
    """CSS: the width (px) at which a picture's words are LEGIBLE: a phone scrolls it, no smaller.

    Drawn `width` wide, its words are of this size, in the same unit.
    """
    return f"--least: {LEGIBLE / size * width:.0f}px"


# One look for every plot of the book: what `explore` and `figure` draw, they draw with this.
STYLE = {
    "figure.figsize": (5.5, 3.2),
    "figure.constrained_layout.use": True,
    "font.size": 10,
    "axes.titlesize": 10,
    "axes.titley": 1.0,  # where it stands anyway: not sought anew at each draw
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    **{"xtick.bottom": False, "ytick.left": False},  # the grid's lines are ticks
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


def plot_style(**more):
    """A context in which plots have `STYLE`, and `more`, whatever a reader's own settings are."""
    return plt.style.context(["default", STYLE | more])
