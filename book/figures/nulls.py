"""What does the work? Each mechanism of the paper beside its nulls and ours."""

import numpy as np

from book.figures.panels import legend_above, mark_now, panels
from reproduce.experiments import learning_curves, nulls
from reproduce.experiments.calibration import SCENARIOS, load_results
from vmc_lib.show.palette import COLOURS
from vmc_lib.statistics import t_interval

READINGS = {  # how a movement is read -> what each rule then leaves after 0, 1, … tries
    "where the command ends": lambda: nulls.load_results()[nulls.BY_TRIES],
    "over the hold": lambda: nulls.load_results()[nulls.BY_TRIES_HELD],
    "over the hold, with 2 mm of scatter": lambda: learning_curves.load_results()["off-line"],
}
KINDS = nulls.IN_SAMPLE, nulls.HELD_OUT
LINES = {  # a rule -> its line
    nulls.EQ_6_7: ("blue", "-"),
    nulls.BLIND: ("orange", "-"),
    nulls.SAME_LENGTH: ("orange", ":"),
    nulls.RANDOM_LENGTH: ("blue", ":"),
    nulls.LINE: ("green", "--"),
    nulls.LEAST_SQUARES: ("green", "-"),
}
NULLS_ONLINE = nulls.SHUFFLED, *nulls.NO_LESSON
TEACHERS = {rule: LINES[rule] for rule in (nulls.EQ_6_7, nulls.BLIND, nulls.LINE)}
TEACHERS[nulls.IN_ORDER] = "blue", "--"


def by_tries(reading, tries):
    """What each rule leaves of the planned error after 0, 1, … `tries`, with 95 % bands.

    Where there is noise, dotted: what it alone leaves.
    """
    found = READINGS[reading]()
    fig, ax = panels(size=(4.3, 4.0))
    for rule in (name for name in LINES if name in found):
        shares = found[rule][:, : tries + 1]
        middle = _curve(ax, rule, LINES[rule], np.arange(tries + 1), shares)
        mark_now(ax, tries, middle[tries], LINES[rule][0])
    if "noise alone" in found:
        ax.axhline(found["noise alone"].mean(), ls=":", color=COLOURS["grey"], gid="noise alone")
    ax.set(xlabel="tries", ylabel="error / planned error", xlim=(0, nulls.TRIES), ylim=(0, 1.05))
    ax.set_xticks(range(0, nulls.TRIES + 1, 3))
    ax.set_yticks(np.arange(0, 1.1, 0.2).round(1))
    legend_above(fig, 1.1)
    return fig


def _curve(ax, rule, line, x, shares):
    """A rule's `line` over `x`, the mean of the draws (draws, x), returned, with its 95 % band."""
    (colour, style), (middle, half) = line, t_interval(shares)
    ax.plot(x, middle, style, color=COLOURS[colour], label=rule)
    ax.fill_between(x, middle - half, middle + half, color=COLOURS[colour], alpha=0.2, lw=0)
    return middle


def by_teaching():
    """What Algorithm 2 leaves after one experiment, by the tries that each of its lessons cost."""
    found = nulls.load_results()[nulls.BY_TEACHING]
    fig, *axes = panels(2, size=(6.4, 3.5))
    for ax, kind, movements in zip(axes, KINDS, ("practised", "never practised"), strict=True):
        for rule, line in TEACHERS.items():
            _curve(ax, rule, line, nulls.TAUGHT, found[f"{rule}, {kind}"])
        ax.set(title=movements, xlabel="tries a lesson", xlim=(0, nulls.TRIES), ylim=(0, 0.8))
        ax.set_xticks([0, *nulls.TAUGHT[2:]])
    axes[0].set_ylabel("error / planned error")
    axes[1].legend(loc="lower right")
    return fig


def tries_in_words(reading, tries):
    """The same in words: what each rule leaves after so many tries."""
    found = READINGS[reading]()
    left = ", ".join(f"{found[n][:, tries].mean():.2f} ({n})" for n in LINES if n in found)
    return f"After {tries} tries, read {reading}, of the planned error there is left: {left}."


def mechanisms():
    """The mechanism, its nulls, and ours: part of the model -> name -> (draws,).

    The miss over that of Eq. 5; and what is left of the planned error, off-line after the paper's
    tries and online after one experiment, for movements never practised.
    """
    found, own = nulls.load_results(), load_results()[SCENARIOS[0]]
    weights, tried, taught = (
        found[k] for k in (nulls.BY_WEIGHTS, nulls.BY_TRIES, nulls.BY_LESSONS)
    )
    return {
        "weights: miss over that of Eq. 5": {
            "the paper: Eq. 5": np.ones(1),
            **{f"null: {name}": weights[f"{name}, over Eq. 5"] for name in nulls.WEIGHTS},
            "ours: Eq. 4 solved exactly": weights[f"{nulls.EXACT}, over Eq. 5"],
        },
        "off-line, 21 tries: error left": {
            "the paper: Eq. 6–7": tried[nulls.EQ_6_7][:, -1],
            **{f"null: {name}": tried[name][:, -1] for name in nulls.NULLS},
            f"the error's direction: {nulls.LINE}": tried[nulls.LINE][:, -1],
            "ours: Broyden": tried[nulls.BROYDEN][:, -1],
        },
        "online, new reaches: error left": {
            "the paper: Algorithm 2": taught[f"{nulls.ALGORITHM_2}, held-out"][:, 1],
            f"the same, {nulls.BLINDLY_TAUGHT}": taught[f"{nulls.BLINDLY_TAUGHT}, held-out"][:, 1],
            **{f"null: {k}": taught[f"{k}, held-out"][:, 1] for k in NULLS_ONLINE},
            "ours, over the hold: granule cells": own["own online, 25 movements, held-out"],
            f"null, over the hold: {nulls.NO_LESSON[1]}": own["own online, 0 movements, held-out"],
        },
    }
