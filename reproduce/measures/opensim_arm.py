"""Our arm beside OpenSim's arm26, as recorded in `results/opensim.npz`."""

from functools import cache

import numpy as np

from reproduce.peers.muscle_models import LAWS
from reproduce.results import arrays
from vmc_lib.arm import dynamics, simulate

RECORDED = arrays("opensim")
COMMANDS = [f"triceps {u[0]:g}, biceps {u[3]:g}" for u in RECORDED["levels"]]
# Postures (518,) with the shoulder between −70° and 30°
IN_RANGE = np.abs(RECORDED["q"][:, 0] - np.radians(-20)) < np.radians(51)


def movements_by_law(start):
    """Joint angles (4, 601, 2) in rad: the recorded commands in our arm, by each muscle law."""
    commands = simulate.constant_excitation(RECORDED["levels"], 0.6)
    return {name: simulate.simulate(commands, start, muscle=law).q for name, law in LAWS.items()}


def largest_angle(q, recorded):
    """How far joint angles (…, 601, 2) are at most from those recorded every 10 ms, in degrees."""
    return np.degrees(np.abs(q[..., 10::10, :] - recorded).max())


@cache
def path_differences():
    """Ours less OpenSim's (3, 518, 6) in mm: lengths, moment arms at shoulder and at elbow."""
    lengths, arms = dynamics.paths(RECORDED["q"])
    parts = [lengths - RECORDED["lengths"], *np.moveaxis(arms - RECORDED["arms"], 1, 0)]
    return 1000 * np.stack(parts)


def largest_differences():
    """The largest of each muscle's `path_differences` (3, 6) in mm, over the postures in range."""
    return np.abs(path_differences()[:, IN_RANGE]).max(axis=1)
