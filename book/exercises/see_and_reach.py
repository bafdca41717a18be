"""Exercises of the chapter on seeing and reaching."""

import numpy as np

from vmc_lib.grading import Exercise


def on_the_table(eye, direction, height):
    far = (height - eye[1]) / direction[1]
    return eye + far * direction


def _line_of_sight(rng):
    eye = np.array([0.1, 0.25, 0]) + rng.normal(size=3) / 20
    direction = np.array([rng.uniform(0.2, 1), rng.uniform(-1.5, -0.5), rng.normal() / 4])
    return eye, direction, -0.4 + rng.random() / 10


ON_THE_TABLE = Exercise(
    on_the_table,
    _line_of_sight,
    {
        "You forgot how high the eye is: the line has to fall from there to the table.": (
            lambda eye, direction, height: eye + height / direction[1] * direction
        ),
        "The second number is the height here, not the third.": lambda eye, direction, height: (
            eye + (height - eye[2]) / direction[2] * direction
        ),
        "You went as far along the line as the eye is high. A slanting line is longer: divide by "
        "how much it falls a metre.": lambda eye, direction, height: (
            eye + (eye[1] - height) * direction / np.linalg.norm(direction)
        ),
        "That is the way from the eye. Add where the eye is.": lambda eye, direction, height: (
            on_the_table(eye, direction, height) - eye
        ),
    },
)


def first_broken(right):
    stages = right.shape[1]
    return np.where(right.all(axis=1), stages, right.argmin(axis=1))


FIRST_BROKEN = Exercise(
    first_broken,
    lambda rng: (rng.random(rng.integers(3, 6, 2)) < 0.8,),
    {
        "Where nothing broke you say 0, the first stage: `argmin` knows no *none*. Return the "
        "number of stages there.": lambda right: right.argmin(axis=1),
        "You found the *last* broken link. Later stages fail because an earlier one did.": (
            lambda right: np.where(
                right.all(axis=1),
                right.shape[1],
                right.shape[1] - 1 - right[:, ::-1].argmin(axis=1),
            )
        ),
        "You counted the broken links.": lambda right: (~right).sum(axis=1),
        "That is the first stage that went *right*.": lambda right: right.argmax(axis=1),
    },
)
