"""What a page loads is made light when the pages are built.

Its script is a bundle of the modules in `page`, without comments and indentation. What its reader
asks for, the page's Python (`page.python`) and all that its eye has learnt (`page.eye`), is packed.
"""

from functools import cache, partial
from itertools import groupby
from pathlib import Path

from pygments.lexers import JavascriptLexer
from pygments.token import Comment, Whitespace

from book._ext.offline import SCRIPTS
from page import bundle
from page.eye import brain
from page.python import pack

SCRIPTS_ON_REQUEST = {  # how each is written, and of what files
    brain.SCRIPT: (brain.script, brain.inputs),
    pack.SCRIPT: (pack.script, pack.inputs),
    pack.PLOTS: (partial(pack.script, pack.PLOTS), pack.inputs),
}


def setup(app):
    app.connect("builder-inited", write_scripts)
    app.connect("build-finished", write_packed)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write_scripts(app):
    """Write the pages' scripts before the pages, which name them by their sums."""
    static = _static(app)
    static.mkdir(parents=True, exist_ok=True)
    for name in ("storage.js", *SCRIPTS):
        script = light_script(f"book/{name}")
        (static / name).write_text(script, encoding="utf-8", newline="\n")


def write_packed(app, exception):
    if app.builder.format != "html" or exception:
        return
    for name in SCRIPTS_ON_REQUEST:
        write_script(_static(app), name)


def write_script(static, name):
    """Write one of SCRIPTS_ON_REQUEST into a folder, unless it is newer than all that it holds."""
    (pack_script, inputs), file = SCRIPTS_ON_REQUEST[name], static / name
    written = file.stat().st_mtime if file.exists() else 0
    if written < max(path.stat().st_mtime for path in inputs()):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(pack_script(), encoding="utf-8", newline="\n")


def _static(app):
    return Path(app.outdir) / "_static"


@cache
def light_script(*entries):
    """The script of a page that these modules need (`page.bundle`), made light."""
    return bundle.HEAD + strip_comments(bundle.page_script(*entries))


def strip_comments(script):
    """A script without comments and indentation; what is in its strings and templates stays."""
    tokens = JavascriptLexer(stripnl=False, ensurenl=False).get_tokens(script)
    text = ""
    for blank, run in groupby(tokens, lambda token: token[0] in Whitespace or token[0] in Comment):
        part = "".join(part for _, part in run)
        text += ("\n" if "\n" in part else " ") if blank else part
    return text.lstrip()
