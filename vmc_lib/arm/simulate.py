"""Forward dynamics (Eq. 9–12): from muscle excitations to a movement, by one of two engines.

`"compiled"` takes the trigonometric polynomials of `dynamics` and is one plain loop, compiled;
`"mujoco"` steps the MuJoCo model and is the reference, and the engine for other muscles than the
paper's. Both meet the same muscles and the same joint stops, with the same semi-implicit Euler
steps, of 1 ms unless told otherwise.
"""

from copy import copy
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco.batch import Batch

from vmc_lib.arm import dynamics
from vmc_lib.arm.dynamics import accelerations, hand, row_of, turns, waves
from vmc_lib.arm.model import F0, L0, LIMITS, SLACK, STEP, loaded, muscle_paths
from vmc_lib.arm.muscle import PAPER, activated, fibre, tension
from vmc_lib.compiled import compiled

STOP_STIFFNESS = 200.0  # N m / rad: ours, not arm26's; bone and ligament beyond the joints' limits
STOP_DAMPING = 0.5  # s / rad


class Perturbation(NamedTuple):
    """What the arm meets while it moves; as it is here, nothing."""

    load: float = 0.0  # kg, held at the wrist
    field: tuple = ((0.0, 0.0), (0.0, 0.0))  # N m s / rad: torque = field @ joint velocity


UNPERTURBED = Perturbation()
UNPUSHED, UNDRAGGED = np.empty((0, 0, 2)), np.zeros((2, 2))


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
    it is the compiled one, or MuJoCo where `muscle` is another `Muscle` than the paper's.
    `perturbation` may load its hand or push it about. ValueError when an excitation is not a
    number in [0, 1], a shape is wrong, a step too long, or the engine not made for this muscle.
    """
    u = np.asarray(excitations, dtype=float)
    if u.ndim < 2 or u.shape[-1] != len(F0) or 0 in u.shape:
        raise ValueError(f"excitations have shape {u.shape}; use (T, 6) or (…, T, 6), T ≥ 1")
    if not (np.all(u >= 0) and np.all(u <= 1)):
        raise ValueError(f"excitations lie in [{u.min():.3g}, {u.max():.3g}]; clip them to [0, 1]")
    engine = engine or ("compiled" if muscle is PAPER else "mujoco")
    if engine not in ENGINES:
        raise ValueError(f"engine {engine!r} is unknown; choose one of {sorted(ENGINES)}")
    if engine == "compiled" and muscle is not PAPER:
        raise ValueError("engine 'compiled' knows the paper's muscle alone; leave the engine out")
    if not 0 < step <= 0.01:
        raise ValueError(f"steps of {step} s would blow up or stand still; choose up to 0.01 s")
    leading = u.shape[:-2]
    q = _each("start", start, leading, 2)
    a = _each("activation", u[..., 0, :] if activation is None else activation, leading, 6)
    path = ENGINES[engine](u.reshape(-1, *u.shape[-2:]), q, a, perturbation, step, muscle)
    return Motion(*(x.reshape(*leading, *x.shape[1:]) for x in path))


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
    return fibre(lengths, shortening, L0, SLACK)


def stop_torque(q, velocity, limits=LIMITS.T):
    """Torques (…, 2) of the joints' stops: a damped spring beyond the limits, nothing within."""
    low, high = limits
    beyond = q - np.minimum(np.maximum(q, low), high)
    return -STOP_STIFFNESS * (beyond + STOP_DAMPING * np.abs(beyond) * velocity)


def acceleration(q, velocity, activation, strength=1.0):
    """Eq. 10–12: the accelerations (…, 2) of arms at q (…, 2), by muscles and stops.

    The muscles are `strength` times as strong as they are.
    """
    torque = strength * muscle_torque(activation, *dynamics.paths(q), velocity)
    return dynamics.acceleration_from(q, velocity, torque + stop_torque(q, velocity))


def _in_one_loop(excitations, start, first, perturbation, step, muscle):
    """The engine "compiled": q and velocity (B, T + 1, 2), activation (B, T + 1, 6)."""
    told = np.require(excitations, float, "CW")  # of one type: each costs a compilation
    path = begun(told, start, 0, first)
    advance(told, path, range(told.shape[1]), perturbation, step)
    return path


def begun(excitations, q, velocity, activation):
    """The paths of q, velocity and activation, (B, T + 1, …), with the first sample alone.

    Room for what excitations (B, T, 6) will make of it.
    """
    batch, steps, _ = excitations.shape
    path = [np.empty((batch, steps + 1, n)) for n in (2, 2, 6)]
    for x, now in zip(path, (q, velocity, activation), strict=True):
        x[:, 0] = now
    return path


def advance(told, path, steps, perturbation=UNPERTURBED, step=STEP, push=UNPUSHED, drag=UNDRAGGED):
    """Go on along a path that has `begun`, in place, through these of its steps, by Eq. 9–12.

    The hand is pushed by `push`, (B, T, 2) in N, and by `drag`, (2, 2), times its velocity.
    """
    arm = dynamics.tables(), *dynamics.coefficients(perturbation.load)
    world = (np.require(x, float, "CW") for x in (perturbation.field, push, drag))
    _move(told, *path, steps[0], steps[-1] + 1, *arm, *world, step)


@compiled
def _move(
    told, q, velocity, activation, first, end, tables, terms_of, hand_of, field, push, drag, step
):
    """Eq. 9–12 of one arm after the other, step by step from the first sample, which is given."""
    entry, torque, terms, slope = np.empty((2, 12)), np.empty(2), np.empty(7), np.empty((2, 2))
    for arm in range(len(q)):
        for t in range(first, end):
            w1, w2 = velocity[arm, t, 0], velocity[arm, t, 1]
            for joint in range(2):
                angle, w = q[arm, t, joint], velocity[arm, t, joint]
                torque[joint] = field[joint, 0] * w1 + field[joint, 1] * w2
                torque[joint] += stop_torque(angle, w, LIMITS[joint])
                row, share = row_of(angle, joint)
                for k in range(12):
                    entry[joint, k] = tables[joint, row, k] + share * tables[joint, row, 12 + k]
            for k in range(6):
                a = activation[arm, t, k]
                activation[arm, t + 1, k] = activated(told[arm, t, k], a, step)
                length, r1, r2 = entry[0, k] + entry[1, k], entry[0, 6 + k], entry[1, 6 + k]
                pull = tension(a, length, r1 * w1 + r2 * w2, L0[k], SLACK[k], F0[k])
                torque[0] += r1 * pull
                torque[1] += r2 * pull
            if len(push):
                slope[:] = 0  # how fast each joint takes the hand along x and y
                for joint, rises in enumerate(turns(q[arm, t, 0], q[arm, t, 1])):
                    for n, rise in enumerate(rises):
                        for axis in range(2):
                            slope[joint, axis] += rise * hand_of[n, axis]
                vx = slope[0, 0] * w1 + slope[1, 0] * w2
                vy = slope[0, 1] * w1 + slope[1, 1] * w2
                for axis in range(2):
                    force = push[arm, t, axis] + drag[axis, 0] * vx + drag[axis, 1] * vy
                    for joint in range(2):
                        torque[joint] += slope[joint, axis] * force
            terms[:] = 0
            for n, wave in enumerate(waves(q[arm, t, 0], q[arm, t, 1])):
                for k in range(7):
                    terms[k] += wave * terms_of[n, k]
            changes = accelerations(terms, w1, w2, torque[0], torque[1], step)
            for joint in range(2):
                velocity[arm, t + 1, joint] = velocity[arm, t, joint] + step * changes[joint]
                q[arm, t + 1, joint] = q[arm, t, joint] + step * velocity[arm, t + 1, joint]


def _in_mujoco(excitations, start, first, perturbation, step, muscle):
    """The engine "mujoco", as `_in_one_loop`."""
    activation = activations(excitations, first, muscle, step)
    model = copy(loaded(perturbation.load))
    model.opt.timestep = step
    arms = Batch(model, len(start), nthread=1, persistent=True)
    now = arms.bind("qpos"), arms.bind("qvel")  # views of its states
    now[0][:] = start
    muscle_paths(arms)  # before the first computation: from then on MuJoCo keeps them current
    arms.forward(stage=mujoco.mjtStage.mjSTAGE_VEL)
    path = [[x.copy() for x in now]]
    for a in np.swapaxes(activation, 0, 1)[:-1]:
        torque = muscle_torque(a, *muscle_paths(arms), now[1], muscle)
        arms.qfrc_applied = torque + stop_torque(*now) + now[1] @ np.transpose(perturbation.field)
        arms.step(stage=mujoco.mjtStage.mjSTAGE_VEL)
        path.append([x.copy() for x in now])
    return *(np.stack(x, axis=1) for x in zip(*path, strict=True)), activation


ENGINES = {"compiled": _in_one_loop, "mujoco": _in_mujoco}
