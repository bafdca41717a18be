"""The arm's equations of motion, integrated step by step by one of two engines (Eq. 9–12).

The compiled one is a plain loop over the closed forms of `dynamics`; the other steps MuJoCo. Both
have the same muscles, joint stops and semi-implicit Euler steps.
"""

from copy import copy

import numpy as np

from vmc_lib.arm import dynamics
from vmc_lib.arm.dynamics import (
    FARTHEST,
    equation_12,
    interpolated_paths,
    table_row,
    trig_basis,
    trig_basis_gradient,
)
from vmc_lib.arm.model import F0, L0, LIMITS, SLACK, STEP
from vmc_lib.arm.muscle import PAPER, euler_activation, fibre, musculotendon_force
from vmc_lib.compiled import AVAILABLE, compiled

STOP_STIFFNESS = 200.0  # N m / rad: ours, not arm26's; bone and ligament beyond the joints' limits
STOP_DAMPING = 0.5  # s / rad
NO_PUSH, NO_DRAG, NO_FIELD = np.empty((0, 0, 2)), np.zeros((2, 2)), np.zeros((2, 2))


def activations(excitations, first, muscle=PAPER, step=STEP):
    """Eq. 9 integrated: activations (B, T + 1, 6) from excitations (B, T, 6) and first (B, 6)."""
    steps = np.swapaxes(excitations, 0, 1)
    path = np.empty((len(steps) + 1, *first.shape))
    path[0] = first
    for k, u in enumerate(steps):
        path[k + 1] = muscle.step_activation(u, path[k], step)
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


def muscle_acceleration(q, velocity, activation, strength=1.0):
    """Eq. 10–12: the accelerations (…, 2) of arms at q (…, 2), by muscles and stops.

    Every muscle's torque is multiplied by `strength`.
    """
    torque = strength * muscle_torque(activation, *interpolated_paths(q), velocity)
    return dynamics.joint_acceleration(q, velocity, torque + stop_torque(q, velocity))


def _compiled_engine(excitations, start, first, perturbation, step, muscle):
    """The engine "compiled": q and velocity (B, T + 1, 2), activation (B, T + 1, 6)."""
    u = np.require(excitations, float, "CW")  # of one type: each costs a compilation
    path = allocate_trajectory(u, start, 0, first)
    step_trajectory(u, path, range(u.shape[1]), *perturbation, step=step)
    return path


def allocate_trajectory(excitations, q, velocity, activation):
    """Arrays q, velocity and activation (B, T + 1, …) for excitations (B, T, 6), sample 0 set."""
    batch, steps, _ = excitations.shape
    path = [np.empty((batch, steps + 1, n)) for n in (2, 2, 6)]
    for x, now in zip(path, (q, velocity, activation), strict=True):
        x[:, 0] = now
    return path


def step_trajectory(
    excitations, path, steps, load=0.0, field=NO_FIELD, push=NO_PUSH, drag=NO_DRAG, step=STEP
):
    """Integrate Eq. 9–12 in place, through these steps of an allocated trajectory.

    The arm holds a `load` in kg, in a `field` on its joints. The hand is pushed by `push`,
    (B, T, 2) in N, and by `drag`, (2, 2), times its velocity.
    """
    if np.any(drag) and not len(push):
        push = np.zeros((*excitations.shape[:2], 2))
    arm = dynamics.tables(), dynamics.coefficients(load)
    forces = (np.require(x, float, "CW") for x in (field, push, drag))
    run = _step if AVAILABLE else _step_together
    run(excitations, *path, steps[0], steps[-1] + 1, *arm, *forces, step)


@compiled
def _step(u, q, velocity, activation, first, end, tables, coefficients, field, push, drag, step):
    """Eq. 9–12 of one arm after the other, step by step from the first sample, which is given."""
    entry, torque, terms, jacobian = np.empty((2, 12)), np.empty(2), np.empty(7), np.empty((2, 2))
    term_coefficients, hand_coefficients = coefficients
    for arm in range(len(q)):
        for t in range(first, end):
            w1, w2 = velocity[arm, t, 0], velocity[arm, t, 1]
            for joint in range(2):
                angle, w = q[arm, t, joint], velocity[arm, t, joint]
                torque[joint] = field[joint, 0] * w1 + field[joint, 1] * w2
                torque[joint] += stop_torque(angle, w, LIMITS[joint])
                row, share = table_row(angle, joint)
                for k in range(12):
                    entry[joint, k] = tables[joint, row, k] + share * tables[joint, row, 12 + k]
            for k in range(6):
                a = activation[arm, t, k]
                activation[arm, t + 1, k] = euler_activation(u[arm, t, k], a, step)
                length, r1, r2 = entry[0, k] + entry[1, k], entry[0, 6 + k], entry[1, 6 + k]
                shortening = r1 * w1 + r2 * w2
                pull = musculotendon_force(a, length, shortening, L0[k], SLACK[k], F0[k])
                torque[0] += r1 * pull
                torque[1] += r2 * pull
            if len(push):
                jacobian[:] = 0  # how fast each joint takes the hand along x and y
                for joint, rises in enumerate(trig_basis_gradient(q[arm, t, 0], q[arm, t, 1])):
                    for n, rise in enumerate(rises):
                        for axis in range(2):
                            jacobian[joint, axis] += rise * hand_coefficients[n, axis]
                vx = jacobian[0, 0] * w1 + jacobian[1, 0] * w2
                vy = jacobian[0, 1] * w1 + jacobian[1, 1] * w2
                for axis in range(2):
                    pushed = push[arm, t, axis] + drag[axis, 0] * vx + drag[axis, 1] * vy
                    for joint in range(2):
                        torque[joint] += jacobian[joint, axis] * pushed
            terms[:] = 0
            for n, wave in enumerate(trig_basis(q[arm, t, 0], q[arm, t, 1])):
                for k in range(7):
                    terms[k] += wave * term_coefficients[n, k]
            changes = equation_12(terms, w1, w2, torque[0], torque[1], step)
            for joint in range(2):
                velocity[arm, t + 1, joint] = velocity[arm, t, joint] + step * changes[joint]
                q[arm, t + 1, joint] = q[arm, t, joint] + step * velocity[arm, t + 1, joint]


def _step_together(
    u, q, velocity, activation, first, end, tables, coefficients, field, push, drag, step
):
    """`_step` of all arms at once, in NumPy: for Python without numba, as in the page."""
    for t in range(first, end):
        now, w, a = q[:, t], velocity[:, t], activation[:, t]
        torque = muscle_torque(a, *interpolated_paths(now), w) + stop_torque(now, w) + w @ field.T
        if len(push):
            rises = np.array(trig_basis_gradient(*now.T))
            jacobian = np.einsum("jnb,nx->bjx", rises, coefficients[1][:, :2])
            pushed = push[:, t] + np.einsum("bjx,bj->bx", jacobian, w) @ drag.T
            torque += np.einsum("bjx,bx->bj", jacobian, pushed)
        terms = coefficients[0].T @ trig_basis(*now.T)
        change = equation_12(terms, *w.T, *torque.T, step)
        activation[:, t + 1] = PAPER.step_activation(u[:, t], a, step)
        velocity[:, t + 1] = w + step * np.transpose(change)
        q[:, t + 1] = now + step * velocity[:, t + 1]


def _mujoco_engine(excitations, start, first, perturbation, step, muscle):
    """The engine "mujoco", as `_compiled_engine`."""
    import mujoco
    from mujoco.batch import Batch

    from vmc_lib.arm.arm26 import model_with_load, muscle_paths

    activation = activations(excitations, first, muscle, step)
    model = copy(model_with_load(perturbation.load))
    model.opt.timestep = step
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET  # let a blow-up be seen
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
        if not np.all(np.abs(now[0]) < FARTHEST):
            break
    return *(np.stack(x, axis=1) for x in zip(*path, strict=True)), activation


ENGINES = {"compiled": _compiled_engine, "mujoco": _mujoco_engine}
