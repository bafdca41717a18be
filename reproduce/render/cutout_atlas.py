"""Atlas of rendered shuttlecock cut-outs (`render.cutouts`), to paste on photographs."""

import io
from functools import cache

import numpy as np
from PIL import Image

from vmc_lib import data

FILE, WIDTH, COLUMNS = data.FOLDER / "cutouts.webp", 128, 20


def store(cutouts, file=FILE):
    """Write cut-outs (n, WIDTH, WIDTH, 4) uint8 RGBA as one image; n is a multiple of COLUMNS."""
    rows = np.reshape(cutouts, (-1, COLUMNS, WIDTH, WIDTH, 4)).swapaxes(1, 2)
    sheet = rows.reshape(-1, COLUMNS * WIDTH, 4)
    Image.fromarray(sheet).save(file, quality=80, alpha_quality=80, method=6)


@cache
def load(file=FILE):
    """Read the cut-outs that `store` has written: (n, WIDTH, WIDTH, 4) uint8 RGBA."""
    sheet = np.array(Image.open(io.BytesIO(data.read(file))))
    rows = sheet.reshape(-1, WIDTH, COLUMNS, WIDTH, 4).swapaxes(1, 2)
    return data.read_only(rows.reshape(-1, WIDTH, WIDTH, 4))
