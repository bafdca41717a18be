"""Exercises of the chapter on noise."""

import numpy as np

from vmc_lib.grading import Exercise


def honest(first, again):
    best = first.argmin(axis=0)
    return again[best, np.arange(len(best))]


HONEST = Exercise(
    honest,
    lambda rng: tuple(rng.random((2, *rng.integers(2, 5, 2)))),
    {
        "That is the error of the lucky trial itself. Choose by `first`, and report what `again` "
        "says.": lambda first, again: first.min(axis=0),
        "You chose by `again`, and the luck is back. Choose by other errors than you report.": (
            lambda first, again: again.min(axis=0)
        ),
        "You kept one trial for all targets. Each target has its own best.": (
            lambda first, again: again[first.mean(axis=1).argmin()]
        ),
        "You took the mean of all trials. Only the one that was kept is repeated.": (
            lambda first, again: again.mean(axis=0)
        ),
    },
)


def combine(reports, errors):
    weights = 1 / errors**2
    return weights @ reports / weights.sum()


def _senses(rng):
    count = rng.integers(2, 5)
    return rng.normal(size=count).round(1), rng.permutation([0.5, 1, 2, 4])[:count]


COMBINE = Exercise(
    combine,
    _senses,
    {
        "That is the plain mean: a sense that errs much has as much to say as one that errs "
        "little.": lambda reports, errors: reports.mean(),
        "You gave the most weight to the sense that errs most. Divide by the error's square.": (
            lambda reports, errors: errors**2 @ reports / (errors**2).sum()
        ),
        "You divided by the errors themselves. Variances add, so weigh by 1 over the error's "
        "square.": lambda reports, errors: (1 / errors) @ reports / (1 / errors).sum(),
        "You believed the best sense alone. The others know something, too.": (
            lambda reports, errors: reports[errors.argmin()]
        ),
    },
)
