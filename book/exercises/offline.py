"""Exercises of the chapter on off-line calibration."""

import numpy as np

from vmc_lib.grading import Exercise


def fair_vote(rates, preferred):
    spread = preferred.T @ preferred  # a multiple of 1 when even
    return np.linalg.solve(spread, preferred.T @ rates)


def _neurons_that_fire(rng):
    angle = rng.uniform(0, 2 * np.pi, rng.integers(3, 7))
    preferred = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return preferred @ rng.normal(size=2), preferred


FAIR_VOTE = Exercise(
    fair_vote,
    _neurons_that_fire,
    {
        "That is the population vector: it is drawn to where many neurons prefer to go. Undo "
        "the spread: multiply by the inverse of $\\sum \\mathbf c_i \\mathbf c_i^{\\mathsf T}$.": (
            lambda rates, preferred: preferred.T @ rates
        ),
        "Dividing by $N/2$ is right only for neurons that are evenly spread.": (
            lambda rates, preferred: 2 / len(rates) * preferred.T @ rates
        ),
        "That is the favourite of the neuron that fires most. Let all of them vote.": (
            lambda rates, preferred: preferred[rates.argmax()]
        ),
        "Right in its direction, but not in its length: the reach may be longer than 1.": (
            lambda rates, preferred: _unit(fair_vote(rates, preferred))
        ),
    },
)


def _unit(vector):
    return vector / np.linalg.norm(vector)


def shortened(changes, longest):
    length = np.linalg.norm(changes, axis=1, keepdims=True)
    return changes * longest / np.maximum(length, longest)


def _length(changes):
    return np.linalg.norm(changes, axis=1, keepdims=True)


def _changes(rng):
    changes = (rng.normal(size=(3, 4)) * rng.uniform(0.05, 0.6, (3, 1))).round(2)
    changes[rng.integers(3)] *= rng.random() < 0.7
    return changes, rng.choice([0.3, 0.5])


SHORTENED = Exercise(
    shortened,
    _changes,
    {
        "You cut each number by itself. That turns the change; shorten it as a whole, and it "
        "keeps its direction.": lambda changes, longest: changes.clip(-longest, longest),
        "Short changes must stay as they are: shorten only what is longer than `longest`.": (
            lambda changes, longest: changes * longest / _length(changes)
        ),
        "A change of zero has length zero: do not divide by it.": lambda changes, longest: (
            changes / _length(changes) * np.minimum(_length(changes), longest)
        ),
        "You shortened all reaches by the same factor. Each change has a length of its own: sum "
        "along `axis=1`.": lambda changes, longest: (
            changes * min(1, longest / np.linalg.norm(changes))
        ),
    },
)


def misfit(points, targets, weights):
    nearness = 1 / np.linalg.norm(points[:, None] - targets, axis=-1)
    by_eq_5 = nearness / nearness.sum(axis=0)
    return np.sqrt(((by_eq_5 - weights) ** 2).mean())


def _nearness(points, targets):
    return 1 / np.linalg.norm(points[:, None] - targets, axis=-1)


def _rms_gap(nearness, weights):
    return np.sqrt(((nearness / nearness.sum(axis=0) - weights) ** 2).mean())


def _printed_weights(rng):
    n = rng.integers(2, 6)
    return rng.random((4, 2)), rng.random((n, 2)), rng.uniform(0.1, 0.5, (4, n)).round(4)


MISFIT = Exercise(
    misfit,
    _printed_weights,
    {
        "The weights of a reach must sum to one: divide each column by its sum.": (
            lambda points, targets, weights: np.sqrt(
                ((_nearness(points, targets) - weights) ** 2).mean()
            )
        ),
        "Each column is a reach. You made the rows sum to one: sum along `axis=0`.": (
            lambda points, targets, weights: _rms_gap(_nearness(points, targets).T, weights.T)
        ),
        "By Eq. 5 the *nearer* a template, the larger its weight: take one over the distance.": (
            lambda points, targets, weights: _rms_gap(1 / _nearness(points, targets), weights)
        ),
        "That is the mean of the squares. Take its root, and it is a weight again.": (
            lambda points, targets, weights: misfit(points, targets, weights) ** 2
        ),
        "That is the mean size of the differences. Square them first, and take the root at the "
        "end.": lambda points, targets, weights: abs(
            _nearness(points, targets) / _nearness(points, targets).sum(axis=0) - weights
        ).mean(),
    },
)
