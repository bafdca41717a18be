"""Markup that lives in a live kernel: the page's own scripts move it, and the kernel answers them.

The browser's end is `static/kernel.js`. It loads a script once for the whole window, however many
demos stand in it and however often their cells are run.
"""

import traceback
from pathlib import Path

import anywidget
import meshcat
import traitlets

STATIC = Path(__file__).parent / "static"
VENDORED = {
    "meshcat.js": Path(meshcat.__file__).parent / "viewer/dist/main.min.js",
    "bones.js": STATIC / "vendor/bones.js",
}


class Live(anywidget.AnyWidget):
    """The markup `page`, given to the script's function `start` once `scripts` (paths) have run.

    `answers` are functions by the name of what the scripts ask for; each takes what was said and
    returns what JSON takes. What one raises is shown where the picture would be. `vendored` are
    files by the name under which a script asks for them, late or never.
    """

    _esm = (STATIC / "kernel.js").read_text(encoding="utf-8")
    page, start = traitlets.Unicode().tag(sync=True), traitlets.Unicode().tag(sync=True)
    scripts, vendored = traitlets.List().tag(sync=True), traitlets.List().tag(sync=True)

    def __init__(self, page, start, scripts, answers=None, vendored=VENDORED):
        names = {"scripts": [path.name for path in scripts], "vendored": list(vendored)}
        super().__init__(page=page, start=start, **names)
        self.files = {path.name: path for path in scripts} | vendored
        self.answers = (answers or {}) | {
            "script": lambda name: self.files[name].read_text(encoding="utf-8")
        }
        self.on_msg(lambda _, asked, buffers: self._reply(**asked))

    def _reply(self, to, about, said):
        try:
            reply = {"answer": self.answers[about](said)}
        except Exception as error:  # a reader's own code may raise anything
            reply = {"error": "".join(traceback.format_exception_only(error)).strip()}
        self.send({"to": to} | reply)
