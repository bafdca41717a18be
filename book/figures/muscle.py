"""Figures of a muscle: how it follows its excitation, its forces, and what a bench shows."""

import numpy as np

from book.figures.panels import panels
from book.figures.sarcomere import sarcomere
from reproduce.measures import muscle_bench
from reproduce.measures.muscle_bench import active_force, normalised_force
from vmc_lib.show.palette import COLOURS

SHORTEST = 0.4  # l₀: long before, myosin has met the discs; Thelen's law goes on


def lift(load, lengths, time):
    """A muscle that hangs from a post and lifts a load, and its filaments: a drawing (SVG).

    `load` is in kg; `lengths` (ms,), in l₀, are the fibre's after the release; `time` is in ms.
    """
    length, speed, said = _fibre(lengths, time)
    long, thick, box = 105 * length, 26 / np.sqrt(length), 16 * np.cbrt(load)
    low, hook = 30 + long, 46 + long  # where the belly ends, and its tendon
    belly = f"M85,30C{85 - thick:.1f},{30 + long / 3:.1f} {85 - thick:.1f},{30 + 2 * long / 3:.1f}"
    belly += f" 85,{low:.1f}C{85 + thick:.1f},{30 + 2 * long / 3:.1f} {85 + thick:.1f},"
    belly += f"{30 + long / 3:.1f} 85,30Z"
    beside = 'x="165" y="100"'
    return (
        '<svg viewBox="0 0 420 260" width="504" height="312" font-size="15">'
        '<path d="M30,10H140" stroke="var(--vmc-ink)" stroke-width="6"/>'
        f'<path d="M85,10V{hook:.1f}" stroke="var(--vmc-grey)" stroke-width="6"/>'
        f'<path d="{belly}" fill="var(--vmc-red)" stroke="var(--vmc-red)"/>'
        f'<path d="M35,{46 + 105 * lengths[0] + box:.1f}h40" stroke="var(--vmc-grey)" '
        'stroke-dasharray="4 4"/>'
        f'<rect x="{85 - box / 2:.1f}" y="{hook:.1f}" width="{box:.1f}" height="{box:.1f}" rx="3" '
        'fill="var(--vmc-grey)"/>'
        f'<text x="{95 + box / 2:.1f}" y="{hook + box / 2 + 5:.1f}" '
        f'fill="var(--vmc-ink)">{load} kg</text>'
        f'<g fill="var(--vmc-ink)"><text x="180" y="40">{time} ms</text>'
        f'<text x="180" y="64">{said}</text></g>'
        f"{sarcomere(length, speed, beside, 250)}</svg>"
    )


def lift_in_words(load, lengths, time):
    """The drawing of `lift`, described."""
    return f"A muscle with {load} kg after {time} ms: {_fibre(lengths, time)[2]}."


def _fibre(lengths, time):
    """A fibre's length in l₀ and its speed in l₀/s at a `time` in ms, or where it ends; in words.

    It moves from when it is let go, at 0 ms.
    """
    possible = _possible_lengths(lengths)
    now = min(time, len(possible) - 1)
    length, speed = possible[now], 1000 * np.gradient(possible)[now]
    way = "shortening" if speed < 0 else "lengthening"
    return length, speed, f"length {length:.2f} l₀, {way if now else 'half on'}"


def response(excitation, activation, with_means=False):
    """An excitation (T,), one value a ms, and the activation (T,) that follows it."""
    means = [f", mean {x.mean():.2f}" * with_means for x in (excitation, activation)]
    fig, ax = panels(size=(4.3, 2.6))
    time = np.arange(len(excitation))
    ax.fill_between(time, excitation, color=COLOURS["line"], label="excitation" + means[0])
    ax.plot(time, activation, color=COLOURS["red"], label="active" + means[1])
    ax.set(xlabel="time (ms)", ylim=(0, 1.25), yticks=[0, 0.5, 1])
    ax.legend(loc="upper right", ncols=2)
    return fig


def force_curves(law, length, speed):
    """The filaments of a fully active muscle, its pull against length, and against speed.

    `law` is a `Muscle`, `length` in l₀, `speed` in l₀/s: against speed, up to this one.
    """
    lengths, speeds = np.linspace(0.3, 1.8, 61), np.linspace(-8, 4, 61)
    fig, left, right = panels(2)
    left.plot(lengths, active_force(law, lengths, 0), color=COLOURS["red"], gid="heads")
    left.plot(lengths, normalised_force(law, 0, lengths, 0), color=COLOURS["blue"], gid="springs")
    dots = active_force(law, length, 0), normalised_force(law, 0, length, 0)
    left.plot([length] * 2, dots, "o", color=COLOURS["ink"], gid="now")
    left.set(xlabel="length (l₀)", ylim=(0, 2), title="held still (F₀)")
    so_far, now = speeds[speeds <= speed], normalised_force(law, 1, length, speed)
    pull = normalised_force(law, 1, length, so_far)
    right.plot(so_far, pull, color=COLOURS["purple"], gid="pull")
    right.plot(speed, now, "o", color=COLOURS["ink"], gid="guide")
    right.set(xlabel="speed (l₀/s), lengthening +", xlim=(-8, 5), ylim=(0, 2))
    right.set_title(f"pulls with {now:.2f} F₀")
    return sarcomere(length, speed), fig


def force_velocity(speed, f2):
    """The force-velocity curve f₂ (n,) over a fibre's speed (n,) in l₀/s."""
    fig, ax = panels(size=(4.3, 2.6))
    ax.plot(speed, f2, color=COLOURS["purple"])
    ax.set(xlabel="fibre's speed (l₀/s)", ylim=(-0.1, 1.8))
    ax.set_title("← shortening  f₂  lengthening →")
    return fig


def isometric(force):
    """The force (600,) in N of a muscle held still under pulses, and its pull before them."""
    fig, ax = panels(size=(4.3, 2.6))
    ax.axhline(force[0], color=COLOURS["blue"], label="passive")
    ax.plot(force, color=COLOURS["red"], label="total")
    ax.set(xlabel="time (ms)", ylabel="force (N)", ylim=(0, 1600))
    ripple = f"{muscle_bench.ripple(force):.0%}"
    ax.set_title(f"ripple: (highest − lowest) / mean = {ripple}", loc="left")
    ax.legend(loc="upper right", ncols=2)
    return fig


def isotonic(loads, load, lengths, speeds):
    """Fibre lengths (ms, n) under loads (n,) in kg, up to one of them, and Hill's curve.

    A fibre is drawn until it is below `SHORTEST`. The curve is how fast it shortens 50 ms after
    the release: `speeds` (ms, n) in l₀/s.
    """
    k, shortening = list(loads).index(load), -speeds[50]
    fig, left, right = panels(2)
    for mass, length in zip(loads[: k + 1], lengths.T, strict=False):
        left.plot(_possible_lengths(length), color=COLOURS["line"], linewidth=1, gid=f"{mass:g} kg")
    left.plot(_possible_lengths(lengths[:, k]), color=COLOURS["red"], gid="guide")
    left.set(xlabel="time (ms)", title="fibre length (l₀)", xlim=(-15, 315), ylim=(0, 2))
    right.plot(loads[: k + 1], shortening[: k + 1], ".-", color=COLOURS["purple"], gid="speed")
    right.plot(load, shortening[k], "o", color=COLOURS["red"], gid="guide")
    room = 0.1 * np.ptp(shortening)
    edges = shortening.min() - room, shortening.max() + room
    right.set(xlabel="load (kg)", xlim=(-3, 84), ylim=edges)
    way = "shortens" if shortening[k] > 0 else "lengthens"
    right.set_title(f"{way} by {abs(shortening[k]):.2f} l₀/s after 50 ms")
    return fig


def _possible_lengths(length):
    """A fibre's lengths (ms,) until one is below `SHORTEST`."""
    return length[: (length < SHORTEST).argmax() or None]
