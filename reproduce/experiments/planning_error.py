"""Why a habitual plan misses: what its weights (Eq. 5) contribute, and what the arm does."""

import numpy as np

from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import exact_weights, habitual_weights, nearest, plan

TARGETS = np.stack(
    np.meshgrid(np.arange(0.01, 0.18, 0.02), np.arange(-0.44, -0.31, 0.02)), axis=-1
).reshape(-1, 2)


RESAMPLES = 2000


def mixed_and_reached(rule=habitual_weights, spacing=0.06, number=4, hold=templates.HOLD):
    """Where the weights alone would send the hand (N, 2) for `TARGETS`, and where it ends, in m.

    Of templates `spacing` m apart it mixes a `number`: four are one in each quadrant, any other
    number the nearest.
    """
    past = templates.load(spacing, hold)
    rows = None if number == 4 else nearest(TARGETS, past.points, number)
    plans = plan(TARGETS, past, rule, rows)
    return (plans.weights[:, None] @ plans.points)[:, 0], execute(plans).endpoint


def misses(rule=habitual_weights, spacing=0.06, number=4, hold=templates.HOLD):
    """How far the hand ends from each of `TARGETS`, (N,), in mm."""
    _, reached = mixed_and_reached(rule, spacing, number, hold)
    return 1000 * np.linalg.norm(reached - TARGETS, axis=-1)


def mean_miss(rule=habitual_weights, spacing=0.06, number=4):
    """How far the hand ends from a target on average, in mm."""
    return misses(rule, spacing, number).mean()


def share_of_weights(spacing=0.06, hold=templates.HOLD):
    """The share of the mean miss that exact weights remove, and its 95 % interval over targets.

    The rest is the arm's, which is not linear. The interval is a bootstrap's.
    """
    near, exact = (misses(rule, spacing, hold=hold) for rule in (habitual_weights, exact_weights))
    drawn = np.random.default_rng(0).integers(len(near), size=(RESAMPLES, len(near)))
    some = 1 - exact[drawn].mean(axis=1) / near[drawn].mean(axis=1)
    return 1 - exact.mean() / near.mean(), *np.quantile(some, (0.025, 0.975))
