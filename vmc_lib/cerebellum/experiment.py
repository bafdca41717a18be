"""The paper's experiments on movement, whole: random targets, planned, calibrated, learned from."""

import numpy as np

from ..motor.planning import surrounding


def random_targets(count, library, rng):
    """`count` plane positions (count, 2), spread evenly where templates lie on all sides, in m."""
    low, high = library.points.min(axis=0), library.points.max(axis=0)
    targets = []
    while len(targets) < count:
        target = rng.uniform(low, high)
        if _is_surrounded(target, library.points):
            targets.append(target)
    return np.array(targets)


def _is_surrounded(target, points):
    try:
        surrounding(target, points)
    except ValueError:
        return False
    return True
