"""What a page loads when its reader asks for it is packed when the pages are built.

These are the page's Python (`python_in_page`) and all that its eye has learnt (`eye_in_page`).
"""

from pathlib import Path

from eye_in_page import brain
from python_in_page import pack


def setup(app):
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(app, exception):
    if app.builder.format != "html" or exception:
        return
    scripts = (brain, brain.SCRIPT), (pack, pack.SCRIPT), (pack, pack.PLOTS, pack.PLOTS)
    for packed, name, *given in scripts:
        script = Path(app.outdir) / "_static" / name
        made = script.stat().st_mtime if script.exists() else 0
        if made < max(path.stat().st_mtime for path in packed.inputs()):
            script.parent.mkdir(parents=True, exist_ok=True)
            script.write_text(packed.script(*given), encoding="utf-8", newline="\n")
