"""LQG control: optimal feedback by an arm whose senses are late and err, and whose muscles waver.

What a nervous system has to do, in the field's own terms (Todorov & Jordan 2002). The price of a
reach is, tick by tick, that of the hand's place and speed while it should be at rest on its target,
and that of the whole command u::

    J = Σ_t w_t |y(x_t) − y*|² + r |u_t|².

*Controller.* The arm is linearised along a reach, the best change of all its commands follows from
the end backwards (Riccati), the arm makes the changed reach, and so on until nothing is gained. No
command leaves [0, 1]: at each tick the best one within is taken, and those at a bound get no
feedback (Tassa, Mansard & Todorov 2014, Control-limited differential dynamic programming). As noise
grows with the command (Harris & Wolpert 1998), it raises a command's price by the scatter that it
will cause, σ² (BᵀSB)_ii u_i² (Todorov 2005).

*Estimator.* The senses report angles and speeds some ticks late, and err. The state is augmented by
the reports on their way, z = (x_t, s_t−1, …, s_t−d), so that the late report is a part of the
present state; then the Kalman filter of `state_estimation` serves. Corrections and filter are
worked out one after the other; Todorov (2005) goes on to fit each to the other's noise.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from reproduce.peers.lqr_tracking import (
    PLACE,
    linearise,
    next_states,
    observation_slopes,
    observe,
)
from reproduce.peers.optimal_control import CLEARANCE
from reproduce.peers.state_estimation import kalman_gains
from vmc_lib.arm.dynamics import hand, paths
from vmc_lib.arm.engines import fibres
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import add_noise, euler_activation, noisy
from vmc_lib.camera import TABLE
from vmc_lib.data import arrays
from vmc_lib.motor.feedback import REFLEX, TICK
from vmc_lib.motor.inverse_dynamics import MOVING, bounded_least_squares
from vmc_lib.motor.templates import START

SENSED = np.eye(4, 10)  # of the state: angles and speeds
ERRORS = np.array([0.01, 0.01, 0.1, 0.1])  # rad and rad/s: a few mm, and a few cm/s, at the hand
PRICE = 3.0  # of a command's square, where 5 mm or 50 mm/s cost 1 at every tick
EVERY_WAY = (1.0, 1.0)  # a miss forward costs, and one upwards
SPINAL = round(REFLEX.spinal / (TICK * STEP))  # ticks
SETTLED = 300  # ms in which a muscle's mean pull is measured
ENOUGH = 1e-4  # of its cost: what a better reach must gain
STEPS = 0.5 ** np.arange(6)  # of a change of the commands, as far as it makes the reach cheaper


class Law(NamedTuple):
    """What to command on the way to a target."""

    commands: np.ndarray  # (T, 6), one for each tick
    reference: np.ndarray  # (T + 1, 10): the states that they lead to, without noise
    gains: np.ndarray  # (T, 6, 10): by what a deviation is corrected
    A: np.ndarray  # (T, 10, 10)
    B: np.ndarray  # (T, 10, 6)


def rest():
    """The state (10,) in which every reach begins."""
    return np.concatenate([START, np.zeros(2), arrays("rest")["activation"]])


def roll_out(commands, reference=None, change=0.0, gains=None):
    """States (…, T + 1, 10) and commands (…, T, 6): what the arm does, without noise.

    Of the commands plus their `change`, and minus gains times deviations from a reference.
    """
    wanted = np.clip(commands + change, 0, 1)
    states, sent = [np.broadcast_to(rest(), (*wanted.shape[:-2], 10))], []
    for t in range(wanted.shape[-2]):
        u = wanted[..., t, :]
        if gains is not None:
            u = np.clip(u - (gains[t] @ (states[-1] - reference[t])[..., None])[..., 0], 0, 1)
        sent.append(u)
        states.append(next_states(states[-1], np.repeat(u[..., None, :], TICK, axis=-2)))
    return np.stack(states, axis=-2), np.stack(sent, axis=-2)


def task_errors(states, target, axes=EVERY_WAY):
    """What reaches (…, T + 1, 10) to a target (2,) pay for, in units that cost 1: (…, T + 1, 5).

    Once the hand should be there, its place and speed; all the way, how far it is below the table.
    `axes` weigh the place along x and y.
    """
    off = (observe(states) - [*target / PLACE, 0, 0]) * [*axes, 1, 1]
    off[..., : MOVING // TICK, :] = 0
    height = hand(states[..., :2])[..., 1] - TABLE - CLEARANCE
    return np.concatenate([off, np.minimum(height, 0)[..., None] / PLACE], axis=-1)


def task_slopes(states, axes=EVERY_WAY):
    """Jacobians of `task_errors` along a reach (T + 1, 10), (T + 1, 5, 10)."""
    C = observation_slopes(states)
    low = hand(states[:, :2])[:, 1] < TABLE + CLEARANCE
    off = C * np.array([*axes, 1, 1])[:, None]
    off[: MOVING // TICK] = 0
    return np.concatenate([off, C[:, 1:2] * low[:, None, None]], axis=1)


def cost(states, commands, target, price=PRICE, axes=EVERY_WAY):
    """What reaches (…, T + 1, 10) cost without their noise, (…,)."""
    off = np.square(task_errors(states, target, axes)).sum((-1, -2))
    return off + price * np.square(commands).sum((-1, -2))


def riccati(states, commands, A, B, target, price=PRICE, axes=EVERY_WAY, share=0.0):
    """The best changes (T, 6) of commands, and the gains (T, 6, 10) that correct deviations.

    From the end backwards; xᵀSx + 2sᵀx is what a deviation x costs from here on.
    """
    C, y = task_slopes(states, axes), task_errors(states, target, axes)
    S, s, found = C[-1].T @ C[-1], C[-1].T @ y[-1], []
    for t in reversed(range(len(commands))):
        a, b, u = A[t], B[t], commands[t]
        back = b.T @ S
        r = price + share**2 * np.diag(back @ b)  # of a command's square, its noise included
        M, slope = back @ b + np.diag(r), b.T @ s + r * u
        root = np.linalg.cholesky(M).T
        best = bounded_least_squares(root, root @ u - np.linalg.solve(root.T, slope))
        free, change = (best > 0) & (best < 1), best - u
        L = np.zeros((6, 10))
        L[free] = np.linalg.solve(M[free][:, free], (back @ a)[free])
        closed = a - b @ L
        s = C[t].T @ y[t] + closed.T @ (s + S @ b @ change) - L.T @ (r * best)
        S = C[t].T @ C[t] + closed.T @ S @ closed + L.T * r @ L
        found.append((change, L))
    return tuple(np.array(x[::-1]) for x in zip(*found, strict=True))


def solve(commands, target, price=PRICE, axes=EVERY_WAY, share=0.0, most=100):
    """A `Law`, of one target (2,), from some commands (T, 6) on: linearise, improve, and again.

    RuntimeError where `most` improvements are not enough.
    """
    how = target, price, axes
    states, commands = roll_out(commands)
    paid = cost(states, commands, *how)
    for _ in range(most):
        A, B = linearise(states[:-1], np.repeat(commands[:, None], TICK, axis=1))
        change, gains = riccati(states, commands, A, B, *how, share)
        tried = roll_out(commands, states, STEPS[:, None, None] * change, gains)
        costs = cost(*tried, *how)
        best = costs.argmin()
        if not costs[best] < paid * (1 - ENOUGH):
            return Law(commands, states, gains, A, B)
        paid, states, commands = costs[best], tried[0][best], tried[1][best]
    raise RuntimeError(f"no end of improvements for the target {target} m")


def switch(first, second, tick):
    """The `Law` that is the first until a tick, and the second from then on."""
    return Law(*(np.concatenate([x[:tick], y[tick:]]) for x, y in zip(first, second, strict=True)))


def per_tick(share):
    """How much a tick's mean command wavers where each of its milliseconds wavers by a share."""
    return share / TICK**0.5


def augment(A, late):
    """The state with the reports on their way: slopes (T, n, n), and what arrives of it (T, 4, n).

    After the state comes what was sensed one tick ago, two, … `late` ago: n is 10 + 4 `late`.
    """
    size = 10 + 4 * late
    whole, arrives = np.zeros((len(A), size, size)), np.zeros((len(A), 4, size))
    whole[:, :10, :10] = A
    if late:
        whole[:, 10:14, :10] = SENSED
        whole[:, 14:, 10:-4] = np.eye(size - 14)
        arrives[:, :, -4:] = np.eye(4)
    else:
        arrives[:] = SENSED
    return whole, arrives


def filter_gains(law, late, share, error=ERRORS):
    """Kalman gains (T, n, 4) of an arm whose senses are so many ticks late."""
    whole, arrives = augment(law.A, late)
    spread = share * law.B * law.commands[:, None]
    process = np.zeros_like(whole)
    process[:, :10, :10] = spread @ np.swapaxes(spread, -1, -2)
    return kalman_gains(whole, arrives, process, error)


@cache
def mean_pulls(share):
    """Commands, and what constant ones they pull like on average when they waver: both (n,).

    By Eq. 9 a muscle is quicker to pull than to let go: the more its command wavers, the more it
    pulls.
    """
    levels, rng = np.linspace(0, 1, 41), np.random.default_rng(0)
    a, mean = np.tile(levels, (500, 1)), 0.0
    for _ in range(SETTLED):
        a = euler_activation(noisy(np.broadcast_to(levels, a.shape), share, rng), a, STEP)
        mean = mean + a.mean(axis=0) / SETTLED
    return levels, mean


def stretch_reflex(way, reference, t):
    """The stretch reflex of `motor.feedback`: what it adds to the commands of a tick, (…, TICK, 6).

    From the states (…, 10) so far, one a tick, and a reference (T + 1, 10). It feels the muscles
    exactly and `SPINAL` late, each millisecond: between two ticks states are interpolated.
    """
    if t < SPINAL:
        return 0.0
    share = np.arange(TICK)[:, None] / TICK
    (length, rate), (meant, meant_rate) = (
        fibres(*paths(felt[..., :2]), felt[..., 2:4])
        for felt in (
            before[..., None, :] + share * (after - before)[..., None, :]
            for before, after in (x[t - SPINAL : t - SPINAL + 2] for x in (way, reference))
        )
    )
    return REFLEX.stretch * (length - meant) + REFLEX.rate * (rate - meant_rate)


def steer(law, filters, share, draws, errors, reflex=False, copied=False):
    """Where hands go by a law and its Kalman gains: states (B, T + 1, 10), commands (B, T, 6).

    `draws` (B, T, TICK, 6) of unit noise make the commands waver by a `share`, each millisecond
    anew; `errors` (B, T, 4) add to the reports. With a `reflex` the `stretch_reflex` adds to the
    commands; where it is `copied`, the filter is told what it adds.
    """
    late = (filters.shape[-2] - 10) // 4
    ahead = next_states(law.reference[:-1], np.repeat(law.commands[:, None], TICK, axis=1))
    slip = ahead - law.reference[1:]  # nothing, but where one law takes over from another
    whole, arrives = augment(law.A, late)
    now = np.broadcast_to(rest(), (len(draws), 10))
    guess, way, sent = np.zeros((len(draws), 10 + 4 * late)), [now], []
    for t, told in enumerate(law.commands):
        u = np.clip(told - guess[:, :10] @ law.gains[t].T, 0, 1)
        excited = u[:, None]
        if reflex:
            excited = np.clip(excited + stretch_reflex(way, law.reference, t), 0, 1)
        pulled = np.interp(excited, *mean_pulls(share)[::-1])
        now = next_states(now, add_noise(pulled, share, draws[:, t]))
        sent.append(pulled.mean(axis=1))
        way.append(now)
        guess = guess @ whole[t].T
        known = excited.mean(axis=1) if copied else u
        guess[:, :10] += (known - told) @ law.B[t].T + slip[t]
        then = max(t + 1 - late, 0)
        report = (way[then] - law.reference[then])[:, :4] + errors[:, t]
        guess = guess + (report - guess @ arrives[t].T) @ filters[t].T
    return np.stack(way, axis=1), np.stack(sent, axis=1)
