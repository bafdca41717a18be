"""Forward dynamics (Eq. 9–12): from muscle excitations to a movement, by one of two engines.

`"compiled"` takes the trigonometric polynomials of `dynamics` and is one plain loop, compiled;
`"mujoco"` steps the MuJoCo model and is the reference, and the engine for other muscles than the
paper's. Both have the same muscles, the same joint stops and the same semi-implicit Euler steps.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.dynamics import FARTHEST, check_posture, hand
from vmc_lib.arm.engines import ENGINES
from vmc_lib.arm.model import F0, STEP, check_load
from vmc_lib.arm.muscle import PAPER, Muscle
from vmc_lib.checks import as_numbers, check_kind, check_shares, is_within
from vmc_lib.short_repr import short, short_repr


class Perturbation(NamedTuple):
    """What the arm meets while it moves; by default, nothing."""

    load: float = 0.0  # kg, held at the wrist
    field: tuple = ((0.0, 0.0), (0.0, 0.0))  # N m s / rad: torque = field @ joint velocity


UNPERTURBED = Perturbation()


def check_unperturbed(perturbation: Perturbation) -> None:
    """Raise ValueError for a load or a field, of an arm that knows none."""
    if perturbation.load or np.any(perturbation.field):
        raise ValueError(f"this arm knows no {perturbation}: leave it out")


@dataclass(frozen=True, eq=False)
class Motion:
    """Trajectories of a movement, or of a batch; sample t is the state t steps after the start."""

    q: np.ndarray  # joint angles (…, T + 1, 2), rad
    velocity: np.ndarray  # joint velocities (…, T + 1, 2), rad/s
    activation: np.ndarray  # muscle activations (…, T + 1, 6)

    __repr__ = short_repr

    def __iter__(self) -> Iterator[Self]:
        """Every movement of a batch, or the one there is, as a `Motion` of its own."""
        parts = (x.reshape(-1, *x.shape[-2:]) for x in (self.q, self.velocity, self.activation))
        for q, velocity, activation in zip(*parts, strict=True):
            yield replace(self, q=q, velocity=velocity, activation=activation)

    @property
    def hand(self) -> np.ndarray:
        """The wrist's path (…, T + 1, 3) in the shoulder frame, m."""
        return hand(self.q)

    @property
    def endpoint(self) -> np.ndarray:
        """Where the wrist ends in the arm's plane, p = (x, y), (…, 2), m."""
        return hand(self.q[..., -1, :])[..., :2]


def simulate(
    excitations: ArrayLike,
    start: ArrayLike,
    activation: ArrayLike | None = None,
    engine: Literal["compiled", "mujoco"] | None = None,
    perturbation: Perturbation = UNPERTURBED,
    muscle: Muscle = PAPER,
    step: float = STEP,
) -> Motion:
    """Simulate the arm from rest, under given muscle excitations.

    Parameters
    ----------
    excitations : array (…, T, 6)
        Muscle excitations in [0, 1], one set every `step` seconds.
    start : array (2,) or (…, 2)
        The posture (shoulder, elbow) in rad.
    activation : array (6,) or (…, 6), optional
        Activations in [0, 1] at the start; by default they have settled to the first excitation.
    engine : {"compiled", "mujoco"}, optional
        By default the compiled one, or MuJoCo where `muscle` is another than the paper's.
    perturbation : Perturbation
        A load in the hand, or a force field on the joints.
    muscle : Muscle
        The laws of activation and force.
    step : float
        The time step in s, in (0, 0.01].

    Returns
    -------
    Motion
        The trajectories, with T + 1 samples.

    Raises
    ------
    ValueError
        Where an input has a wrong shape, unit or range, the engine is not made for the muscle, or
        the movement blows up.

    Examples
    --------
    >>> motion = simulate(np.full((500, 6), 0.1), start=np.radians([0, 90]))
    >>> motion.q.shape, motion.hand.shape
    ((501, 2), (501, 3))
    """
    u = as_numbers("excitations", excitations)
    if u.ndim < 2 or u.shape[-1] != len(F0) or 0 in u.shape:
        raise ValueError(f"excitations have shape {u.shape}; use (T, 6) or (…, T, 6), T ≥ 1")
    check_shares("excitations", u)
    check_kind("muscle", muscle, Muscle, "Muscle(activation_rate, force), two functions")
    engine = engine or ("compiled" if muscle is PAPER else "mujoco")
    if not isinstance(engine, str) or engine not in ENGINES:
        raise ValueError(f"engine {short(engine)} is unknown; choose one of {sorted(ENGINES)}")
    if engine == "compiled" and muscle is not PAPER:
        raise ValueError("engine 'compiled' knows the paper's muscle alone; leave the engine out")
    _check_step(step)
    leading = u.shape[:-2]
    q = _per_movement("start", start, leading, 2)
    check_posture(q, "start")
    a = _per_movement("activation", u[..., 0, :] if activation is None else activation, leading, 6)
    check_shares("activation", a)
    check_kind("perturbation", perturbation, Perturbation, "Perturbation(load=1.0), in kg")
    check_load(perturbation.load)
    _check_field(perturbation.field)
    path = ENGINES[engine](u.reshape(-1, *u.shape[-2:]), q, a, perturbation, step, muscle)
    check_sane(path[0])
    return Motion(*(x.reshape(*leading, *x.shape[1:]) for x in path))


def constant_excitation(level: ArrayLike, duration: float, step: float = STEP) -> np.ndarray:
    """Excitations (…, T, 6) for `simulate` that stay at `level` (…, 6) for `duration` in s.

    ValueError for other shapes, levels beyond [0, 1], a step as `simulate` refuses it, or a
    duration that is not finite, or shorter than one step.
    """
    _check_step(step)
    if not is_within(duration, step, np.inf):
        raise ValueError(f"a duration of {short(duration)} s: choose at least {step} s")
    level = as_numbers("level", level)
    if level.shape[-1:] != (6,):
        raise ValueError(f"levels of shape {level.shape}: give one for each of the 6 muscles")
    check_shares("levels", level)
    return np.repeat(level[..., None, :], round(duration / step), axis=-2)


def _per_movement(name, value, leading, size):
    value = as_numbers(name, value)
    shapes = dict.fromkeys(((size,), (*leading, size)))
    if value.shape not in shapes or not np.all(np.isfinite(value)):
        raise ValueError(
            f"{name} must be finite, of shape {' or '.join(map(str, shapes))}: this one has shape "
            f"{value.shape} and {np.isfinite(value).sum()} finite values"
        )
    return np.broadcast_to(value, (*leading, size)).reshape(-1, size)


def _check_step(step):
    if not (is_within(step, 0, 0.01) and step):
        raise ValueError(f"a step of {short(step)} s: Euler's method needs one in (0, 0.01] s")


def _check_field(field):
    if np.shape(field) != (2, 2) or not np.isfinite(as_numbers("field", field)).all():
        raise ValueError(f"field {field} must be a finite (2, 2) matrix in N m s / rad")


def check_sane(q: np.ndarray, first: int = 0) -> None:
    """ValueError where joint angles (B, T, 2) are not finite, or far beyond the joints' limits.

    `first` is the step of the first of them, for what the error says.
    """
    if q.min() > -FARTHEST and q.max() < FARTHEST:
        return
    movement, sample, joint = np.argwhere(~(np.abs(q) < FARTHEST))[0]
    raise ValueError(
        f"movement {movement} blows up: at step {first + sample} a joint is at "
        f"{q[movement, sample, joint]} rad; weaken what pushes the arm, or shorten the step"
    )
