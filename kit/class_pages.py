"""Pages for a class without a server: throws with a turned pointer, and what all have answered."""

import json
import re
from pathlib import Path

import numpy as np

from book._ext.policy import seal
from vmc_lib.cerebellum import two_rates

PAGES = Path(__file__).parent / "pages"
RECORD = Path(__file__).parents[1] / "page/book/record.js"  # saves what the class's page reads
BLOCKS = (10, 0), (30, 30), (15, 0)  # throws, and by how many degrees they are turned


def throws_page():
    """The page on which a class throws with a turned pointer, with the model's curve in it."""
    page = (PAGES / "throws.html").read_text(encoding="utf-8")
    page = page.replace("/*BLOCKS*/[]", json.dumps(BLOCKS))
    return seal(page.replace("/*MODEL*/[]", json.dumps(throws().round(4).tolist())))


def throws():
    """What two memories leave of a shift, as a share of it, throw by throw of the blocks (55,)."""
    counts, degrees = np.transpose(BLOCKS)
    turned = np.repeat(degrees / degrees.max(), counts)
    return turned - two_rates.adapt(turned).sum(axis=1)


def class_page():
    """The page that joins what a class has answered, with the limits by which answers are kept."""
    page = (PAGES / "class.html").read_text(encoding="utf-8")
    record = RECORD.read_text(encoding="utf-8")
    page = page.replace("/*MOST*/0", re.search(r"\bMOST = (\d+)", record)[1])
    return seal(page.replace("/*TEXTS*/[]", re.search(r"\bTEXTS = (\[.+?\])", record)[1]))
