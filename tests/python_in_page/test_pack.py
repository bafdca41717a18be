"""One script holds the engine, unchanged but for what is left out, and the library."""

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


def test_the_script_holds_the_vendored_files_unchanged(packed):
    files = json.loads(packed[packed.index("{") : packed.rindex("}") + 1])
    files = {name: gzip.decompress(base64.b64decode(text)) for name, text in files.items()}
    for name in ("pyodide.js", "pyodide.asm.js", "pyodide.asm.wasm"):
        assert files[name] == (pack.VENDOR / name).read_bytes()
    for name in (name for name in files if name.endswith((".zip", ".whl"))):
        inside = opened(files[name])
        if name == "library.zip":
            assert inside == {p.as_posix(): (ROOT / p).read_bytes() for p in pack.paths()}
            continue
        whole = opened((pack.VENDOR / name).read_bytes())
        assert inside.items() <= whole.items()
        left_out = whole.keys() - inside.keys()
        assert not [one for one in left_out if "LICENSE" in one or one.endswith(".so")]


def test_the_page_tells_the_scripts_size(packed):
    size = len(packed.encode())
    assert size <= 12e6
    told = (ROOT / "python_in_page/static/interpreter.js").read_text(encoding="utf-8")
    assert re.search('SIZE = "(.*) MB"', told)[1] == f"{size / 1e6:.1f}"
