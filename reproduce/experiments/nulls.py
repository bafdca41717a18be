"""What luck, and other mechanisms, obtain at the cost of the paper's: nulls for its motor claims.

Off-line calibration makes 21 tries. `offline_rules` change the weights in other ways, as often.
Online calibration learns from pairs: in `errors_by_lessons` they are shuffled, or their
corrections were found blindly, or nothing is learned and the plan's weights are others; in
`errors_after_teaching` few tries, or none, find the corrections. Eq. 5 weighs templates by
nearness; `WEIGHTS` do otherwise. All meet the same targets, so that they are compared in pairs.
"""

from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import (
    AS_PRINTED,
    MANY,
    no_calibration,
    run_experiments,
)
from reproduce.one_draw import mean_best_so_far, planned_error_ratio, worst_example
from vmc_lib.cerebellum.offline import (
    algorithm_1,
    algorithm_1_change,
    broyden_calibration,
    gauss_newton_calibration,
)
from vmc_lib.cerebellum.online import WeightCorrection
from vmc_lib.motor import templates
from vmc_lib.motor.planning import (
    draw_targets,
    exact_weights,
    habitual_weights,
    least_change,
    norm,
    plan,
)

TRIES = 21  # of off-line calibration: n = 0, 1, …, 20, as we read it (the paper prints no M)
COARSE_TO_FINE = (10, 0, 20, 5, 15, 2, 8, 12, 18, *(1, 3, 4, 6, 7, 9, 11, 13, 14, 16, 17, 19))
AS_ALGORITHM_1 = (*range(1, 21), 0)  # the n in the order in which it counts them
LENGTH = 0.1  # of a blind change of the weights: good, not best, on other targets (seeds 100–109)
EQ_6_7, BLIND = "Eq. 6–7", "blind search"
SAME_LENGTH, LINE = "random direction", "line search along Eq. 4"
RANDOM_LENGTH = "random length"
LUCK = BLIND, SAME_LENGTH  # in place of a direction …
NULLS = *LUCK, RANDOM_LENGTH  # … and of a length
TAUGHT = 0, 1, 3, 6, 11, TRIES  # tries that a lesson costs
IN_ORDER = f"{EQ_6_7}, n = 1, 2, 3, …"
BROYDEN, LEAST_SQUARES = "Broyden", "least squares over the hold"
ALGORITHM_2, SHUFFLED, BLINDLY_TAUGHT = "Algorithm 2", "shuffled pairs", "taught by blind search"
IN_SAMPLE, HELD_OUT = "in-sample", "held-out"
NO_LESSON = "no lesson, inverse-square weights", "no lesson, Eq. 4 solved exactly"


def _random_unit(plan, rng):
    way = rng.normal(size=plan.weights.shape)
    return way / norm(way)[..., None]


def blind_change(plan, *_, rng, length=LENGTH):
    """A random Δw (…, N) of one `length`, that asks neither for the error nor for the target."""
    return length * _random_unit(plan, rng)


def random_direction_change(plan, *asked, rng):
    """A random Δw (…, N), as long as that of Eq. 6–7."""
    return norm(algorithm_1_change(plan, *asked))[..., None] * _random_unit(plan, rng)


def random_length_change(plan, *asked, rng):
    """A Δw (…, N) along that of Eq. 6–7, of a random length: up to twice that of a blind one."""
    change = algorithm_1_change(plan, *asked)
    length = norm(change)[..., None]
    drawn = rng.uniform(0, 2 * LENGTH, length.shape)
    return drawn * np.divide(change, length, out=np.zeros_like(change), where=length > 0)


LAWS = {SAME_LENGTH: random_direction_change, BLIND: blind_change}  # luck's, of a generator


def line_search_change(plan, endpoint, n, *_):
    """Δw (…, N) along Eq. 4: from a tenth of what it takes for the whole error, to 2.1 times it."""
    points = np.swapaxes(plan.points, -1, -2)
    return (n + 1) / 10 * least_change(points, plan.target - endpoint)


def calibration_by(law, order=COARSE_TO_FINE):
    """Algorithm 1 with another `law` for Eq. 6–7, and the n in this order."""
    return partial(algorithm_1, gains=order, change=law)


def offline_rules(rng):
    """Name -> a rule that calibrates a plan by `TRIES` movements."""
    laws = {
        EQ_6_7: algorithm_1_change,
        **{name: partial(law, rng=rng) for name, law in LAWS.items()},
        LINE: line_search_change,
    }
    rules = {name: calibration_by(law) for name, law in laws.items()}
    rules[BROYDEN] = partial(broyden_calibration, n_trials=TRIES)
    rules[LEAST_SQUARES] = lambda plan: gauss_newton_calibration(plan, TRIES - plan.rows.shape[-1])
    return rules


def draw_habit(past, rng, count=25):
    """The habit's plans for the targets that `error_ratios` practises with the same generator."""
    _, targets = (draw_targets(past, n, rng) for n in (200, count))
    return plan(targets, past)


def errors_by_tries(seed, hold=templates.HOLD, count=25):
    """What each rule leaves of the planned error after 0, 1, … tries, by name, (1 + TRIES,).

    The movements are those that `error_ratios` practises with the same seed. Of the tries alone,
    without the plan: what the best leaves, and the share of movements that it brings nearer.
    """
    rng, past = np.random.default_rng(seed), templates.load(hold=hold)
    habit, found = draw_habit(past, rng, count), {}
    rules = offline_rules(rng)
    rules[RANDOM_LENGTH] = calibration_by(partial(random_length_change, rng=rng))
    for name, rule in rules.items():
        planned, *tried = rule(habit).error
        alone = np.min(tried, axis=0)
        found[name] = mean_best_so_far([planned, *tried]) / planned.mean()
        found[f"{name}, tries alone"] = alone.mean() / planned.mean()
        found[f"{name}, nearer"] = (alone < planned).mean()
        if name == EQ_6_7:
            by_n = np.array(tried)[np.argsort(COARSE_TO_FINE)]
            in_order = [planned, *by_n[list(AS_ALGORITHM_1)]]
            found[IN_ORDER] = mean_best_so_far(in_order) / planned.mean()
    return found


@dataclass(eq=False)
class ShuffledPairs(WeightCorrection):
    """Algorithm 2, but each correction is learned at the place of another movement."""

    rng: Any = None

    def update(self, plan, **lesson):
        """Learn the batch, its corrections dealt out anew."""
        super().update(plan, **lesson)
        inputs, changes = self.training_pairs[-1]
        self.training_pairs[-1] = inputs, self.rng.permutation(changes)
        self.g.fit(*map(np.concatenate, zip(*self.training_pairs, strict=True)))
        return self


@dataclass
class OtherWeights:
    """No learner: it gives every plan the weights of a `rule`, whatever was practised."""

    rule: Any

    def correct(self, plan):
        """The plan with those weights."""
        return plan.with_weights(self.rule(plan.target, plan.points))

    def update(self, plan, **lesson):
        """Nothing is learned."""
        return self


def errors_by_lessons(seed, movements=25, held_out=200, experiments=10):
    """Algorithm 2 and its nulls, read where the command ends: what is left of the planned error.

    After 0, 1, … experiments, in-sample and held-out; and the share of movements that the first
    brings nearer. The targets are those of `error_ratios` with the same seed.
    """
    past, rng = templates.load(hold=0.0), np.random.default_rng(seed)
    draw = np.random.default_rng((seed, 1))
    blindly = calibration_by(*teachers(seed)[BLIND])
    learners = {
        ALGORITHM_2: (WeightCorrection(), {}),
        SHUFFLED: (ShuffledPairs(rng=draw), {}),
        BLINDLY_TAUGHT: (WeightCorrection(), {"rule": blindly}),
        **{
            name: (OtherWeights(rule), {"rule": no_calibration})
            for name, rule in zip(
                NO_LESSON, (WEIGHTS["inverse square"], exact_weights), strict=True
            )
        },
    }
    found = {}
    for name, (learner, lesson) in learners.items():
        size = movements, held_out, experiments
        errors = run_experiments(learner, past, deepcopy(rng), *size, **lesson)
        for kind, before, after in (
            (IN_SAMPLE, errors.planned, errors.in_sample),
            (HELD_OUT, errors.held_out_planned, errors.held_out),
        ):
            found[f"{name}, {kind}"] = after.mean(axis=1) / before.mean()
            found[f"{name}, nearer, {kind}"] = (after[1] < before).mean()
    return found


def teachers(seed):
    """What finds a lesson's corrections: name -> a law, and the n in the order in which it tries.

    All but one try n coarse to fine: few tries then span as wide a range of n as all do.
    """
    return {
        EQ_6_7: (algorithm_1_change, COARSE_TO_FINE),
        IN_ORDER: (algorithm_1_change, AS_ALGORITHM_1),
        BLIND: (partial(blind_change, rng=np.random.default_rng((seed, 2))), COARSE_TO_FINE),
        LINE: (line_search_change, COARSE_TO_FINE),
    }


def errors_after_teaching(seed, movements=25, held_out=200):
    """What Algorithm 2 leaves after one experiment whose lessons cost so many tries, (TAUGHT,).

    By the law that found the corrections, in-sample and held-out; without a try the lesson is the
    habit's own movement. The targets are those of `errors_by_lessons` with the same seed, and so
    is luck.
    """
    past, found = templates.load(hold=0.0), {}
    for name in teachers(seed):
        left = {IN_SAMPLE: [], HELD_OUT: []}
        for count in TAUGHT:
            law, order = teachers(seed)[name]  # with luck that has not been drawn yet
            rule = calibration_by(law, order[:count]) if count else no_calibration
            size = WeightCorrection(), past, np.random.default_rng(seed), movements, held_out, 1
            errors = run_experiments(*size, rule=rule)
            left[IN_SAMPLE].append(errors.in_sample[1].mean() / errors.planned.mean())
            left[HELD_OUT].append(errors.held_out[1].mean() / errors.held_out_planned.mean())
        found |= {f"{name}, {kind}": np.array(shares) for kind, shares in left.items()}
    return found


def nearest_only(target, points):
    """Weights (…, N): all to the nearest template."""
    distance = norm(points - np.asarray(target)[..., None, :])
    return (distance == distance.min(axis=-1, keepdims=True)).astype(float)


def uniform(target, points):
    """Weights (…, N): to each template the same."""
    return np.full(np.shape(points)[:-1], 1 / np.shape(points)[-2])


WEIGHTS = {
    "nearest only": nearest_only,
    "uniform": uniform,
    "inverse square": partial(habitual_weights, power=2),
}
EXACT = "exact"  # no null, but the best known: Eq. 4 solved


def errors_by_weights(seed):
    """The planned error over the reach by other weights than Eq. 5's, (spacings,), by name.

    And the largest of five examples; and over that by Eq. 5.
    """
    sets, found = [templates.load(apart, 0.0) for apart in templates.SPACINGS], {}
    habit = planned_error_ratio(seed)
    for name, rule in (WEIGHTS | {EXACT: exact_weights}).items():
        found[name] = [planned_error_ratio(seed, past, rule) for past in sets]
        found[f"{name}, worst of five"] = worst_example(seed, rule)
        found[f"{name}, over Eq. 5"] = planned_error_ratio(seed, rule=rule) / habit
    return found


BY_TRIES, BY_TRIES_HELD = f"tries, {AS_PRINTED}", "tries, over the hold"
BY_LESSONS, BY_WEIGHTS = f"lessons, {AS_PRINTED}", f"weights, {AS_PRINTED}"
BY_TEACHING = f"teaching, {AS_PRINTED}"
EXPERIMENTS = {
    BY_TRIES: partial(errors_by_tries, hold=0.0),
    BY_TRIES_HELD: errors_by_tries,
    BY_LESSONS: errors_by_lessons,
    BY_TEACHING: errors_after_teaching,
    BY_WEIGHTS: errors_by_weights,
}
load_results = partial(calibration.load_results, "nulls")


def make(experiments=EXPERIMENTS, seeds=MANY):
    """What `results/nulls.json` holds: every experiment with every seed, to four digits."""
    return calibration.make(experiments, seeds)
