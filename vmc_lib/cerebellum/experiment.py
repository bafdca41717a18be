"""The paper's experiments on movement, whole: plan, calibrate off-line, learn, test on new targets.

Tables IV to VI are `planned`, `offline` and a row of `in_sample`; Fig. 12 is the mean of each row.
The paper reports movements that were practised; `held_out` is what was learned for others.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from ..motor.planning import draw_targets, plan
from ..motor.templates import Library
from .offline import published

# Algorithm 1 with every fifth n: a quarter of the reaches, and hardly a difference
quick = partial(published, gains=range(0, 21, 5))


class Errors(NamedTuple):
    """How far from the target the hand ends, in m; row k is after k experiments."""

    planned: np.ndarray  # (movements,): the first experiment's, by habit (Table IV) …
    offline: np.ndarray  # (movements,): … and after their off-line calibration (Table V)
    in_sample: np.ndarray  # (experiments + 1, movements): online, for movements just practised
    held_out: np.ndarray  # (experiments + 1, held_out): online, for movements never practised
    held_out_planned: np.ndarray  # (held_out,): those by habit


def run(learner, library, rng, movements=25, held_out=200, experiments=10, fresh=False, **lesson):
    """`Errors` of a learner (`Linear`, `Aim`) that practises `movements` in every experiment.

    They are the same movements each time, as we read Fig. 12, or new ones where `fresh`. What
    `lesson` names is passed to the learner's `practise`: `rule=quick` saves Algorithm 1's time.
    """
    unseen = plan(draw_targets(library, held_out, rng), library)
    first = practised = plan(draw_targets(library, movements, rng), library)
    in_sample, others = [_errors(learner.correct(first))], [_errors(learner.correct(unseen))]
    for experiment in range(experiments):
        if fresh and experiment:
            practised = plan(draw_targets(library, movements, rng), library)
        learner.practise(practised, **lesson)
        in_sample.append(_errors(learner.correct(practised)))
        others.append(_errors(learner.correct(unseen)))
    offline = lesson.get("rule", published)(first).error.min(axis=0)
    return Errors(_errors(first), offline, np.array(in_sample), np.array(others), _errors(unseen))


def around(library, place):
    """The four templates around a place (2,) as a `Library`: the scenario of four fixed ones."""
    four = plan(place, library).chosen
    return Library(library.points[four], library.excitations[four])


def _errors(plan):
    return np.linalg.norm(plan.reached() - plan.target, axis=-1)
