"""Widgets in a live kernel: the page's own scripts move their markup, and the kernel answers them.

The browser's end is `page/kernel.js`. Questions are answered beside the cells, while a chapter
still runs: so there may be two threads that draw.
"""

import traceback
from contextlib import contextmanager
from functools import cache, lru_cache, partial
from importlib.util import find_spec
from pathlib import Path
from threading import RLock
from time import monotonic

import anywidget
import matplotlib.pyplot as plt
import matplotlib_inline.backend_inline  # noqa: F401  (in `rc_context` its settings would end)
import traitlets
from IPython import get_ipython
from ipywidgets import Widget

from vmc_lib.show.render_mode import BROUGHT, STATIC

VENDORED = {"bones.js": STATIC / "vendor/bones.js"}
if MESHCAT := find_spec("meshcat"):  # not in the page
    VENDORED["meshcat.js"] = Path(str(MESHCAT.origin)).parent / "viewer/dist/main.min.js"
_pyplot = RLock()


@cache
def demo_script():
    """What moves a demo in a live kernel: as a wheel brings it, or made of `page`."""
    if STATIC == BROUGHT:
        return (BROUGHT / "demo.js").read_text(encoding="utf-8")
    from page import bundle  # in a clone

    return bundle.widget_script("demo/live.js")


class Live(anywidget.AnyWidget):
    """A widget that shows the markup `page`, which a `script` moves (`page.bundle.widget_script`).

    `vendored` are the paths, by name, of what a script asks for only when it
    needs it. `answers` maps a question to the function that answers it, JSON in, JSON out; what
    that raises is shown where the picture would be. `first` is the first answer to "state": lines
    of text for every part of the page, or None for a part that stands there already. `state` are
    further traits, of a subclass.

    Questions come by a `channel`, a model without a view: anywidget's own drops all messages where
    it loads later than two seconds, as on a busy machine.
    """

    _esm, page = traitlets.Unicode().tag(sync=True), traitlets.Unicode().tag(sync=True)
    vendored = traitlets.List().tag(sync=True)
    first = traitlets.List(allow_none=True).tag(sync=True)
    channel = traitlets.Unicode().tag(sync=True)

    def __init__(self, page, script, answers=None, vendored=VENDORED, first=None, **state):
        self._channel = Widget()
        super().__init__(
            _esm=script,
            page=page,
            vendored=list(vendored),
            first=first,
            channel=self._channel.model_id,
            **state,
        )
        self.answers = {
            "ping": lambda _: True,
            "script": lambda name: vendored[name].read_text(encoding="utf-8"),
        } | (answers or {})
        self._channel.on_msg(lambda _, message, buffers: self._reply(**message))
        if kernel := getattr(get_ipython(), "kernel", None):
            kernel.comm_manager.register_comm(_Listener(self._channel.comm, self._reply))
        _lock_cells_end()

    def __repr__(self):
        return "(an interactive demo)"  # the text of an output that may not, or cannot, be shown

    def _reply(self, id, question, value=None):
        try:
            if question == "state":
                reload_edited(int(monotonic()))
            reply = {"answer": self.answers[question](value)}
        except Exception as error:  # a reader's own code may raise anything
            reply = {"error": "".join(traceback.format_exception_only(error)).strip()}
        self._channel.send({"id": id} | reply)


class _Listener:
    """What a kernel hands a comm's messages to, in its place: `answer` hears the questions.

    A comm of ipykernel 7.4 lets the thread that last wrote to the browser read them, here the
    cells', behind all cells to come; this one lets the browser say which. Nor are IPython's events
    for a question: they show and close the figures of the cell that runs.
    """

    def __init__(self, comm, answer):
        self.comm_id, self.handle_close = comm.comm_id, comm.handle_close
        self._comm, self._answer = comm, answer

    def handle_msg(self, message):
        data = message["content"]["data"]
        if data.get("method") == "custom":
            self._answer(**data["content"])
        else:
            self._comm.handle_msg(message)


@lru_cache(1)
def reload_edited(second):
    """Let the extension autoreload take edited files, as before a cell: once in each `second`."""
    events = getattr(get_ipython(), "events", None)
    for function in events.callbacks["pre_run_cell"] if events else []:
        if function.__module__ == "IPython.extensions.autoreload":
            function(None)


@contextmanager
def exclusive_pyplot():
    """While one thread draws with pyplot, others wait; of a drawing that fails, nothing is left."""
    with _pyplot:
        before = set(plt.get_fignums())
        try:
            yield
        except BaseException:
            for number in set(plt.get_fignums()) - before:
                plt.close(number)
            raise


def _lock_cells_end():
    """Let the end of a cell, where matplotlib shows all open figures, wait for one being drawn."""
    events = getattr(get_ipython(), "events", None)
    for function in list(events.callbacks["post_execute"]) if events else []:
        if function.__module__.startswith("matplotlib"):
            events.unregister("post_execute", function)
            events.register("post_execute", partial(_locked, function))


def _locked(function):
    with _pyplot:
        function()
