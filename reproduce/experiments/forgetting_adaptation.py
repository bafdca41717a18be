"""People's experiments on the model: a turned cursor, and an error clamp, with learning that fades.

The book's `Adaptation` takes a share of each error and forgets nothing. Here it may forget a share
with every cycle of movements, as state-space models of people do (Smith et al. 2006). The targets
lie round the start of the hand, and angles are measured there, as in the people's experiments.
"""

from functools import partial
from itertools import product

import numpy as np
from joblib import Parallel, delayed

from reproduce import results
from reproduce.experiments.calibration import MANY
from reproduce.measures.changed_worlds import (
    BLOCKS,
    PERTURBATIONS,
    Observation,
    adaptation_curve,
    train_aim_correction,
    turn_between,
)
from reproduce.people import MEASUREMENTS, MISSES
from vmc_lib.cerebellum.adaptation import Adaptation
from vmc_lib.motor.execution import execute, rotate
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import HOME, load

DISTANCE = 0.08  # m: the farthest targets round which a hand may turn by 30 degrees among templates
DIRECTIONS = np.radians([210.0, 250.0, 290.0, 330.0])  # there are no templates above the start
SHARES = *(k / 100 for k in range(10, 80, 5)), 1 / 1.3  # of an error; the book's is last
FORGETS = tuple(k / 200 for k in range(21))  # of what was learnt, with every cycle
SIZES = (1.75, 3.5, 7.0, 14.0)  # degrees, of clamps
SHOWN, TURNED = np.radians(3.5), np.radians(30.0)
VISIBLE, HIDDEN = "visible", "hidden"
CLAMP = [
    VISIBLE,
    *80 * [SHOWN],
    *5 * [HIDDEN],
    *10 * [VISIBLE],
]  # cycles: an angle is a clamp
CLAMPED = slice(1, 81)
LAST_WITH_LOAD = sum(BLOCKS[:2]) - 1
# cycles of 't Hart and Henriques: turned one way, the other way, and clamped to the target
ROTATION = [*2 * [0.0], *25 * [-TURNED], *3 * [TURNED]]
REBOUND = 5 * [0.0]
COMPARED = slice(3, 27)  # of the first rotation: in its first cycle people learn after each reach


class ForgettingAdaptation(Adaptation):
    """`Adaptation` of the aim that learns a `share` of an error, and `forgets` one of all."""

    def __init__(self, trained_correction, template_set, share, forgets, corrects="aim"):
        super().__init__(trained_correction, template_set, corrects, 1 / share - 1)
        self.forgets = forgets

    def update(self, plan, execute=execute):
        """Move, learn from what is seen, and forget."""
        movement = super().update(plan, execute)
        self.forget()
        return movement

    def forget(self):
        """Keep the rest of what was learnt."""
        self.purkinje = (1 - self.forgets) * self.purkinje


def targets(directions=DIRECTIONS):
    """Places (n, 2), m, at `DISTANCE` from `HOME`."""
    return HOME + DISTANCE * np.stack([np.cos(directions), np.sin(directions)], axis=-1)


def hand_angles(learner, plans, cycles, look):
    """How far the hand turns from its targets in each cycle, (cycles,), rad; mean over targets.

    `look(cycle, movement)` says which end points (n, 2) are shown, or None if nothing is.
    """
    turned = []
    for cycle in cycles:
        movement = execute(learner.correct(plans))
        turned.append(turn_between(movement.endpoint, plans.target, HOME).mean())
        seen = look(cycle, movement)
        if seen is None:
            learner.forget()
        else:
            learner.update(plans, lambda _, seen=seen: Observation(seen))
    return np.array(turned)


def clamp_angles(learner, plans, cycles=CLAMP):
    """`hand_angles` in degrees of an error clamp, positive away from what is shown, from zero on.

    In the first cycle and the last ten the hand is seen, in the five before these it is not.
    """

    def look(cycle, movement):
        if cycle in (VISIBLE, HIDDEN):
            return movement.endpoint if cycle == VISIBLE else None
        return rotate(plans.target, cycle, HOME)

    angles = hand_angles(learner, plans, cycles, look)
    return -np.degrees(angles - angles[0])


def rotation_angles(learner, plans, cycles=ROTATION, rebound=REBOUND):
    """`hand_angles` in degrees when what is seen of the hand is turned, then clamped to targets."""
    angles = hand_angles(learner, plans, cycles, lambda c, seen: rotate(seen.endpoint, c, HOME))
    clamped = hand_angles(learner, plans, rebound, lambda c, _: rotate(plans.target, c, HOME))
    return np.degrees(np.concatenate([angles, clamped]) - angles[0])


def learner_and_plans(share, forgets, seed=0):
    """A `ForgettingAdaptation` on an arm that has practised, and plans to `targets`."""
    template_set = load()
    trained = train_aim_correction(template_set, np.random.default_rng(seed))
    learner = ForgettingAdaptation(trained, template_set, share, forgets)
    return learner, plan(targets(), template_set)


def both_curves(share, forgets, seed=0):
    """`clamp_angles` and `rotation_angles` of one setting."""
    make = partial(learner_and_plans, share, forgets, seed)
    return clamp_angles(*make()), rotation_angles(*make())


def clamp_end(share, forgets, degrees):
    """How far the hand has turned, in degrees, after 80 cycles of an error clamp of so many."""
    cycles = [VISIBLE, *80 * [np.radians(degrees)], HIDDEN]
    return clamp_angles(*learner_and_plans(share, forgets), cycles)[-1]


def load_left(share, forgets, seed):
    """Mean error in mm in the last block with 0.5 kg in the hand, corrected in the pull."""
    rng, template_set = np.random.default_rng(seed), load()
    trained = train_aim_correction(template_set, rng)
    learner = ForgettingAdaptation(trained, template_set, share, forgets, "pull")
    curve = adaptation_curve(learner, template_set, rng, PERTURBATIONS["a load of 0.5 kg"])
    return 1000 * curve.error[LAST_WITH_LOAD]


def misfits(curves, people, cycles):
    """Root mean square over `cycles` of how far curves (…, cycles) are from people's means.

    In people's standard errors.
    """
    off = (curves - np.array(people["mean"])) / np.array(people["sem"])
    return np.sqrt(np.square(off)[..., cycles].mean(axis=-1))


def both_misfits(clamp, rotation):
    """`misfits` (2, shares, forgets): in the clamp whose cursor missed the target; rotated."""
    of_clamp = misfits(clamp, MEASUREMENTS["clamp"][MISSES], CLAMPED)
    return np.stack([of_clamp, misfits(rotation, MEASUREMENTS["rotation"], COMPARED)])


def nearest_setting(misfit):
    """Fitted: the place of the least misfit (shares, forgets).

    ValueError where it is at an edge of the grid: a better one may lie beyond. What has one value
    is not fitted.
    """
    best = np.unravel_index(misfit.argmin(), misfit.shape)
    if any(k in (0, n - 1) for k, n in zip(best, misfit.shape, strict=True) if n > 1):
        raise ValueError(f"the least misfit is at an edge of the grid {misfit.shape}: widen it")
    return best


def fitted_settings(clamp, rotation):
    """Two places in (shares, forgets): `nearest_setting` to the clamp, and to both tests."""
    both = both_misfits(clamp, rotation)
    return nearest_setting(both[0]), nearest_setting(np.hypot(*both))


def make(shares=SHARES, forgets=FORGETS, seeds=MANY):
    """What `results/forgetting.npz` holds: curves in degrees (shares, forgets, cycles), and costs.

    At the two `fitted_settings` and at the book's: `ends` (3, sizes) is `clamp_end`, `load`
    (3, seeds) is `load_left`.
    """
    curves = Parallel()(delayed(both_curves)(*one) for one in product(shares, forgets))
    clamp, rotation = (
        np.reshape(x, (len(shares), len(forgets), -1)).astype(np.float32)
        for x in zip(*curves, strict=True)
    )
    fitted = [(shares[i], forgets[j]) for i, j in fitted_settings(clamp, rotation)]
    three = *fitted, (shares[-1], forgets[0])
    ends = [[clamp_end(*one, degrees) for degrees in SIZES] for one in three]
    left = [[load_left(*one, seed) for seed in seeds] for one in three]
    return {"clamp": clamp, "rotation": rotation, "ends": ends, "load": left}


load_results = partial(results.arrays, "forgetting")
