"""Checks of what a caller gives: an error says what is wrong, the value, and the remedy."""

from numbers import Integral, Real
from typing import Any

import numpy as np

from vmc_lib.short_repr import short


def check_kind(name: str, value: object, kind: type, remedy: str) -> None:
    """Raise ValueError where a value is of another class than `kind`."""
    if not isinstance(value, kind):
        raise ValueError(f"{name} {short(value)} is no {kind.__name__}: give {remedy}")


def check_rng(rng: object) -> None:
    """Raise ValueError where `rng` is no source of random numbers, but a seed."""
    check_kind("rng", rng, np.random.Generator, "np.random.default_rng(seed)")


def check_count(name, value, least=0):
    """Raise ValueError where a value is no whole number, or less than `least`."""
    if not (isinstance(value, Integral) and value >= least):
        raise ValueError(f"{name} = {short(value)}: give a whole number, {least} or more")


def is_within(value, low, high):
    """Whether a value is one finite number, within [low, high]; text and arrays are not."""
    return isinstance(value, Real) and bool(low <= value <= high and abs(value) < np.inf)


def as_numbers(name: str, values: Any) -> np.ndarray:
    """Convert values to an array of floats; ValueError where they are no numbers, or ragged."""
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        message = (
            f"{name} {short(values)} is no array of numbers: give numbers, in rows of a length"
        )
        raise ValueError(message) from None
