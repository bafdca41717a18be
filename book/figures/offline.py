"""Figures of the chapter on off-line calibration: a miss, its correction, trial after trial."""

from functools import partial

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import curves, mark_now, panels, shade
from book.figures.reaching import corrections, ends, mean_mm, norm_mm, reaches
from reproduce import paper
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.simulate import Perturbation
from vmc_lib.cerebellum.offline import GAINS, algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import least_change
from vmc_lib.motor.templates import START
from vmc_lib.show import table
from vmc_lib.show.palette import COLOURS

SIDE_BY_SIDE = 2, (8.2, 3.6)  # the plane, and curves
FOUR = 0.06 * np.array([[1, -7], [2, -7], [2, -6], [1, -6]])  # templates round a target, m
FIFTH = range(0, 21, 5)  # every fifth n
GRIDS = {"n = 0 only": (0,), "every fifth n": FIFTH, "every n": GAINS}
ORIGINS = {  # where Eq. 7 may measure from, m
    "shoulder": (0, 0),
    "eye": (0.10, 0.25),
    "resting hand": hand(START)[:2],
    "ground": (0, -0.8),
}
SIGNS = {"hand to target": 1, "target to hand": -1}


def change_above(above):
    """The least change (4,) of the weights of `FOUR` where the hand is `above` m too high."""
    return least_change(FOUR.T, np.array([0, -above]))


def miss_above(above):
    """That change, where the target lies in the middle of `FOUR`."""
    target = FOUR.mean(axis=0)
    hand_at = target + np.array([0, above])
    fig, ax = plt.subplots(figsize=(4.6, 4.6))
    corrections(ax, target, hand_at, FOUR, change_above(above))
    ends(ax, target, hand_at)
    return fig


def correction(plan, trials, gains, n):
    """Fig. 4 for a plan's `trials` with each of `gains`: the change with n, and the error by n."""
    (before, *errors), k = 1000 * trials.error, gains.index(n)
    fig, left, right = panels(*SIDE_BY_SIDE)
    change = trials.weights[1 + k] - plan.weights
    corrections(left, plan.target, trials.endpoint[0], plan.points, change)
    ends(left, plan.target, trials.endpoint[1 + k])
    right.plot(gains, errors, gid="with each n")
    right.axhline(before, color=COLOURS["grey"], ls="--")
    right.plot(n, errors[k], "o", color=COLOURS["red"], gid="this n")
    right.set(xlabel="n", ylim=(0, None), title=f"error {errors[k]:.1f} mm")
    return fig


def error_ratio(trials):
    """Mean error of the best trials of each reach, over the planned one."""
    return trials.error.min(axis=0).mean() / trials.error[0].mean()


def least_misfits(*choices):
    """The least misfit (m) that four points can have, for columns of Table IV: by their count."""
    from reproduce.experiments.printed_weights import best_points  # not in the page

    weights = paper.TABLE_4_WEIGHTS / paper.TABLE_4_WEIGHTS.sum(axis=0)
    chosen = {len(k): (paper.TARGETS[k], weights[:, k]) for k in map(list, choices)}
    return {n: best_points(*one, np.random.default_rng(0))[1] for n, one in chosen.items()}


def before_and_after(printed, ours):
    """A table of errors before and after a calibration, (2, n): the paper's, and ours in mm."""
    rows = [
        (k, f"{a:.4f} → {b:.4f} ({b / a:.2f})", f"{c:.1f} → {d:.1f} mm ({d / c:.2f})")
        for k, (a, b, c, d) in enumerate(zip(*printed, *ours, strict=True), start=1)
    ]
    return table(["example", "the paper (ratio)", "ours (ratio)"], rows)


def best_of_each(plan, trials):
    """Hands after each target's best n; and the mean error where all use one n of `FIFTH`."""
    fig, left, right = panels(*SIDE_BY_SIDE)
    winner = trials.error.argmin(axis=0), np.arange(len(plan.target))
    title = f"after / planned = {error_ratio(trials):.2f}"
    in_plane(left, plan, trials.endpoint[winner], title)
    planned, *tried = trials.error.mean(axis=1)
    right.plot(FIFTH, tried / planned, "o-")
    right.axhline(1, color=COLOURS["grey"], ls="--")
    right.set(xlabel="n, the same for all", ylabel="mean error / planned", ylim=(0, 3))
    return fig


def repeat_algorithm_1(plan, keep, rounds=4):
    """Endpoints (rounds + 1, n, 2) by Algorithm 1 upon Algorithm 1, for each of `GRIDS`.

    With `keep` the weights before a round are among its tries.
    """
    first, everyone = 0 if keep else 1, np.arange(len(plan.target))
    endpoints = {}
    for name, gains in GRIDS.items():
        start, ends_at = plan, [execute(plan).endpoint]
        for _ in range(rounds):
            trials = algorithm_1(start, gains)
            winner = first + trials.error[first:].argmin(axis=0), everyone
            start = start.with_weights(trials.weights[winner])
            ends_at.append(trials.endpoint[winner])
        endpoints[name] = np.array(ends_at)
    return endpoints


def after_trial(plan, rules, trial, rule):
    """Hands after a trial of one rule; the mean errors of all against the extra reaches made.

    `rules` maps a name to endpoints (trials, n, 2), and how many reaches a trial takes.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    for name, (endpoints, cost) in rules.items():
        errors = mean_mm(endpoints, plan.target)[: trial + 1]
        right.plot(cost * np.arange(trial + 1), errors, ".-", label=name)
    endpoints, cost = rules[rule][0][trial], rules[rule][1] * trial
    now = mean_mm(endpoints, plan.target)
    mark_now(right, cost, now)
    in_plane(left, plan, endpoints, f"extra reaches: {cost}, mean error {now:.2g} mm")
    right.set(xlabel="extra reaches", xlim=(-1, 21), yscale="log")
    right.set_yticks([10, 1, 0.1, 0.01], ["10", "1", "0.1", "0.01"])
    right.legend(title="mean error (mm)")
    return fig


def reaches_until(mm, plan, rules):
    """Extra reaches by each rule (see `after_trial`) until its mean error is below so many mm.

    Infinite where it never is.
    """
    errors = {name: mean_mm(endpoints, plan.target) for name, (endpoints, _) in rules.items()}
    return {
        name: rules[name][1] * min(np.flatnonzero(error < mm), default=np.inf)
        for name, error in errors.items()
    }


def after_rounds(plan, rounds_by, rounds, n, keep):
    """Hands after so many rounds with one grid of n; the mean errors of all against the rounds.

    `rounds_by[keep]` is what `repeat_algorithm_1` returned.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    errors = {name: mean_mm(ends, plan.target) for name, ends in rounds_by[keep].items()}
    now = errors[n][rounds]
    in_plane(left, plan, rounds_by[keep][n][rounds], f"mean error {now:.1f} mm")
    curves(right, range(5), errors, now=(rounds, now))
    right.set(xlabel="rounds", ylabel="mean error (mm)", ylim=(0, 25))
    return fig


def errors_with_load(plan, load):
    """Errors in mm, (9, n), of Broyden calibration with a load in kg: guarded -> errors."""
    move = partial(execute, perturbation=Perturbation(load))
    return {
        guarded: 1000 * broyden_calibration(plan, 8, guarded=guarded, execute=move).error
        for guarded in (True, False)
    }


def mean_best_so_far(errors):
    """Mean over the targets of the least error up to each trial, (trials,), for (trials, n)."""
    return np.minimum.accumulate(errors).mean(axis=1)


def with_guards(errors):
    """Mean errors in mm, (trials, n) over the targets: of each trial, and of the best so far."""
    best = mean_best_so_far(errors)
    fig, ax = panels(size=(5.5, 3.2))
    fig.subplots_adjust(left=0.17)  # room for 0.001
    ax.plot(errors.mean(axis=1), ".:", color=COLOURS["grey"], label="this trial")
    ax.plot(best, ".-", color=COLOURS["red"], label="the best so far")
    ax.set(xlabel="trial", ylabel="mean error (mm)", yscale="log", ylim=(1e-3, 1000))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.set_title(f"before: {in_mm(best[0])}; best of eight: {in_mm(best[-1])}")
    ax.legend()
    return fig


def in_mm(error):
    """An error in mm as text, with two digits; below what matters beside the drift, as that."""
    return f"{error:.2g} mm" if error >= 0.01 else "at most 0.01 mm"


def correct_plans(plans, trials):
    """The plans as so many trials of Broyden calibration leave them."""
    return plans.with_weights(broyden_calibration(plans, trials).best_weights)


def distances(plans, seconds=1.5):
    """How far the hand is from each target after the command, (n, T), mm, every 10 ms."""
    paths = templates.reach(plans.excitations, hold=seconds).hold
    return norm_mm(paths - plans.target[:, None])


def after_the_command(away, reach):
    """Those distances by name, of one reach (its number as text) or the mean; the hold in grey."""
    fig, ax = panels(size=(6.0, 3.2))
    time = 1 + np.arange(next(iter(away.values())).shape[1]) * templates.EVERY / 1000
    shade(ax, 1, 1 + templates.HOLD)
    for name, each in away.items():
        mm = each[int(reach) - 1] if reach.isdigit() else each.mean(axis=0)
        ax.plot(time, mm, label=name)
    ax.set(xlabel="time (s)", ylabel="from the target (mm)", ylim=(0, 30))
    ax.legend()
    return fig


HOLD_HEADS = [
    "plan",
    "miss where the command ends (mm)",
    "miss of the end point (mm)",
    "mean distance in the hold (mm)",
    "speed in the hold (mm/s)",
]


def hold_table(plan, others):
    """A plan with the weights of others, by name: a table with `HOLD_HEADS`."""
    rows = {}
    for name, other in others.items():
        hold = execute(plan.with_weights(other.weights)).hold
        at_end = norm_mm(hold[:, 0] - plan.target).mean()
        rows[name] = f"{at_end:.2f}", *hold_numbers(hold, plan.target)
    return table(HOLD_HEADS, rows)


def hold_numbers(hold, target):
    """Mean over reaches of the last three of `HOLD_HEADS`, for paths (n, T, 2) and targets."""
    miss = norm_mm(hold.mean(axis=1) - target).mean()
    distance = norm_mm(hold - target[:, None]).mean()
    speed = 1000 * templates.mean_speed(hold).mean()
    return [f"{miss:.2f}", f"{distance:.2f}", f"{speed:.1f}"]


def in_plane(ax, plan, endpoints, title):
    """The reaches of a plan, (n, 2), among its templates."""
    reaches(ax, plan.template_set.points, plan.target, endpoints, title)
