"""How things are shown: `explore` (demos that answer their sliders), plots, photos, scenes.

The arm's own scenes are in `vmc_lib.show.arm`.
"""

from vmc_lib.show.controls import Choice, Pad, Slider, Switch
from vmc_lib.show.demo import explore, figure
from vmc_lib.show.figures import COLOURS, photo_view, say
from vmc_lib.show.scene import Scene

__all__ = [
    "COLOURS",
    "Choice",
    "Pad",
    "Scene",
    "Slider",
    "Switch",
    "explore",
    "figure",
    "photo_view",
    "say",
]
