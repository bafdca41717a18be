"""The project as its tests use it: where it is, its notebooks, and how its programs are run."""

import os
import socket
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from book.figures.inventory import core, reading_and_demos

ROOT = Path(__file__).parents[1]
NOTEBOOKS = sorted((ROOT / "book").glob("*.ipynb"))
CHAPTERS = [path for path in NOTEBOOKS if path.stem[:2].isdigit()]
each_chapter = pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)


def sample(cases, *kept):
    """The cases of a test, of which all but some, by name, wait for the audit (`make audit`)."""
    name = lambda case: getattr(case, "stem", getattr(case, "name", case))  # noqa: E731
    named, audit = {name(c): c for c in cases}, pytest.mark.audit
    assert not named or {*kept} <= {*named}, f"no case { ({*kept} - {*named}) }"
    return [c if n in kept else pytest.param(c, marks=audit, id=f"{n}") for n, c in named.items()]


def code_cells(path):
    """The cells of a notebook that hold code."""
    return [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]


def code(path):
    """The code of a module, or of a notebook's cells."""
    if path.suffix == ".py":
        return path.read_text(encoding="utf-8")
    return "\n".join(cell.source for cell in code_cells(path))


def run(*command, cwd=ROOT, **environment):
    """What a program prints, of the project in a folder; AssertionError where it fails."""
    variables = os.environ | {"PYTHONPATH": str(cwd), "PYTHONIOENCODING": "utf-8"} | environment
    done = subprocess.run(command, cwd=cwd, env=variables, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def listens(port):
    """Whether a program of this machine listens at a port."""
    with socket.socket() as knock:
        return knock.connect_ex(("127.0.0.1", port)) == 0


def python(*arguments, **options):
    """What Python prints (see `run`)."""
    return run(sys.executable, *arguments, **options)


def core_minutes(path):
    """How long a chapter's core takes to read and play, estimated."""
    return sum(reading_and_demos(core(nbformat.read(path, as_version=4).cells)))
