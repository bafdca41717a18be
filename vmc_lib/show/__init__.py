"""How things are shown: `explore` (demos that answer their sliders), plots, photos, the arm."""

from vmc_lib.show.arm import arm_scene
from vmc_lib.show.explore import Choice, Slider, Switch, explore, figure
from vmc_lib.show.figures import COLOURS, photo_view, say
from vmc_lib.show.scene import Scene

__all__ = [
    "COLOURS",
    "Choice",
    "Scene",
    "Slider",
    "Switch",
    "arm_scene",
    "explore",
    "figure",
    "photo_view",
    "say",
]
