"""State estimation: a Kalman filter of the arm, whose senses err and whose commands are noisy.

As in `lqr_tracking` the arm is linear in small deviations from a reach, step by step. What is
estimated is the deviation of all ten states; what is sensed is the hand's place, at every tick and
without delay, with normal errors. The commands' noise is normal as well, grows with the command,
and is new at every tick. Lengths are metres.
"""

import numpy as np

from reproduce.peers.lqr_tracking import PLACE, observation_slopes


def command_noise(law, share):
    """Covariances (ticks, 10, 10) of what noise, a share of each command, adds to the state."""
    commands = law.commands[0].mean(axis=1)
    spread = share * law.B[0] * commands[:, None]
    return spread @ np.swapaxes(spread, -1, -2)


def place_slopes(law):
    """How the hand's place follows from the state after each tick, (ticks, 2, 10)."""
    return PLACE * observation_slopes(law.reference[0, 1:])[:, :2]


def kalman_gains(A, C, process, error):
    """The best gains (ticks, n, k) for k senses, C (ticks, k, n), that err by `error` (k,)."""
    P, found = np.zeros_like(A[0]), []
    doubt = np.diag(np.broadcast_to(np.square(error), C.shape[1]))
    for a, c, noise in zip(A, C, process, strict=True):
        P = a @ P @ a.T + noise
        found.append(np.linalg.solve(c @ P @ c.T + doubt, c @ P).T)
        P = P - found[-1] @ c @ P
    return np.array(found)


def estimate(A, C, gains, reports):
    """Estimated states (…, ticks, n) by the filter of some gains, from reports (…, ticks, k)."""
    x, found = np.zeros((*reports.shape[:-2], A.shape[-1])), []
    for t, (a, c, gain) in enumerate(zip(A, C, gains, strict=True)):
        x = x @ a.T
        x = x + (reports[..., t, :] - x @ c.T) @ gain.T
        found.append(x)
    return np.stack(found, axis=-2)


def deviate(A, B, commands, share, repeats, rng):
    """States (repeats, ticks, 10) of reaches whose commands (ticks, 6) have noise, a share."""
    x, found = np.zeros((repeats, 10)), []
    for a, b, u in zip(A, B, commands, strict=True):
        x = x @ a.T + share * u * rng.standard_normal((repeats, 6)) @ b.T
        found.append(x)
    return np.stack(found, axis=1)
