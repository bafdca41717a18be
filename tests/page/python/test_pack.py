"""One script holds the engine, unchanged but for what is left out, and the library."""

import _imp
import hashlib
import io
import json
import re
import zipfile

import pytest

from page.python import pack
from tests.project import ROOT
from vmc_lib.show.packed import unpack_bytes


def opened(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist() if name[-1] != "/"}


WHEELS = {path.name: path.read_bytes() for path in pack.VENDOR.glob("*.whl")}


def unpacked(script):
    """The files that a script holds: {name: bytes}."""
    packed = json.loads(script[script.index(', {"') + 2 : script.rindex(")")])
    return {name: unpack_bytes(text) for name, text in packed.items()}


def compiled():
    names = ("compiled.zip", "compiled-plots.zip")
    both = [opened((pack.VENDOR / name).read_bytes()) for name in names]
    return both[0] | both[1]


def test_wheels_are_the_files_that_pyodide_names():
    lock = json.loads((pack.VENDOR / "pyodide-lock.json").read_bytes())["packages"].values()
    names = {hashlib.sha256(wheel).hexdigest(): name for name, wheel in WHEELS.items()}
    assert {x["sha256"]: x["file_name"] for x in lock if x["file_name"] in WHEELS} == names


def test_the_script_of_plots_holds_what_is_vendored_with_its_licences_and_the_library(packed):
    files = unpacked(packed[pack.PLOTS])
    figures, plots = opened(files["figures.zip"]), opened(files["plots.zip"])
    assert figures == {p.as_posix(): (ROOT / p).read_bytes() for p in pack.drawn_paths()}
    whole = {
        k: v
        for name, wheel in WHEELS.items()
        if "numpy" not in name
        for k, v in opened(wheel).items()
    }
    assert plots.items() <= (whole | compiled()).items()
    left_out = {one for one in whole if not {one, f"{one}c"} & plots.keys()}
    assert not [one for one in left_out if "LICENSE" in one]


def test_the_script_holds_what_is_vendored_and_the_library(packed):
    files = unpacked(packed[pack.SCRIPT])
    for name in pack.UNCHANGED:
        assert files[name] == (pack.VENDOR / name).read_bytes()
    library = opened(files["library.zip"])
    assert library == {p.as_posix(): (ROOT / p).read_bytes() for p in pack.paths()}
    for name in ("python_stdlib.zip", next(name for name in files if name.endswith(".whl"))):
        inside, whole = opened(files[name]), opened((pack.VENDOR / name).read_bytes())
        assert inside.items() <= (whole | compiled()).items()
        left_out = {one for one in whole if not {one, f"{one}c"} & inside.keys()}
        left_out = [one for one in left_out if not re.search(r"_tests\.|_simd|lapack_lite\.", one)]
        assert not [one for one in left_out if "LICENSE" in one or one.endswith(".so")]


MAGIC = b"\xcb\r\r\n"  # of Python 3.12, the page's


def test_what_is_compiled_was_made_of_the_vendored_sources():
    """The header of each compiled module bears its source's hash."""
    names = ("python_stdlib.zip", *(path.name for path in pack.VENDOR.glob("*.whl")))
    whole = {k: v for name in names for k, v in opened((pack.VENDOR / name).read_bytes()).items()}
    assert len(compiled()) > 300
    for name, data in compiled().items():
        summed = _imp.source_hash(int.from_bytes(MAGIC, "little"), whole[name.removesuffix("c")])
        assert data[:16] == MAGIC + b"\1\0\0\0" + summed


@pytest.mark.parametrize(("script", "most"), [(pack.SCRIPT, 12e6), (pack.PLOTS, 14e6)])
def test_the_page_tells_a_scripts_size(packed, script, most):
    size = len(packed[script].encode())
    assert size <= most
    interpreter = (ROOT / "page/python/interpreter.js").read_text(encoding="utf-8")
    name = script.split("/")[1]
    assert re.search(f'"{name}": "(.*?) MB"', interpreter)[1] == f"{size / 1e6:.0f}"
