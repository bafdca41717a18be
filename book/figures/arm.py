"""Figures of the arm: what its muscles can do, and how it compares."""

import numpy as np

from book.figures.panels import muscle_key, muscle_lines, panels
from book.figures.reaching import arrows
from reproduce.measures import holding, opensim_arm
from vmc_lib.arm import dynamics
from vmc_lib.arm.model import MUSCLES
from vmc_lib.motor.inverse_dynamics import static_activation
from vmc_lib.show.arm import arm_scene
from vmc_lib.show.arm_plane import plane_view
from vmc_lib.show.figures import note
from vmc_lib.show.palette import COLOURS

JOINTS = {"shoulder": np.arange(-60, 61), "elbow": np.arange(0, 131)}  # degrees
LEVEL = np.radians([0, 90])  # the upper arm hangs, the forearm is level
HEAVIEST = 4  # kg: of the loads shown


def held_posture(shoulder, elbow):
    """The arm held in a posture (degrees) with the least activation, and whether it is held."""
    q = np.radians([shoulder, elbow])
    return arm_scene(q, static_activation(q)), note(_held(q))


def held_in_words(shoulder, elbow):
    """Whether a posture (degrees) is held, and each muscle's activation."""
    q = np.radians([shoulder, elbow])
    each = zip(MUSCLES, static_activation(q), strict=True)
    return f"{_held(q)}. Activations: " + ", ".join(f"{name} {a:.2f}" for name, a in each)


def _held(q):
    torques = holding.muscle_torques(q) @ static_activation(q)
    lack = np.abs(holding.required_torques(q) - torques).max()
    return "held against gravity" if lack < 0.05 else f"falls: {lack:.1f} N m are missing"


def moment_arms_and_torques(muscle_torques, joint, other):
    """Each muscle's moment arm and greatest torque as a joint turns, the other one at `other`°.

    `muscle_torques(q)` are the greatest torques (…, 2, 6).
    """
    k, turn = list(JOINTS).index(joint), JOINTS[joint]
    q = np.radians(np.full((len(turn), 2), float(other)))
    q[:, k] = np.radians(turn)
    fig, left, right = panels(2, size=(6.5, 3.1))
    muscle_lines(left, turn, 1000 * dynamics.paths(q)[1][:, k])
    muscle_lines(right, turn, muscle_torques(q)[:, k])
    left.set(title="moment arm (mm)", ylim=(-55, 55), xlabel=f"{joint} (degrees)")
    right.set(title="greatest torque (N m)", ylim=(-45, 45), xlabel=f"{joint} (degrees)")
    return muscle_key(), fig


def holding_map(muscle_torques, busiest, load):
    """The torques that six muscles can hold in one posture, and where the wrist can be held.

    `muscle_torques(q)` are the muscles' greatest torques (…, 2, 6); `busiest(q, load)` is the
    busiest muscle's least activation (…), for a load in kg.
    """
    fig, left, right = panels(2, size=(8.2, 4.0))
    torque_polygon(left, muscle_torques(LEVEL), holding.required_torques(LEVEL, load))
    left.update_datalim([holding.required_torques(LEVEL, HEAVIEST)])  # one scale for all loads
    left.set_title(f"forearm level: busiest {busiest(LEVEL, load):.0%}")
    x, y, _ = np.moveaxis(dynamics.hand(holding.POSTURES), -1, 0)
    least, steps = busiest(holding.POSTURES, load), [-1, 0.1, 0.25, 0.5, 1]
    shades = [(COLOURS["blue"], opacity) for opacity in (0.6, 0.4, 0.22, 0.08)]
    areas = right.contourf(x, y, least, steps, colors=shades)
    plane_view(right)
    patches, _ = areas.legend_elements()
    labels = ["to 10%", "to 25%", "to 50%", "to 100%"]
    for patch in patches:
        patch.set_edgecolor(COLOURS["blue"])  # the faintest, too, is seen on a dark page
    right.legend(patches, labels, loc="upper center")  # between the shoulder and the arc
    right.text(0.14, -0.4, "● shuttlecocks", color=COLOURS["red"], va="center")
    right.set_title(f"holds {(least <= 1).mean():.0%} of all postures")
    return fig


def torque_polygon(ax, each, needed):
    """The torques that six muscles can hold together, those of `each` (2, 6), and the needed."""
    corners = [each[:, each.T @ way > 0].sum(axis=1) for way in holding.DIRECTIONS.T]
    ax.fill(*np.transpose(corners), color=COLOURS["blue"], alpha=0.2)
    arrows(ax, [0, 0], each.T, "ink")
    for name, tip in zip(MUSCLES, each.T, strict=True):
        left = name in ("TRIlat", "BRA")  # another's name stands on the right
        side = "right" if left else "left"
        at = -3 if left else 3, -12 if tip[1] < 0 else 3
        if name.startswith("BIC"):  # on either side of it the other's arrow runs
            side, at = "center", (0, 14 if name == "BICshort" else 5)
        ax.annotate(name, tip, at, textcoords="offset points", ha=side)
    ax.plot(*needed, "x", color=COLOURS["red"], ms=9, mew=2)
    ax.set(xlabel="at the shoulder (N m)", ylabel="at the elbow (N m)")


def end_in_words(motion):
    """Where a movement ends."""
    return "At the end: shoulder {:.0f}°, elbow {:.0f}°.".format(*np.degrees(motion.q[-1]))


def laws_beside_opensim(by_law, command, law):
    """The movements (4, 601, 2) of each muscle law under a command, one marked; and OpenSim's."""
    k, time = opensim_arm.COMMANDS.index(command), np.arange(10, 601, 30)
    fig, *axes = panels(2)
    for joint, (name, ax) in enumerate(zip(JOINTS, axes, strict=True)):
        for other, q in by_law.items():
            gid = "guide" if other == law else other
            ax.plot(np.degrees(q[k, :, joint]), color=COLOURS["line"], gid=gid)
        angle = np.degrees(by_law[law][k, :, joint])
        ax.plot(angle, color=COLOURS["purple"], gid=law)
        dots = np.degrees(opensim_arm.RECORDED["elastic"][k, ::3, joint])
        ax.plot(time, dots, ".", color=COLOURS["ink"], markersize=4, gid="OpenSim")
        ax.set(xlabel="time (ms)")
        ax.set_title(f"{name}: {angle.min():.0f}° to {angle.max():.0f}°")
    return fig


def engine_difference(gap):
    """How far two engines are apart, (movements, T) in degrees, a millisecond apart."""
    fig, ax = panels(size=(4.3, 2.6))
    ax.semilogy(gap.T + 1e-14, color=COLOURS["blue"], alpha=0.4, linewidth=1)
    ax.set(xlabel="time (ms)", ylabel="difference (°)")
    return fig


def paths_beside_opensim(muscle, joint):
    """A muscle's length, ours and OpenSim's, as one joint turns, and what is between them."""
    k, column = MUSCLES.index(muscle), list(JOINTS).index(joint)
    q, apart = opensim_arm.RECORDED["q"], opensim_arm.path_differences()
    alone = np.isclose(q[:, 1 - column], np.radians([60, 0])[column])  # the other joint stays
    turn = np.degrees(q[alone, column])
    fig, left, right = panels(2)
    ours = 1000 * dynamics.paths(q)[0][alone, k]
    left.plot(turn, ours, color=COLOURS["purple"], gid="ours")
    theirs = 1000 * opensim_arm.RECORDED["lengths"][alone, k]
    left.plot(turn, theirs, ".", color=COLOURS["ink"], markersize=4, gid="OpenSim")
    left.update_datalim([(0, ours.mean() - 5), (0, ours.mean() + 5)])  # rounding alone stays small
    left.set(xlabel=f"{joint} (degrees)", title="length (mm)")
    for row, colour, name in ((0, "red", "length"), (1 + column, "blue", "arm")):
        right.plot(turn, apart[row, alone, k], color=COLOURS[colour], label=name)
    right.set(xlabel=f"{joint} (degrees)", ylim=(-6, 6))
    most = opensim_arm.largest_differences()[0, k]
    right.set_title(f"−70° to 30°: up to {most:.3f} mm")
    right.legend(loc="lower left", ncols=2)
    return fig


def step_error(steps, miss):
    """How far the wrist ends from where the smallest steps put it: (n,) in mm, steps in ms."""
    fig, ax = panels(size=(4.3, 2.6))
    ax.plot(steps, miss, "o-", color=COLOURS["purple"])
    ax.set(xlabel="step (ms)", ylabel="wrist differs by (mm)")
    ax.set(xlim=(0, None), ylim=(0, None))
    return fig


def elbow_torques(bag, muscle):
    """The torques of 1 kg at two lever arms in m, as bars."""
    fig, ax = panels(size=(4.3, 1.8))
    ax.barh(["bag", "muscle"], [9.81 * bag, 9.81 * muscle], color=[COLOURS["grey"], COLOURS["red"]])
    ax.set(xlabel="torque at the elbow (N m)", xlim=(0, 7))
    return fig
