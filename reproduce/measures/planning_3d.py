"""Planning in space (Eq. 3–5 in R³): the trunk's turn is remembered with a reach and mixed too.

The paper proposes its method in three dimensions and tests it in two. Here a memory is a reach in
the arm's plane together with the trunk's turn under which it was made. The turn is a command like
the six excitations, so that all that plans and calibrates in the plane does so in space. Positions
are in the frame of the trunk straight ahead, in m.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from vmc_lib import NoReach
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics, to_world, turn_towards
from vmc_lib.arm.simulate import UNPERTURBED
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import planning, templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.templates import HeldMotion

TURNS = np.radians([-10.0, 5.0, 20.0, 35.0, 50.0, 65.0])


class TrunkMovement(NamedTuple):
    """A movement of the arm on a trunk that has turned by `turn` (…), rad."""

    motion: HeldMotion
    turn: np.ndarray

    @property
    def hold(self):
        """The hand's path over the hold, (…, n, 3), m."""
        return to_world(self.motion.wrist, self.turn[..., None])

    @property
    def endpoint(self):
        """Where the hand is on average over the hold, (…, 3), m."""
        return self.hold.mean(axis=-2)


def move(commands, perturbation=UNPERTURBED):
    """What commands (…, T, 7), six excitations and the turn, make of the arm and the trunk."""
    return TrunkMovement(templates.reach(commands[..., :-1], perturbation), commands[..., -1, -1])


def with_trunk_turns(template_set):
    """A `TemplateSet` in space: every reach of a set (N) under every turn, which changes fastest.

    Its commands are (6 N, T, 7).
    """
    count, turns = len(TURNS), np.tile(TURNS, len(template_set.points))
    excitations = np.repeat(template_set.excitations, count, axis=0)
    held = np.broadcast_to(turns[:, None, None], (*excitations.shape[:2], 1))
    ends = np.repeat(templates.reach(template_set.excitations).wrist.mean(axis=1), count, axis=0)
    limits = np.append(np.zeros(6), -np.inf), np.append(np.ones(6), np.inf)  # the trunk's: none
    commands = np.concatenate([excitations, held], axis=-1)
    return templates.TemplateSet(to_world(ends, turns), commands, limits, move)


def surrounding(target, template_set):
    """Rows (…, 8) round a target (…, 3): four reaches of a set about it, each under two turns.

    `NoReach` when the target is outside the space that experience covers.
    """
    turn, p = turn_towards(target)
    far = (turn <= TURNS[0]) | (turn >= TURNS[-1])
    if np.any(far):
        first, needed = target[far][0], np.degrees(np.asarray(turn)[far][0])
        raise NoReach(
            f"target {first} m needs a turn of {needed:.0f}°, outside those remembered; move it"
        )
    before = np.searchsorted(TURNS, turn)[..., None] - 1
    rows = planning.surrounding(p, template_set.points) * len(TURNS) + before
    return np.concatenate([rows, rows + 1], axis=-1)


def plan(targets, template_set, rule=planning.habitual_weights):
    """The `Plan` for targets (n, 3), by Eq. 5 or another rule."""
    chosen = surrounding(targets, template_set)
    return planning.plan(targets, with_trunk_turns(template_set), rule, chosen)


def plan_and_correct(targets, template_set, trials=3):
    """`Trials` for targets (n, 3): planned by Eq. 5, then corrected by Eq. 4."""
    habit = plan(targets, template_set)
    return broyden_calibration(habit, trials, broyden=False, guarded=False)


def experiment(seed, count=100, trials=3, laws=None):
    """One draw of `count` targets in space: numbers by name.

    "planned / reach" is the mean miss over the mean distance from the shoulder; "exact / reach",
    the same with weights that satisfy Eq. 4; "in the plane", the same for the same reaches before
    the trunk turns; "corrected 1 ×" and so on, what is left of the planned miss; and by the names
    of other `laws`, each of a random generator `rng`, what the best of as many tries leaves.
    """
    rng, past = np.random.default_rng(seed), templates.load()
    flat = planning.draw_targets(past, count, rng)
    places = hand(inverse_kinematics(flat))
    targets = to_world(places, rng.uniform(TURNS[0], TURNS[-1], count))
    distance = np.linalg.norm(places, axis=1).mean()
    habit = plan(targets, past)
    planned, *left = plan_and_correct(targets, past, trials).error.mean(axis=1)
    by_luck = {
        name: algorithm_1(habit, range(trials), change=partial(law, rng=rng)).error
        for name, law in (laws or {}).items()
    }
    exact = execute(plan(targets, past, planning.exact_weights)).error.mean()
    in_plane = execute(planning.plan(flat, past)).error.mean()
    return {
        "planned / reach": planned / distance,
        "exact / reach": exact / distance,
        "in the plane": in_plane / np.linalg.norm(flat, axis=1).mean(),
        **{f"corrected {k} ×": mean / planned for k, mean in enumerate(left, start=1)},
        **{
            f"{name} {k} ×": tried[: k + 1].min(axis=0).mean() / planned
            for name, tried in by_luck.items()
            for k in range(1, trials + 1)
        },
    }
