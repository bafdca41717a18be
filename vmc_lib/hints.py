"""General hints: what a wrong answer has in common with the right one, in any exercise.

An exercise's own hints name a fault of its subject; these name faults of arithmetic, order and
shape, and are asked where none of its own fits.
"""

import numpy as np

from vmc_lib.checks import as_numbers

# A hint, and what a function with that fault gives for what is right, an array.
FAULTS = [
    ("The sign is wrong, everywhere.", np.negative),
    ("That is twice what is right.", lambda right: 2 * right),
    ("That is half of what is right.", lambda right: right / 2),
    (
        "That is a hundred times what is right: a percentage, where a share is asked for?",
        lambda right: 100 * right,
    ),
    ("That is a hundredth of what is right.", lambda right: right / 100),
    (
        "That is a thousand times what is right: millimetres, where metres are asked for?",
        lambda right: 1000 * right,
    ),
    ("That is a thousandth of what is right.", lambda right: right / 1000),
    ("That is 57.3 times what is right: degrees, where radians are asked for?", np.degrees),
    ("That is right divided by 57.3: radians, where degrees are asked for?", np.radians),
    ("That is one over what is right.", lambda right: 1 / right),
    ("That is one minus what is right.", lambda right: 1 - right),
    ("That is the square of what is right.", np.square),
    ("That is the root of what is right.", np.sqrt),
    ("One too many, everywhere. (In Python counting begins at 0.)", lambda right: right + 1),
    ("One too few, everywhere.", lambda right: right - 1),
    ("The right numbers in the wrong order: the last comes first.", lambda right: right[::-1]),
    ("Rows and columns are exchanged.", np.transpose),
    ("The right numbers, one place too late.", lambda right: np.roll(right, 1, axis=0)),
    ("The right numbers, one place too early.", lambda right: np.roll(right, -1, axis=0)),
    ("The right numbers, sorted: leave them in their order.", np.sort),
    ("That is the first alone: all are asked for.", lambda right: right[0]),
    ("That is the last alone: all are asked for.", lambda right: right[-1]),
    ("The first one is missing.", lambda right: right[1:]),
    ("The last one is missing.", lambda right: right[:-1]),
    ("That is the sum of all: each is asked for.", np.sum),
    ("That is the mean of all: each is asked for.", lambda right: right.sum() / right.size),
    ("You cut off what is behind the point.", np.trunc),
    *(
        ("You rounded: return the numbers as they are.", lambda right, k=k: right.round(k))
        for k in range(5)
    ),
]


def fault(answers, rights, agree):
    """The hint of the first of `FAULTS` that gives all `answers`, or None.

    `answers` and `rights` are a value for each case; `agree(answer, expected)` tells whether two
    are the same. A fault that gives one number whatever is right explains nothing.
    """
    for hint, spoil in FAULTS:
        try:
            with np.errstate(all="ignore"):
                spoilt = [np.asarray(spoil(np.asarray(right, float))) for right in rights]
        except (IndexError, ValueError):  # a single number has no order
            continue
        several = len({number for one in spoilt for number in one.ravel()}) > 1
        if several and all(map(agree, answers, spoilt)):
            return hint
    return None


def difference(answer, right):
    """What an answer is instead of what is right, in its kind, shape or size; "" if nothing."""
    if answer is None:
        return "Here it returns nothing: is a `return` missing?"
    if callable(answer):
        return "It returns a function, not numbers."
    if isinstance(answer, str):
        return "It returns a text, not numbers."
    if (got := numbers(answer)) is None:
        return "What it returns cannot be read as numbers, in rows of equal length."
    right = np.asarray(right, float)
    if got.ndim and not right.ndim:
        many = f"{got.size} number{'s' * (got.size != 1)}"
        return f"It returns a list of {many}; one plain number is asked for."
    if got.shape != right.shape:
        alike = got.size == right.size and np.allclose(got.ravel(), right.ravel())
        what = "The right numbers" if alike else "It returns numbers" if got.ndim else "One number"
        return f"{what}, shape {got.shape} for {right.shape}."
    if np.isnan(got).any():
        return "It is *nan*, not a number: a division of zero by zero?"
    off = abs(got - right).max()
    return f"Nearly: it differs by {off:.0e} at most." if off < 1e-3 * abs(right).max() else ""


def numbers(value):
    """A value as an array of floats, or None: nothing, words, complex numbers, ragged rows."""
    try:
        return as_numbers("answer", value)
    except ValueError:
        return None
