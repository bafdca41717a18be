"""What a reader meets on the main line of a built chapter, counted: `python -m tools.main_line`."""

import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from bs4 import BeautifulSoup

BUILT = Path(__file__).parents[1] / "_build/html/book"
FOLDED = "details > :not(summary), details.hide, .solution, .tag_solution"
ASIDE = f".vmc-optional > :not(h2, h3), .vmc-more, {FOLDED}"
UNREAD = "pre, svg, script, style, .math, .vmc-spoken, .vmc-scene, .vmc-numbers-of, a.headerlink"
RADIOS = "fieldset.vmc-control, .vmc-control:has(> select)"
SLIDERS = ".vmc-control:has(> input[type=range]):not(.vmc-pad *, .vmc-turn, .vmc-clock)"
CONTROLS = f".vmc-pad, {RADIOS}, {SLIDERS}, .vmc-options > label:has([type=checkbox])"


@dataclass
class Figure:
    """A figure of the main line: the words of its caption, and how many controls it shows."""

    name: str
    caption: int
    controls: int


@dataclass
class MainLine:
    """A chapter's main line: its words, its figures in order, and how many predictions it asks."""

    words: int
    predictions: int
    figures: list[Figure] = field(default_factory=list)

    @property
    def controls(self):
        """The numbers of controls, figure by figure; those that have none are left out."""
        return [figure.controls for figure in self.figures if figure.controls]


@cache
def main_line(path):
    """The `MainLine` of a built page: what is folded, code, formulas and pictures left out.

    A pad is one control; what lies behind "more" is none.
    """
    page = article(path)
    figures = [
        Figure(one.get("id", ""), words_of(one.select_one("figcaption")), len(one.select(CONTROLS)))
        for one in page.select(".vmc-demo, .vmc-live:not(.vmc-demo *)")
    ]
    predictions = len(page.select(".vmc-predict"))
    return MainLine(words_of(page), predictions, figures)


def article(path):
    """A built page's article, without its pictures, which are long, and what is folded."""
    html = re.sub("<svg.*?</svg>", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    page = BeautifulSoup(html, "html.parser").select_one("article")
    for part in page.select(ASIDE):
        part.decompose()
    return page


def words_of(part):
    """How many words a part of an `article` has to read; 0 for None."""
    if part is None:
        return 0
    for unread in part.select(UNREAD):
        unread.extract()
    return sum(any(map(str.isalnum, word)) for word in part.get_text(" ").split())


if __name__ == "__main__":
    total = 0
    for path in sorted(BUILT.glob("[01]*.html")):
        line = main_line(path)
        total += line.words
        captions = [figure.caption for figure in line.figures]
        print(
            f"{path.stem:18} {line.words:5} words, {line.predictions} predictions, "
            f"controls {line.controls}, captions {captions}"
        )
    print(f"{total} words")
