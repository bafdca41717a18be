"""What ships beside the code: photos, and what training has learnt, as arrays.

`python -m reproduce --list` names the step that remakes each.
"""

from functools import cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent


@cache
def arrays(name, folder=FOLDER):
    """The arrays of the data file `name`.npz, by name; read once, shared, and so read-only.

    FileNotFoundError when nothing of that name ships.
    """
    with np.load(Path(folder) / f"{name}.npz", allow_pickle=False) as file:
        return {part: read_only(array) for part, array in file.items()}


def read_only(array):
    """The same array, which refuses to be written to: what is cached is shared by all."""
    array.flags.writeable = False
    return array
