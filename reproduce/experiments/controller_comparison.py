"""The granule cells and their peers compared: all practise the same movements."""

from dataclasses import replace
from functools import partial
from time import process_time

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import NOISE, SEEDS
from reproduce.peers.adaptive_controllers import LEARNERS
from vmc_lib.arm.muscle import noisy
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load, reach

MOVEMENTS = (25, 50, 100, 250)


def make(seeds=SEEDS, **size):
    """What `results/cerebella.json` holds: each learner's `compare`, with every seed."""
    compared = {name: partial(compare, *learner, **size) for name, learner in LEARNERS.items()}
    return calibration.make(compared, seeds)


measured = partial(calibration.measured, "cerebella")


def compare(kind, cells, seed, movements=MOVEMENTS, held_out=200):
    """A learner's shares of habit's error that are left after so many `movements`, by name.

    "seconds" are the processor's, while the last of them were practised; "numbers" is how many the
    learner remembers then.
    """
    pupil, seconds, shares = practise(kind, cells, seed, movements, held_out)
    white = partial(noisy, share=NOISE)
    noisy_shares = practise(kind, cells, seed, movements, held_out, white)[-1]
    return {
        "in-sample": shares[:, 0],
        "held-out": shares[:, 1],
        "held-out, noisy arm": noisy_shares[:, 1],
        "seconds": seconds,
        "numbers": numbers(pupil),
    }


def practise(kind, cells, seed, movements, held_out, noise=None):
    """A learner that has practised, the seconds it took, and the shares of habit's error left.

    Those are in-sample and held-out, (len(movements), 2); `noise` is that of the `arm`.
    """
    rng = np.random.default_rng(seed)
    unseen, targets = (draw_targets(load(), n, rng) for n in (held_out, movements[-1]))
    practised = plan(targets, arm(noise, (seed, 1)))
    pupil, shares = kind(load(), cells()), []
    for first, last in zip((0, *movements[:-1]), movements, strict=True):
        start = process_time()
        pupil.practise(practised[first:last])
        seconds = process_time() - start
        tests = (plan(some, arm(noise, (seed, 2))) for some in (targets[:last], unseen))
        shares.append([_left(pupil, plans) for plans in tests])
    return pupil, seconds, np.array(shares)


def numbers(pupil):
    """How many numbers a learner remembers: the arrays of its regressions, or their lessons."""
    parts = [part for regression in vars(pupil).values() for part in _kept(regression)]
    return sum(part.size for part in parts if isinstance(part, np.ndarray))


def _kept(regression):
    lessons = [part for lesson in getattr(regression, "lessons_", ()) for part in lesson]
    return lessons or vars(regression).values()


def _left(pupil, plans):
    """The mean miss of plans that the pupil corrects, over that of habit."""
    return pupil.correct(plans).missed().mean() / plans.missed().mean()


def arm(noise, stream):
    """The templates, and an arm whose excitations vary: `noise(excitations, rng=…)`, or None."""
    if noise is None:
        return load()
    return replace(load(), reach=partial(_unsteady, noise, np.random.default_rng(stream)))


def _unsteady(noise, rng, excitations, perturbation):
    return reach(noise(excitations, rng=rng), perturbation)
