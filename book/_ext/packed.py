"""What a page loads is made light when the pages are built.

What its reader asks for, the page's Python (`python_in_page`) and all that its eye has learnt
(`eye_in_page`), is packed; every other script of our own goes without comments and indentation.
"""

from itertools import groupby
from pathlib import Path

from pygments.lexers import JavascriptLexer
from pygments.token import Comment, Whitespace

from eye_in_page import brain
from python_in_page import pack


def setup(app):
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(app, exception):
    if app.builder.format != "html" or exception:
        return
    static = Path(app.outdir) / "_static"
    scripts = (brain, brain.SCRIPT), (pack, pack.SCRIPT), (pack, pack.PLOTS, pack.PLOTS)
    for packed, name, *given in scripts:
        script = static / name
        made = script.stat().st_mtime if script.exists() else 0
        if made < max(path.stat().st_mtime for path in packed.inputs()):
            script.parent.mkdir(parents=True, exist_ok=True)
            script.write_text(packed.script(*given), encoding="utf-8", newline="\n")
    for folder in app.config.html_static_path:
        for script in Path(app.confdir, folder).glob("*.js"):
            light = strip_comments(script.read_text(encoding="utf-8"))
            light = f"// Readable in {folder}/{script.name}\n{light}"
            (static / script.name).write_text(light, encoding="utf-8", newline="\n")


def strip_comments(script):
    """A script without comments and indentation; what is in its strings and templates stays."""
    tokens = JavascriptLexer(stripnl=False, ensurenl=False).get_tokens(script)
    text = ""
    for blank, run in groupby(tokens, lambda token: token[0] in Whitespace or token[0] in Comment):
        part = "".join(part for _, part in run)
        text += ("\n" if "\n" in part else " ") if blank else part
    return text.lstrip()
