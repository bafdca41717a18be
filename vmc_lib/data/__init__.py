"""What ships beside the code: photos, trained weights, measurements.

CONTRIBUTING.md names the command that remakes each.
"""

from functools import cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent


@cache
def arrays(name):
    """The arrays of the data file `name`.npz, by name; the file is read only once.

    FileNotFoundError when nothing of that name ships.
    """
    with np.load(FOLDER / f"{name}.npz", allow_pickle=False) as file:
        return dict(file)
