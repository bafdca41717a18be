"""The library as a whole: documented, one-way, and the same in the reference page."""

import ast
import re
import subprocess
import sys
from importlib.util import resolve_name
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("vmc_lib", "arm_in_page", "reproduce")
EMPTY = [ROOT / f"vmc_lib/{name}/__init__.py" for name in ("where", "arm", "motor", "cerebellum")]
FILES = sorted(p for top in PACKAGES for p in (ROOT / top).rglob("*.py") if p not in EMPTY)
# From the bottom: a package may import those below it, and not those beside or above it
FLOORS = (
    ("vmc_lib", "reproduce.paper"),
    ("vmc_lib.where", "vmc_lib.what", "vmc_lib.arm"),
    ("vmc_lib.motor", "vmc_lib.box_selection"),
    ("vmc_lib.cerebellum",),
    ("vmc_lib.loop",),
    ("vmc_lib.show",),
    ("render", "arm_in_page"),
    ("reproduce.results",),
    ("reproduce.training", "reproduce.peers"),
    ("reproduce.experiments", "reproduce.whole_arm"),
    ("reproduce.ledger",),
    ("reproduce.pipeline",),
    ("reproduce",),
    ("book",),
    ("tools",),
    ("kit", "bench"),
    ("tests",),
)
FLOOR = {package: floor for floor, packages in enumerate(FLOORS) for package in packages}
SEES, MOVES = {"vmc_lib.where", "vmc_lib.what"}, {"vmc_lib.motor", "vmc_lib.cerebellum"}


def module(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def test_the_reference_names_every_module_or_its_package():
    pages = "".join(
        page.read_text(encoding="utf-8") for page in (ROOT / "book/library").glob("*.md")
    )
    listed = {*" ".join(re.findall(r"```\{modules\}\n(.*?)```", pages, re.S)).split()}
    names = {*map(module, FILES)} - {"vmc_lib", "reproduce", "reproduce.__main__"}
    assert not {name for name in names if not {name, name.rpartition(".")[0]} & listed}


@pytest.mark.parametrize("path", FILES, ids=module)
def test_everything_public_says_what_it_is(path):
    tree = ast.parse(path.read_bytes())
    public = [
        node
        for node in tree.body
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not re.match("_|main$", node.name)
    ]
    assert ast.get_docstring(tree)
    assert not [node.name for node in public if not ast.get_docstring(node)]


@pytest.mark.parametrize("path", FILES, ids=module)
def test_every_public_method_says_what_it_does(path):  # of a name that classes share, one may
    methods = [
        method
        for node in ast.parse(path.read_bytes()).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
        for method in node.body
        if isinstance(method, ast.FunctionDef) and not method.name.startswith("_")
    ]
    said = {method.name for method in methods if ast.get_docstring(method)}
    assert {method.name for method in methods} == said


def imports(source, name):
    """What the module `name` imports, in whatever form it says so: modules, and names of theirs."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            stem = resolve_name("." * node.level + (node.module or ""), name.rpartition(".")[0])
            yield from (f"{stem}.{alias.name}" for alias in node.names)


def package(name):
    """The package of `FLOORS` that a module, or a name of one, belongs to; or None."""
    parts = name.split(".")
    return next((p for n in (3, 2, 1) if (p := ".".join(parts[:n])) in FLOOR), None)


@pytest.mark.parametrize(
    "source",
    [
        "import vmc_lib.show",
        "import numpy, vmc_lib.show.arm as arm",
        "from vmc_lib import show",
        "from vmc_lib.show import say",
        "from .. import show",
        "from ..show import say",
        "def late():\n    from ..show.figures import say",
    ],
)
def test_no_form_of_import_goes_unseen(source):
    assert "vmc_lib.show" in {*map(package, imports(source, "vmc_lib.where.detector"))}


HOUSE = [
    p for top in dict.fromkeys(n.split(".")[0] for n in FLOOR) for p in (ROOT / top).rglob("*.py")
]


@pytest.mark.parametrize("path", sorted(HOUSE), ids=module)
def test_imports_point_one_way(path):
    own = package(module(path))
    below = {package(name) for name in imports(path.read_text(encoding="utf-8"), module(path))}
    assert not {other for other in below - {own, None} if FLOOR[other] >= FLOOR[own]}
    assert not (own in MOVES and below & SEES)


# Within `fork_rng`: what torch's layers draw takes no generator
FORKED = "reproduce.training.ventral_stream", "torch.random.default_generator.manual_seed(seed)"


@pytest.mark.parametrize("path", FILES, ids=module)
def test_nothing_is_pickled_and_chance_is_passed_in(path):
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"allow_pickle=True|import pickle|torch\.(load|save)\(|joblib\.dump", text)
    if module(path) == FORKED[0]:
        text = text.replace(FORKED[1], "", 1)
    assert not re.search(r"np\.random\.(seed|rand|randn|normal|uniform)\(", text)
    assert not re.search(r"torch\.((random|cuda)\.)?(manual_)?seed|default_generator", text)


def test_who_only_sees_and_reads_needs_no_torch():
    """It weighs 200 MB and a second or more on every kernel that imports it."""
    code = "import sys, vmc_lib.loop, reproduce.ledger; sys.exit('torch' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=ROOT)
