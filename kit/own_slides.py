"""A lecturer's own slides: Markdown that is put into the decks after the figures it names.

A file `session-3.md` of the folder holds, for that deck:

    after: Figure 7.1

    ## My own slide

    Its text. A line of three dashes begins the next one.

    Note: what only the speaker sees
"""

import re
from pathlib import Path

from book._ext.numbering import FIGURE_NUMBER
from kit.chapter_slides import Slide
from kit.page import html

FOLDER = Path(__file__).parent / "own"  # of the lecturer: nothing writes there
PLACE = re.compile(r"^after: Figure ([\d.]+)$", re.M)
NOTE = re.compile(r"^Note: ", re.M)


def own_slides(text):
    """The slides of a file, {number of the figure that they follow: [Slide]}.

    ValueError where a slide stands before the first figure is named.
    """
    before, *parts = PLACE.split(text)
    if before.strip():
        raise ValueError(
            f"{before.strip()[:50]!r} stands after no figure: begin with a line such as "
            "'after: Figure 7.1'"
        )
    slides = {}
    for figure, part in zip(parts[::2], parts[1::2], strict=True):
        pieces = [NOTE.split(piece, 1) for piece in re.split(r"^---$", part, flags=re.M)]
        slides.setdefault(figure, []).extend(
            Slide([html(body)], [html(note) for note in notes]) for body, *notes in pieces
        )
    return slides


def put_in(deck, own):
    """Put own slides into a deck, {part: [Slide]}, behind the slides that show their figures.

    ValueError where the deck shows a figure nowhere.
    """
    left, figures = dict(own), []
    for part, slides in deck.items():
        deck[part] = []
        for slide in slides:
            shown = FIGURE_NUMBER.findall(str(slide.body))
            figures += shown
            deck[part] += [slide, *(mine for figure in shown for mine in left.pop(figure, ()))]
    if left:
        raise ValueError(
            f"no slide shows Figure {next(iter(left))}: put yours after one of {', '.join(figures)}"
        )
