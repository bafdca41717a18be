"""One script holds the engine, unchanged but for what is left out, and the library."""

import _imp
import base64
import gzip
import hashlib
import io
import json
import re
import zipfile

from python_in_page import pack
from tests.project import ROOT


def opened(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist() if name[-1] != "/"}


def test_numpy_is_the_file_that_pyodide_names():
    lock = json.loads((pack.VENDOR / "pyodide-lock.json").read_bytes())
    numpy = lock["packages"]["numpy"]
    wheel = (pack.VENDOR / numpy["file_name"]).read_bytes()
    assert hashlib.sha256(wheel).hexdigest() == numpy["sha256"]


def test_the_script_holds_what_is_vendored_and_the_library(packed):
    files = json.loads(packed[packed.index("{") : packed.rindex("}") + 1])
    files = {name: gzip.decompress(base64.b64decode(text)) for name, text in files.items()}
    for name in pack.UNCHANGED:
        assert files[name] == (pack.VENDOR / name).read_bytes()
    library = opened(files["library.zip"])
    assert library == {p.as_posix(): (ROOT / p).read_bytes() for p in pack.paths()}
    compiled = opened((pack.VENDOR / "compiled.zip").read_bytes())
    for name in ("python_stdlib.zip", next(name for name in files if name.endswith(".whl"))):
        inside, whole = opened(files[name]), opened((pack.VENDOR / name).read_bytes())
        assert inside.items() <= (whole | compiled).items()
        left_out = {one for one in whole if not {one, f"{one}c"} & inside.keys()}
        assert not [one for one in left_out if "LICENSE" in one or one.endswith(".so")]


MAGIC = b"\xcb\r\r\n"  # of Python 3.12, the page's


def test_what_is_compiled_was_made_of_the_vendored_sources():
    """The header of each compiled module bears its source's hash."""
    names = ("python_stdlib.zip", *(path.name for path in pack.VENDOR.glob("*.whl")))
    whole = {k: v for name in names for k, v in opened((pack.VENDOR / name).read_bytes()).items()}
    compiled = opened((pack.VENDOR / "compiled.zip").read_bytes())
    assert len(compiled) > 200
    for name, data in compiled.items():
        summed = _imp.source_hash(int.from_bytes(MAGIC, "little"), whole[name.removesuffix("c")])
        assert data[:16] == MAGIC + b"\1\0\0\0" + summed


def test_the_page_tells_the_scripts_size(packed):
    size = len(packed.encode())
    assert size <= 12e6
    told = (ROOT / "python_in_page/static/interpreter.js").read_text(encoding="utf-8")
    assert re.search('SIZE = "(.*) MB"', told)[1] == f"{size / 1e6:.0f}"
