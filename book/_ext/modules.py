"""The library's pages: the block `modules` names modules and packages, which autodoc documents.

Each module becomes a section with its docstrings; a package, one for itself and one for each of its
modules.
"""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"```\{modules\}\n(.*?)```", re.S)


def setup(app):
    app.connect("source-read", translate)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def translate(app, page, source):
    source[0] = BLOCK.sub(lambda block: "\n".join(map(_sections, block[1].split())), source[0])


def _sections(name):
    place = ROOT / name.replace(".", "/")
    own = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    members = (
        "\n   :members:"
        if re.search(r"^(def|class) ", own.read_text(encoding="utf-8"), re.M)
        else ""
    )
    inside = [f"{name}.{file.stem}" for file in sorted(place.glob("[!_]*.py"))]
    section = f"## `{name}`\n\n```{{eval-rst}}\n.. automodule:: {name}{members}\n```\n"
    return "\n".join([section, *map(_sections, inside)])
