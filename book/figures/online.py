"""Figures of the chapter on online calibration: learning curves, granule cells, changed worlds."""

from book.figures.offline import SIDE_BY_SIDE, in_plane, plot_noisy_mean
from book.figures.panels import curves, panels, shade_change
from book.figures.reaching import mean_mm, norm_mm, reach_scene, reaches
from reproduce.experiments import learning_curves
from reproduce.experiments.calibration import SCENARIOS, ratio_name
from reproduce.experiments.controller_comparison import MOVEMENTS
from reproduce.experiments.online_calibration import STEPS, error_shares, holds_by_width
from reproduce.measures.changed_worlds import BLOCKS, CURES
from vmc_lib.motor.execution import execute, rotate_about_eye
from vmc_lib.show import note, table
from vmc_lib.show.palette import COLOURS

CHANGES = {  # from the paper's rule to ours, one after the other
    "Algorithm 2 as printed": "online, 1 experiment",
    "+ exact weights (Eq. 4)": "online, + exact weights, 1 experiment",
    "+ granule cells": "online, + granule cells, 1 experiment",
    "+ no off-line trials": "online, + no off-line trials, 1 experiment",
    "+ an aim, not weights: ours": "own online, 25 movements",
    "ours, 150 movements": "own online, 150 movements",
    "ours, 250 movements": "own online, 250 movements",
}
PERIODS = {  # blocks of an adaptation
    "at first": [2],
    "after 8 to 24 movements": [3, 4, 5],
    "after 40 to 56": [7, 8, 9],
    "change taken away": [10],
    "40 later": [15],
}


def progress(plans, history, steps, now, movements):
    """Hands at the step `now`; and what is left of the planned error, up to this step.

    `plans` and `history` by name, as `learn` takes and returns them.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    k, shares = steps.index(now), error_shares(history, plans)
    share = shares[movements][k]
    title = f"{share:.2f} of the planned error"
    in_plane(left, plans[movements], history[movements][k].mean(axis=1), title)
    curves(right, steps, {name: y[: k + 1] for name, y in shares.items()}, now=(now, share))
    right.set(ylabel="error / planned error", ylim=(0, 1.05))
    right.set_xlim(-0.04 * steps[-1], 1.04 * steps[-1])
    right.legend(loc="upper right")
    return fig


def after_experiment(plans, linear, published, experiment, movements, step_5, templates_are):
    """`progress` of Algorithm 2, by scenario; dashed, the ratio that the paper printed.

    `linear` holds a history for each reading of its step 5 and each scenario.
    """
    history = linear[step_5][templates_are]
    fig = progress(plans[templates_are], history, range(6), experiment, movements)
    fig.axes[1].axhline(published, ls="--", color=COLOURS["grey"])
    fig.axes[1].set_xlabel("experiments of 25 movements")
    return fig


def after_movements(plans, granule, linear, movements, templates_are, measured_on):
    """`progress` of granule cells, by scenario; dotted, that of Algorithm 2 (`linear`).

    Dashed: the mean of many draws on an arm whose hand scatters by 2 mm.
    """
    some = plans[templates_are]
    fig = progress(some, granule[templates_are], STEPS, movements, measured_on)
    line = error_shares(linear[templates_are], some)[measured_on]
    look = dict(color=COLOURS["grey"], gid="Algorithm 2")
    fig.axes[1].plot(STEPS[: len(line)], line, ":", **look)
    name = learning_curves.online_name(templates_are, learning_curves.NOISY)
    noisy = learning_curves.load_results()[name][f"granule cells, {measured_on}"]
    plot_noisy_mean(fig.axes[1], STEPS, noisy)
    fig.axes[1].set_xlabel("movements (dotted: Algorithm 2)")
    return fig


def by_reading(draws, experiments, end=None):
    """What either reading of step 5 leaves of the error: reading -> row -> (draws,).

    Of movements whose end point is over the hold, or by another `end`.
    """
    key = f", {end}" if end else ""
    rules = {"as printed": "online", "right for the target": "online, the other reading"}
    return {
        reading: {
            f"{scenario}, {on}": draws[scenario + key][f"{rule}, {ratio_name(experiments, on)}"]
            for scenario in SCENARIOS
            for on in ("in-sample", "held-out")
        }
        for reading, rule in rules.items()
    }


def readings_table(draws):
    """The same as a table."""
    rows = {row: [one[row] for one in draws.values()] for row in draws["as printed"]}
    return table(["error / planned error", *draws], rows)


def ablation(draws):
    """What is left of the error on movements never practised: scenario -> change -> (draws,)."""
    return {
        s: {row: draws[s][f"{name}, held-out"] for row, name in CHANGES.items()} for s in SCENARIOS
    }


def choose_width(plans, widths, holds, width, movements):
    """Hands with cells of one width; the mean error of each set of movements against the width.

    The `holds` of each set, (widths, n, T, 2), are known for some; for others cells practise anew.
    """
    holds = {k: dict(zip(widths, holds[k], strict=True)) for k in plans}
    if width not in widths:
        new = holds_by_width([width], plans)
        holds = {k: dict(sorted((holds[k] | new[k]).items())) for k in plans}
    fig, left, right = panels(*SIDE_BY_SIDE)
    errors = errors_by_width(plans, holds)
    now, widths = errors[movements][width], list(errors[movements])
    ended = holds[movements][width].mean(axis=1)
    in_plane(left, plans[movements], ended, f"mean error {now:.2f} mm")
    wider = widths[widths.index(width) :]
    curves(right, wider, {k: [mm[w] for w in wider] for k, mm in errors.items()}, now=(width, now))
    right.set(xscale="log", xlabel="granule cells' width (m)", title="mean error (mm)")
    highest = max(max(mm.values()) for mm in errors.values())
    right.set(xlim=(0.8 * widths[0], 1.25 * widths[-1]), ylim=(0, 1.1 * highest))
    right.set_xticks(widths, widths, minor=False)
    right.legend(loc="upper right")
    return fig


def errors_by_width(plans, holds):
    """Mean error in mm, name -> width -> number, for plans and hands of the same names."""
    return {
        name: {width: mean_mm(hold, plans[name].target) for width, hold in by_width.items()}
        for name, by_width in holds.items()
    }


def attempt_scene(attempts, attempt, online, offline):
    """One of the `lesions`, and by how much it misses."""
    movement = attempts[online, offline][int(attempt[0]) - 1]
    words = note(f"misses by {1000 * movement.error:.1f} mm")
    return reach_scene(movement.motion, movement.plan.target), words


def misses_by_lesion(attempts):
    """Misses in mm of both attempts of many reaches: attempt -> lesion -> (n,); see `lesions`."""
    names = {
        (online, offline): f"online {'kept' if online else 'lost'}, "
        f"off-line {'kept' if offline else 'lost'}"
        for online, offline in attempts
    }
    return {
        f"{ordinal} attempt": {names[kept]: 1000 * both[k].error for kept, both in attempts.items()}
        for k, ordinal in enumerate(("1st", "2nd"))
    }


def adaptation(templates, adaptations, noisy, block, change, cure):
    """Hands in a block of a `Curve`; the mean error of each block, dotted where nothing learns.

    Dashed: `noisy[change, cure]`, the mean of draws (draws, blocks) with 2 mm of scatter, mm.
    """
    fig, left, right = panels(*SIDE_BY_SIDE)
    curve, baseline = adaptations[change, cure], adaptations[change, CURES[-1]]
    errors = 1000 * curve.error
    reaches(left, templates, curve.target[block], curve.endpoint[block])
    shade_change(right, BLOCKS)
    name = cure
    if cure != CURES[-1]:
        name = f"correct the {cure}"
        right.plot(1000 * baseline.error, ":", color=COLOURS["grey"], gid=CURES[-1])
    plot_noisy_mean(right, range(len(errors)), noisy[change, cure])
    curves(right, range(len(errors)), {name: errors}, now=(block, errors[block]))
    right.set(xlabel="block of 8 movements", ylabel="mean error (mm)")
    right.set(xticks=range(0, 16, 5), ylim=(0, 110))
    right.set_title(f"block {block}: mean error {errors[block]:.0f} mm")
    return fig


def clamp_plot(drifts, clamp):
    """Drift by block under every error clamp of `drifts`, degrees -> (blocks,); one in blue.

    Dashed: where the hand would be if it made up for the `clamp`.
    """
    fig, ax = panels(size=(4.3, 3))
    for drift in drifts.values():
        ax.plot(drift, color=COLOURS["grey"], alpha=0.5, gid="other clamps")
    shade_change(ax, BLOCKS)
    ax.axhline(-clamp, ls="--", color=COLOURS["grey"])
    last, drift = sum(BLOCKS[:2]) - 1, drifts[clamp]
    curves(ax, range(len(drift)), {f"{clamp}°": drift}, now=(last, drift[last]))
    ax.set(xlabel="block of 8 movements", ylabel="drift, seen from the eye (°)", ylim=(-13, 1))
    ax.set_title(f"shown {clamp}° above, the hand ends {-drift[last]:.1f}° below")
    return fig


def reaches_in_worlds(trained, learners, plans, worlds):
    """Reaches in each changed world, (world, state) -> `Movement`: unaware, adapted, taken away."""
    reaches = {}
    for world, change in worlds.items():
        adapted = learners[world, "aim" if world == "a prism" else "pull"].correct(plans)
        reaches[world, "unaware"] = execute(trained.correct(plans), **change)
        reaches[world, "adapted"] = execute(adapted, **change)
        reaches[world, "taken away"] = execute(adapted)
    return reaches


def adapted_scene(movements, change, state):
    """A reach in a changed world or after it; its target is where a prism does not show it."""
    movement = movements[change, state]
    [motion], [target] = movement.motion, movement.plan.target
    return reach_scene(motion, rotate_about_eye(target, -movement.prism))


def periods_table(draws, names):
    """A table of mean errors in mm in `PERIODS`, six draws; `names` maps worlds to their names."""
    rows = [
        [name, cure, *(draws[f"{world}, {cure}"][:, k].mean(axis=1) for k in PERIODS.values())]
        for world, name in names.items()
        for cure in CURES
    ]
    return table(["change", "corrected", *PERIODS], rows)


def after_effects_table(moved):
    """A table of mean misses in mm; `moved` maps a world and a cure to `after_effects`."""
    rows = []
    for key, (first, left, after) in moved.items():
        misses = [1000 * each.error.mean() for each in (first, left, after)]
        by = norm_mm(left.endpoint - first.endpoint).mean()
        rows.append([*key, *(f"{mm:.0f} mm" for mm in (*misses, by))])
    heads = ["change", "corrected", "first miss", "left", "taken away", "correction moves it by"]
    return table(heads, rows)


def peers_table(peers):
    """A table of what `controller_comparison` shipped, each learner a row: means of six draws."""
    measured_on = "in-sample", "held-out", "held-out, noisy arm"
    [own, *_] = peers.values()
    rows = [
        [
            name,
            *(" → ".join(f"{draws[on][:, k].mean():.2f}" for k in (0, -1)) for on in measured_on),
            draws["seconds"].mean() / own["seconds"].mean(),
            int(draws["numbers"][0]),
        ]
        for name, draws in peers.items()
    ]
    left = f"left after {MOVEMENTS[0]} → {MOVEMENTS[-1]}"
    return table([left, *measured_on, "time / ours", "numbers remembered"], rows)
