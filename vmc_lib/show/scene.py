"""Three-dimensional scenes with meshcat's own commands, recorded instead of sent to a server.

A `Scene` is used like a `meshcat.Visualizer`. It keeps the last message for every object,
transform and property, so a scene is a value: the viewer, given another scene, applies only what
differs. The same messages travel to the viewer inside the built page or, in a live kernel,
over Jupyter's own channel; no port is opened.
"""

import base64
import html
import itertools
import json
import re
from collections import defaultdict
from collections.abc import Iterable
from typing import Any, Self

import numpy as np
import umsgpack

from vmc_lib.checks import as_numbers

_UUID = re.compile(rb"[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}")


class Scene:
    """A recorded meshcat scene in the book's axes (x forward, y up, z right; metres).

    `Scene(base)` starts from everything that `base` holds, so that what never moves is made once.

    >>> from meshcat.geometry import Sphere
    >>> scene = Scene()
    >>> scene["ball"].set_object(Sphere(0.02))
    >>> len(scene.messages())
    2
    """

    zmq_url = web_url = None  # what meshcat asks of a window: there is no server

    def __init__(self, base: Self | None = None) -> None:
        self._messages = dict(base._messages) if base else {}
        if base is None:
            self.look((1.2, 0.5, 1.4), at=(0.2, -0.2, 0.0))

    def look(self, eye: Iterable[float], at: Iterable[float]) -> None:
        """Place the reader's eye, and the point it looks at (and walks around)."""
        view = [as_numbers("view", point).tolist() for point in (eye, at)]
        if list(map(np.shape, view)) != [(3,), (3,)]:
            raise ValueError(f"a view from {eye} at {at}: give both as (x, y, z), in m")
        self.tell("camera", view)

    def tell(self, name: str, value: Any) -> None:
        """Tell the viewer, as JSON takes it, what no meshcat command says: see scene.js."""
        self._messages[name] = json.dumps(value, separators=(",", ":"))

    def __getitem__(self, path: str) -> Any:
        """The meshcat visualizer at `path`: `scene["hand"].set_object(...)`."""
        import meshcat  # here, for it brings a server along

        return meshcat.Visualizer(window=self)[path]

    def send(self, command: Any) -> None:
        """Record one meshcat command (called by meshcat)."""
        lowered = command.lower()
        key = f"{lowered['type']} {lowered['path']} {lowered.get('property', '')}"
        packed = umsgpack.packb(lowered, force_float_precision="single")
        # meshcat names each object by the clock: numbering them instead makes equal scenes equal
        numbers = defaultdict(itertools.count().__next__)
        packed = _UUID.sub(lambda uuid: b"%036d" % numbers[uuid[0]], packed)
        self._messages[key] = base64.b64encode(packed).decode()

    def messages(self) -> list[str]:
        """The scene as a list of `"type path property|base64"` strings, in recorded order."""
        return [f"{key}|{data}" for key, data in self._messages.items()]

    def html(self, alt: str) -> str:
        """Where the viewer will stand in the page; until then, and without WebGL, words."""
        return f'<div class="vmc-scene"><p>{html.escape(alt)}</p></div>'
