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
HOUSE = (
    ("vmc_lib",),
    ("render", "arm_in_page"),
    ("reproduce",),
    ("book",),
    ("tools",),
    ("kit", "bench"),
    ("tests",),
)
SHARED = ("photos", "boxes", "data", "compiled", "NoReach")
MAY_IMPORT = {  # beside itself and what is shared: dependencies point one way
    "where": set(),
    "what": set(),
    "arm": set(),
    "motor": {"arm"},
    "cerebellum": {"arm", "motor"},
}


def module(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def test_the_reference_names_every_module_or_its_package():
    pages = "".join(page.read_text("utf-8") for page in (ROOT / "book/library").glob("*.md"))
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


def imports(source, part):
    """The parts of `vmc_lib` that a module of `part` imports, in whatever form it says so."""
    names = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            stem = resolve_name("." * node.level + (node.module or ""), f"vmc_lib.{part}")
            names += [f"{stem}.{alias.name}" for alias in node.names]
    return {name.split(".")[1] for name in names if name.startswith("vmc_lib.")}


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
    assert imports(f"import numpy\nfrom . import boxes\n{source}", "where") == {"where", "show"}


@pytest.mark.parametrize("part", MAY_IMPORT)
def test_dependencies_point_one_way(part):
    sources = (path.read_text(encoding="utf-8") for path in (ROOT / "vmc_lib" / part).glob("*.py"))
    imported = set().union(*(imports(source, part) for source in sources))
    assert imported - {part, *SHARED} <= MAY_IMPORT[part]


@pytest.mark.parametrize("below", range(len(HOUSE) - 1), ids=lambda k: "-".join(HOUSE[k]))
def test_what_stands_above_is_not_imported_from_below(below):
    above = "|".join(name for names in HOUSE[below + 1 :] for name in names)
    for name in HOUSE[below]:
        for path in (ROOT / name).rglob("*.py"):
            assert not re.search(
                rf"^\s*(from|import) ({above})\b", path.read_text(encoding="utf-8"), re.M
            ), path


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
