"""How things are shown: `explore` (demos that answer their sliders), plots, photos, questions.

The arm's own scenes are in `vmc_lib.show.arm`, and the arm that runs in the page in
`page.arm`: what needs no arm need not wait for one.
"""

try:
    import anywidget  # noqa: F401
    import matplotlib  # noqa: F401
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"{error.name} is not installed: what shows pictures comes with "
        'pip install "vmc_lib[show]", a chapter\'s all with "vmc_lib[chapters]"'
    ) from error

from vmc_lib.show.compare import compare, dot_plot
from vmc_lib.show.controls import Choice, Pad, Slider, Switch
from vmc_lib.show.demo import explore, figure, widget
from vmc_lib.show.estimate import Estimate, estimate
from vmc_lib.show.figures import details, itemise, markdown, note, photo_view, table
from vmc_lib.show.palette import COLOURS
from vmc_lib.show.questions import check, grade, solution
from vmc_lib.show.scene import Scene
from vmc_lib.show.verify import verify

__all__ = [
    "COLOURS",
    "Choice",
    "Estimate",
    "Pad",
    "Scene",
    "Slider",
    "Switch",
    "check",
    "compare",
    "details",
    "dot_plot",
    "estimate",
    "explore",
    "figure",
    "grade",
    "itemise",
    "markdown",
    "note",
    "photo_view",
    "solution",
    "table",
    "verify",
    "widget",
]
