"""Atlases of rendered cut-outs (`render.cutouts`), to paste on photographs."""

import io
from functools import cache

import numpy as np
from PIL import Image

from vmc_lib import data

WIDTH, COLUMNS = 128, 20
FILES = {"shuttlecocks": data.FOLDER / "cutouts.webp", "decoys": data.FOLDER / "decoys.webp"}
UNTRAINED_COUNT = 80  # cut-outs of each, the last, not trained on: half validate, half test


def store(cutouts, kind):
    """Write the cut-outs (n, WIDTH, WIDTH, 4) uint8 RGBA of a kind of FILES as one image.

    n is a multiple of COLUMNS.
    """
    rows = np.reshape(cutouts, (-1, COLUMNS, WIDTH, WIDTH, 4)).swapaxes(1, 2)
    sheet = rows.reshape(-1, COLUMNS * WIDTH, 4)
    Image.fromarray(sheet).save(FILES[kind], quality=80, alpha_quality=80, method=6)


@cache
def load(kind):
    """Read the cut-outs of a kind of FILES, as `store` wrote them: (n, WIDTH, WIDTH, 4) uint8."""
    sheet = np.array(Image.open(io.BytesIO(data.read(FILES[kind]))))
    rows = sheet.reshape(-1, WIDTH, COLUMNS, WIDTH, 4).swapaxes(1, 2)
    return data.read_only(rows.reshape(-1, WIDTH, WIDTH, 4))
