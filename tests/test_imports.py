"""What is loaded with a module, or before a chapter's first demo: no library that is not needed."""

import ast
import re
from importlib.util import find_spec
from itertools import takewhile

from tests.project import CHAPTERS, ROOT, code, code_cells, python

HEAVY = {"cv2", "joblib", "matplotlib", "mujoco", "numba", "scipy", "sklearn", "torch"}
HEAVY |= {"IPython", "anywidget", "ipywidgets", "meshcat", "traitlets"}  # nor a notebook
NEED_THEM = ("arm26", "learning")  # the arm in MuJoCo, and training by torch


def loaded(lines):
    """The modules that a fresh Python has loaded after these lines."""
    return set(python("-c", "\n".join([*lines, "import sys", "print(*sys.modules)"])).split())


def test_model_modules_import_no_heavy_library():
    paths = [path.relative_to(ROOT).with_suffix("") for path in (ROOT / "vmc_lib").rglob("*.py")]
    model = [path for path in paths if "show" not in path.parts and path.stem not in NEED_THEM]
    assert HEAVY.isdisjoint(loaded(f"import {'.'.join(path.parts)}" for path in model))


def test_programs_that_start_modules_name_what_is_there():
    named = {
        name
        for path in (ROOT / "tools").rglob("*.py")
        for name in re.findall(r'"-m", "((?:kit|reproduce|tests|tools)[\w.]*)"', code(path))
    }
    assert "tools.bench.live" in named
    assert all(find_spec(name) for name in named)


def test_chapters_load_no_learning_library_before_their_first_demo():
    lines = []
    for chapter in CHAPTERS:
        sources = (cell.source for cell in code_cells(chapter))
        before = takewhile(lambda source: "explore(" not in source, sources)
        nodes = ast.parse("\n".join(before)).body
        lines += [ast.unparse(n) for n in nodes if isinstance(n, ast.Import | ast.ImportFrom)]
    modules = loaded(lines)
    assert "vmc_lib.show.demo" in modules
    assert {"scipy.stats", "skimage", "sklearn", "torch"}.isdisjoint(modules)
