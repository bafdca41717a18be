"""The library as a package: it declares what it imports, and its wheel is enough for a chapter."""

import ast
import re
import shutil
import sys
import sysconfig
import tomllib
from functools import partial
from importlib import metadata
from pathlib import Path

import nbformat
import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name as canonical

from tests.project import ROOT, code, python, run

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
OPTIONAL = PROJECT["optional-dependencies"] | PYPROJECT["dependency-groups"]
OURS = {"vmc_lib", "arm_in_page", "eye_in_page", "python_in_page", "reproduce", "render"}
OURS |= {"bench", "book", "kit", "tests", "tools"}
PINS = re.findall(
    r"^([\w.\[\]-]+)==([\w.]+)", (ROOT / "requirements.txt").read_text(encoding="utf-8"), flags=re.M
)


def declared(*extras):
    """The requirements of the core and some extras: name → versions."""
    lists = [PROJECT["dependencies"], *(OPTIONAL[e] for e in extras)]
    requirements = [Requirement(line) for lines in lists for line in lines]
    return {canonical(r.name): r.specifier for r in requirements if r.name != "vmc_lib"}


EVERYTHING = declared("book", "test", "cluster")


def imported(source):
    """Names of the packages that some code imports, but for Python's and ours."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        else:
            modules = [node.module] if isinstance(node, ast.ImportFrom) else []
        yield from {module.split(".")[0] for module in modules} - OURS - sys.stdlib_module_names


@pytest.mark.parametrize(
    ("patterns", "extras"),
    [
        ("vmc_lib/**/*.py *_in_page/**/*.py book/figures/*.py", ()),
        ("reproduce/**/*.py", ("derive",)),
        ("book/*.ipynb", ()),
        ("render/*.py", ("render",)),
        ("book/_ext/*.py kit/**/*.py tests/**/*.py tools/*.py", ("book", "test", "cluster")),
    ],
)
def test_imports_are_declared(patterns, extras):
    makers, names_declared = metadata.packages_distributions(), declared(*extras)
    files = [path for pattern in patterns.split() for path in ROOT.glob(pattern)]
    names = {name for path in files for name in imported(code(path))}
    assert names
    assert not {
        n for n in names if not {*map(canonical, makers.get(n, [n]))} & names_declared.keys()
    }


def test_pins_are_the_declared_packages():
    pinned = {canonical(name.split("[")[0]): version for name, version in PINS}
    assert pinned.keys() == EVERYTHING.keys()
    assert not {n for n, version in pinned.items() if version not in EVERYTHING[n]}


def locked():
    """The lock's lines, each with a checksum: name → requirement."""
    lock = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    assert "://" not in lock
    lines = re.findall(r"^(\w.*?) *\\\n +--hash=sha256:", lock, flags=re.M)
    assert len(lines) == len(re.findall(r"^\w", lock, flags=re.M))
    return {canonical(r.name): r for r in map(Requirement, lines)}


def test_the_lock_holds_every_pin_but_torch():
    locks = {(name, str(r.specifier)) for name, r in locked().items()}
    pinned = {(canonical(name.split("[")[0]), f"=={version}") for name, version in PINS}
    assert {name for name, _ in pinned - locks} == {"torch"}


def test_the_lock_names_every_extra():
    """Where it does not, pip 23 takes the extra's newest release, which the lock does not hold."""
    lock = locked()
    here = {name: r for name, r in lock.items() if not r.marker or r.marker.evaluate()}
    missing = {
        (name, requirement.name)
        for name, package in here.items()
        for requirement in map(Requirement, metadata.requires(name) or [])
        for extra in ("", *package.extras)
        if not requirement.marker or requirement.marker.evaluate({"extra": extra})
        if not requirement.extras <= lock.get(canonical(requirement.name), requirement).extras
    }
    assert len(here) > 100
    assert not missing


def test_a_reader_installs_no_tools():
    core = declared()
    assert len(core) <= 25
    assert all(core.values())
    pulled, waiting = set(), [*core]
    while waiting:
        if (name := waiting.pop()) not in pulled:
            pulled.add(name)
            requirements = (Requirement(line) for line in metadata.requires(name) or [])
            here = (r for r in requirements if not r.marker or r.marker.evaluate({"extra": ""}))
            waiting += (canonical(r.name) for r in here)
    assert not pulled & {"pytest", "playwright", "ruff", "sphinx", "jupyter-book", "dask"}


@pytest.fixture(scope="session")
def reader(tmp_path_factory):
    """A Python that has the wheel and what it needs, but neither the repository nor its paths."""
    folder = tmp_path_factory.mktemp("reader")
    unwanted = shutil.ignore_patterns(".*", "_build", "build", "__pycache__", "*.egg-info")
    shutil.copytree(ROOT, folder / "source", ignore=unwanted)
    wheel = "wheel --quiet --no-deps --no-build-isolation --wheel-dir".split()
    python("-m", "pip", *wheel, folder, folder / "source")
    shutil.rmtree(folder / "source")
    python("-m", "venv", "--without-pip", folder / "venv")
    (site,) = (folder / "venv").glob("**/site-packages")
    install = ["install", "--quiet", "--no-deps", "--target", site, *folder.glob("*.whl")]
    python("-m", "pip", *install)
    installed = sysconfig.get_path("purelib")  # its own .pth files rest
    (site / "others.pth").write_text(installed, encoding="utf-8")
    return folder / "venv/bin/python"


@pytest.fixture
def alone(reader, tmp_path):
    """A function that runs the reader's Python in an empty folder, and returns what it printed."""
    return partial(run, reader, cwd=tmp_path, PYTHONPATH="", VMC_RENDER_MODE="")


def test_the_wheel_holds_the_packages(alone):
    names = "vmc_lib arm_in_page eye_in_page reproduce render book.figures book.exercises"
    script = f"import {names.replace(' ', ', ')}; print(vmc_lib.__file__, *book.figures.__path__)"
    for path in alone("-c", script).split():
        assert "site-packages" in path
        assert not Path(path).is_relative_to(ROOT)


def test_a_readers_file_hides_no_package_that_readme_does_not_name(tmp_path):
    parts = PYPROJECT["tool"]["setuptools"]["packages"]["find"]["include"]
    names = {part.split(".")[0].rstrip("*") for part in parts}
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    [sentence] = re.findall(r"It brings the packages (.*?)\.\s", readme, re.S)
    assert {*re.findall(r"`(\w+)`", sentence)} == names
    (tmp_path / "book.py").touch()
    script = "try: import book.figures\nexcept ImportError as error: print(error)"
    assert "'book' is not a package" in python("-c", script, cwd=tmp_path)


@pytest.mark.parametrize("chapter", ["08_arm", "photos"])
def test_a_chapter_runs_with_the_wheel_alone(alone, tmp_path, chapter):
    notebook = nbformat.read(ROOT / f"book/{chapter}.ipynb", as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell("import vmc_lib\nvmc_lib.__file__"))
    nbformat.write(notebook, tmp_path / "chapter.ipynb")
    alone("-m", "nbconvert", "--execute", "--to=notebook", "--inplace", "chapter.ipynb")
    executed = nbformat.read(tmp_path / "chapter.ipynb", as_version=4)
    (output,) = executed.cells[-1].outputs
    assert "reader" in output.data["text/plain"]
    assert str(ROOT) not in output.data["text/plain"]
