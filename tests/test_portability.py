"""The project on another system: line ends, encodings, and where a reader may put it."""

import ast
import json
import os
import re
import shutil
import sys
import sysconfig
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from tests.project import CHAPTERS, NOTEBOOKS, ROOT, code, python, run

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


@pytest.mark.audit
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


# ---------------------------------------------------------------- make, beside a reader's own files

NAMES = [
    "07_muscle (1).ipynb",
    "Untitled Folder/a.ipynb",
    "a: b.md",
    "$(x)#%\\.py",
    "two\nlines.md",
]


@pytest.fixture
def home(tmp_path):
    """A set-up project, built an hour ago and of the same age, with copies of odd names in it."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    asked = {*re.findall(r"\w+\.(?:txt|toml|yml)", (ROOT / "Makefile").read_text(encoding="utf-8"))}
    layout = ".venv/share/jupyter/lab/workspaces/book-9271.jupyterlab-workspace"
    made = (
        ".venv/.ready",
        ".bench/.ready",
        "_build/.built",
        "tools/bench/requirements.txt",
        layout,
    )
    files = [tmp_path / name for name in (*asked, *made, *(f"book/{name}" for name in NAMES))]
    for file in files:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
        os.utime(file, (10**9, 10**9))
    return tmp_path


COMMANDS = {  # what a target does in a project that is built
    "book": "The book is at",
    "test": ".venv/bin/pytest -n auto",
    "lab": ".venv/bin/jupyter lab",
    "kit": ".venv/bin/python -m kit\n",
    "pdf": ".venv/bin/python -m kit.pdf\n",
    "data": ".venv/bin/python -m reproduce\n",
    "bench": ".bench/bin/python -m tools.bench.$name",
    "lock": "uv pip compile",
    "clean": "rm -rf _build\n",
}


@pytest.mark.parametrize("target", COMMANDS)
def test_no_readers_file_stops_make(home, target):
    assert COMMANDS[target] in run("make", "--dry-run", target, cwd=home)


@pytest.mark.parametrize("name", NAMES)
def test_a_file_of_any_name_that_is_saved_builds_the_book_again(home, name):
    assert "jupyter-book" not in run("make", "--dry-run", "book", cwd=home)
    (home / "book" / name).touch()
    assert "jupyter-book build" in run("make", "--dry-run", "book", cwd=home)


def test_make_installs_into_the_environment_whatever_pip_is_told(home):
    (home / "show.mk").write_text("show: ; @echo PIP_USER=$$PIP_USER", encoding="utf-8")
    assert "PIP_USER=0\n" in run(
        "make", "-f", "Makefile", "-f", "show.mk", "show", cwd=home, PIP_USER="1"
    )


@pytest.mark.parametrize(
    ("uv", "install"),
    [("", ".venv/bin/pip install"), ("uv", "uv pip install --python .venv/bin/python")],
)
def test_make_installs_what_is_locked_with_uv_or_without(home, uv, install):
    (home / "pyproject.toml").touch()
    printed = run("make", "--dry-run", f"UV={uv}", ".venv/.ready", cwd=home).splitlines()
    locked, rest = (line for line in printed if line.startswith(install))
    assert locked.endswith("--require-hashes -r constraints.txt")
    assert rest.endswith("-r requirements.txt -e .")


def test_the_lock_leaves_out_torch_and_what_it_brings(home):
    *_, edit = run("make", "--no-print-directory", "--dry-run", "lock", cwd=home).splitlines()
    block = "{}==1 \\\n    --hash=sha256:a \\\n    --hash=sha256:b\n".format
    names = ["numpy", "nvidia-a", "nvidia-b", "setuptools", "cuda-c", "torch", "triton", "zipp"]
    (home / "constraints.txt").write_text("".join(map(block, names)), encoding="utf-8")
    run("sh", "-c", edit, cwd=home)
    left = (home / "constraints.txt").read_text(encoding="utf-8")
    assert left == "".join(map(block, ["numpy", "setuptools", "zipp"]))
    assert "\\|" not in edit  # which POSIX's sed does not know, nor that of macOS


def test_a_copied_chapter_is_none_of_the_books(clone):
    (clone / "book/07_muscle (1).ipynb").touch()
    script = "from kit.__main__ import CHAPTERS\nprint(*CHAPTERS, sep='\\n')"
    chapters = [Path(line) for line in python("-c", script, cwd=clone).splitlines()]
    assert [chapter.parent for chapter in chapters] == len(chapters) * [clone / "book"]
    assert [chapter.name for chapter in chapters] == [path.name for path in CHAPTERS]


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


@pytest.mark.parametrize("room", ["reproduce", "tools"])
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
    export = ["-m", "jupyterlab", "workspaces", "export", f"/{name}"]
    layout = json.loads(python(*export, JUPYTERLAB_WORKSPACES_DIR=tmp_path))
    assert "notebook:book/01_loop.ipynb" in layout["data"]


def test_jupyterlab_knows_our_settings():
    for plugin, settings in json.loads((ROOT / ".binder/overrides.json").read_bytes()).items():
        package, name = plugin.split(":")
        properties = json.loads((SCHEMAS / package / f"{name}.json").read_bytes())["properties"]
        assert settings.keys() <= properties.keys()
    from jupyterlab.labapp import LabApp  # which starts Node

    classes = {each.__name__: each for each in LabApp.serverapp_class.classes}
    options = json.loads((ROOT / ".binder/jupyter_server_config.json").read_bytes())
    for name, traits in options.items():
        assert traits.keys() <= {*classes[name].class_trait_names()}
