"""The library as a package: what it declares, what its wheel holds, and a chapter elsewhere."""

import ast
import json
import re
import shutil
import sys
import sysconfig
import tomllib
from functools import cache, partial
from importlib import metadata
from pathlib import Path
from zipfile import ZipFile

import nbformat
import pytest
from packaging.metadata import Metadata
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name as canonical
from packaging.utils import parse_wheel_filename

from page.bundle import STATIC, widget_script
from tests.project import ROOT, code, python, run, sample
from tools import wheel

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
OPTIONAL = PROJECT["optional-dependencies"] | {"derive": ["myo-sim"]}
LIVE_STYLES = ("demo", "scene")
OURS = {"vmc_lib", "page", "reproduce"}
OURS |= {"book", "kit", "tests", "tools"}
# Of January 2026: github.com/googlecolab/backend-info, pip-freeze.txt
COLAB = "ipykernel==6.17.1 ipython==7.34.0 matplotlib==3.10.0 numpy==2.0.2 traitlets==5.7.1"
PINS = re.findall(
    r"^([\w.\[\]-]+)==([\w.]+)", (ROOT / "requirements.txt").read_text(encoding="utf-8"), flags=re.M
)


def declared(*extras):
    """The requirements of the core and some extras, with those that these name."""
    lists = [PROJECT["dependencies"], *(OPTIONAL[e] for e in extras)]
    requirements = [Requirement(line) for lines in lists for line in lines]
    inner = {extra for r in requirements if r.name == "vmc_lib" for extra in r.extras}
    own = {canonical(r.name): r.specifier for r in requirements if r.name != "vmc_lib"}
    return (declared(*inner) if inner else {}) | own


EVERYTHING = declared("book", "test", "cluster")


def imported(source):
    """Names of the packages that some code imports, but for Python's and ours."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        else:
            modules = [node.module] if isinstance(node, ast.ImportFrom) else []
        yield from {module.split(".")[0] for module in modules} - OURS - sys.stdlib_module_names


packages_distributions = cache(metadata.packages_distributions)


@pytest.mark.parametrize(
    ("patterns", "extras"),
    [
        ("vmc_lib/*.py vmc_lib/[!s]*/*.py", ("learning",)),
        ("vmc_lib/show/*.py", ("show",)),
        ("page/**/*.py book/figures/*.py book/*.ipynb", ("chapters",)),
        ("reproduce/**/*.py", ("chapters", "derive", "render")),
        ("book/_ext/*.py kit/**/*.py tests/**/*.py tools/*.py", ("book", "test", "cluster")),
    ],
)
def test_imports_are_declared(patterns, extras):
    makers, names_declared = packages_distributions(), declared(*extras)
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
    assert len(declared()) <= 6
    assert all(declared("chapters").values())
    assert not needed(declared()) & {"ipython", "matplotlib", "notebook", "torch", "traitlets"}
    tools = {"pytest", "playwright", "ruff", "sphinx", "jupyter-book", "dask"}
    assert not needed(declared("chapters")) & tools


def needed(packages):
    """The names of packages and of all that they pull in."""
    pulled, waiting = set(), [*packages]
    while waiting:
        if (name := waiting.pop()) not in pulled:
            pulled.add(name)
            requirements = (Requirement(line) for line in metadata.requires(name) or [])
            here = (r for r in requirements if not r.marker or r.marker.evaluate({"extra": ""}))
            waiting += (canonical(r.name) for r in here)
    return pulled


@pytest.mark.audit
def test_the_model_runs_on_the_base_install_alone():
    """In a plain script; what draws says what it lacks."""
    absent = {n for name in declared("chapters").keys() - declared() for n in modules(name)}
    script = f"""import sys
sys.modules.update(dict.fromkeys({sorted(absent)}))
from vmc_lib import loop, photos
photo = photos.load("rig", "validation")[3]
print(*loop.see_and_reach(loop.VisuomotorModel.load("rig"), photo.image, photo.camera))
try: import vmc_lib.show
except ImportError as error: print(error)"""
    seen, missing = python("-c", script).splitlines()
    assert re.match(r"Sight\(.* sure\) Reach\(", seen)
    assert 'pip install "vmc_lib[show]"' in missing


def modules(package):
    """The names under which a package is imported."""
    makers = metadata.packages_distributions()
    return [name for name, made_by in makers.items() if package in map(canonical, made_by)]


@pytest.fixture(scope="session")
def reader(once):
    """A folder: a copy of the project, its wheel, and a Python that has this and what it needs."""
    return once("reader", install)


def install(folder):
    unwanted = shutil.ignore_patterns(".*", "_build", "build", "__pycache__", "*.egg-info")
    shutil.copytree(ROOT, folder / "source", ignore=unwanted)
    wheel = "wheel --quiet --no-deps --no-build-isolation --wheel-dir".split()
    python("-m", "pip", *wheel, folder, folder / "source")
    python("-m", "venv", "--without-pip", folder / "venv")
    (site,) = (folder / "venv").glob("**/site-packages")
    options = ["install", "--quiet", "--no-deps", "--target", site, *folder.glob("*.whl")]
    python("-m", "pip", *options)
    installed = sysconfig.get_path("purelib")  # its own .pth files rest
    (site / "others.pth").write_text(installed, encoding="utf-8")


@pytest.fixture
def alone(reader, tmp_path):
    """A function that runs the reader's Python in an empty folder, and returns what it printed."""
    options = {"cwd": tmp_path, "PYTHONPATH": "", "VMC_RENDER_MODE": ""}
    return partial(run, reader / "venv/bin/python", **options)


def test_the_wheel_puts_all_of_the_library_and_nothing_else_into_site_packages(reader):
    (file,) = reader.glob("*.whl")
    names = {name for name in ZipFile(file).namelist() if ".dist-info/" not in name}
    files = {path for path in (ROOT / "vmc_lib").rglob("*") if path.is_file()}
    ours = {path.relative_to(ROOT).as_posix() for path in files if "__pycache__" not in path.parts}
    brought = {f"vmc_lib/show/static/{name}" for name in ("demo.js", *wheel.FILES)}
    assert names == ours | brought
    assert "vmc_lib/py.typed" in names


def test_an_index_takes_the_wheel(reader):
    (file,) = reader.glob("*.whl")
    with ZipFile(file) as content:
        [name] = [name for name in content.namelist() if name.endswith(".dist-info/METADATA")]
        described = Metadata.from_email(content.read(name))  # raises where one thing is invalid
    assert parse_wheel_filename(file.name)[:2] == ("vmc-lib", described.version)
    assert described.description_content_type == "text/markdown"
    assert described.description == (ROOT / "README.md").read_text(encoding="utf-8")
    assert described.license_expression == PROJECT["license"]


# Without an ignored line's mistake mypy would call its comment unused
TYPED = """
from vmc_lib import loop, photos
from vmc_lib.cerebellum.offline import calibrate
from vmc_lib.motor import planning, templates
from vmc_lib.show import widget
from vmc_lib.show.arm import arm_scene
model, photo = loop.VisuomotorModel.load("rig"), photos.load("rig", "test")[0]
sight, reach = loop.see_and_reach(model, photo.image, photo.camera)
plan = planning.plan((0.1, -0.38), templates.load(), rule="exact")
print(sight.summary.upper(), calibrate(plan, "own").error.min(), calibrate(plan, calibrate))
print(widget(lambda k: arm_scene((0, k)), k=(0, 2)).value)
calibrate(plan, rule=3)  # type: ignore[arg-type]
calibrate(plan, "best")  # type: ignore[arg-type]
calibrate("own", plan)  # type: ignore[arg-type]
planning.plan((0.1, -0.38), templates.load(), "published")  # type: ignore[arg-type]
loop.see(photo, photo.image)  # type: ignore[arg-type]
loop.reach(model)  # type: ignore[call-arg]
sight.detection  # type: ignore[attr-defined]
widget(3)  # type: ignore[arg-type]
"""


@pytest.mark.audit
def test_a_checker_tells_right_calls_of_the_installed_library_from_wrong_ones(reader, tmp_path):
    (tmp_path / "script.py").write_text(TYPED, encoding="utf-8")
    options = [f"--config-file={ROOT / 'pyproject.toml'}", f"--cache-dir={tmp_path / 'cache'}"]
    options += [f"--python-executable={reader / 'venv/bin/python'}", "--warn-unused-ignores"]
    python("-m", "mypy", *options, "script.py", cwd=tmp_path, PYTHONPATH="")


def test_a_demo_of_the_wheel_is_moved_by_the_script_that_a_clone_makes(alone):
    """And looks the same; there it comes along, for the wheel has no `page`."""
    script = """
import json
from importlib.util import find_spec
from vmc_lib.show import Slider, demo, explore, live, markup, outputs
shown = []
demo.display = lambda *items, **_: shown.extend(items)
widget = explore(lambda k: f"<svg><text>{k}</text></svg>", alt="words", k=Slider([1, 2], "k"))
bones = live.VENDORED["bones.js"].read_text(encoding="utf-8")
print(json.dumps([bool(find_spec("page")), widget._esm, markup.with_style_sheet(""), bones]))"""
    clone, *there = json.loads(alone("-c", script))
    bones = (STATIC / "vendor/bones.js").read_text(encoding="utf-8")
    styles = "".join((STATIC / f"{name}.css").read_text(encoding="utf-8") for name in LIVE_STYLES)
    assert not clone
    assert there == [widget_script("demo/live.js"), f"<style>{styles}</style>", bones]


@pytest.mark.audit
def test_the_library_works_alone(alone):
    script = """
from importlib import import_module
from pkgutil import walk_packages
import vmc_lib
for module in walk_packages(vmc_lib.__path__, "vmc_lib."):
    import_module(module.name)
from vmc_lib import loop, photos
loop.VisuomotorModel.load("rig")
print(vmc_lib.__file__, photos.load("rig", "test")[0].image.shape, sep="\\n")"""
    file, shape = alone("-c", script).splitlines()
    assert "site-packages" in file
    assert not Path(file).is_relative_to(ROOT)
    assert shape.endswith(", 3)")


@pytest.mark.parametrize("release", COLAB.split())
def test_colab_keeps_what_its_kernel_has_loaded(release):
    """Or the first cell would ask for a restart: to install is not enough."""
    name, version = release.split("==")
    assert version in declared("chapters")[name]


def test_a_readers_file_may_hide_a_folder_as_readme_says(tmp_path):
    (tmp_path / "book.py").touch()
    script = "try: import book.figures\nexcept ImportError as error: print(error)"
    error = python("-c", script, cwd=tmp_path)
    assert "'book' is not a package" in error
    assert "'book' is not a package" in (ROOT / "README.md").read_text(encoding="utf-8")


# Python reads and writes text as ASCII, and warns where it was not told how: Windows at its worst
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
ASCII |= {"PYTHONWARNDEFAULTENCODING": "1"}
STRICT = f"""import locale, warnings
warnings.filterwarnings("error", category=EncodingWarning, module=r"({"|".join(OURS)})\\b")
locale.getencoding()"""


@pytest.mark.parametrize("chapter", sample(["08_arm", "photos"], "photos"))
def test_a_chapter_runs_elsewhere_after_the_lines_of_readme(reader, alone, tmp_path, chapter):
    """Live, also where text is ASCII unless its encoding is named."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    lines = r"!git clone .*> (\w+)\n(%cd \1)\n%pip install --quiet -e .\.\[chapters\].\n"
    [(folder, enter)] = re.findall(lines, readme)  # the last is for what `reader` has
    (tmp_path / folder).symlink_to(reader / "source")
    used = "import book.figures, vmc_lib\n[*book.__path__, vmc_lib.__file__]"
    notebook = nbformat.read(ROOT / f"book/{chapter}.ipynb", as_version=4)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(f"{enter}\n{STRICT}"))
    notebook.cells.append(nbformat.v4.new_code_cell(used))
    nbformat.write(notebook, tmp_path / "chapter.ipynb")
    convert = "-m nbconvert --execute --to=notebook --inplace chapter.ipynb"
    alone(*convert.split(), **ASCII)
    executed = nbformat.read(tmp_path / "chapter.ipynb", as_version=4)
    assert "ANSI" in executed.cells[0].outputs[-1].data["text/plain"]  # ASCII's official name
    (output,) = executed.cells[-1].outputs
    assert output.data["text/plain"].count("/source/") == 2
    assert str(ROOT) not in output.data["text/plain"]
