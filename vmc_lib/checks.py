"""Checks of what a caller gives: an error says what is wrong, the value, and the remedy."""

from collections.abc import Callable
from functools import cache, wraps
from numbers import Integral, Real
from typing import Any, ParamSpec, TypeVar

import numpy as np

from vmc_lib.short_repr import short

Given = ParamSpec("Given")
Returned = TypeVar("Returned")


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


def check_function(name, value, remedy):
    """Raise ValueError where a value cannot be called."""
    if not callable(value):
        raise ValueError(f"{name} {short(value)} is no function: give {remedy}")


def cached(function: Callable[Given, Returned]) -> Callable[Given, Returned]:
    """`functools.cache`, with a ValueError where an argument is a list or another such."""
    kept: Any = cache(function)

    @wraps(function)
    def call(*given: Given.args, **named: Given.kwargs) -> Returned:
        try:
            hash((given, *named.values()))
        except TypeError:
            lists = short([*given, *named.values()])
            raise ValueError(f"{function.__name__} of {lists}: give numbers or names") from None
        return kept(*given, **named)

    return call


def is_within(value, low, high):
    """Whether a value is one finite number, within [low, high]; text and arrays are not."""
    return isinstance(value, Real) and bool(low <= value <= high and abs(value) < np.inf)


def is_positive(value):
    """Whether a value is one finite number above 0."""
    return is_within(value, 0, np.inf) and value > 0


def check_shares(name, values):
    """Raise ValueError where numbers lie below 0, or above 1 by more than Euler's method rounds."""
    low, high = values.min(initial=0), values.max(initial=0)
    if not (low >= 0 and high <= 1 + 1e-9):
        raise ValueError(f"{name}: values in [{low:.9g}, {high:.9g}]; clip them to [0, 1]")


def check_features(x, width):
    """Raise ValueError where x is not (n, width)."""
    if np.ndim(x) != 2 or np.shape(x)[1] != width:
        raise ValueError(f"X of shape {np.shape(x)}: give rows of {width} features, (n, {width})")


def shape_of(name: str, values: Any) -> tuple[int, ...]:
    """The shape of an array, or of what becomes one; ValueError where its rows are ragged."""
    try:
        return np.shape(values)
    except ValueError:
        raise ValueError(f"{name} {short(values)}: give rows of a length") from None


def as_numbers(name: str, values: Any) -> np.ndarray:
    """Convert values to an array of floats; ValueError where they are no numbers, or ragged."""
    try:
        numbers = np.asarray(values)
        if values is None or numbers.dtype.kind in "USc":
            raise TypeError  # NumPy would take None for NaN, "1" for 1, and 1j for 0
        return numbers.astype(float, copy=False)
    except (TypeError, ValueError):
        message = (
            f"{name} {short(values)} is no array of numbers: give numbers, in rows of a length"
        )
        raise ValueError(message) from None
