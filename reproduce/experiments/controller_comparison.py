"""The granule cells and their peers compared: all practise the same movements."""

from dataclasses import replace
from functools import partial
from time import process_time

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import NOISE, SEEDS
from reproduce.peers.motor_noise import noisy_reach
from vmc_lib.arm.muscle import noisy
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load

MOVEMENTS = (25, 50, 100, 250)


def make(seeds=SEEDS, **size):
    """What `results/cerebella.json` holds: each learner's `compare`, with every seed."""
    from reproduce.peers.adaptive_controllers import LEARNERS  # here, with scikit-learn

    compared = {name: partial(compare, *learner, **size) for name, learner in LEARNERS.items()}
    return calibration.make(compared, seeds)


load_results = partial(calibration.load_results, "cerebella")


def compare(kind, cells, seed, movements=MOVEMENTS, held_out=200):
    """A learner's shares of habit's error that are left after so many `movements`, by name.

    "seconds" are the processor's, while the last of them were practised; "numbers" is how many the
    learner remembers then.
    """
    learner, seconds, shares = train_controller(kind, cells, seed, movements, held_out)
    white = partial(noisy, share=NOISE)
    noisy_shares = train_controller(kind, cells, seed, movements, held_out, white)[-1]
    return {
        "in-sample": shares[:, 0],
        "held-out": shares[:, 1],
        "held-out, noisy arm": noisy_shares[:, 1],
        "seconds": seconds,
        "numbers": memory_size(learner),
    }


def train_controller(kind, cells, seed, movements, held_out, noise=None):
    """A learner that has practised, the seconds of its last lesson, and the shares of error left.

    Those, of habit's error, are in-sample and held-out, (len(movements), 2); `noise` as for
    `templates_with_noise`.
    """
    rng = np.random.default_rng(seed)
    unseen, targets = (draw_targets(load(), n, rng) for n in (held_out, movements[-1]))
    practised = plan(targets, templates_with_noise(noise, (seed, 1)))
    learner, shares = kind(load(), cells()), []
    for first, last in zip((0, *movements[:-1]), movements, strict=True):
        start = process_time()
        learner.update(practised[first:last])
        seconds = process_time() - start
        tests = (
            plan(some, templates_with_noise(noise, (seed, 2))) for some in (targets[:last], unseen)
        )
        shares.append([_error_share(learner, plans) for plans in tests])
    return learner, seconds, np.array(shares)


def memory_size(learner):
    """How many numbers a learner remembers: the arrays of its regressions, or their lessons."""
    parts = [part for regression in vars(learner).values() for part in _stored_arrays(regression)]
    return sum(part.size for part in parts if isinstance(part, np.ndarray))


def _stored_arrays(regression):
    lessons = [part for lesson in getattr(regression, "lessons_", ()) for part in lesson]
    return lessons or vars(regression).values()


def _error_share(learner, plans):
    """The mean miss of plans that the learner corrects, over that of habit."""
    return execute(learner.correct(plans)).error.mean() / execute(plans).error.mean()


def templates_with_noise(noise, stream):
    """The templates, and an arm whose excitations vary: `noise(excitations, rng=…)`, or None."""
    if noise is None:
        return load()
    noise = partial(noise, rng=np.random.default_rng(stream))
    return replace(load(), reach=partial(noisy_reach, noise))
