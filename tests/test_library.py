"""The library as a whole: imports point one way, and the reference page lists every module."""

import re

import pytest

from reproduce.pipeline.imports import imported_names
from tests.project import ROOT, code, python

PACKAGES = ("vmc_lib", "page", "reproduce")
EMPTY = [ROOT / f"vmc_lib/{name}/__init__.py" for name in ("where", "arm", "motor", "cerebellum")]
FILES = sorted(p for top in PACKAGES for p in (ROOT / top).rglob("*.py") if p not in EMPTY)
# From the bottom: a package may import those below it, and not those beside or above it
FLOORS = (
    ("vmc_lib", "reproduce.paper", "page.bundle"),
    ("vmc_lib.where", "vmc_lib.what", "vmc_lib.arm"),
    ("vmc_lib.motor", "vmc_lib.box_selection"),
    ("vmc_lib.cerebellum",),
    ("vmc_lib.loop", "reproduce.one_draw"),
    ("vmc_lib.show",),
    ("reproduce.render", "page"),
    ("reproduce.results",),
    ("reproduce.training", "reproduce.peers", "reproduce.people"),
    ("reproduce.measures",),
    ("reproduce.whole_arm",),
    ("reproduce.experiments",),
    ("reproduce.ledger",),
    ("reproduce.pipeline",),
    ("reproduce",),
    ("book",),
    ("tools",),
    ("kit", "tools.bench"),
    ("tests",),
)
FLOOR = {package: floor for floor, packages in enumerate(FLOORS) for package in packages}
SEES, MOVES = {"vmc_lib.where", "vmc_lib.what"}, {"vmc_lib.motor", "vmc_lib.cerebellum"}


def module(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def test_the_reference_names_every_module_or_its_package():
    pages = "".join(p.read_text(encoding="utf-8") for p in (ROOT / "book/library").glob("*.md"))
    entries = {*" ".join(re.findall(r"```\{modules\}\n(.*?)```", pages, re.S)).split()}
    names = {*map(module, FILES)} - {"vmc_lib", "page", "reproduce", "reproduce.__main__"}
    assert not {name for name in names if not {name, name.rpartition(".")[0]} & entries}


def package(name):
    """The package of `FLOORS` that a module, or a name of one, belongs to; or None."""
    parts = name.split(".")
    return next((p for n in (3, 2, 1) if (p := ".".join(parts[:n])) in FLOOR), None)


HOUSE = [
    p for top in dict.fromkeys(n.split(".")[0] for n in FLOOR) for p in (ROOT / top).rglob("*.py")
]


@pytest.mark.parametrize("path", sorted(HOUSE), ids=module)
def test_imports_point_one_way(path):
    own = package(module(path))
    below = {package(n) for n in imported_names(code(path), module(path).rpartition(".")[0])}
    assert not {other for other in below - {own, None} if FLOOR[other] >= FLOOR[own]}
    assert not (own in MOVES and below & SEES)


# Within `fork_rng`: what torch's layers draw takes no generator
FORKED = {"reproduce.training.ventral_stream": "torch.random.default_generator.manual_seed(seed)"}
REFUSED = r"allow_pickle=True|import pickle|torch\.(load|save)\(|joblib\.dump"
REFUSED += r"|torch\.((random|cuda)\.)?(manual_)?seed|default_generator"


@pytest.mark.parametrize("path", FILES, ids=module)
def test_nothing_is_pickled_and_torch_has_no_global_seed(path):
    """Ruff's NPY002 refuses NumPy's."""
    assert not re.search(REFUSED, code(path).replace(FORKED.get(module(path), "\n"), "", 1))


def test_the_loop_needs_no_torch():
    """It weighs 200 MB and a second or more on every kernel that imports it."""
    python("-c", "import sys, vmc_lib.loop, reproduce.ledger; sys.exit('torch' in sys.modules)")
