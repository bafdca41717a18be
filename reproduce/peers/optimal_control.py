"""Optimal control, habit's rival: the commands of least effort that bring the hand there.

Effort is the mean square of the excitations (Diedrichsen et al., 2010). The task is a template's:
be at the target, still, when a movement ends, and again when the hold ends. Sequential quadratic
programming minimises one subject to the other, with the compiled arm. What ships are
the optima of `TARGETS`.
"""

from functools import cache
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import arrays
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.motor.inverse_dynamics import MOVING, SAMPLES, bounded_least_squares, spline
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import TemplateSet, load, reach

KNOTS = 12  # spline coefficients of each muscle's excitation: fewer than a template's, to be quick
TARGETS = np.array(
    list(product((0.03, 0.06, 0.09, 0.12, 0.15), (-0.46, -0.43, -0.40, -0.37, -0.34)))
)
INNER = np.flatnonzero(np.all(abs(TARGETS - [0.09, -0.40]) < 0.04, axis=1))  # others all round
NUDGE = 1e-4
FULL_STRENGTH = np.ones(6)  # of each muscle's strength: all of it


def effort(excitations):
    """The mean square of excitations (…, T, 6)."""
    return np.square(excitations).mean(axis=(-1, -2))


def solve(target):
    """The excitations (T, 6) of least effort that bring the hand to a target (2,) and hold it.

    The search begins at the habitual plan. RuntimeError when it does not come to an end.
    """
    return excitations_from_knots(search(target).x)


def search(target, strength=FULL_STRENGTH):
    """The knots `x` of least effort, as a `scipy.optimize.OptimizeResult`.

    `x` is what the muscles get: of each command the share that is the muscle's `strength` (6,).
    """
    price = np.kron(spline(KNOTS).T @ spline(KNOTS), np.diag(strength**-2.0))
    price /= np.diag(price).mean()  # about 1 in every direction, as the method likes it
    return minimise_cost(target, lambda x: x @ price @ x / 2, lambda x: price @ x, most=strength)


def minimise_cost(target, cost, slope, ftol=1e-4, most=FULL_STRENGTH):
    """The knots `x` that bring the hand there at least `cost`, as an `OptimizeResult`.

    No muscle gets more than `most` (6,).
    `slope` (n,) is the cost's; how often the arm was tried: each of the search's `nfev` trials
    moves it once, each of its `njev` slopes once for every knot and once more (beside what the cost
    takes).
    """
    from scipy.optimize import minimize

    start = plan(target, load()).excitations
    first = np.stack(
        [bounded_least_squares(spline(KNOTS), muscle) for muscle in start.T], axis=-1
    ).ravel()
    most = np.tile(most, KNOTS)
    goal = np.concatenate([np.tile(inverse_kinematics(target), 2), np.zeros(4)])
    found = minimize(
        cost,
        np.minimum(first, most),
        jac=slope,
        bounds=[(0, limit) for limit in most],
        constraints={"type": "eq", "fun": lambda x: _ends(x) - goal, "jac": _end_gradients},
        method="SLSQP",
        options={"ftol": ftol, "maxiter": 60},
    )
    if not found.success:
        raise RuntimeError(f"no optimum for the target {target} m: {found.message}")
    return found


def make(targets=TARGETS, search=search):
    """What `results/optimal.npz` holds: the knots (n, 6 KNOTS) of targets (n, 2)."""
    found = Parallel()(delayed(search)(target) for target in targets)
    return {"knots": np.array([optimum.x for optimum in found], np.float32)}


@cache
def optimal_excitations():
    """The optimal excitations (25, T, 6) of `TARGETS`."""
    return excitations_from_knots(arrays("optimal")["knots"].astype(float))


def mix_optima():
    """Habit with optima for templates: a `Plan` of the nine `INNER` targets.

    Each mixes the four optima that lie 3 cm to its sides, above and below: a square of 6 cm.
    """
    memories = TemplateSet(reach(optimal_excitations()).endpoint, optimal_excitations())
    corners = INNER[:, None] + [-6, -4, 4, 6]  # `TARGETS` has rows of five
    return plan(TARGETS[INNER], memories, rows=corners)


def excitations_from_knots(x):
    """The excitations (…, T, 6) of knots (…, 6 KNOTS)."""
    return np.clip(spline(KNOTS) @ x.reshape(*x.shape[:-1], KNOTS, 6), 0, 1)


def _ends(x):
    """Angles and velocities (…, 8) when the movement ends and when the hold ends."""
    motion = reach(excitations_from_knots(x))
    q, velocity = (path[..., [MOVING, SAMPLES], :] for path in (motion.q, 0.05 * motion.velocity))
    return np.concatenate([q, velocity], axis=-2).reshape(*x.shape[:-1], 8)


def _end_gradients(x):
    """How `_ends` changes with each knot, (8, n): all knots nudged, in one batch of movements."""
    nudge = np.where(x > 0.5, -NUDGE, NUDGE)
    nudged = _ends(np.vstack([x, x + np.diag(nudge)]))
    return (nudged[1:] - nudged[0]).T / nudge
