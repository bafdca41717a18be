"""The project's files that some code imports, found without running it."""

import ast
from functools import cache
from importlib.util import resolve_name
from pathlib import Path

ROOT = Path(__file__).parents[2]
DATA_SUFFIXES = {".xml", ".npz", ".json", ".jpg", ".webp"}  # of what code reads beside it


def imported_names(source, package=""):
    """What some source imports, in whatever form it says so: modules, and names of theirs."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            stem = resolve_name("." * node.level + (node.module or ""), package)
            yield from (f"{stem}.{alias.name}" for alias in node.names)


def imported_files(source, root=ROOT):
    """The set of files below `root` that some source imports, or that these import."""
    files, new = set(), _directly_imported(source, "", root)
    while new:
        files |= new
        new = set().union(*(_imported_by(file, root) for file in new)) - files
    return files


@cache
def _imported_by(file, root):
    package = ".".join(file.relative_to(root).parent.parts)
    return _directly_imported(file.read_text(encoding="utf-8"), package, root)


def _directly_imported(source, package, root):
    names = imported_names(source, package)
    return {file for name in names for file in _files_of(name, root)}


def _files_of(name, root):
    """The files that run when a module is imported, or a name of one: its own, its packages'."""
    place = root
    for part in name.split("."):
        place /= part
        yield from filter(Path.is_file, (place.with_suffix(".py"), place / "__init__.py"))
