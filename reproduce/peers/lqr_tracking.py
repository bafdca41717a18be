"""LQR tracking, a third rival: commands of least effort, corrected on the way.

Todorov and Jordan (2002) took for the brain's aim not the best commands but the best *corrections*:
those that disturb the task least, for the least change of command. A deviation that does not matter
to the task is left alone. Here the commands are given, `optimal_control`'s, and deviations small:
so the arm is taken to be linear in them, step by step, and the best gains follow from the end
backwards (Riccati's equation). The state is all that there is to know of the arm: angles, speeds
and activations (10,); it is known exactly, and noise is not reckoned with. A controller whose
senses err, and which reckons with noise, is `lqg`'s. The task is that of `minimum_variance`: be
there, still, during the hold.
"""

from typing import NamedTuple

import numpy as np

from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.engines import allocate_trajectory, step_trajectory
from vmc_lib.arm.model import STEP
from vmc_lib.motor.feedback import TICK
from vmc_lib.motor.inverse_dynamics import MOVING
from vmc_lib.motor.templates import keep_last, reach

PLACE, SPEED, CHANGE = 0.005, 0.05, 0.1  # m, m/s, of a command: these three weigh the same
COMMAND_PRICE = np.eye(6) / CHANGE**2
NUDGE = 1e-5


def next_states(state, commands):
    """States (…, 10) a tick later, under commands (…, TICK, 6)."""
    u = np.ascontiguousarray(np.reshape(commands, (-1, TICK, 6)))
    q, velocity, activation = np.split(state.reshape(-1, 10), [2, 4], axis=-1)
    path = allocate_trajectory(u, q, velocity, activation)
    step_trajectory(u, path, range(TICK))
    return np.concatenate([x[:, -1] for x in path], axis=-1).reshape(state.shape)


def in_ticks(excitations):
    """Excitations (…, T, 6) tick by tick, (…, T / TICK, TICK, 6)."""
    return excitations.reshape(*excitations.shape[:-2], -1, TICK, excitations.shape[-1])


def states(excitations):
    """The states (…, ticks + 1, 10) that excitations (…, T, 6), and their hold, lead through."""
    motion = reach(excitations)
    whole = np.concatenate([motion.q, motion.velocity, motion.activation], axis=-1)
    return whole[..., ::TICK, :]


def linearise(state, commands):
    """Linearised dynamics: Jacobians of the next state, (…, 10, 10) and (…, 10, 6)."""
    nudges = NUDGE * np.eye(16)
    ends = [
        next_states(
            state[..., None, :] + side[:, :10], commands[..., None, :, :] + side[:, None, 10:]
        )
        for side in (nudges, -nudges)
    ]
    return np.split(np.swapaxes(np.subtract(*ends), -1, -2) / (2 * NUDGE), [10], axis=-1)


def observe(state):
    """Observation: the hand's place and velocity, in units that weigh the same, (…, 4)."""
    q, velocity, _ = np.split(state, [2, 4], axis=-1)
    ahead = hand(q + STEP * velocity)[..., :2]
    place = hand(q)[..., :2]
    return np.concatenate([place / PLACE, (ahead - place) / STEP / SPEED], axis=-1)


def observation_slopes(state):
    """Jacobians of `observe` at states (…, 10), (…, 4, 10)."""
    nudges = NUDGE * np.eye(10)
    C = observe(state[..., None, :] + nudges) - observe(state[..., None, :] - nudges)
    return np.swapaxes(C, -1, -2) / (2 * NUDGE)


def deviation_price(state, since=MOVING // TICK):
    """What small deviations cost along states (…, ticks + 1, 10): matrices, 0 before a tick."""
    C = observation_slopes(state)
    price = np.swapaxes(C, -1, -2) @ C
    price[..., :since, :, :] = 0
    return price


def gains(state, commands, since=MOVING // TICK):
    """The best gains (…, ticks, 6, 10) along states (…, ticks + 1, 10), and the arm's slopes.

    A correction is minus the gain times the deviation. Paid for are corrections, and deviations
    `since` a tick: the hold's alone, or with 0 the whole way's.
    """
    A, B = linearise(state[..., :-1, :], commands)
    price = deviation_price(state, since)
    ahead, found = price[..., -1, :, :], []
    for t in reversed(range(commands.shape[-3])):
        a, b = A[..., t, :, :], B[..., t, :, :]
        back = np.swapaxes(b, -1, -2) @ ahead
        gain = np.linalg.solve(COMMAND_PRICE + back @ b, back @ a)
        ahead = price[..., t, :, :] + np.swapaxes(a, -1, -2) @ ahead @ (a - b @ gain)
        found.append(gain)
    return np.stack(found[::-1], axis=-3), A, B


class FeedbackLaw(NamedTuple):
    """Commands, the states they should lead to, and the gains that correct deviations."""

    commands: np.ndarray  # (n, ticks, TICK, 6)
    reference: np.ndarray  # (n, ticks + 1, 10)
    gains: np.ndarray  # (n, ticks, 6, 10)
    A: np.ndarray  # (n, ticks, 10, 10)
    B: np.ndarray  # (n, ticks, 10, 6)


def feedback_law(excitations, since=MOVING // TICK):
    """The LQR law along commands (n, T, 6), and through the hold; `since` as for `gains`."""
    commands, reference = in_ticks(keep_last(excitations)), states(excitations)
    return FeedbackLaw(commands, reference, *gains(reference, commands, since))


def move(law, share, late=0):
    """Where hands go (…, n, ticks + 1, 2) in m, and the commands (…, n, T, 6).

    They get a `share` (…, n, T, 6) of it, as far as there is more. Deviations are known `late` by
    so many ticks; what has become of them since is foreseen by the law's own slopes.
    """
    share = in_ticks(share)
    now = np.broadcast_to(law.reference[:, 0], (*share.shape[:-3], 10))
    way, off, changes, commands = [now], [], [], []
    for t in range(law.commands.shape[1]):
        off.append(now - law.reference[:, t])
        known = max(t - late, 0)
        here = off[known]
        for k in range(known, t):
            here = _times(law.A[:, k], here) + _times(law.B[:, k], changes[k])
        change = -_times(law.gains[:, t], here)[..., None, :]
        commands.append(np.clip(law.commands[:, t] + change, 0, 1))
        changes.append((commands[-1] - law.commands[:, t]).mean(axis=-2))
        now = next_states(now, np.clip(commands[-1] * share[..., t, :, :], 0, 1))
        way.append(now)
    path = hand(np.stack(way, axis=-2)[..., :2])[..., :2]
    return path, np.concatenate(commands, axis=-2)


def scatter(path):
    """The standard deviation in m of repeated paths (repeats, …, ticks, 2), (…, ticks)."""
    return np.sqrt(path.var(axis=0, ddof=1).mean(axis=-1))


def _times(matrix, vector):
    return (matrix @ vector[..., None])[..., 0]
