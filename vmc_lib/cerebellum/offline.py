"""Off-line calibration: try, see the error, correct the weights, try again.

`algorithm_1` is the paper's (Eq. 6–7), `broyden_calibration` our own. Both take a `Plan`, of
one reach or a batch, and return `Trials`, the plan's own reach first. Both let the arm move by
`execute`, or, in another world, by `partial(execute, perturbation=…)`.
"""

from typing import NamedTuple

import numpy as np

from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import Plan, check_rule, least_change, norm
from vmc_lib.short_repr import short_repr

GAINS = tuple(range(21))  # the paper's n in [0, 20]
LARGEST_STEP = 0.5  # of Δw's norm: no single correction may throw the arm about


class Trials(NamedTuple):
    """Trials of a calibration, in order; the first is the plan before."""

    weights: np.ndarray  # (trials, …, N)
    endpoint: np.ndarray  # (trials, …, 2), m
    error: np.ndarray  # (trials, …), m: how far from the target
    movements: tuple  # as they were made: `Movement`s, whose leading axis may count trials

    __repr__ = short_repr

    @property
    def best_weights(self):
        """Weights (…, N) of the trial that came nearest."""
        winner = self.error.argmin(axis=0)
        return np.take_along_axis(self.weights, winner[None, ..., None], axis=0)[0]

    @property
    def best_motion(self):
        """The `Motion` of the trial that came nearest, of one reach."""
        motions = [motion for movement in self.movements for motion in movement.motion]
        return motions[self.error.argmin()]


def calibrate(rule, plan: Plan):
    """The `Trials` by which a rule calibrates a plan; ValueError where it returns anything else."""
    check_rule(rule, algorithm_1, broyden_calibration)
    if not isinstance(trials := rule(plan), Trials):
        name = getattr(rule, "__name__", rule)
        raise ValueError(
            f"the calibration rule {name} returned a {type(trials).__name__}: it must return "
            "Trials(weights, endpoint, error, movements), as algorithm_1 does"
        )
    return trials


def algorithm_1_change(plan, endpoint, n, origin=(0.0, 0.0), sign=1):
    """Eq. 6–7: Δw_i = k_i cos θ_i (…, N), with k_i growing with n for templates nearer than p_t."""
    error = sign * (plan.target - endpoint)
    towards = plan.points - endpoint[..., None, :]
    lengths = norm(error)[..., None] * norm(towards)
    cosine = (towards @ error[..., None])[..., 0] / np.where(lengths > 0, lengths, 1)
    d_t, d_a, d_i = (norm(x - np.asarray(origin)) for x in (plan.target, endpoint, plan.points))
    return (norm(error) / d_a)[..., None] * (1 + n * (d_t[..., None] - d_i) / d_i) * cosine


def algorithm_1(
    plan: Plan, gains=GAINS, origin=(0.0, 0.0), sign=1, execute=execute, change=algorithm_1_change
):
    """Calibrate a plan off-line by Algorithm 1: try every n, each with the correction of Eq. 6–7.

    The paper leaves `origin` and `sign` open. The sign was chosen for the ratio of errors that it
    prints, a reading fitted to the answer; the origin is that of all our places. And its best is
    one of the n; here it may be the plan itself: no correction should make a reach worse.

    Parameters
    ----------
    plan : Plan
        Of one reach or a batch.
    gains : sequence of int
        The n to try.
    origin : array (2,)
        Where positions are measured from, m; the shoulder.
    sign : {1, -1}
        Which way the error points; 1: from the hand to the target.
    execute : callable
        Moves the arm: a plan to its `Movement`.
    change : callable
        Eq. 6–7, or another law of the same arguments.

    Returns
    -------
    Trials
        The plan's movement, then one for each n.

    Raises
    ------
    ValueError
        Where there is no n to try.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> trials = algorithm_1(plan([0.15, -0.4], load()))
    >>> len(trials.error), bool(trials.error.min() < trials.error[0])
    (22, True)
    """
    if not len(gains):
        raise ValueError("gains are empty: name at least one n to try, as in gains=range(21)")
    planned = execute(plan)
    changes = [change(plan, planned.endpoint, n, origin, sign) for n in gains]
    return _trials(planned, execute(plan.with_weights(plan.weights + np.stack(changes))))


def broyden_calibration(plan: Plan, n_trials=2, broyden=True, guarded=True, execute=execute):
    """Calibrate a plan off-line by Broyden's method: solve Eq. 4 for the error, trial by trial.

    Each trial makes the smallest Δw that shifts the hand by the whole error, if moving a weight
    moved the hand as a Jacobian says: at first along p_i (Eq. 4); afterwards corrected by what the
    arm really did. It is for templates what the optimal linear estimator is for neurons.

    Parameters
    ----------
    plan : Plan
        Of one reach or a batch.
    n_trials : int
        How many movements to make after the first.
    broyden : bool
        Correct the Jacobian after each trial.
    guarded : bool
        No step is larger than `LARGEST_STEP`, and each starts from the best weights so far.
    execute : callable
        Moves the arm: a plan to its `Movement`.

    Returns
    -------
    Trials
        The plan's movement, then the trials.

    Raises
    ------
    ValueError
        Where the templates lie on one line.

    References
    ----------
    Broyden, C. G. (1965). A class of methods for solving nonlinear simultaneous equations.
    Salinas, E. & Abbott, L. F. (1994). Vector reconstruction from firing rates.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> trials = broyden_calibration(plan([0.15, -0.4], load()))
    >>> bool(trials.error[2] < 0.1 * trials.error[0])
    True
    """
    jacobian, planned = np.swapaxes(plan.points, -1, -2), execute(plan)
    weights, endpoint, tried = plan.weights, planned.endpoint, []
    for _ in range(n_trials):
        change = least_change(jacobian, plan.target - endpoint)
        change = _clip_norm(change) if guarded else change
        tried.append(execute(plan.with_weights(weights + change)))
        end = tried[-1].endpoint
        if broyden:
            jacobian = broyden_update(jacobian, change, end - endpoint)
        better = (norm(plan.target - end) < norm(plan.target - endpoint))[..., None]
        weights = np.where(better | (not guarded), weights + change, weights)
        endpoint = np.where(better | (not guarded), end, endpoint)
    return _trials(planned, *tried)


def broyden_update(jacobian, change, shift):
    """The nearest Jacobian (…, D, N) by which a change (…, N) would have had the shift (…, D)."""
    surprise = shift - (jacobian @ change[..., None])[..., 0]
    square = np.maximum((change**2).sum(axis=-1), 1e-24)[..., None, None]
    return jacobian + surprise[..., :, None] * change[..., None, :] / square


def _trials(*movements):
    """`Trials` of a plan's movement, and of others after it, each one trial or several at once."""
    plan = movements[0].plan
    weights = np.concatenate([m.plan.weights.reshape(-1, *plan.weights.shape) for m in movements])
    endpoint = np.concatenate([m.endpoint.reshape(-1, *plan.target.shape) for m in movements])
    return Trials(weights, endpoint, norm(plan.target - endpoint), movements)


def _clip_norm(change):
    return change * np.minimum(1, LARGEST_STEP / np.maximum(norm(change), 1e-12))[..., None]
