"""Exercises of the chapter on online calibration."""

import numpy as np

from vmc_lib.grading import Exercise


def after_lessons(v, active, answers, rate):
    for a, y in zip(active, answers, strict=True):
        v = v + rate * (y - v @ a) * a
    return v


def _lessons(rng):
    n, m = rng.integers([2, 3], [5, 6])
    return rng.normal(size=m), rng.random((n, m)), rng.normal(size=n), rng.choice([0.1, 0.3])


def _taught_by(change):
    """`after_lessons` with another change after one lesson."""

    def wrong(v, active, answers, rate):
        for a, y in zip(active, answers, strict=True):
            v = v + rate * change(v, a, y)
        return v

    return wrong


AFTER_LESSONS = Exercise(
    after_lessons,
    _lessons,
    {
        "Your cells learn the answer again and again, even when they know it. Let only the "
        "*error* teach: $y - \\mathbf v \\cdot \\mathbf a$.": _taught_by(lambda v, a, y: y * a),
        "The error grows from lesson to lesson: mind its sign.": (
            _taught_by(lambda v, a, y: (v @ a - y) * a)
        ),
        "Every weight changes by the same amount. Only cells that are active are to blame: "
        "multiply by the activity.": _taught_by(lambda v, a, y: y - v @ a),
        "You found all errors with the first weights. Each lesson meets what the one before it "
        "has left.": lambda v, active, answers, rate: v + rate * (answers - active @ v) @ active,
    },
)


def sparse(x, centres, width, most):
    square = ((centres - x) ** 2).sum(axis=1)
    active = np.exp(-square / (2 * width**2))
    active[np.argsort(-active)[most:]] = 0
    return active


def _place_and_cells(rng):
    m, d = rng.integers([4, 2], [8, 4])
    return rng.random(d), rng.random((m, d)), rng.choice([0.3, 0.5]), int(rng.integers(2, m))


SPARSE = Exercise(
    sparse,
    _place_and_cells,
    {
        "All cells answer still. Silence all but the `most` strongest.": (
            lambda x, centres, width, most: sparse(x, centres, width, len(centres))
        ),
        "You kept the weakest. `argsort` puts the smallest first.": (
            lambda x, centres, width, most: (
                sparse(x, centres, width, len(centres))
                - sparse(x, centres, width, len(centres) - most)
            )
        ),
        "The right cells are on, but how strongly they answer is lost: keep their activity.": (
            lambda x, centres, width, most: 1.0 * (sparse(x, centres, width, most) > 0)
        ),
        "Your bells are too narrow: the square is to be divided by $2\\sigma^2$.": (
            lambda x, centres, width, most: sparse(x, centres, width / np.sqrt(2), most)
        ),
    },
)
