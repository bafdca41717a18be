"""The checksums of the files in `vmc_lib.data`; the library checks them when it reads a file.

`python -m reproduce.pipeline.checksums` writes them anew; the steps do so by themselves.
"""

import json

from reproduce.pipeline.imports import DATA_SUFFIXES
from vmc_lib import data


def data_checksums():
    """The checksum of every file that ships, by its place in the folder."""
    files = sorted(file for file in data.FOLDER.rglob("*") if file.suffix in DATA_SUFFIXES)
    return {
        file.relative_to(data.FOLDER).as_posix(): data.checksum(file.read_bytes())
        for file in files
        if file != data.CHECKSUMS
    }


def write():
    """Write the checksums into `data.CHECKSUMS`."""
    data.CHECKSUMS.write_text(
        json.dumps(data_checksums(), indent=0) + "\n", encoding="utf-8", newline="\n"
    )


if __name__ == "__main__":  # pragma: no cover: the tests call `data_checksums`
    write()
