"""The project on another system: line ends, encodings, and where a reader may put it."""

import ast
import json
import re
import shutil
import sys
import sysconfig
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from jupyterlab.labapp import LabApp

from tests.project import NOTEBOOKS, ROOT, code, python, run

SCHEMAS = Path(sysconfig.get_path("data")) / "share/jupyter/lab/schemas"
AWKWARD = "a b&c#d+ü"  # a folder of a name that is lawful everywhere
OURS = [room.name for room in ROOT.glob("[a-z]*") if [*room.rglob("*.py")]]
LOAD = """
from vmc_lib import photos
levels = {*photos.EVERY_LEVEL, photos.SHEET_LEVEL}
levels = {level for level in levels for split in photos.SPLITS
          if (photos.FOLDER / level / split).exists() and photos.load(level, split)[0].image.any()}
print(photos.FOLDER, *sorted(levels), sep="\\n")"""


# ---------------------------------------------------------------- line ends, and names


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A clone as Git makes it on Windows, where it turns line ends by default."""
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("NOT TESTED: this is no Git repository")
    folder = tmp_path_factory.mktemp("home") / AWKWARD
    windows = ["-c", "core.autocrlf=true", "-c", "core.eol=crlf"]
    run("git", "clone", "--quiet", "--shared", *windows, ROOT, folder, cwd=ROOT)
    return folder


def test_clone_with_crlf_loads_every_level(clone):
    folder, *levels = python("-c", LOAD, cwd=clone).splitlines()
    assert Path(folder).is_relative_to(clone)
    assert levels == ["free", "real", "rig", "sheet", "varied"]


def test_clone_with_crlf_matches_the_vendor_manifest(clone):
    python("tools/vendor.py", "--check", cwd=clone)


def test_the_programs_run_in_a_folder_of_an_awkward_name(clone):
    assert "templates.npz" in python("-m", "reproduce", "--list", cwd=clone)


def test_every_file_can_lie_on_a_disk_of_windows():
    files = run("git", "ls-files", "-z").split("\0") if (ROOT / ".git").exists() else []
    if not files:
        pytest.skip("NOT TESTED: this is no Git repository")
    refused = r'[<>:"\\|?*]|[. ](/|$)|(^|/)(con|aux|nul|prn|com\d|lpt\d)(\.|/|$)'
    assert [name for name in files if re.search(refused, name, re.I) or len(name) > 120] == []
    assert len({name.casefold() for name in files}) == len(files)


def test_make_prints_the_address_of_the_book(tmp_path):
    home = tmp_path / AWKWARD
    (home / ".venv/bin").mkdir(parents=True)
    (home / ".venv/bin/python").symlink_to(sys.executable)
    shutil.copy(ROOT / "Makefile", home)
    built = run(
        "make",
        "--no-print-directory",
        "--old-file=_build/.built",
        "book",
        cwd=home,
        DISPLAY="",
        WAYLAND_DISPLAY="",
    )
    address = urlsplit(built.split()[-1])
    assert Path(url2pathname(address.path)) == home / "_build/html/index.html"


# ---------------------------------------------------------------- encodings


def lacking(keyword, source, names="read_text write_text run"):
    """Calls that read or write text without an argument; ruff's PLW1514 sees but plain paths."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and getattr(node.func, "attr", None) in names.split():
            options = {each.arg: ast.unparse(each.value) for each in node.keywords}
            if keyword not in options and (node.func.attr != "run" or "text" in options):
                yield ast.unparse(node)


def test_every_text_names_its_encoding():
    files = [file for part in OURS for file in (ROOT / part).rglob("*.py")]
    assert len(files) > 200
    calls = [call for path in (*files, *NOTEBOOKS) for call in lacking("encoding", code(path))]
    assert calls == []


@pytest.mark.parametrize("room", ["render", "reproduce", "tools"])
def test_generated_files_have_fixed_line_ends(room):
    codes = [code(path) for path in (ROOT / room).rglob("*.py")]
    assert any("write_text(" in text for text in codes)
    assert [call for text in codes for call in lacking("newline", text, "write_text")] == []


# ---------------------------------------------------------------- JupyterLab


def test_jupyterlab_finds_the_layout_of_make_lab_by_its_name(tmp_path):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    name = re.search("default_url=/lab/workspaces/(.*)", makefile)[1]
    shutil.copy(
        ROOT / ".binder/workspace.json", tmp_path / re.search("LAYOUT .*/(.*)", makefile)[1]
    )
    export = ["-m", "jupyterlab", "workspaces", "export", name]
    layout = json.loads(python(*export, JUPYTERLAB_WORKSPACES_DIR=tmp_path))
    assert "notebook:book/01_loop.ipynb" in layout["data"]


def test_jupyterlab_knows_our_settings():
    for plugin, settings in json.loads((ROOT / ".binder/overrides.json").read_bytes()).items():
        package, name = plugin.split(":")
        properties = json.loads((SCHEMAS / package / f"{name}.json").read_bytes())["properties"]
        assert settings.keys() <= properties.keys()
    classes = {each.__name__: each for each in LabApp.serverapp_class.classes}
    options = json.loads((ROOT / ".binder/jupyter_server_config.json").read_bytes())
    for name, traits in options.items():
        assert traits.keys() <= {*classes[name].class_trait_names()}
