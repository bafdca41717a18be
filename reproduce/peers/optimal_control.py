"""Optimal control, habit's rival: the commands of least effort that bring the hand there.

Effort is the mean square of the excitations (Diedrichsen et al., 2010). The task is a template's:
be at the target as soon as a template is, at rest, stay until the hold ends, and never pass below
the table. Sequential quadratic programming minimises one subject to the other, with the compiled
arm. What ships are the optima of `TARGETS`.
"""

from functools import cache
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce.results import arrays
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.camera import TABLE
from vmc_lib.motor.inverse_dynamics import MOVING, SAMPLES, bounded_least_squares, spline
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import load, reach, simulate_templates

KNOTS = 24  # spline coefficients of each muscle's excitation: with 40 the effort is 0.6 % less
TARGETS = np.array(list(product((0.03, 0.06, 0.09, 0.12, 0.15), (-0.42, -0.39, -0.36, -0.33))))
INNER = np.flatnonzero(np.all(abs(TARGETS - [0.09, -0.375]) < 0.04, axis=1))  # others all round
STAY = [MOVING, 800, 900, SAMPLES, 1250, 1500]  # ms: when the hand is to be at its target
HEIGHTS = slice(0, MOVING, 25)  # ms: when it is to be above the table …
CLEARANCE = 0.001  # m: … by so much, for it is not looked at in between
ARRIVE, AVOID = slice(2 * len(STAY) + 2), slice(2 * len(STAY) + 2, None)  # rows of `_task`
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


def minimise_cost(target, cost, slope, ftol=1e-4, most=FULL_STRENGTH, knots=KNOTS):
    """The knots `x` that bring the hand there at the least `cost`, as an `OptimizeResult`.

    Each muscle has so many `knots`; none gets more than `most` (6,). `slope` (n,) is the gradient
    of the cost. Each of the search's `nfev` trials moves the arm once, each of its `njev` gradients
    once for every knot and once more (beside what the cost takes).
    """
    from scipy.optimize import minimize

    start = plan(target, load()).excitations
    first = np.stack(
        [bounded_least_squares(spline(knots), muscle) for muscle in start.T], axis=-1
    ).ravel()
    most = np.tile(most, knots)
    value, slopes = (cache(lambda x, f=f: f(np.array(x), target)) for f in (_task, _task_gradients))
    constraints = [
        {
            "type": kind,
            "fun": lambda x, rows=rows: value(tuple(x))[rows],
            "jac": lambda x, rows=rows: slopes(tuple(x))[rows],
        }
        for kind, rows in (("eq", ARRIVE), ("ineq", AVOID))
    ]
    found = minimize(
        cost,
        np.minimum(first, most),
        jac=slope,
        bounds=[(0, limit) for limit in most],
        constraints=constraints,
        method="SLSQP",
        options={"ftol": ftol, "maxiter": 60},
    )
    if not found.success:
        raise RuntimeError(f"no optimum for the target {target} m: {found.message}")
    return found


def make(targets=TARGETS, search=search):
    """What `results/optimal.npz` holds: the knots (n, …) of targets (n, 2), found by `search`."""
    found = Parallel()(delayed(search)(target) for target in targets)
    return {"knots": np.array([optimum.x for optimum in found], np.float32)}


@cache
def optimal_excitations():
    """The optimal excitations (20, T, 6) of `TARGETS`."""
    return excitations_from_knots(arrays("optimal")["knots"].astype(float))


def mix_optima():
    """Habit with optima for templates: a `Plan` of the six `INNER` targets.

    Each mixes the four optima that lie 3 cm to its sides, above and below: a square of 6 cm.
    """
    memories = simulate_templates(optimal_excitations())
    corners = INNER[:, None] + [-5, -3, 3, 5]  # `TARGETS` has rows of four
    return plan(TARGETS[INNER], memories, rows=corners)


def excitations_from_knots(x):
    """The excitations (…, T, 6) of knots (…, n), as many for each muscle."""
    knots = x.reshape(*x.shape[:-1], -1, 6)
    return np.clip(spline(knots.shape[-2]) @ knots, 0, 1)


def _task(x, target):
    """What must be zero, and then what must not be negative, of the task, (…, m).

    Angles off those of the target and velocities; heights above the table, in m.
    """
    motion = reach(excitations_from_knots(x))
    off = motion.q[..., STAY, :] - inverse_kinematics(target)
    parts = off.reshape(*x.shape[:-1], -1), 0.05 * motion.velocity[..., SAMPLES, :]
    heights = hand(motion.q[..., HEIGHTS, :])[..., 1] - TABLE - CLEARANCE
    return np.concatenate([*parts, heights], axis=-1)


def _task_gradients(x, target):
    """How `_task` changes with each knot, (m, n): all knots nudged, in one batch of movements."""
    nudge = np.where(x > 0.5, -NUDGE, NUDGE)
    nudged = _task(np.vstack([x, x + np.diag(nudge)]), target)
    return (nudged[1:] - nudged[0]).T / nudge
