"""The printed sheet, a page of each paper, for readers to print: python -m tools.sheet."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from vmc_lib.camera import TABLE
from vmc_lib.marker_sheet import AXES, FIRST, GAP, GRID, MARKER, PAPERS, page_image

STATIC = Path(__file__).parents[1] / "book/_static"
FILES = {"A4": STATIC / "sheet.pdf", "Letter": STATIC / "sheet-letter.pdf"}


def draw(paper):
    """The page of a paper as a figure."""
    (wide, high), margin = PAPERS[paper]
    ahead, _, left = 100 * (FIRST - np.array(margin) / 1000 @ AXES[:2])
    lowest = margin[1] + GRID[1] * (MARKER + GAP) - GAP  # mm from the upper edge, of the markers
    lines = [
        "Print at 100 %: this line is 100 mm long. Lay the sheet flat, and what is to be",
        "reached for to its left. The arm’s shoulder is "
        f"{left:.0f} cm left of this sheet’s left edge,",
        f"{ahead - high / 10:.0f} cm nearer to you than its lower edge, and {-100 * TABLE:.0f} cm "
        "above the table.",
    ]
    room = high - lowest
    words = {margin[1] / 2: "↑  away from you"}
    words |= {lowest + (0.54 + 0.143 * k) * room: line for k, line in enumerate(lines)}
    figure = plt.figure(figsize=(wide / 25.4, high / 25.4))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.imshow(page_image(paper), "gray", extent=(0, wide, high, 0), interpolation="none")
    axes.axis("off")
    line = lowest + 0.34 * room
    axes.plot([wide / 2 - 50, wide / 2 + 50], [line, line], "|-", color="black", lw=0.5)
    for y, text in words.items():
        axes.text(wide / 2, y, text, ha="center", va="center", fontsize=10)
    return figure


if __name__ == "__main__":
    for paper, place in FILES.items():
        metadata = {"CreationDate": None, "Title": f"A sheet of markers, {paper}"}
        draw(paper).savefig(place, metadata=metadata)
