"""Data that ships beside the code: photos, and trained models as arrays.

`python -m reproduce --list` names the step that remakes each.
"""

import hashlib
import io
import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from zipfile import BadZipFile
from zlib import error as ZlibError

import numpy as np

FOLDER = Path(__file__).parent
CHECKSUMS = FOLDER / "checksums.json"


class DamagedFile(ValueError):
    """A file that ships and cannot be used: which it is, why, and what mends it."""

    def __init__(self, path, why):
        super().__init__(f"{path} is damaged: {why}. {_remedy(path)}")


@cache
def arrays(name: str, folder: Path = FOLDER) -> Mapping[str, np.ndarray]:
    """The arrays of the data file `name`.npz, by name; read once, shared, and so read-only.

    FileNotFoundError when nothing of that name ships, `DamagedFile` when the file is damaged.
    """
    path = Path(folder) / f"{name}.npz"
    try:
        with np.load(io.BytesIO(read(path)), allow_pickle=False) as file:
            return MappingProxyType({part: read_only(array) for part, array in file.items()})
    except (BadZipFile, EOFError, OSError, ZlibError) as error:
        if isinstance(error, FileNotFoundError):
            raise
        raise DamagedFile(path, error) from None


def read_only(array: np.ndarray) -> np.ndarray:
    """Make an array read-only, in place: what is cached is shared by all."""
    array.flags.writeable = False
    return array


def read(path: Path) -> bytes:
    """The bytes of a file that ships.

    FileNotFoundError where it is missing, `DamagedFile` where it is not the one that shipped.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{path} is missing. {_remedy(path)}")
    content, shipped = path.read_bytes(), _checksums().get(path)
    if shipped and shipped != checksum(content):
        raise DamagedFile(path, "it is cut, changed or swapped")
    return content


def checksum(content: bytes) -> str:
    """The first 16 digits of the SHA-256 of bytes."""
    return hashlib.sha256(content).hexdigest()[:16]


def _remedy(path):
    return (
        f"Restore it (git checkout -- {path}), or remake it: python -m reproduce --list names the "
        "step. If it is your own and meant to be so: python -m reproduce.pipeline.checksums"
    )


@cache
def _checksums():
    if not CHECKSUMS.is_file():
        return {}
    return {FOLDER / name: sums for name, sums in json.loads(CHECKSUMS.read_bytes()).items()}
