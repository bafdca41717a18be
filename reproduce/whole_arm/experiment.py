"""Experiments with the whole arm: does mixing (Eq. 3–5) survive redundancy?

Eight memories surround a place in space, one in each octant; whatever plans and corrects is
`vmc_lib`'s, the same as for the arm of six muscles.
"""

from dataclasses import replace
from functools import cache
from time import process_time

import numpy as np

from reproduce import results
from reproduce.peers import motor_noise
from reproduce.whole_arm import habits, plant
from reproduce.whole_arm.habits import ZONE, goal_grid
from vmc_lib.arm.simulate import UNPERTURBED
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.cerebellum.online import AimCorrection, GranuleCells
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import exact_weights, first_inside, is_surrounded, plan, surrounding
from vmc_lib.motor.templates import mean_distance

INSIDE = ZONE + np.array([[0.04], [-0.04]])  # m: targets keep so far from its edge
SEEDS, COUNT = range(6), 17  # draws of targets, and targets of each
LESSONS = 6  # movements practised, for each target held out
WIDTH = 0.1  # m: how wide granule cells are; chosen on validation targets
NUDGE = 0.03  # rad: how far each joint is turned aside
PROBE = 0.1  # of one weight, to see what it does
SPARE = 0.5  # rad: how far apart memories' easy postures are that share no habit
ANY_POSTURE = "any posture"  # of memories that share none


def draw_targets_3d(*memories, count, rng):
    """Targets (count, 3) in the zone that all these sets of memories surround.

    ValueError where they surround so little of it that the draw does not fill up.
    """
    drawn = rng.uniform(*INSIDE, (8 * count + 20, 3))
    inside = [is_surrounded(drawn, known.points) for known in memories]
    return first_inside(drawn, np.all(inside, axis=0), count)


def mean_way(targets):
    """How far the finger moves to targets (n, 3) on average, m."""
    return np.linalg.norm(targets - plant.tip_and_jacobian(habits.START)[0], axis=-1).mean()


def planned_errors(past, targets):
    """The mean miss over the mean way, by name; what corrections leave of it; speed, stray then.

    The way is what is moved; a reach is as long as its target (n, 3) is far from the shoulder.
    """
    trials = broyden_calibration(plan(targets, past))
    exact = execute(plan(targets, past, rule=exact_weights)).error.mean()
    none, *left = trials.error.mean(axis=1)
    first, *_, last = trials.movements
    return {
        "planned / way": none / mean_way(targets),
        "planned / reach": none / np.linalg.norm(targets, axis=-1).mean(),
        "Eq. 4 / way": exact / mean_way(targets),
        **{f"{k} corrections": miss / none for k, miss in enumerate(left, start=1)},
        **{"planned speed": first.speed.mean(), "planned stray": first.stray.mean()},
        **{"corrected speed": last.speed.mean(), "corrected stray": last.stray.mean()},
    }


def with_noise(past, share, rng):
    """The memories `past`, on an arm whose commands waver by a share of their size, also held."""

    def reach(commands, perturbation=UNPERTURBED):
        held = np.pad(commands, [*(commands.ndim - 2) * [(0, 0)], (0, plant.HOLD), (0, 0)], "edge")
        moved = past.reach(motor_noise.with_noise(held, share, rng, plant.TICK), perturbation)
        return plant.Motion(*(x[..., : -plant.HOLD, :] for x in moved))

    return replace(past, reach=reach)


class StopMotion(plant.Motion):
    """A movement of which six numbers count: the finger's place over the hold, and its drift."""

    @property
    def hold(self):
        """The finger's path over the hold, and with each place the whole drift, (…, n, 6), m."""
        path = super().hold
        drift = path[..., -1:, :] - path[..., :1, :]
        return np.concatenate([path, np.broadcast_to(drift, path.shape)], axis=-1)


def stop_calibration(reach, trials=4):
    """Calibrate one reach so that the finger ends on its target *and* stops: `Trials`, (trials, 6).

    Eight weights can meet six demands. What each weight does to them is tried first, in eight
    movements; then Broyden's method goes on from there.
    """
    own, count = reach.template_set, reach.weights.size
    past = replace(own, excitations=own.excitations[reach.rows], points=own.points[reach.rows])
    past = replace(past, reach=lambda *asked: StopMotion(*own.reach(*asked)))
    target = np.append(reach.target, np.zeros(3))
    planned = replace(reach, template_set=past, target=target, rows=np.arange(count))
    ways = PROBE * (np.eye(count) - 1 / count)
    ends = execute(planned.with_weights(reach.weights + ways)).endpoint
    slopes = (ends - execute(planned).endpoint) / PROBE
    return broyden_calibration(planned, trials, jacobian=slopes.T)


def stop_errors(past, seed, count=5):
    """One draw: mean miss, m, and speed over the hold, m/s, after four corrections of each kind."""
    drawn = draw_targets_3d(past, count=count, rng=np.random.default_rng((seed, 2)))
    reaches = plan(drawn, past)
    alone = broyden_calibration(reaches, n_trials=4).movements[-1]
    both = [stop_calibration(reaches[k]).movements[-1] for k in range(count)]
    misses = [
        mean_distance(end.hold[:, :3], target) for end, target in zip(both, drawn, strict=True)
    ]
    return {
        **{"place, miss": alone.error.mean(), "place, speed": alone.speed.mean()},
        "place and drift, miss": np.mean(misses),
        "place and drift, speed": np.mean([end.speed for end in both]),
    }


def nudge(activation, dampers=1.0, count=4, seconds=3):
    """How far the finger is from its place, (count, T), m, after its joints were turned aside.

    The arm starts at rest near `START`, one nudge for each movement; activations (63,) hold on.
    """
    ways = np.random.default_rng(0).choice([-NUDGE, NUDGE], (count, len(plant.FREE)))
    commands = np.tile(activation, (round(seconds / plant.TICK) - plant.HOLD, 1))
    moved = [plant.move(commands, habits.START + way, activation, dampers).joints for way in ways]
    place = plant.tip_and_jacobian(habits.START)[0]
    return np.linalg.norm(plant.fingertip(moved) - place, axis=-1)


def drift(past, seconds=3):
    """How long the memories' last commands hold: how far the finger is after `seconds`, each, m."""
    more = round(seconds / plant.TICK) - plant.HOLD - plant.TICKS
    commands = np.pad(past.excitations, ((0, 0), (0, more), (0, 0)), "edge")
    return np.linalg.norm(past.reach(commands).hold[:, -1] - past.points, axis=-1)


def online_errors(past, seed, count=COUNT, width=WIDTH):
    """One draw: what online calibration leaves of the planned miss, in sample and held out.

    It practises `LESSONS` times as many movements as are held out; "in-sample" are the first
    `count` of them, so that both are of one number.
    """
    rng = np.random.default_rng(100 + seed)
    new, practised = (
        plan(draw_targets_3d(past, count=n, rng=rng), past) for n in (count, LESSONS * count)
    )
    spots = rng.uniform(*ZONE, (4000, 3))
    spots = spots[is_surrounded(spots, past.points)]
    around = np.unique(surrounding(spots, past.points), axis=0)
    aims = AimCorrection(past, GranuleCells(width), around).update(practised)
    return {
        name: execute(aims.correct(plans)).error.mean() / execute(plans).error.mean()
        for name, plans in (("in-sample", practised[:count]), ("held-out", new))
    }


def optimised_errors(past, synergies, seed, count=COUNT):
    """One draw: every reach computed afresh, as the memories were made, beside mixing them.

    The optimiser's miss over the way: at once; then with one movement more, after which the hold is
    made ("held") or all is aimed beyond the goal by the miss ("aimed"); and "again", as memories
    are made, by three. And the seconds that a plan takes.
    """
    targets = draw_targets_3d(past, count=count, rng=np.random.default_rng(seed))
    began = process_time()
    commands = np.array([synergies.commands(habits.reach_posture(goal)) for goal in targets])
    spent = process_time() - began
    began = process_time()
    plan(targets, past).excitations  # noqa: B018 (they are made when they are asked for)
    seconds = {
        "seconds, optimiser": spent / count,
        "seconds, habit": (process_time() - began) / count,
    }
    moved, again = synergies.move(commands), habits.record_templates(synergies, targets)
    beyond = 2 * targets - moved.endpoint
    aimed = np.array([synergies.commands(habits.reach_posture(goal)) for goal in beyond])
    holds = {
        "once": moved.hold,
        "held": synergies.move(synergies.hold(commands)).hold,
        "aimed": synergies.move(aimed).hold,
        "again": again.reach(again.excitations).hold,
    }
    off = {k: mean_distance(hold, targets).mean() for k, hold in holds.items()}
    return seconds | {f"{name} / way": miss / mean_way(targets) for name, miss in off.items()}


def covered_share(past, count=1000):
    """The share of the zone that memories surround."""
    spots = np.random.default_rng(0).uniform(*INSIDE, (count, 3))
    return float(is_surrounded(spots, past.points).mean())


def seconds_per_second(synergies, count=5):
    """How many seconds of the arm's life one second of a processor simulates."""
    began = process_time()
    synergies.move(np.tile(synergies.rest, (count, plant.TICKS, 1)))
    return count * plant.TICK * (plant.TICKS + plant.HOLD) / (process_time() - began)


def random_postures(goals, rng):
    """Easy postures (N, 7), another for each goal: memories that share no habit of posture."""
    return habits.EASY + rng.uniform(-SPARE, SPARE, (len(goals), len(habits.EASY)))


@cache
def memory_sets(sides=(3, 4), shared=(6, 14, 34)):
    """Sets of memories by name: of grids with so many along each edge, and of so few commands."""
    own, few = habits.muscle_synergies(), goal_grid(sides[0])
    sets = {f"{side**3} memories": habits.record_templates(own, goal_grid(side)) for side in sides}
    return sets | {
        f"{count} commands": habits.record_templates(habits.muscle_synergies(count), few)
        for count in shared
    }


def memories_of_any_posture(seed, side=3):
    """Memories of all 63 muscles, each of an easy posture of its own, drawn with a seed."""
    goals, rng = goal_grid(side), np.random.default_rng((seed, 1))
    return habits.record_templates(habits.muscle_synergies(), goals, random_postures(goals, rng))


def make(sides=(3, 4), shared=(6, 14, 34), past=None, seeds=SEEDS, **size):
    """What ships: every experiment's numbers, by name; each a list over draws.

    `past` are the densest memories, by default those that ship. All memories are asked for the same
    targets; those of any posture are made anew for every draw.
    """
    past, own = past or habits.load_templates(), habits.muscle_synergies()
    sets = memory_sets(sides, shared) | {f"{len(past.points)} memories": past}
    found = {name: {"covered": covered_share(known)} for name, known in sets.items()}
    known = {name: memories for name, memories in sets.items() if found[name]["covered"] > 0.5}
    draws = [compare_memories(known, sides[0], seed, **size) for seed in seeds]
    for name, row in join_draws(draws).items():
        found.setdefault(name, {}).update(join_draws(row))
    found["after 3 s"] = drift(past).tolist()
    found["real time"] = seconds_per_second(own)
    found["online"] = join_draws([online_errors(past, seed, **size) for seed in seeds])
    found["stop"] = join_draws([stop_errors(past, seed, **size) for seed in seeds])
    found["afresh"] = join_draws([optimised_errors(past, own, seed, **size) for seed in seeds])
    return found


def compare_memories(sets, side, seed, count=COUNT):
    """One draw: what `planned_errors` finds of all these memories, and of those of any posture."""
    rng, apart = np.random.default_rng(seed), memories_of_any_posture(seed, side)
    sets = {**sets, ANY_POSTURE: apart}
    targets = draw_targets_3d(*sets.values(), count=count, rng=rng)
    away = np.linalg.norm(apart.points - goal_grid(side), axis=-1).mean()
    rows = {name: planned_errors(known, targets) for name, known in sets.items()}
    rows[ANY_POSTURE] |= {"covered": covered_share(apart), "from their goals": away}
    return rows


def join_draws(rows):
    """What several draws found, by name: lists."""
    return {name: [row[name] for row in rows] for name in rows[0]}


def load_results():
    """What ships: `make`'s numbers, in arrays."""
    return {
        name: {key: np.array(value) for key, value in row.items()} if isinstance(row, dict) else row
        for name, row in results.records("whole_arm").items()
    }
