"""Forward dynamics (Eq. 9–12): from muscle excitations to a movement, one interface, two engines.

`"mujoco"` steps the MuJoCo model and is the reference; `"closed form"` steps a whole batch of
movements at once and is the one to use for hundreds. Both call the same muscle law and the same
joint stops, with the same semi-implicit Euler steps of 1 ms.
"""

from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np

from . import closed_form
from .closed_form import hand
from .model import F0, L0, LIMITS, SLACK, STEP, holding, muscle_paths
from .muscle import MAX_VELOCITY, activation_rate, force

STOP_STIFFNESS = 200.0  # N m / rad: ours, not arm26's; bone and ligament beyond the joints' limits
STOP_DAMPING = 0.5  # s / rad


class World(NamedTuple):
    """What the arm meets while it moves; as it is here, nothing."""

    load: float = 0.0  # kg, held at the wrist
    field: tuple = ((0.0, 0.0), (0.0, 0.0))  # N m s / rad: torque = field @ joint velocity


EMPTY = World()


@dataclass(frozen=True)
class Motion:
    """A movement, or a batch of them; sample t is the state t milliseconds after the start."""

    q: np.ndarray  # joint angles (…, T + 1, 2), rad
    velocity: np.ndarray  # joint velocities (…, T + 1, 2), rad/s
    activation: np.ndarray  # muscle activations (…, T + 1, 6)

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


def simulate(excitations, start, activation=None, engine="closed form", world=EMPTY):
    """The `Motion` that excitations (…, T, 6), sampled at 1 kHz, give the arm.

    It starts still, in the posture `start` (…, 2), with the muscles' `activation` (…, 6); by
    default they have settled to the first excitation. `world` may load its hand or push it about.
    ValueError when an excitation is not a number in [0, 1], or a shape is wrong.
    """
    u = np.asarray(excitations, dtype=float)
    if u.ndim < 2 or u.shape[-1] != len(F0) or 0 in u.shape:
        raise ValueError(f"excitations have shape {u.shape}; use (T, 6) or (…, T, 6), T ≥ 1")
    if not (np.all(u >= 0) and np.all(u <= 1)):
        raise ValueError(f"excitations lie in [{u.min():.3g}, {u.max():.3g}]; clip them to [0, 1]")
    if engine not in ENGINES:
        raise ValueError(f"engine {engine!r} is unknown; choose one of {sorted(ENGINES)}")
    leading = u.shape[:-2]
    q = _each("start", start, leading, 2)
    first = _each("activation", u[..., 0, :] if activation is None else activation, leading, 6)
    a = activations(u.reshape(-1, *u.shape[-2:]), first)
    path = ENGINES[engine](a, q, world)
    return Motion(*(x.reshape(*leading, *x.shape[1:]) for x in (*path, a)))


def _each(name, value, leading, size):
    value = np.asarray(value, dtype=float)
    if value.shape not in ((size,), (*leading, size)) or not np.all(np.isfinite(value)):
        raise ValueError(f"{name} must be finite, of shape ({size},) or {(*leading, size)}")
    return np.broadcast_to(value, (*leading, size)).reshape(-1, size)


def activations(excitations, first):
    """Eq. 9 integrated: activations (B, T + 1, 6) from excitations (B, T, 6) and first (B, 6)."""
    steps = np.swapaxes(excitations, 0, 1)
    path = np.empty((len(steps) + 1, *first.shape))
    path[0] = first
    for k, u in enumerate(steps):
        path[k + 1] = path[k] + STEP * activation_rate(u, path[k])
    return np.swapaxes(path, 0, 1)


def muscle_torque(activation, lengths, arms, velocity):
    """Joint torques (…, 2) in N m of muscles at these lengths (…, 6) and moment arms (…, 2, 6)."""
    pull = force(activation, *fibres(lengths, arms, velocity), F0)
    return np.einsum("...jk,...k", arms, pull)


def fibres(lengths, arms, velocity):
    """The fibres' lengths and velocities (…, 6), normalised as Eq. 10 and 11 take them."""
    shortening = np.einsum("...jk,...j", arms, velocity)
    return (lengths - SLACK) / L0, -shortening / (MAX_VELOCITY * L0)


def stop_torque(q, velocity):
    """Torques (…, 2) of the joints' stops: a damped spring beyond the limits, nothing within."""
    beyond = q - np.clip(q, *LIMITS.T)
    return -STOP_STIFFNESS * (beyond + STOP_DAMPING * np.abs(beyond) * velocity)


def _closed_form(activation, start, world):
    q, velocity = (np.empty((activation.shape[1], *start.shape)) for _ in range(2))
    q[0], velocity[0], push = start, 0, np.transpose(world.field)
    for k, a in enumerate(np.swapaxes(activation[:, :-1], 0, 1)):
        torque = muscle_torque(a, *closed_form.paths(q[k]), velocity[k])
        torque += stop_torque(q[k], velocity[k]) + velocity[k] @ push
        acceleration = closed_form.acceleration_from(q[k], velocity[k], torque, world.load)
        velocity[k + 1] = velocity[k] + STEP * acceleration
        q[k + 1] = q[k] + STEP * velocity[k + 1]
    return np.swapaxes(q, 0, 1), np.swapaxes(velocity, 0, 1)


def _mujoco(activation, start, world):
    q, velocity = (np.empty((*activation.shape[:2], 2)) for _ in range(2))
    data = mujoco.MjData(model := holding(world.load))
    for b, posture in enumerate(start):
        mujoco.mj_resetData(model, data)
        data.qpos = q[b, 0] = posture
        velocity[b, 0] = 0
        for k, a in enumerate(activation[b, :-1]):
            mujoco.mj_step1(model, data)
            torque = muscle_torque(a, *muscle_paths(data), data.qvel)
            torque += stop_torque(data.qpos, data.qvel) + world.field @ data.qvel
            data.qfrc_applied = torque
            mujoco.mj_step2(model, data)
            q[b, k + 1], velocity[b, k + 1] = data.qpos, data.qvel
    return q, velocity


ENGINES = {"closed form": _closed_form, "mujoco": _mujoco}
