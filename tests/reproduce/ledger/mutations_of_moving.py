"""What is made wrong under the ledger's rows of moving: the code, the truth or a stored reading.

And rivals, mechanisms that one might take for the paper's: what a row says of them is held, too.
Where a row reads what ships, the shipped numbers are made again first, from few draws.
"""

from dataclasses import replace
from functools import cache, partial
from types import SimpleNamespace

import numpy as np

from reproduce import one_draw
from reproduce.experiments import calibration as experiments
from reproduce.experiments import nulls
from reproduce.ledger import arm, calibration, online, planning
from reproduce.ledger.entry import BEATEN, DIFFERS, NULL_PASSES
from reproduce.measures import second_plant
from vmc_lib import photos
from vmc_lib.cerebellum import offline
from vmc_lib.motor import planning as motor_planning

FEW = range(3)  # draws, to be quick
SMALL = {"held_out": 20}


def looks_at_the_cup(patch):
    real, wrong = photos.load, {"shuttlecock": "cup", "cup": "shuttlecock"}

    def swapped(level, split):
        return [
            replace(shot, boxes={wrong[k]: box for k, box in shot.boxes.items()})
            for shot in real(level, split)
        ]

    patch.setattr(arm.photos, "load", swapped)


def silences_a_muscle(patch):
    awake = np.ones(6)
    awake[1] = 0

    def load(*kind, real=planning.templates.load, **how):
        past = real(*kind, **how)
        return replace(past, reach=lambda u, p: past.reach(u * awake, p))

    patch.setattr(planning.templates, "load", load)
    patch.setattr(planning, "MANY", FEW)


def moves_linearly(patch):
    """The hand ends where the weights say."""

    def execute(plans):
        ends = (plans.weights[:, None] @ plans.points)[:, 0]
        return SimpleNamespace(error=np.linalg.norm(ends - plans.target, axis=-1))

    for module in (planning, one_draw):
        patch.setattr(module, "execute", execute)
    patch.setattr(planning, "MANY", FEW)


def plans_slowly(patch):
    """The clock was read once, and its reading ships: here it reads otherwise."""
    row = {"task": "habitual plan", "× faster than optimal control": 0.5}
    patch.setattr(arm.results, "records", lambda name: {"rows": [row]})


def minimises_nothing(patch):
    """The optimum is where the search began: the habitual plan."""
    habit = arm.plan(arm.optimal_control.TARGETS, arm.templates.load()).excitations
    patch.setattr(arm.optimal_control, "optimal_excitations", lambda: habit)


def shuffles_the_weights(patch):
    def shuffled(target, points):
        weights = motor_planning.habitual_weights(target, points)
        return np.random.default_rng(0).permuted(weights, axis=-1)

    for module in (planning, one_draw, motor_planning):
        patch.setattr(module, "exact_weights", shuffled)
    draws_few(patch, planning)


def corrects_the_wrong_way(patch):
    real = offline.least_change
    patch.setattr(offline, "least_change", lambda *where: -real(*where))


def corrects_space_the_wrong_way(patch):
    corrects_the_wrong_way(patch)
    draws_few(patch, planning)


def mixes_up_torques(patch):
    past = second_plant.torque_templates()
    points = np.random.default_rng(0).permutation(past.points)
    patch.setattr(second_plant, "torque_templates", lambda: replace(past, points=points))
    draws_few(patch, calibration)


def changes_no_weight(patch):
    """On the other robot Eq. 6–7 ask for nothing."""
    still = partial(offline.algorithm_1, change=lambda plan, *_: np.zeros_like(plan.weights))
    patch.setattr(second_plant, "algorithm_1", still)
    draws_few(patch, calibration)


def draws_few(patch, module):
    patch.setattr(module, "repeat_over_seeds", partial(module.repeat_over_seeds, seeds=FEW))


def forgets_half_of_the_votes(patch):
    real = calibration.largest_deviation
    patch.setattr(
        calibration, "largest_deviation", lambda moved, preferred: real(moved, preferred[:7])
    )


def turns_the_error(patch):
    patch.setattr(nulls, "algorithm_1", partial(nulls.algorithm_1, sign=-1))
    tries_again(patch, nulls.BY_TRIES)


def calibrates_the_wrong_way(patch):
    """Both off-line rules step away from the target."""
    corrects_the_wrong_way(patch)
    patch.setattr(experiments, "ABLATION", {})
    patch.setitem(offline.RULES, "published", partial(offline.algorithm_1, sign=-1))
    patch.setattr(calibration, "load_results", lambda: Again.of("off-line", experiments=1))


def learns_nothing(patch):
    """Off-line calibration still does its share; what is learned for the next time is nothing."""
    patch.setattr(experiments, "ABLATION", {})
    for rule in (experiments.WeightCorrection, experiments.AimCorrection):
        patch.setattr(rule, "update", lambda self, *lesson, **how: self)
    for module in (calibration, online):
        patch.setattr(module, "load_results", lambda: Again.of("online", experiments=10))
    few = {
        reading: {name: draws[: len(FEW)] for name, draws in found.items()}
        for reading, found in nulls.load_results().items()
    }
    patch.setattr(nulls, "load_results", lambda: few)


def mixes_alike_for_every_target(patch):
    """What our rule makes of an aim takes as much of each template, wherever that lies."""
    learns_nothing(patch)
    patch.setattr(
        experiments.AimCorrection,
        "correct",
        lambda self, plans: plans.with_weights(np.full_like(plans.weights, 0.25)),
    )
    patch.setattr(calibration, "load_results", lambda: Again.of("aim", experiments=10))


def lessons_teach_nothing(patch):
    """No experiment changes what the rule does in the next."""
    for rule in (nulls.WeightCorrection, nulls.ShuffledPairs):
        patch.setattr(rule, "update", lambda self, *lesson, **how: self)
    tries_again(patch, nulls.BY_LESSONS, movements=5, held_out=5, experiments=3)


def tries_again(patch, part, **size):
    """What `nulls.json` holds of a part, by the code as it is now, from few draws."""
    shipped = nulls.load_results()
    shipped[part] = experiments.repeat_over_seeds(partial(nulls.EXPERIMENTS[part], **size), FEW)
    patch.setattr(nulls, "load_results", lambda: shipped)


# Rivals: not the paper's mechanism made wrong, but another that one might take for it


def searches_blindly(patch):
    """Random changes of the weights, as many, in the place of Eq. 6–7."""
    blind = partial(
        offline.algorithm_1, change=partial(nulls.blind_change, rng=np.random.default_rng(0))
    )
    patch.setattr(experiments, "ABLATION", {})
    patch.setitem(offline.RULES, "published", blind)
    for module in (calibration, second_plant):
        patch.setattr(module, "algorithm_1", blind)
    patch.setattr(calibration, "load_results", lambda: Again.of("blind", experiments=1))
    draws_few(patch, calibration)


def tries_blindly(patch):
    """The same where rules are compared by their number of tries."""
    blind = partial(nulls.blind_change, rng=np.random.default_rng(0))
    patch.setattr(nulls, "algorithm_1_change", blind)
    tries_again(patch, nulls.BY_TRIES)


def weighs(rule):
    """Plans by other weights than Eq. 5's."""

    def mutate(patch):
        ratios, example = planning.planned_error_ratios, one_draw.worst_example
        patch.setattr(
            planning,
            "planned_error_ratios",
            lambda apart=0.06, _=None: ratios(apart, nulls.WEIGHTS[rule]),
        )
        patch.setattr(one_draw, "worst_example", lambda seed: example(seed, nulls.WEIGHTS[rule]))
        patch.setattr(planning, "MANY", FEW)

    mutate.__name__ = f"weighs_{rule}"
    return mutate


def shuffles_pairs(patch):
    """Algorithm 2 learns corrections, but each at the place of another movement."""
    shuffled = partial(nulls.ShuffledPairs, rng=np.random.default_rng(0))
    patch.setattr(experiments, "ABLATION", {})
    patch.setattr(experiments, "WeightCorrection", shuffled)
    for module in (calibration, online):
        patch.setattr(module, "load_results", lambda: Again.of("shuffled", experiments=2))


def learns_no_lesson(patch):
    """Eq. 4 is solved exactly, in the place of Algorithm 2, and nothing is learned."""
    patch.setattr(experiments, "ABLATION", {})
    for module in (nulls, experiments):
        untaught = partial(nulls.OtherWeights, motor_planning.exact_weights)
        patch.setattr(module, "WeightCorrection", lambda untaught=untaught, **_: untaught())
    for module in (calibration, online):
        patch.setattr(module, "load_results", lambda: Again.of("untaught", experiments=2))
    tries_again(patch, nulls.BY_LESSONS, movements=5, held_out=5, experiments=3)


class Again(dict):
    """What `movements.json` would hold, by the code as it is now: small, made where it is read."""

    def __init__(self, **size):
        super().__init__()
        self.size = SMALL | size

    @classmethod
    @cache
    def of(cls, broken, **size):
        """Made once for all rows that rest on the same broken code."""
        return cls(**size)

    def __missing__(self, name):
        run = partial(experiments.EXPERIMENTS[name], **self.size)
        self[name] = experiments.repeat_over_seeds(run, FEW)
        return self[name]


RIVALS = {  # what a row says of each
    "Table IV": {weighs(rule): NULL_PASSES for rule in nulls.WEIGHTS}
    | {moves_linearly: NULL_PASSES},
    "Fig. 9": {
        weighs("nearest only"): DIFFERS,
        weighs("uniform"): DIFFERS,
        weighs("inverse square"): NULL_PASSES,
        moves_linearly: NULL_PASSES,
    },
    "III, Block 2": {moves_linearly: NULL_PASSES},
    "Ours, Eq. 5": {moves_linearly: BEATEN},
    "III, Block 3": {moves_linearly: DIFFERS},
    "Table V": {searches_blindly: NULL_PASSES},
    "Fig. 4": {tries_blindly: NULL_PASSES},
    "Fig. 10": {tries_blindly: NULL_PASSES},
    "Ours, Eq. 6–7": {tries_blindly: DIFFERS},
    "V, robots": {searches_blindly: NULL_PASSES},
    "Table VI": {shuffles_pairs: DIFFERS, learns_no_lesson: NULL_PASSES},
    "Fig. 11": {learns_no_lesson: NULL_PASSES},
    "IV D, online": {learns_no_lesson: NULL_PASSES},
}
MOVING = {
    "Ours, Fig. 3": [looks_at_the_cup],
    "IV C, computation": [plans_slowly],
    "III, Block 2, effort": [minimises_nothing],
    "Table IV": [silences_a_muscle],
    "Fig. 9": [silences_a_muscle],
    "III, Block 2": [silences_a_muscle],
    "III, Block 3": [moves_linearly],
    "Ours, space": [corrects_space_the_wrong_way],
    "Ours, Eq. 5": [shuffles_the_weights],
    "Table V": [calibrates_the_wrong_way],
    "Fig. 4": [turns_the_error],
    "III, population": [forgets_half_of_the_votes],
    "Fig. 10": [turns_the_error],
    "V, robots": [changes_no_weight],
    "Ours, robots": [mixes_up_torques],
    "Ours, Table V": [calibrates_the_wrong_way],
    "Table VI": [learns_nothing],
    "Fig. 11": [lessons_teach_nothing],
    "Fig. 12": [lessons_teach_nothing],
    "IV D, online": [learns_nothing],
    "Ours, Eq. 6–7": [tries_blindly],
    "Ours, Table VI": [mixes_alike_for_every_target],
}
