"""Why a habitual plan misses: what its weights (Eq. 5) contribute, and what the arm does."""

import numpy as np

from reproduce.one_draw import template_rows
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import habitual_weights, plan

TARGETS = np.stack(
    np.meshgrid(np.arange(0.01, 0.18, 0.02), np.arange(-0.44, -0.31, 0.02)), axis=-1
).reshape(-1, 2)


def mixture_and_endpoint(rule=habitual_weights, spacing=0.06, number=4):
    """Where the weights alone would send the hand (N, 2) for `TARGETS`, and where it ends, in m.

    Of templates `spacing` m apart it mixes a `number` (`template_rows`).
    """
    past = templates.load(spacing)
    plans = plan(TARGETS, past, rule, template_rows(TARGETS, past.points, number))
    return (plans.weights[:, None] @ plans.points)[:, 0], execute(plans).endpoint


def mean_bias(rule, spacing=0.06, number=4):
    """The mean bias: how far the hand's mean place over the hold is from a target, in mm."""
    _, reached = mixture_and_endpoint(rule, spacing, number)
    return 1000 * np.linalg.norm(reached - TARGETS, axis=-1).mean()
