"""The printed sheet as a page of A4, for readers to print: python tools/sheet.py."""

from pathlib import Path

import matplotlib.pyplot as plt

from vmc_lib.camera import TABLE
from vmc_lib.marker_sheet import CORNER, PAGE, page_image

wide, high = PAGE
ahead, _, left = 100 * CORNER
WORDS = {  # from the page's upper edge, in mm
    17: "↑  away from you",
    281: "Print at 100 %: this line is 100 mm long. Lay the sheet flat, and what is to be",
    286: "reached for to its left. The arm’s shoulder is "
    f"{left:.0f} cm left of this sheet’s left edge,",
    291: f"{ahead - high / 10:.0f} cm nearer to you than its lower edge, and {-100 * TABLE:.0f} cm "
    "above the table.",
}

figure = plt.figure(figsize=(wide / 25.4, high / 25.4))
axes = figure.add_axes((0, 0, 1, 1))
axes.imshow(page_image(), "gray", extent=(0, wide, high, 0), interpolation="none")
axes.axis("off")
axes.plot([wide / 2 - 50, wide / 2 + 50], [274, 274], "|-", color="black", lw=0.5)
for y, words in WORDS.items():
    axes.text(wide / 2, y, words, ha="center", va="center", fontsize=10)
place = Path(__file__).parents[1] / "book/_static/sheet.pdf"
figure.savefig(place, metadata={"CreationDate": None, "Title": "A sheet of markers"})
