"""Templates of the whole arm: inverse kinematics, static optimisation, muscle synergies.

A posture is the one nearest to a comfortable posture among all that reach the goal. A minimum-jerk
path there gives torques by inverse dynamics; static optimisation shares them among the muscles with
the least squares of activation; excitations are what makes those activations. In the end, they are
what holds the arm where it has come to.
"""

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.optimize import least_squares, nnls

from reproduce import results
from reproduce.peers.muscle_models import lag
from reproduce.whole_arm import plant
from vmc_lib.arm.simulate import UNPERTURBED, check_unperturbed
from vmc_lib.motor.inverse_dynamics import MOVING, bounded_least_squares, minimum_jerk
from vmc_lib.motor.templates import TemplateSet

START = np.radians([70.0, 25.0, 0.0, 95.0, 0.0, 0.0, 0.0])  # elbow bent, the hand before the body
EASY = np.radians([70.0, 40.0, 0.0, 80.0, 0.0, 0.0, 0.0])  # what a posture would be, if it could
ZONE = np.array([[0.40, -0.25, -0.25], [0.58, 0.15, 0.20]])  # lowest and highest (x, y, z), m
SIDE = 5  # memories along each edge of the zone, of those that ship
EFFORT = 0.05  # what full activation of a muscle costs beside a missed N m
ARRIVED = 45  # commands, 0.9 s: from then on a memory only holds


def reach_posture(goal, easy=EASY):
    """The posture (7,) nearest to an easy one that puts the finger's tip on a goal (3,)."""
    ease, bounds = 0.1, plant.LIMITS.T + np.array([[0.01], [-0.01]])

    def off(q):
        return np.append(100 * (plant.tip_and_jacobian(q)[0] - goal), ease * (q - easy))

    def slopes(q):
        return np.vstack([100 * plant.tip_and_jacobian(q)[1], ease * np.eye(len(q))])

    return least_squares(off, easy.clip(*bounds), slopes, bounds=bounds).x


@dataclass(frozen=True, eq=False)
class SynergyMap:
    """Muscle synergies: which muscles share a command, `groups` (63, n), one 1 in each row."""

    groups: np.ndarray

    @cached_property
    def rest(self):
        """The commands (n,) that hold the arm where every reach starts."""
        return self.share(START, 0 * START, 0 * START)

    def move(self, commands):
        """The `plant.Motion` that commands (…, T, n) give the arm from rest in `START`."""
        return self.excite(commands @ self.groups.T)

    def excite(self, excitations, perturbation=UNPERTURBED):
        """The same for excitations (…, T, 63) of every muscle; ValueError for a perturbation."""
        check_unperturbed(perturbation)
        return plant.move(excitations, START, self.groups @ self.rest)

    def commands(self, goal):
        """The commands (T, n) of the smoothest way to a posture (7,), and a hold there."""
        path = minimum_jerk(START, goal, plant.TICKS, MOVING / 1000 / plant.TICK)
        velocity = np.gradient(path, plant.TICK, axis=0)
        acceleration = np.gradient(velocity, plant.TICK, axis=0)
        return invert_activation(
            [self.share(*now) for now in zip(path, velocity, acceleration, strict=True)]
        )

    def hold(self, commands):
        """The same commands (N, T, n), but for the last: these hold the arm where it is by then."""
        there = self.move(commands).joints[:, ARRIVED, plant.FREE]
        last = [[self.share(q, 0 * q, 0 * q)] * (plant.TICKS - ARRIVED) for q in there]
        return np.concatenate([commands[:, :ARRIVED], last], axis=1)

    def share(self, *moment):
        """Static optimisation: the activations (n,) with the least sum of squares that do it."""
        torque, gain = plant.required_torque(*moment)
        matrix = np.vstack([gain @ self.groups, EFFORT * np.diag(self.groups.sum(axis=0) ** 0.5)])
        wanted = np.append(torque, np.zeros(matrix.shape[1]))
        pull = nnls(matrix, wanted)[0]  # quicker, and right unless a muscle would need more than 1
        return pull if pull.max() <= 1 else bounded_least_squares(matrix, wanted)


def invert_activation(wanted):
    """Excitations (T, n) that give activations (T + 1, n) by MuJoCo's law, as far as they can."""
    active, excitations = wanted[0], []
    for want in wanted[1:]:
        gain = -np.expm1(-plant.TICK / lag(want, active))  # how much of the way a tick goes
        excitations.append(np.clip(active + (want - active) / gain, 0, 1))
        active = active + (excitations[-1] - active) * gain
    return np.array(excitations)


def muscle_synergies(count=plant.MODEL.nu):
    """Muscle synergies: a `SynergyMap` of `count` commands, shared by muscles of like effect.

    Alike are muscles whose pulls turn the joints alike in `START` (Ward's clusters of unit
    vectors); what turns none of the seven joints joins any.
    """
    gain = plant.required_torque(START, 0 * START, 0 * START)[1].T
    effect = gain / np.maximum(np.linalg.norm(gain, axis=1, keepdims=True), 0.1)
    kind = fcluster(linkage(effect, "ward"), count, "maxclust")
    if count == len(plant.MUSCLES):
        kind = np.arange(count) + 1
    return SynergyMap((kind[:, None] == np.unique(kind)).astype(float))


def stiff_activation(posture, stiff=0.3):
    """Co-contraction: activations (63,) that hold a posture (7,), nowhere less stiff than `stiff`.

    Static optimisation, in which each direction that gives way more easily, N m/rad, makes a demand
    of its own, until there is none (cutting planes).
    """
    torque, gain = plant.required_torque(posture, 0 * posture, 0 * posture)
    slack, active = plant.stiffness(posture)
    rows, wanted = np.vstack([gain, EFFORT * np.eye(gain.shape[1])]), np.append(torque, 0 * gain[0])
    demands, lacks = np.empty((0, gain.shape[1])), np.empty(0)
    while True:
        beyond = -np.eye(len(lacks))  # it may be stiffer
        matrix = np.block([[rows, np.zeros((len(rows), len(lacks)))], [demands, beyond]])
        pull = nnls(matrix, np.append(wanted, lacks))[0][: len(wanted) - len(torque)]
        stiffness, ways = np.linalg.eigh(slack + active @ pull)
        weak = ways.T[stiffness < stiff - 0.01]
        if not len(weak):
            return pull
        demands = np.vstack([demands, np.einsum("wi,ijn,wj->wn", weak, active, weak)])
        lacks = np.append(lacks, stiff - np.einsum("wi,ij,wj->w", weak, slack, weak))


def record_templates(synergies, goals, easy=EASY):
    """Record templates: a `TemplateSet` of reaches that end near the goals (N, 3).

    Each is tried once, and then aimed beyond its goal by as much as it missed. `easy` is the easy
    posture (7,), or one for each goal (N, 7). What is recorded are the excitations of all muscles.
    """
    missed = 0
    for _ in range(2):  # once at the goal, then beyond it by the miss
        ways = zip(goals + missed, np.broadcast_to(easy, (len(goals), len(EASY))), strict=True)
        commands = np.array([synergies.commands(reach_posture(*way)) for way in ways])
        commands = synergies.hold(commands)
        reached = synergies.move(commands).endpoint
        missed = goals - reached
    return TemplateSet(reached, commands @ synergies.groups.T, reach=synergies.excite)


def goal_grid(side=SIDE):
    """Goals (side³, 3) that fill the zone evenly."""
    return np.stack(np.meshgrid(*np.linspace(*ZONE, side).T), axis=-1).reshape(-1, 3)


def make(goals=None):
    """What ships: the densest memories' commands, rounded, and where they end so."""
    synergies = muscle_synergies()
    commands = record_templates(
        synergies, goal_grid() if goals is None else goals
    ).excitations.astype(np.float16)
    return {"commands": commands, "points": synergies.move(commands.astype(float)).endpoint}


@cache
def load_templates():
    """The shipped `TemplateSet`: 125 reaches of all 63 muscles."""
    shipped = results.arrays("whole_arm_habits")
    commands = shipped["commands"].astype(float)
    return TemplateSet(shipped["points"], commands, reach=muscle_synergies().excite)
