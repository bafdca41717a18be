"""Figures of the chapter on off-line calibration: a miss, its correction, trial after trial."""

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import curves, legend_above, mark_now, panels, shade
from book.figures.reaching import corrections, ends, mean_mm, reaches
from reproduce.experiments.calibration import FIFTH
from reproduce.experiments.offline_calibration import hold_measures
from reproduce.one_draw import error_ratio, mean_best_so_far
from vmc_lib.motor import templates
from vmc_lib.motor.planning import least_change
from vmc_lib.motor.templates import HOME
from vmc_lib.show import table
from vmc_lib.show.palette import COLOURS

SIDE_BY_SIDE = 2, (8.2, 3.3)  # the plane, and curves
FOUR = 0.06 * np.array([[1, -7], [2, -7], [2, -6], [1, -6]])  # templates round a target, m
ORIGINS = {  # where Eq. 7 may measure from, m
    "shoulder": (0, 0),
    "eye": (0.10, 0.25),
    "resting hand": HOME,
    "ground": (0, -0.8),
}
SIGNS = {"hand to target": 1, "target to hand": -1}


def change_above(above, rule=least_change):
    """By a rule, the change (4,) of the weights of `FOUR` where the hand is `above` m too high."""
    return rule(FOUR.T, np.array([0, -above]))


def miss_above(above, rule=least_change):
    """That change, where the target lies in the middle of `FOUR`."""
    target = FOUR.mean(axis=0)
    hand_at = target + np.array([0, above])
    fig, ax = plt.subplots(figsize=(4.3, 4.3))
    corrections(ax, target, hand_at, FOUR, change_above(above, rule))
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
    right.set(xlabel="n", ylabel="error (mm)", ylim=(0, None))
    right.set_title(f"error {errors[k]:.1f} mm")
    return fig


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
    right.set(xlabel="n, the same for all", ylabel="mean error / planned")
    right.set(yscale="log", ylim=(0.5, 20))
    right.set_yticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"])
    right.minorticks_off()
    return fig


def after_trial(plan, rules, trial, rule, noisy=()):
    """Hands after a trial of one rule; the mean errors of all against the extra reaches made.

    `rules` maps a name to hands over the hold (trials, n, T, 2), and the reaches of a trial.
    Dashed: `noisy`, mean errors after 0, 1, … reaches by Broyden's rule on an arm with noise, mm.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    for name, (holds, cost) in rules.items():
        errors = mean_mm(holds, plan.target)[: trial + 1]
        right.plot(cost * np.arange(trial + 1), errors, ".-", label=name)
    if len(noisy):
        right.plot(noisy, "--", color=COLOURS["grey"], label="Broyden, 2 mm of scatter")
    hold, cost = rules[rule][0][trial], rules[rule][1] * trial
    now = mean_mm(hold, plan.target)
    mark_now(right, cost, now)
    measure = "mean error" if len(plan.target) > 1 else "error"
    in_plane(left, plan, hold.mean(axis=1), f"extra reaches: {cost}, {measure} {now:.2g} mm")
    right.set(xlabel="extra reaches", xlim=(-1, 21), yscale="log", ylim=(0.3, 30))
    right.set_yticks([10, 5, 2, 1, 0.5], ["10", "5", "2", "1", "0.5"])
    right.minorticks_off()
    right.legend(title=f"{measure} (mm)", loc="lower right")
    return fig


def after_rounds(plan, holds, noisy, rounds, n):
    """Hands after so many rounds with one grid of n; the mean errors of all against the rounds.

    `holds` is what `offline_calibration.repeat_algorithm_1` returned. Dashed: with this grid on an
    arm with noise, `noisy` (draws, 1 + rounds), mm.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    errors = {name: mean_mm(each, plan.target) for name, each in holds.items()}
    now = errors[n][rounds]
    in_plane(left, plan, holds[n][rounds].mean(axis=1), f"mean error {now:.1f} mm")
    plot_noisy_mean(right, range(5), noisy)
    curves(right, range(5), errors, now=(rounds, now))
    right.set(xlabel="rounds", ylabel="mean error (mm)", ylim=(0, 25))
    return fig


def with_guards(errors, noisy):
    """Mean errors in mm, (trials, n) over the targets: of each trial, and of the best so far.

    Dashed: `noisy`, the best so far on an arm with noise (draws, trials), mm.
    """
    best = mean_best_so_far(errors)
    fig, ax = panels(size=(4.3, 3.2))
    ax.plot(errors.mean(axis=1), ".:", color=COLOURS["grey"], label="this trial")
    ax.plot(best, ".-", color=COLOURS["red"], label="the best so far")
    plot_noisy_mean(ax, range(len(best)), noisy)
    ax.set(xlabel="trial", ylabel="mean error (mm)", yscale="log", ylim=(0.5, 1000))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.set_title(f"before: {best[0]:.2g} mm; best of eight: {best[-1]:.2g} mm")
    ax.legend()
    return fig


def plot_noisy_mean(ax, x, curves):
    """Dashed over x (n,), the mean of `curves` (draws, n) on an arm whose hand scatters by 2 mm."""
    ax.plot(x, curves.mean(axis=0), "--", color=COLOURS["grey"], label="2 mm of scatter")


def after_the_command(away, reach):
    """Those distances by name, of one reach (its number as text) or the mean; the hold in grey."""
    fig, ax = panels(size=(4.3, 3.8))
    time = 1 + np.arange(next(iter(away.values())).shape[1]) * templates.EVERY / 1000
    shade(ax, 1, 1 + templates.HOLD)
    for name, each in away.items():
        mm = each[int(reach) - 1] if reach.isdigit() else each.mean(axis=0)
        ax.plot(time, mm, label=name)
    ax.set(xlabel="time (s)", ylabel="from the target (mm)", ylim=(0, 30))
    legend_above(fig, 1.0, columns=1)  # not over the hold
    return fig


HOLD_HEADS = [
    "plan",
    "miss where the command ends (mm)",
    "miss: mean distance in the hold (mm)",
    "bias: the mean place's (mm)",
    "speed in the hold (mm/s)",
]


def hold_table(holds, target):
    """`hold_numbers` of the hand's paths over the hold (n, T, 2), by plan: a table."""
    return table(HOLD_HEADS, {name: hold_numbers(hold, target) for name, hold in holds.items()})


def hold_numbers(hold, target):
    """`hold_measures` of paths (n, T, 2) for targets (n, 2) as text, below `HOLD_HEADS`."""
    *mm, speed = hold_measures(hold, target)
    return [*(f"{each:.2f}" for each in mm), f"{speed:.1f}"]


def in_plane(ax, plan, endpoints, title):
    """The reaches of a plan, (n, 2), among its templates."""
    reaches(ax, plan.template_set.points, plan.target, endpoints, title)
