"""Forward dynamics (Eq. 9–12): from muscle excitations to a movement, one loop, two engines.

`"mujoco"` steps the MuJoCo model and is the reference; `"closed form"` takes the trigonometric
polynomials of `dynamics` and steps a whole batch of movements at once. Both meet the same muscles
and the same joint stops, with the same semi-implicit Euler steps, of 1 ms unless told otherwise;
the quicker one is taken.
"""

from copy import copy
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco.batch import Batch

from vmc_lib.arm import dynamics
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import F0, L0, LIMITS, SLACK, STEP, loaded, muscle_paths
from vmc_lib.arm.muscle import MAX_VELOCITY, PAPER

STOP_STIFFNESS = 200.0  # N m / rad: ours, not arm26's; bone and ligament beyond the joints' limits
STOP_DAMPING = 0.5  # s / rad
MUJOCO_UP_TO = 4  # movements: as many are quicker in MuJoCo than in the other
LENGTHENING = -1 / (MAX_VELOCITY * L0)  # per metre that a muscle shortens in a second


class Perturbation(NamedTuple):
    """What the arm meets while it moves; as it is here, nothing."""

    load: float = 0.0  # kg, held at the wrist
    field: tuple = ((0.0, 0.0), (0.0, 0.0))  # N m s / rad: torque = field @ joint velocity


UNPERTURBED = Perturbation()


@dataclass(frozen=True, eq=False)
class Motion:
    """A movement, or a batch of them; sample t is the state t steps after the start."""

    q: np.ndarray  # joint angles (…, T + 1, 2), rad
    velocity: np.ndarray  # joint velocities (…, T + 1, 2), rad/s
    activation: np.ndarray  # muscle activations (…, T + 1, 6)

    def __iter__(self):
        """Every movement of a batch, or the one there is, as a `Motion` of its own."""
        parts = (x.reshape(-1, *x.shape[-2:]) for x in (self.q, self.velocity, self.activation))
        return (Motion(*one) for one in zip(*parts, strict=True))

    @property
    def hand(self):
        """The wrist's path (…, T + 1, 3) in the shoulder frame, m."""
        return hand(self.q)

    @property
    def reached(self):
        """Where in the arm's plane the wrist ended: p = (x, y), (…, 2), m."""
        return hand(self.q[..., -1, :])[..., :2]

    @property
    def end_speed(self):
        """The faster joint's speed at the end, (…), rad/s."""
        return np.abs(self.velocity[..., -1, :]).max(axis=-1)


def simulate(
    excitations,
    start,
    activation=None,
    engine=None,
    perturbation=UNPERTURBED,
    muscle=PAPER,
    step=STEP,
):
    """The `Motion` that excitations (…, T, 6), one every `step` seconds, give the arm.

    It starts still, in the posture `start` (…, 2), with the muscles' `activation` (…, 6); by
    default they have settled to the first excitation. `engine` names one of `ENGINES`; by default
    it is MuJoCo for up to `MUJOCO_UP_TO` movements and the closed form for more. `perturbation` may
    load its hand or push it about, and `muscle` may be another `Muscle` than the paper's.
    ValueError when an excitation is not a number in [0, 1], a shape is wrong, or a step too long.
    """
    u = np.asarray(excitations, dtype=float)
    if u.ndim < 2 or u.shape[-1] != len(F0) or 0 in u.shape:
        raise ValueError(f"excitations have shape {u.shape}; use (T, 6) or (…, T, 6), T ≥ 1")
    if not (np.all(u >= 0) and np.all(u <= 1)):
        raise ValueError(f"excitations lie in [{u.min():.3g}, {u.max():.3g}]; clip them to [0, 1]")
    if engine not in (None, *ENGINES):
        raise ValueError(f"engine {engine!r} is unknown; choose one of {sorted(ENGINES)}")
    if not 0 < step <= 0.01:
        raise ValueError(f"steps of {step} s would blow up or stand still; choose up to 0.01 s")
    leading = u.shape[:-2]
    q = _each("start", start, leading, 2)
    first = _each("activation", u[..., 0, :] if activation is None else activation, leading, 6)
    a = activations(u.reshape(-1, *u.shape[-2:]), first, muscle, step)
    engine = engine or ("mujoco" if len(q) <= MUJOCO_UP_TO else "closed form")
    path = _move(ENGINES[engine](q, perturbation.load, step), a, perturbation.field, muscle)
    return Motion(*(x.reshape(*leading, *x.shape[1:]) for x in (*path, a)))


def steady(level, duration, step=STEP):
    """Excitations (…, T, 6) for `simulate` that stay at `level` (…, 6) for `duration` in s.

    ValueError when the duration is not finite, or shorter than one step.
    """
    if not step <= duration < np.inf:
        raise ValueError(f"a duration of {duration} s: choose at least {step} s")
    return np.repeat(np.asarray(level, dtype=float)[..., None, :], round(duration / step), axis=-2)


def _each(name, value, leading, size):
    value = np.asarray(value, dtype=float)
    if value.shape not in ((size,), (*leading, size)) or not np.all(np.isfinite(value)):
        raise ValueError(
            f"{name} must be finite, of shape ({size},) or {(*leading, size)}: this one has shape "
            f"{value.shape} and {np.isfinite(value).sum()} finite values"
        )
    return np.broadcast_to(value, (*leading, size)).reshape(-1, size)


def activations(excitations, first, muscle=PAPER, step=STEP):
    """Eq. 9 integrated: activations (B, T + 1, 6) from excitations (B, T, 6) and first (B, 6)."""
    steps = np.swapaxes(excitations, 0, 1)
    path = np.empty((len(steps) + 1, *first.shape))
    path[0] = first
    for k, u in enumerate(steps):
        path[k + 1] = path[k] + step * muscle.activation_rate(u, path[k])
    return np.swapaxes(path, 0, 1)


def muscle_torque(activation, lengths, arms, velocity, muscle=PAPER):
    """Joint torques (…, 2) in N m of muscles at these lengths (…, 6) and moment arms (…, 2, 6)."""
    pull = muscle.force(activation, *fibres(lengths, arms, velocity), F0)
    return np.einsum("...jk,...k", arms, pull)


def fibres(lengths, arms, velocity):
    """The fibres' lengths and velocities (…, 6), normalised as Eq. 10 and 11 take them."""
    shortening = np.einsum("...jk,...j", arms, velocity)
    return (lengths - SLACK) / L0, shortening * LENGTHENING


def stop_torque(q, velocity):
    """Torques (…, 2) of the joints' stops: a damped spring beyond the limits, nothing within."""
    beyond = q - q.clip(*LIMITS.T)
    return -STOP_STIFFNESS * (beyond + STOP_DAMPING * np.abs(beyond) * velocity)


def _move(arm, activation, field, muscle):
    """Eq. 12 step by step: q and velocity (B, T + 1, 2) of an engine's arms."""
    q, velocity = (np.empty((activation.shape[1], *arm.q.shape)) for _ in range(2))
    push = np.transpose(field)
    for k, a in enumerate(np.swapaxes(activation, 0, 1)):
        q[k], velocity[k] = arm.q, arm.velocity
        torque = muscle_torque(a, *arm.paths(), arm.velocity, muscle)
        torque += stop_torque(arm.q, arm.velocity) + arm.velocity @ push
        arm.step(torque)
    return np.swapaxes(q, 0, 1), np.swapaxes(velocity, 0, 1)


class ClosedForm:
    """A batch of arms, all at once: postures and velocities (B, 2)."""

    def __init__(self, start, load, step):
        self.q, self.velocity = start, np.zeros_like(start)
        self.load, self.seconds = load, step

    def paths(self):
        """Where the muscles are now: lengths (B, 6) and moment arms (B, 2, 6)."""
        return dynamics.paths(self.q)

    def step(self, torque):
        """Move on by one step under joint torques (B, 2)."""
        acceleration = dynamics.acceleration_from(
            self.q, self.velocity, torque, self.load, self.seconds
        )
        self.velocity = self.velocity + self.seconds * acceleration
        self.q = self.q + self.seconds * self.velocity


class MuJoCo:
    """The same arms, each stepped by MuJoCo; `q` and `velocity` are views of its states."""

    def __init__(self, start, load, step):
        model = copy(loaded(load))
        model.opt.timestep = step
        self.arms = Batch(model, len(start), nthread=1, persistent=True)
        self.q, self.velocity = self.arms.bind("qpos"), self.arms.bind("qvel")
        self.q[:] = start
        self.paths()  # before the first computation: from then on MuJoCo keeps them current
        self.arms.forward(stage=mujoco.mjtStage.mjSTAGE_VEL)

    def paths(self):
        """As `ClosedForm.paths`."""
        return muscle_paths(self.arms)

    def step(self, torque):
        """As `ClosedForm.step`."""
        self.arms.qfrc_applied = torque
        self.arms.step(stage=mujoco.mjtStage.mjSTAGE_VEL)


ENGINES = {"closed form": ClosedForm, "mujoco": MuJoCo}
