"""Off-line calibration: try, see the error, correct the weights, try again.

`algorithm_1` is the paper's (Eq. 6–7), `broyden_calibration` and `gauss_newton_calibration` are our
own. Each takes a `Plan`, of one reach or a batch, and returns `Trials`, the plan's own reach first.
Each lets the arm move by `execute`, or, in another world, by `partial(execute, perturbation=…)`.
"""

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.checks import as_numbers, check_count, check_function, check_kind
from vmc_lib.motor.execution import Execute, Movement, execute
from vmc_lib.motor.planning import Plan, check_plan, least_change, norm, rule_called
from vmc_lib.motor.templates import HeldMotion
from vmc_lib.short_repr import short, short_repr

GAINS = tuple(range(21))  # the paper's n in [0, 20]
LARGEST_STEP = 0.5  # of Δw's norm: no single correction may throw the arm about
NUDGE = 0.1  # of one weight, to see what it does: smaller ones drown in a muscle's noise
RIDGE_SHARE = 1e-4  # of a least-squares step: of what all weights do; chosen on other targets

MOVES = "execute, or partial(execute, perturbation=…)"  # what is asked for where no arm would move


class Trials(NamedTuple):
    """Trials of a calibration, in order; the first is the plan before."""

    weights: np.ndarray  # (trials, …, N)
    endpoint: np.ndarray  # (trials, …, 2), m
    error: np.ndarray  # (trials, …), m: how far from the target, on average over the hold
    movements: tuple  # as they were made: `Movement`s, whose leading axis may count trials

    __repr__ = short_repr

    @property
    def hold(self) -> np.ndarray:
        """The hand's path over the hold in each trial, (trials, …, n, 2), m."""
        shape = self.endpoint.shape[1:-1]
        holds = [m.hold.reshape(-1, *shape, *m.hold.shape[-2:]) for m in self.movements]
        return np.concatenate(holds)

    @property
    def best_weights(self) -> np.ndarray:
        """Weights (…, N) of the trial that came nearest."""
        winner = self.error.argmin(axis=0)
        return np.take_along_axis(self.weights, winner[None, ..., None], axis=0)[0]

    @property
    def best_motion(self) -> HeldMotion:
        """The `Motion` of the trial that came nearest, of one reach."""
        motions = [motion for movement in self.movements for motion in movement.motion]
        return motions[self.error.argmin()]


def algorithm_1_change(
    plan: Plan,
    endpoint: np.ndarray,
    n: float,
    origin: ArrayLike = (0.0, 0.0),
    sign: Literal[1, -1] = 1,
) -> np.ndarray:
    """Eq. 6–7: Δw_i = k_i cos θ_i (…, N), with k_i growing with n for templates nearer than p_t."""
    error = sign * (plan.target - endpoint)
    towards = plan.points - endpoint[..., None, :]
    lengths = norm(error)[..., None] * norm(towards)
    cosine = (towards @ error[..., None])[..., 0] / np.where(lengths > 0, lengths, 1)
    d_t, d_a, d_i = (norm(x - np.asarray(origin)) for x in (plan.target, endpoint, plan.points))
    return (norm(error) / d_a)[..., None] * (1 + n * (d_t[..., None] - d_i) / d_i) * cosine


def algorithm_1(
    plan: Plan,
    gains: Sequence[int] = GAINS,
    origin: ArrayLike = (0.0, 0.0),
    sign: Literal[1, -1] = 1,
    execute: Execute = execute,
    change: Callable[..., np.ndarray] = algorithm_1_change,
) -> Trials:
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
        Where there is no n to try, or the change is no Δw of the plan.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> trials = algorithm_1(plan([0.15, -0.4], load()))
    >>> len(trials.error), bool(trials.error.min() < trials.error[0])
    (22, True)
    """
    numbers = as_numbers("gains", gains)
    if not numbers.size or numbers.ndim != 1:
        raise ValueError(f"gains = {short(gains)}: name at least one n to try, as range(21) does")
    if not np.isfinite(numbers).all():
        raise ValueError(f"gains = {short(gains)}: give finite numbers")
    check_function("change", change, "algorithm_1_change")
    check_function("execute", execute, MOVES)
    if sign not in (1, -1) or as_numbers("origin", origin).shape != (2,):
        raise ValueError(
            f"origin {short(origin)}, sign {short(sign)}: give (x, y) in m, and 1 or -1"
        )
    planned = movement_of(execute, plan)
    changes = [change(plan, planned.endpoint, n, origin, sign) for n in gains]
    for each in changes:
        if np.shape(each) != plan.weights.shape:
            name = getattr(change, "__name__", change)
            raise ValueError(
                f"the law {name} returned {short(each)}, a {type(each).__name__}: it must return "
                f"Δw, an array {plan.weights.shape}, as algorithm_1_change does"
            )
    return _trials(planned, execute(plan.with_weights(plan.weights + np.stack(changes))))


def broyden_calibration(
    plan: Plan,
    n_trials: int = 2,
    broyden: bool = True,
    guarded: bool = True,
    execute: Execute = execute,
    jacobian: np.ndarray | None = None,
) -> Trials:
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
    jacobian : array (…, D, N), optional
        Where each weight takes the hand at first, m; by default the templates' points p_i.

    Returns
    -------
    Trials
        The plan's movement, then the trials.

    Raises
    ------
    ValueError
        Where the templates lie on one line, or a Jacobian is of another shape.

    References
    ----------
    Broyden, C. G. (1965). A class of methods for solving nonlinear simultaneous equations.
    Salinas, E. & Abbott, L. F. (1994). Vector reconstruction from firing rates.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> trials = broyden_calibration(plan([0.15, -0.4], load()))
    >>> bool(trials.movements[2].bias < 0.1 * trials.movements[0].bias)
    True
    """
    check_count("n_trials", n_trials)
    check_function("execute", execute, MOVES)
    planned, weights = movement_of(execute, plan), plan.weights
    points, shape = np.swapaxes(plan.points, -1, -2), (plan.target.shape[-1], weights.shape[-1])
    jacobian = points if jacobian is None else as_numbers("jacobian", jacobian)
    if jacobian.shape[-2:] != shape:
        raise ValueError(f"jacobian {jacobian.shape}: give (D, N) of target and weights, {shape}")
    best, endpoint, tried = planned.error, planned.endpoint, []
    for _ in range(n_trials):
        change = least_change(jacobian, plan.target - endpoint)
        change = _clip_norm(change) if guarded else change
        tried.append(now := execute(plan.with_weights(weights + change)))
        if broyden:
            jacobian = broyden_update(jacobian, change, now.endpoint - endpoint)
        better = (now.error < best) | (not guarded)
        weights = np.where(better[..., None], weights + change, weights)
        endpoint = np.where(better[..., None], now.endpoint, endpoint)
        best = np.where(better, now.error, best)
    return _trials(planned, *tried)


def gauss_newton_calibration(plan: Plan, n_steps: int = 4, execute: Execute = execute) -> Trials:
    """Calibrate a plan off-line by least squares over the whole hold, so that the hand stays.

    First each weight is nudged alone, N trials that measure how the hand's path over the hold
    follows it. Then come Gauss–Newton steps, damped, each from the best weights so far; between
    them every step corrects the measured Jacobian (Broyden). The weights need not sum to 1: more
    of every muscle lifts the hand, and stiffens it.

    Parameters
    ----------
    plan : Plan
        Of one reach or a batch.
    n_steps : int
        How many movements to make after the first and the nudges.
    execute : callable
        Moves the arm: a plan to its `Movement`.

    Returns
    -------
    Trials
        The plan's movement, a trial for each weight, then the steps.

    References
    ----------
    Nocedal, J. & Wright, S. J. (2006). Numerical optimization, chapter 10.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> trials = gauss_newton_calibration(plan([0.15, -0.4], load()))
    >>> len(trials.error), bool(trials.error[-1] < 0.2 * trials.error[0])
    (9, True)
    """
    check_count("n_steps", n_steps)
    check_function("execute", execute, MOVES)
    planned, weights = movement_of(execute, plan), plan.weights
    ways = NUDGE * np.eye(weights.shape[-1]).reshape(-1, *(weights.ndim - 1) * [1], len(weights.T))
    nudged = execute(plan.with_weights(weights + ways))
    best, residual = planned.error, _residual(planned)
    jacobian = np.moveaxis(_residual(nudged) - residual, 0, -1) / NUDGE
    tried = []
    for _ in range(n_steps):
        change = _clip_norm(-_damped_least_squares(jacobian, residual))
        tried.append(now := execute(plan.with_weights(weights + change)))
        jacobian = broyden_update(jacobian, change, _residual(now) - residual)
        better = now.error < best
        weights = np.where(better[..., None], weights + change, weights)
        residual = np.where(better[..., None], _residual(now), residual)
        best = np.where(better, now.error, best)
    return _trials(planned, nudged, *tried)


RULES: dict[str, Callable[..., Trials]] = {  # of off-line calibration
    "published": algorithm_1,
    "own": broyden_calibration,
}
Rule = Literal["published", "own"] | Callable[[Plan], Trials]


def calibrate(plan: Plan, rule: Rule = "published") -> Trials:
    """The `Trials` by which a rule calibrates a plan: one of `RULES` by its name, or a function.

    ValueError for a name that none has, and where a function returns anything else.
    """
    check_plan(plan)
    if not isinstance(trials := rule_called(rule, RULES)(plan), Trials):
        name = getattr(rule, "__name__", rule)
        raise ValueError(
            f"the calibration rule {name} returned a {type(trials).__name__}: it must return "
            "Trials(weights, endpoint, error, movements), as algorithm_1 does"
        )
    return trials


def movement_of(execute: Execute, plan: Plan) -> Movement:
    """The `Movement` of a plan by `execute`; ValueError where that returns anything else."""
    check_kind("what execute returned,", movement := execute(plan), Movement, MOVES)
    return movement


def _residual(movement):
    """How far the hand is from its target at each moment of the hold, axis by axis, (…, n D)."""
    away = movement.hold - movement.plan.target[..., None, :]
    return away.reshape(*away.shape[:-2], -1)


def _damped_least_squares(matrix, wanted):
    """The x (…, N) for which matrix (…, m, N) @ x is near `wanted` (…, m) (Levenberg)."""
    normal = np.swapaxes(matrix, -1, -2) @ matrix
    ridge = RIDGE_SHARE * np.trace(normal, axis1=-2, axis2=-1)[..., None, None]
    gradient = np.swapaxes(matrix, -1, -2) @ wanted[..., None]
    return np.linalg.solve(normal + ridge * np.eye(matrix.shape[-1]), gradient)[..., 0]


def broyden_update(jacobian: np.ndarray, change: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """The nearest Jacobian (…, D, N) by which a change (…, N) would have had the shift (…, D)."""
    surprise = shift - (jacobian @ change[..., None])[..., 0]
    square = np.maximum((change**2).sum(axis=-1), 1e-24)[..., None, None]
    return jacobian + surprise[..., :, None] * change[..., None, :] / square


def _trials(*movements):
    """`Trials` of a plan's movement, and of others after it, each one trial or several at once."""
    plan = movements[0].plan
    weights = np.concatenate([m.plan.weights.reshape(-1, *plan.weights.shape) for m in movements])
    endpoint = np.concatenate([m.endpoint.reshape(-1, *plan.target.shape) for m in movements])
    error = np.concatenate([m.error.reshape(-1, *plan.target.shape[:-1]) for m in movements])
    return Trials(weights, endpoint, error, movements)


def _clip_norm(change):
    return change * np.minimum(1, LARGEST_STEP / np.maximum(norm(change), 1e-12))[..., None]
