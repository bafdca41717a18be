"""Adaptation in a world that changes: a load, a viscous field, a prism, each for some blocks.

And error clamp: a seen error that no movement changes.
"""

from copy import deepcopy
from functools import partial
from typing import NamedTuple

import numpy as np

from vmc_lib.arm.simulate import Perturbation
from vmc_lib.cerebellum.adaptation import CORRECTIONS, Adaptation
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor.execution import EYE, execute, rotate_about_eye
from vmc_lib.motor.planning import draw_targets, first_inside, is_surrounded, plan
from vmc_lib.motor.templates import load, mean_distance

PRISM = np.radians(6.0)
PERTURBATIONS = {  # what may change, as `execute` takes it
    "a load of 0.5 kg": {"perturbation": Perturbation(load=0.5)},
    "a viscous field": {"perturbation": Perturbation(field=((-1.0, 0.0), (0.0, -1.0)))},
    "a prism": {"prism": PRISM},
}
NOTHING = "nothing learns"
CURES = (*CORRECTIONS, NOTHING)
BLOCKS = (2, 8, 6)  # of an adaptation: before the world changes, changed, and after


class Curve(NamedTuple):
    """An adaptation, block by block; every movement is made before it is learned from."""

    target: np.ndarray  # (blocks, movements, 2), m, as seen
    hold: np.ndarray  # (blocks, movements, n, 2), m: the hand's path over the hold, as seen

    @property
    def endpoint(self):
        """Where the hand is on average over the hold, (blocks, movements, 2), m."""
        return self.hold.mean(axis=-2)

    @property
    def error(self):
        """Mean distance from the target in each block, (blocks,), m."""
        return mean_distance(self.hold, self.target).mean(axis=-1)


def adaptation_curve(learner, template_set, rng, perturbation, blocks=BLOCKS, movements=8):
    """The `Curve` of an `Adaptation` in a world (of `PERTURBATIONS`) that comes and goes.

    `blocks` counts those before, in and after the changed world. All targets are new, and lie
    where the arm has experience with the prism and without it.
    """
    before, during, _ = blocks
    targets = draw_targets(template_set, 4 * sum(blocks) * movements, rng)
    inside = is_surrounded(rotate_about_eye(targets, -PRISM), template_set.points)
    targets = first_inside(targets, inside, sum(blocks) * movements).reshape(-1, movements, 2)
    hold = [
        learner.update(
            plan(t, template_set),
            partial(execute, **(perturbation if before <= b < before + during else {})),
        ).hold
        for b, t in enumerate(targets)
    ]
    return Curve(targets, np.array(hold))


def train_aim_correction(template_set, rng, movements=150):
    """An `AimCorrection` trained on so many movements."""
    return AimCorrection(template_set).update(
        plan(draw_targets(template_set, movements, rng), template_set)
    )


def without_learning(trained, template_set, perturbation, target, blocks=BLOCKS):
    """The `Curve` of such blocks of targets (blocks, movements, 2) where nothing learns."""
    corrected = trained.correct(plan(target, template_set))
    changed = np.repeat([False, True, False], blocks)[:, None, None, None]
    holds = execute(corrected, **perturbation).hold, execute(corrected).hold
    return Curve(target, np.where(changed, *holds))


class Observation(NamedTuple):
    """What the learner sees of its movements, wherever they end."""

    endpoint: np.ndarray  # (n, 2), m


def error_clamp(trained, template_set, rng, angle, blocks=BLOCKS, movements=8):
    """Drift under error clamp: how far the hand turns from its targets in each block, (blocks,).

    Mean angle, rad, as the eye sees it, upwards where it is positive; all blocks have the same
    targets. In the second of the `blocks` the hand is seen `angle` rad above its target whatever it
    does (Morehead et al., 2017).
    """
    plans = plan(draw_targets(template_set, movements, rng), template_set)
    clamped = Observation(rotate_about_eye(plans.target, angle))
    learner, drift = Adaptation(trained, template_set), []
    for is_clamped in np.repeat([False, True, False], blocks):
        movement = execute(learner.correct(plans))
        drift.append(turn_between(movement.endpoint, plans.target, EYE).mean())
        learner.update(plans, lambda _, seen=clamped if is_clamped else movement: seen)
    return np.array(drift)


def direction(points, centre):
    """The direction of plane positions (…, 2) from a `centre` (2,), (…), rad."""
    away = points - centre
    return np.arctan2(away[..., 1], away[..., 0])


def turn_between(points, targets, centre):
    """The angle from targets (…, 2) to points (…, 2) about a centre (2,), (…), rad in (−π, π]."""
    return np.angle(np.exp(1j * (direction(points, centre) - direction(targets, centre))))


def block_errors(seed, before=150, blocks=BLOCKS, past=None, **size):
    """Mean error in mm of each block, by world and by what is corrected, for one seed.

    So many movements are practised `before`; `blocks` and `size` are passed to `adaptation_curve`.
    `past` are other templates than those that ship.
    """
    rng, template_set = np.random.default_rng(seed), past or load()
    trained, errors = train_aim_correction(template_set, rng, before), {}
    for name, world in PERTURBATIONS.items():
        for corrects in CORRECTIONS:
            learner = Adaptation(trained, template_set, corrects)
            curve = adaptation_curve(learner, template_set, deepcopy(rng), world, blocks, **size)
            errors[f"{name}, {corrects}"] = 1000 * curve.error
        alone = without_learning(trained, template_set, world, curve.target, blocks)
        errors[f"{name}, {NOTHING}"] = 1000 * alone.error
    return errors
