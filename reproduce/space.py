"""Planning in space (Eq. 3–5 in R³): the trunk's turn is remembered with a reach and mixed too.

The paper proposes its method in three dimensions and tests it in two. Here a memory is a reach in
the arm's plane together with the trunk's turn under which it was made; both are commands, both are
weighted sums. Positions are in the frame of the trunk straight ahead, in m.
"""

from dataclasses import dataclass

import numpy as np

from vmc_lib import NoReach
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics, to_world, turn_towards
from vmc_lib.motor.planning import (
    draw_targets,
    exact_weights,
    habitual_weights,
    least_change,
    plan,
    surrounding,
)
from vmc_lib.motor.templates import TemplateSet, load, reach

TURNS = np.radians([-10.0, 5.0, 20.0, 35.0, 50.0, 65.0])


@dataclass(frozen=True, eq=False)
class SpatialTemplates:
    """Every reach of a template set, made under every turn of the trunk."""

    template_set: TemplateSet
    turns: np.ndarray  # (M,), rad
    points: np.ndarray  # (N · M, 3): where each ended; turn changes fastest

    @classmethod
    def of(cls, template_set, turns=TURNS):
        """The memories of a template set's N reaches under M turns."""
        ends = reach(template_set.excitations).hand[:, -1]
        points = np.stack([to_world(ends, turn) for turn in turns], axis=1)
        return cls(template_set, np.asarray(turns), points.reshape(-1, 3))

    def surrounding(self, target):
        """Rows (8,) round a target (3,): four reaches about it, under the turns on its two sides.

        `NoReach` when the target is outside the space that experience covers.
        """
        turn, p = turn_towards(target)
        if not self.turns[0] < turn < self.turns[-1]:
            raise NoReach(
                f"target {target} m needs a turn of {np.degrees(turn):.0f}°, outside those "
                f"remembered; move it"
            )
        before = np.searchsorted(self.turns, turn) - 1
        reaches = surrounding(p, self.template_set.points) * len(self.turns)
        return np.concatenate([reaches + before, reaches + before + 1])

    def mix(self, chosen, weights):
        """Eq. 3: the excitations (…, T, 6) and the trunk's turn (…) of memories (…, 8) mixed."""
        template, turn = np.divmod(chosen, len(self.turns))
        mixed = np.einsum("...i,...itm->...tm", weights, self.template_set.excitations[template])
        return np.clip(mixed, 0, 1), (weights * self.turns[turn]).sum(axis=-1)

    def move(self, chosen, weights):
        """Where the hand ends, (…, 3), when the memories are mixed so."""
        excitations, turn = self.mix(chosen, weights)
        return to_world(reach(excitations).hand[..., -1, :], turn)


def practise(memories, targets, trials=3, rule=habitual_weights):
    """Plan by Eq. 5 (or another rule), then correct by Eq. 4 in R³, a trial at a time.

    Returns, for the plan and each trial of targets (n, 3), the weights (trials + 1, n, 8) and how
    far the hand ended from its target, (trials + 1, n) in m.
    """
    chosen = np.array([memories.surrounding(target) for target in targets])
    points = memories.points[chosen]
    history, weights = [], rule(targets, points)
    for _ in range(trials + 1):
        missing = targets - memories.move(chosen, weights)
        history.append((weights, np.linalg.norm(missing, axis=-1)))
        weights = weights + least_change(np.swapaxes(points, -1, -2), missing)
    return tuple(map(np.array, zip(*history, strict=True)))


def measured(seed, count=100, trials=3):
    """One draw of `count` targets in space: numbers by name.

    "planned / reach" is the mean miss over the mean distance from the shoulder; "exact / reach",
    the same with weights that satisfy Eq. 4; "in the plane", the same for the same reaches before
    the trunk turns; "k corrections", what is left of the planned miss.
    """
    rng, template_set = np.random.default_rng(seed), load()
    memories, flat = SpatialTemplates.of(template_set), draw_targets(template_set, count, rng)
    turns = rng.uniform(*memories.turns[[0, -1]], count)
    places = hand(inverse_kinematics(flat))
    targets, distance = to_world(places, turns), np.linalg.norm(places, axis=1).mean()
    _, missed = practise(memories, targets, trials)
    _, (exact,) = practise(memories, targets, 0, exact_weights)
    planned, *left = missed.mean(axis=1)
    in_plane = np.linalg.norm(plan(flat, template_set).reached() - flat, axis=1).mean()
    return {
        "planned / reach": planned / distance,
        "exact / reach": exact.mean() / distance,
        "in the plane": in_plane / np.linalg.norm(flat, axis=1).mean(),
        **{f"{k} corrections": mean / planned for k, mean in enumerate(left, start=1)},
    }
