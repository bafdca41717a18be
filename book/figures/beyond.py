"""Figures of the chapter beyond the paper."""

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import panels
from book.figures.reaching import norm_mm
from reproduce import results
from reproduce.experiments.obstacle_avoidance import RADIUS
from reproduce.one_draw import WHOLE_HOLD
from vmc_lib.photos import LEVELS
from vmc_lib.show import note, table
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane
from vmc_lib.show.figures import margins
from vmc_lib.show.palette import COLOURS
from vmc_lib.show.svg_renderer import text_width
from vmc_lib.statistics import t_interval

TRIED = ((-0.05, 0.3), (-0.53, -0.25))  # the plane round the obstacles, m


def miss_histogram(miss):
    """How many reaches miss by how much: `miss` (n,) in mm, on a logarithmic axis, a median."""
    fig, ax = panels(size=(4.3, 3.0))
    ax.stairs(*np.histogram(miss, np.geomspace(2.5e-5, 40, 63)), fill=True)
    median = np.median(miss)
    ax.axvline(median, color="C1")
    ax.set_title(f"median {median:.2g} mm")
    ax.set(xscale="log", xlabel="miss, mean over the hold (mm)")
    ax.set(ylabel="reaches", ylim=(0, 20), yticks=range(0, 21, 5))
    ax.set_xticks([0.001, 0.1, 10], ["0.001", "0.1", "10"])
    return fig


def changes():
    """What each change leaves of the planned miss, of the ledger's draws: name -> (draws,)."""
    from reproduce.experiments import calibration  # these two are not in the page
    from reproduce.ledger import planning

    def label(name):
        rule = "least squares" if name == WHOLE_HOLD else "Broyden"
        return name.replace("own off-line", f"off-line, {rule}").replace("1 trials", "1 trial")

    removed = planning.draws("III, Block 3")[
        "share of the miss that exact weights remove, over the hold"
    ]
    ratios = {"Eq. 4 exactly": 1 - removed}
    ratios |= calibration.load_results()["changing neighbours"]
    no_shares = "planned / reach", ", mm", ", bias", ", speed", ", stray", " 2.5 s"
    return {label(k): draws for k, draws in ratios.items() if not k.endswith(no_shares)}


def boxes_table():
    """How many boxes are right in forty test photos of each level: a Markdown table."""
    from reproduce.experiments.localisation import table_2  # not in the page

    by_level = {level: table_2(level) for level in LEVELS}
    recipes = "published", "improved"
    rows = {level: [by[name][1] for name in recipes] for level, by in by_level.items()}
    heads = "boxes right (recall at IoU 0.8), forty test photos", *recipes
    return table(heads, rows, ".2f")


def sweeps():
    """The benches of growing experience: what grows -> its rows."""
    by_quantity = {}
    for row in results.records("bench/scaling")["rows"]:
        by_quantity.setdefault(row["more"], []).append(row)
    return by_quantity


def tenfold_divisor(rows):
    """What divides the error of a sweep's records: a tenfold size, on average, and all of it."""
    first, last = rows[0], rows[-1]
    whole = first["error"] / last["error"]
    return whole ** (1 / np.log10(last["size"] / first["size"])), whole


def scaling_curves(rows, quantity, measure):
    """Error and seconds against size, both logarithmic, of a sweep's records.

    `quantity` is what grows, `measure` names the error.
    """
    marked = [0, len(rows) // 2, -1]
    fig, *axes = panels(2)
    margins(fig, left=0.95)  # for ticks of three digits
    curves = ("error", measure, "blue"), ("seconds", "seconds to learn", "orange")
    for ax, (key, label, hue) in zip(axes, curves, strict=True):
        sizes, values = np.array([(row["size"], row[key]) for row in rows]).T
        ax.loglog(sizes, values, "o-", color=COLOURS[hue])
        ax.set(xlabel=quantity, ylabel=label)
        ax.set_xticks(sizes[marked], sizes[marked].astype(int))
        ax.set_yticks(values[marked], [f"{v:.3g}" for v in values[marked]])
        ax.minorticks_off()  # whose labels would lie over these
    axes[0].set_title(f"a tenfold divides by {tenfold_divisor(rows)[0]:.1f}")
    return fig


def reach_in_space(trials, target, trial):
    """One trial of a reach for one of several targets in space: the arm's scene, and its miss."""
    movement = trials.movements[trial]
    motion, turn = movement.motion
    moves = motion.q[target], motion.activation[target]
    scene = arm_scene(*moves, turn=turn[target], balls=[(movement.plan.target[target], "green")])
    mm = 1000 * trials.error[trial, target]
    scene.tell("miss", {"mm": round(mm, 4), "end": movement.endpoint[target].round(5).tolist()})
    return scene, note(f"misses by {mm:.1f} mm")


def detour(templates, places, ways, reach, route, senses, time):
    """The hand's path up to a time (s), past a ball, by a route and with senses.

    `places` are target, ball and via-point, reach -> (3, 2); `ways` paths, name -> (n, ticks, 2).
    """
    target, ball, via = places[reach]
    path = ways[f"{route}, {senses}"][[*places].index(reach), : round(100 * time) + 1]
    fig, ax = plt.subplots(figsize=(4.3, 3.2))  # inches: a phone has the plot's whole width
    plane(ax, templates, within=TRIED)
    ax.add_patch(plt.Circle(ball, RADIUS, color=COLOURS["orange"]))
    if route != "straight":
        ax.plot(*via, "+", ms=9, color=COLOURS["purple"], gid="via-point")
    ax.plot(*target, "o", ms=9, mfc="none", color=COLOURS["green"], gid="target")
    ax.plot(*path.T, color=COLOURS["blue"], gid="path")
    ax.plot(*path[-1], "o", ms=5, color=COLOURS["red"], gid="the hand")
    nearest = norm_mm(path - ball).min()
    ax.set_title(f"the hand came within {nearest:.0f} mm of the ball's middle")
    return fig


def race(target, rivals, reaches):
    """Rules that correct one reach: where what each has kept so far ends, and how far it misses.

    `rivals` maps a name to its `Movement`s (1 + tries, draws), `reaches` counts those made after
    the plan. Where there are many draws, the miss is their mean.
    """
    fig, left, right = panels(2, (8, 3.6))
    for k, (name, kept) in enumerate(rivals.items()):
        miss = 1000 * kept.error.mean(axis=1)[: reaches + 1]
        away = 1000 * (kept.endpoint[len(miss) - 1] - target)
        if len(away) == 1:
            left.plot([0, away[0, 0]], [0, away[0, 1]], f"C{k}", lw=1, gid="guide")
        left.plot(*away.T, "o", color=f"C{k}", ms=8 if len(away) == 1 else 3, label=name)
        right.plot(miss, ".-", color=f"C{k}", label=name)
    left.plot(0, 0, "o", ms=14, mfc="none", mew=2, color=COLOURS["green"], gid="target")
    left.set(xlim=(-16, 16), ylim=(-16, 16), aspect="equal")
    left.set(xlabel="forward of the target (mm)", ylabel="above it (mm)")
    right.set(xlabel="extra reaches", xlim=(-0.5, 21.5), yscale="log", ylim=(0.1, 20))
    right.set_yticks([10, 3, 1, 0.3, 0.1], ["10", "3", "1", "0.3", "0.1"])
    right.set_title("miss of what is kept (mm)")
    right.minorticks_off()
    right.legend(loc="lower right")
    return fig


def settings(found, argument=None):
    """Of what `sensitivity` found, each other setting; those alone that change an `argument`."""
    from reproduce.experiments import sensitivity  # not in the page

    return {
        name: found[name]
        for choice, others in sensitivity.CHOICES.items()
        for other, given in others.items()
        if argument in (None, *given)
        for name in [sensitivity.name_of(choice, other)]
    }


def tornado(rule):
    """How a rule's miss changes with each of our choices: mm, 95 % of the difference, in pairs.

    A bar for each other setting, from the miss as it is; the choices with most effect come first.
    """
    from reproduce.experiments import sensitivity  # not in the page

    found = sensitivity.load_results()
    usual = found[sensitivity.AS_IT_IS][rule]
    shifts = {
        choice: {
            f"{choice} → {other}": t_interval(
                found[sensitivity.name_of(choice, other)][rule] - usual
            )
            for other in others
        }
        for choice, others in sensitivity.CHOICES.items()
    }
    order = sorted(shifts, key=lambda choice: -max(abs(x) for x, _ in shifts[choice].values()))
    rows = {name: shift for choice in order for name, shift in shifts[choice].items()}
    shift, half = np.transpose([*rows.values()])
    # A phone has the plot's whole width: names longer than 2 inches stand in two lines
    names = [x if text_width(x) <= 2 else x.replace(" → ", "\n→ ") for x in rows]
    lines = [name.count("\n") + 1 for name in names]
    places = np.cumsum(lines) - np.divide(lines, 2)  # of a name's middle, in lines
    fig, ax = plt.subplots(figsize=(4.3, 0.8 + 0.19 * sum(lines)), layout="none")
    ax.barh(places, shift, left=usual.mean(), alpha=0.4, gid="shift")
    middle = usual.mean() + shift
    ax.errorbar(middle, places, xerr=half, fmt="o", ms=4, elinewidth=1.4, zorder=3)
    ax.axvline(usual.mean(), color=COLOURS["ink"], lw=1)
    ax.set_yticks(places, names)
    ax.set(xlabel=f"miss, {rule} (mm)", ylim=(sum(lines), 0))
    margins(
        fig, left=0.15 + max(text_width(x) for name in names for x in name.split("\n")), top=0.12
    )
    return fig


def tornado_in_words(rule):
    """The same in words: the miss as it is, and with every other setting."""
    from reproduce.experiments import sensitivity  # not in the page

    found = sensitivity.load_results()
    each = "; ".join(f"{x[rule].mean():.1f} mm ({name})" for name, x in settings(found).items())
    return f"The miss, {rule}: {found[sensitivity.AS_IT_IS][rule].mean():.1f} mm as it is; {each}."
