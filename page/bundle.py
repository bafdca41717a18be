"""One script of ES modules: a page that is opened from the disk may load classic scripts alone.

A bundle is a function of a table in which the exports of each module (a file below `page`) stand
under its path, those of "demo/axes.js" under "demo/axes"; what the table has, is not run again. A
module may say `import {…} from`, `import * as … from` or `import` alone, a line each, and
`export const`, `class`, `function` or `export {…}`; none needs one that needs it.
"""

import re
from pathlib import Path
from posixpath import dirname, join, normpath

FOLDER = Path(__file__).parent
STATIC = FOLDER / "static"  # what a page loads as it is: styles, and vendored scripts
IMPORT = re.compile(r'^import (?:(.+) from )?"(\.[^"]+)";\n', re.M)
EXPORT = re.compile(r"^export (const|class|(?:async )?function\*?) (\w+)", re.M)
LIST = re.compile(r"^export \{ (.+) \};\n", re.M)
UNREAD = re.compile(r"^(?:import|export)\b.*", re.M)
HEAD = "/* Made of the modules in the folder `page`, readable there. */\n"


def bundle(*entries, folder=FOLDER):
    """The entries (paths from `folder`) and what they import: the text of a function of a table."""
    modules = "".join(_wrap(name, folder) for name in import_order(entries, folder))
    return f'((vmc) => {{\n"use strict";\n{modules}return vmc;\n}})'


def page_script(*entries):
    """The classic script of a page; `self.vmc` is its table, for tests and whoever looks inside."""
    return f"{HEAD}{bundle(*entries)}(self.vmc = {{}});\n"


def widget_script(entry):
    """The module of a widget (see `vmc_lib.show.live`) that what `entry` exports as `start` moves.

    Widgets of a window share its table `vmc`: what is fetched or counted there, is once.
    """
    return (
        f"{HEAD}const vmc = {bundle('kernel.js', entry)}(globalThis.vmc ??= {{}});\n"
        f"export default {{ render: (it) => vmc.kernel.render(it, vmc{_key(entry)}.start) }};\n"
    )


def import_order(entries, folder=FOLDER):
    """The modules that entries need, each after all that it imports; ValueError for a circle."""
    order, above = [], []

    def visit(name):
        if name in above:
            raise ValueError(f"modules import one another: {' → '.join([*above, name])}")
        if name not in order:
            above.append(name)
            for _, path in IMPORT.findall((folder / name).read_text(encoding="utf-8")):
                visit(_place(name, path))
            order.append(above.pop())

    for entry in entries:
        visit(entry)
    return order


def _place(name, path):
    """Where a module lies that the module `name` calls `path`."""
    return normpath(join(dirname(name), path))


def _key(name):
    return f'["{name.removesuffix(".js")}"]'


def _wrap(name, folder):
    """A module's text as a statement that puts its exports into the table."""
    text = (folder / name).read_text(encoding="utf-8")
    exports = [export for _, export in EXPORT.findall(text)]
    exports += [export for names in LIST.findall(text) for export in names.split(", ")]
    text = IMPORT.sub(lambda line: _import(name, *line.groups()), text)
    text = LIST.sub("", EXPORT.sub(r"\1 \2", text))
    if unread := UNREAD.search(text):
        raise ValueError(f"{name}: write `{unread[0]}` as the first lines of bundle.py say")
    return f"vmc{_key(name)} ??= (() => {{\n{text}return {{ {', '.join(exports)} }};\n}})();\n"


def _import(name, names, path):
    """An import as a statement that takes from the table."""
    if names is None:
        return ""
    names = names.removeprefix("* as ").replace(" as ", ": ")
    return f"const {names} = vmc{_key(_place(name, path))};\n"
