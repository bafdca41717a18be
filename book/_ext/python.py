"""The script of the page's Python is packed when the pages are built: see `python_in_page`."""

from pathlib import Path

from python_in_page import pack


def setup(app):
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(app, exception):
    script = Path(app.outdir) / "_static" / pack.SCRIPT
    made = script.stat().st_mtime if script.exists() else 0
    changed = max(path.stat().st_mtime for path in pack.inputs())
    if app.builder.format == "html" and not exception and made < changed:
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(pack.script(), encoding="utf-8", newline="\n")
