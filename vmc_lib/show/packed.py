"""Data packed: bytes, JSON and arrays as text that a page can hold; files as a zip."""

import base64
import gzip
import io
import json
from collections.abc import Mapping
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np


def pack_bytes(data):
    """Bytes as gzip in base64, which the page's `unzip` unpacks."""
    return base64.b64encode(gzip.compress(data, mtime=0)).decode()


def unpack_bytes(text):
    """Bytes that `pack_bytes` packed."""
    return gzip.decompress(base64.b64decode(text))


def pack_json(data):
    """JSON as `pack_bytes` packs it."""
    return pack_bytes(json.dumps(data, separators=(",", ":")).encode())


def pack_zip(files, compression=ZIP_STORED):
    """Files {name: text or bytes} as the bytes of a zip; no clock enters: an entry says 1980."""
    archive = io.BytesIO()
    with ZipFile(archive, "w") as opened:
        for name, data in files.items():
            opened.writestr(ZipInfo(name), data, compression, compresslevel=1)
    return archive.getvalue()


def pack_arrays(arrays):
    """Arrays by name, or dictionaries of such, as text; no name has a "/"."""
    file = io.BytesIO()
    np.savez_compressed(file, **dict(_flat(arrays)))
    return base64.b64encode(file.getvalue()).decode()


def unpack_arrays(text):
    """What `pack_arrays` was given; "" holds nothing."""
    found = {}
    if text:
        with np.load(io.BytesIO(base64.b64decode(text)), allow_pickle=False) as file:
            for path in file.files:
                *folders, name = path.split("/")
                inside = found
                for folder in folders:
                    inside = inside.setdefault(folder, {})
                inside[name] = file[path]
    return found


def _flat(arrays, path=""):
    for name, value in arrays.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{path}{name}/")
        else:
            yield f"{path}{name}", value
