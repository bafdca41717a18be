"""Off-line calibration: try, see the error, correct the weights, try again.

`published` is the paper's rule (Eq. 6–7, Algorithm 1); `calibrate` is ours. Both take a `Plan`, of
one reach or a batch, and return `Trials`, the plan's own reach first.
"""

from typing import NamedTuple

import numpy as np

from ..motor.planning import Plan, least_change

GAINS = tuple(range(21))  # the paper's n in [0, 20]
LARGEST_STEP = 0.5  # of Δw's norm: no single correction may throw the arm about


class Trials(NamedTuple):
    """What was tried, in order; the first entry is the plan before calibration."""

    weights: np.ndarray  # (trials, …, N)
    reached: np.ndarray  # (trials, …, 2), m
    error: np.ndarray  # (trials, …), m: how far from the target

    @property
    def best(self):
        """Weights (…, N) of the trial that came nearest."""
        winner = self.error.argmin(axis=0)
        return np.take_along_axis(self.weights, winner[None, ..., None], axis=0)[0]


def published(plan: Plan, gains=GAINS, origin=(0.0, 0.0), sign=1):
    """Algorithm 1: try every n at once, each with the correction of Eq. 6–7.

    The paper leaves open where positions are measured from (`origin`, here the shoulder) and which
    way the error points (`sign` = 1: from the hand to the target). `Trials` holds the plan's reach
    and then one for each of `gains`; its `best` may be the plan itself, which the paper, choosing
    among the n alone, does not allow: no correction should make a reach worse.
    """
    reached = plan.reached()
    changes = np.stack([published_change(plan, reached, n, origin, sign) for n in gains])
    tried = plan.with_weights(plan.weights + changes)
    return _trials(
        plan, [(plan.weights, reached), *zip(tried.weights, tried.reached(), strict=True)]
    )


def published_change(plan, reached, n, origin=(0.0, 0.0), sign=1):
    """Eq. 6–7: Δw_i = k_i cos θ_i (…, N), with k_i growing with n for templates nearer than p_t."""
    error = sign * (plan.target - reached)
    towards = plan.points - reached[..., None, :]
    lengths = _norm(error)[..., None] * _norm(towards)
    cosine = (towards @ error[..., None])[..., 0] / np.where(lengths > 0, lengths, 1)
    d_t, d_a, d_i = (_norm(x - np.asarray(origin)) for x in (plan.target, reached, plan.points))
    return (_norm(error) / d_a)[..., None] * (1 + n * (d_t[..., None] - d_i) / d_i) * cosine


def calibrate(plan: Plan, trials=2, broyden=True, guarded=True):
    """The population vector done right: solve Eq. 4 for the error, and learn from each trial.

    Each trial makes the smallest Δw that shifts the hand by the whole error, if moving a weight
    moved the hand as `jacobian` says: at first along p_i (Eq. 4); afterwards corrected by what the
    arm really did (Broyden, 1965). Two guards: no step is larger than `LARGEST_STEP`, and the next
    one starts from the best weights so far.
    """
    jacobian = np.swapaxes(plan.points, -1, -2)
    weights, reached = plan.weights, plan.reached()
    history = [(weights, reached)]
    for _ in range(trials):
        change = least_change(jacobian, plan.target - reached)
        change = _capped(change) if guarded else change
        tried = plan.with_weights(weights + change).reached()
        history.append((weights + change, tried))
        if broyden:
            surprise = tried - reached - (jacobian @ change[..., None])[..., 0]
            square = np.maximum((change**2).sum(axis=-1), 1e-24)[..., None, None]
            jacobian = jacobian + surprise[..., :, None] * change[..., None, :] / square
        better = (_norm(plan.target - tried) < _norm(plan.target - reached))[..., None]
        weights = np.where(better | (not guarded), weights + change, weights)
        reached = np.where(better | (not guarded), tried, reached)
    return _trials(plan, history)


def _trials(plan, history):
    weights, reached = map(np.stack, zip(*history, strict=True))
    return Trials(weights, reached, _norm(plan.target - reached))


def _capped(change):
    return change * np.minimum(1, LARGEST_STEP / np.maximum(_norm(change), 1e-12))[..., None]


def _norm(vectors):
    return np.linalg.norm(vectors, axis=-1)
