"""The muscle: from excitation to activation to force (Eq. 9–11).

Three curves and one lag. The paper leaves units and ranges open; we read it so:

- length `l = (musculotendon length − slack tendon) / optimal fibre length`: the tendon is rigid,
  and the pennation (at most 12 degrees here) is left out;
- velocity `v = (rate of l) / 2.5`, **lengthening positive**, in units of 2.5 optimal fibre lengths
  a second (which is not the fastest shortening: Eq. 11 still pulls there);
- Eq. 11 divides by zero at v = 1 and its even powers fall again beyond; at v = 1 − √11 it reaches
  zero and turns negative below. `force_velocity` therefore holds v inside `VELOCITY_RANGE`;
- the passive force rises again below l = 0.22 (an even power): `passive_force` holds l above it.

Every law takes numbers or arrays: NumPy works them out as they stand, and the arm's compiled loop
is made of the same functions, without the checks that `law` adds.
"""

from collections.abc import Callable
from functools import wraps
from inspect import signature, unwrap
from numbers import Real
from typing import Any, NamedTuple, ParamSpec

import numpy as np

from vmc_lib.checks import as_numbers, check_rng, check_shares, is_positive, is_within
from vmc_lib.short_repr import short

Given = ParamSpec("Given")
Numbers = float | np.ndarray

TAU_ACTIVATION = 0.010  # s: calcium floods in quickly …
TAU_DEACTIVATION = 0.040  # s: … and is pumped back slowly
MAX_VELOCITY = 2.5  # optimal fibre lengths per second, the unit of v
VELOCITY_RANGE = 1 - 11**0.5, 0.9


def law(equation: Callable[Given, Any]) -> Callable[Given, Any]:
    """An equation that takes lists, too, and refuses text, and what no muscle can have.

    The arm's compiled loop leaves these checks out, by `unwrap`: they would take longer than the
    equation, and what blows up there is told of by its step.
    """
    names = tuple(signature(equation).parameters)

    @wraps(equation)
    def call(*given: Any, **named: Any) -> Any:
        numbers = {name: _checked(name, value) for name, value in named.items()}
        return equation(*map(_checked, names, given), *given[len(names) :], **numbers)

    return call


def _checked(name, value):
    numbers = as_numbers(name, value)
    if name in ("excitation", "activation"):
        check_shares(name, numbers)
    if name == "step" and not is_positive(value):
        raise ValueError(f"a step of {short(value)} s: give seconds, above 0")
    return value if isinstance(value, Real) else numbers


@law
def activation_rate(excitation: Numbers, activation: Numbers) -> Any:
    """Eq. 9: how fast activation follows excitation, both in [0, 1]; per second, same shape."""
    gap, (fall, haste) = excitation - activation, _rates()
    return gap * (fall + haste * excitation * (gap >= 0))


@law
def euler_activation(excitation: Numbers, activation: Numbers, step: float) -> Any:
    """Eq. 9 by Euler's method: the activation one `step` in s later; same shape."""
    return activation + step * activation_rate(excitation, activation)


def excitation_for(activation: Numbers, rate: Numbers) -> Any:
    """Eq. 9 solved for the excitation that changes this activation at this rate; same shape.

    Rising, it is a quadratic in the excitation; falling, it is linear. Outside [0, 1] no
    excitation can do it: the caller decides.
    """
    fall, haste = _rates()
    half = (fall - haste * activation) / 2
    root = np.sqrt(half**2 + haste * np.maximum(fall * activation + rate, 0))
    return np.where(rate >= 0, (root - half) / haste, activation + rate / fall)


def _rates():
    """How fast activation falls, and how much full excitation speeds its rise: 1/s."""
    return 1 / TAU_DEACTIVATION, 1 / TAU_ACTIVATION - 1 / TAU_DEACTIVATION


@law
def force_length(length: Numbers) -> Any:
    """f1 of Eq. 11: the share of maximal force an active fibre has at this normalised length."""
    square = np.square(length - 0.95)
    return np.exp(square - 40 * np.square(square))


@law
def force_velocity(velocity: Numbers) -> Any:
    """f2 of Eq. 11: 1.01 when still, falling to 0 in fast shortening, up to 1.6 in lengthening."""
    low, high = VELOCITY_RANGE
    inverse = 1 / np.square(1 - np.minimum(np.maximum(velocity, low), high))
    return 1.6 - 1.6 * np.exp(0.1 * inverse - 1.1 * np.square(inverse))


@law
def passive_force(length: Numbers) -> Any:
    """f3 of Eq. 11: the pull of a stretched muscle that nobody excites."""
    return 1.3 * np.arctan(0.1 * (np.maximum(length, 0.22) - 0.22) ** 10)


@law
def force(activation: Numbers, length: Numbers, velocity: Numbers, maximum: Numbers) -> Any:
    """Eq. 10: muscle force in newtons; `length` and `velocity` normalised, `maximum` = F0."""
    active = force_length(length) * force_velocity(velocity) * activation
    return maximum * (active + passive_force(length))


def fibre(
    length: Numbers, shortening: Numbers, optimal: Numbers, slack: Numbers
) -> tuple[Any, Any]:
    """The fibre's length and velocity, normalised as Eq. 10 and 11 take them.

    From the musculotendon length and its shortening (m, m/s); `optimal` is the fibre's best length
    l0, `slack` the tendon's length (m).
    """
    return (length - slack) / optimal, -shortening / (MAX_VELOCITY * optimal)


def musculotendon_force(
    activation: Numbers,
    length: Numbers,
    shortening: Numbers,
    optimal: Numbers,
    slack: Numbers,
    maximum: Numbers,
) -> Any:
    """Eq. 10 for a muscle and its tendon, measured as `fibre` takes them: newtons."""
    return force(activation, *fibre(length, shortening, optimal, slack), maximum)


def noisy(excitation: Numbers, share: float, rng: np.random.Generator) -> np.ndarray:
    """Excitations (…) with motor noise: fresh each step, its deviation a `share` of the signal.

    The stronger the command, the noisier (Harris & Wolpert 1998, Nature 394:780); clipped to
    [0, 1].
    """
    check_rng(rng)
    if not is_within(share, 0, np.inf):
        raise ValueError(f"noise of {short(share)} times the signal: give a number, 0 or more")
    excitation = as_numbers("excitation", excitation)
    return add_noise(excitation, share, rng.standard_normal(np.shape(excitation)))


def add_noise(excitation: Numbers, share: float, draws: Numbers) -> np.ndarray:
    """Signal-dependent noise by unit `draws` (…) that are there already, clipped to [0, 1]."""
    return np.clip(excitation * (1 + share * draws), 0, 1)


class Muscle(NamedTuple):
    """What makes a muscle: functions of the shapes and units of the two that fill `PAPER`."""

    activation_rate: Callable
    force: Callable

    def step_activation(
        self, excitation: np.ndarray, activation: np.ndarray, step: float
    ) -> np.ndarray:
        """One step of Euler's method, in s, of its activation; same shape."""
        return activation + step * self.activation_rate(excitation, activation)


# Looked up when they are called: whoever replaces a law of this module is followed
PAPER = Muscle(lambda *given: unwrap(activation_rate)(*given), lambda *given: unwrap(force)(*given))
