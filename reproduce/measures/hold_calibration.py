"""Calibration of the end point and of the drift in the hold, by weights that change in time.

Four weights suffice for a place, not for a place and rest. Here a plan has two sets of weights, one
for the way and one for the hold, and a command goes over from the first to the second.
"""

import numpy as np

from vmc_lib.cerebellum.offline import LARGEST_STEP, broyden_update
from vmc_lib.motor.inverse_dynamics import SAMPLES
from vmc_lib.motor.planning import draw_targets, plan

GOING_OVER = 800, 1000  # ms; from 600 to 900 the weights of the hold hardly stop the drift
VALIDATION = 7  # seed of the targets on which the effect of weights is measured


def hold_paths(habit, changes):
    """The hand's path over the hold, (…, n, 2), m, by weights with `changes` (…, 8)."""
    first, last = GOING_OVER
    share = np.clip((np.arange(SAMPLES) - first) / (last - first), 0, 1)[:, None]
    share = share**2 * (3 - 2 * share)
    way, hold = (
        habit.with_weights(habit.weights + c).excitations for c in np.split(changes, 2, axis=-1)
    )
    return habit.template_set.reach((1 - share) * way + share * hold).hold


def place_and_drift(paths):
    """The end point and half of the drift over the hold, (…, 4), m, of paths (…, n, 2)."""
    return np.concatenate(
        [paths.mean(axis=-2), (paths[..., -1, :] - paths[..., 0, :]) / 2], axis=-1
    )


def effects(template_set, count=50, size=0.05):
    """How place and drift (rows) follow the points by either set of weights (columns), (2, 2)."""
    rng = np.random.default_rng(VALIDATION)
    habit = plan(draw_targets(template_set, count, rng), template_set)
    change = size * rng.normal(size=habit.weights.shape)
    change -= change.mean(axis=-1, keepdims=True)
    moved = (change[:, None] @ habit.points)[:, 0]
    before = place_and_drift(hold_paths(habit, np.tile(0 * change, 2)))
    columns = []
    for way, hold in ((1, 0), (1, 1)):
        both = np.concatenate([way * change, hold * change], axis=-1)
        after = place_and_drift(hold_paths(habit, both)) - before
        columns.append(after.reshape(-1, 2, 2).transpose(1, 0, 2).reshape(2, -1) @ moved.ravel())
    by_way, by_both = np.array(columns) / (moved**2).sum()
    return np.stack([by_way, by_both - by_way], axis=-1)


def calibrate(habit, trials=4):
    """The hand's path over the hold after each trial, the best so far, (trials + 1, …, n, 2), m.

    By Broyden's method, as `broyden_calibration`, for the end point and for no drift.
    """
    points = np.swapaxes(habit.points, -1, -2)
    rows = [[k * points for k in row] for row in effects(habit.template_set)]
    jacobian = np.concatenate([np.concatenate(row, axis=-1) for row in rows], axis=-2)
    wanted = np.concatenate([habit.target, 0 * habit.target], axis=-1)
    changes = np.zeros((*habit.weights.shape[:-1], 2 * habit.weights.shape[-1]))
    best = [hold_paths(habit, changes)]
    for _ in range(trials):
        before = place_and_drift(best[-1])
        step = _least_change(jacobian, wanted - before)
        path = hold_paths(habit, changes + step)
        after = place_and_drift(path)
        jacobian = broyden_update(jacobian, step, after - before)
        left = [np.linalg.norm(wanted - result, axis=-1) for result in (before, after)]
        nearer = (left[1] < left[0])[..., None]
        changes = np.where(nearer, changes + step, changes)
        best.append(np.where(nearer[..., None], path, best[-1]))
    return np.array(best)


def _least_change(jacobian, shift):
    """The least change (…, 8) for a shift (…, 4), each set of weights summing to zero."""
    parts = jacobian.reshape(*jacobian.shape[:-1], 2, -1)
    centred = (parts - parts.mean(axis=-1, keepdims=True)).reshape(jacobian.shape)
    step = (np.linalg.pinv(centred) @ shift[..., None])[..., 0]
    length = np.linalg.norm(step, axis=-1, keepdims=True)
    return step * np.minimum(1, LARGEST_STEP / np.maximum(length, 1e-12))
