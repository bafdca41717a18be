"""Feedback control of reaches: with and without a forward model, target jumps, curl fields.

What is measured of a hand's path, and the experiments whose results ship.
"""

from functools import partial

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import NOISE, SEEDS
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import noisy
from vmc_lib.cerebellum.feedback_error import FeedbackErrorLearning
from vmc_lib.cerebellum.forward_model import ForwardModel
from vmc_lib.motor.feedback import (
    BLIND,
    SIGHT,
    curl,
    push,
    reference_trajectory,
    simulate_feedback,
    switch,
)
from vmc_lib.motor.inverse_dynamics import MOVING
from vmc_lib.motor.planning import draw_targets, exact_weights, plan, surrounded
from vmc_lib.motor.templates import load, reach

JUMP, JUMPS_AT = 0.05, 0.15  # m and s: how far a target jumps, and when
SWING, TREMOR = (0.5, 3.0), (3.0, 8.0)  # Hz
FIELD = 15.0  # N for each m/s
ARMS = {"the plan alone": (BLIND, False), "forward model": (SIGHT, True), "lesion": (SIGHT, False)}


def exact_plans(targets, template_set):
    """Plans to targets (B, 2), with weights that satisfy Eq. 4."""
    return plan(targets, template_set, exact_weights)


def fit_forward_model(template_set, rng, count=20):
    """A `ForwardModel` that has felt so many reaches with motor noise, without sight."""
    some = exact_plans(draw_targets(template_set, count, rng), template_set)
    return ForwardModel().update(reach(noisy(some.excitations, NOISE, rng)))


def draw_target_jumps(template_set, count, rng, by=JUMP):
    """Targets (count, 2) and where they jump to, `by` metres in any direction, all within reach.

    ValueError when so few of those drawn jump to a place within reach that targets are missing.
    """
    first = draw_targets(template_set, 4 * count, rng)
    angle = rng.uniform(0, 2 * np.pi, len(first))
    second = first + by * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    inside = surrounded(second, template_set.points)
    if inside.sum() < count:
        raise ValueError(
            f"{inside.sum()} of {count} jumps by {by} m stay within reach; jump less far"
        )
    return first[inside][:count], second[inside][:count]


def reference_after_jump(template_set, first, second):
    """The reference, for 2 s, of reaches whose target jumps at `JUMPS_AT`, and is seen later."""
    before, after = (
        reference_trajectory(exact_plans(p, template_set), 2.0) for p in (first, second)
    )
    return switch(before, after, JUMPS_AT + SIGHT.delay)


def watch(reference, gains=SIGHT, model=None, disturbance=None):
    """Reaches with feedback, and with motor noise that is the same for every arm: a `Motion`."""
    rng = np.random.default_rng(1)
    return simulate_feedback(reference, gains, model, disturbance, NOISE, rng)


def pushed_paths(reference, gains, model, pushes):
    """By push, (N, s), the hand's path (T + 1, 2) in m: reaches of one reference, pushed back."""
    force, at = np.array(pushes).T[..., None]
    motion = watch(reference, gains, model, push(force * [-1, 0], at))
    return dict(zip(pushes, motion.hand[..., :2], strict=True))


def delayed_paths(target, template_set, gains, delay, model=None):
    """Hand paths (n, T + 1, 2) to one target (2,): feedback with gains (n,) and a delay in s."""
    senses = SIGHT._replace(gain=np.array(gains)[:, None], delay=delay)
    return watch(repeat_reach(target, len(gains), template_set), senses, model).hand[..., :2]


def repeat_reach(target, count, template_set):
    """The reference of so many reaches to one target (2,), which stays."""
    return reference_trajectory(exact_plans(np.tile(target, (count, 1)), template_set))


def push_error(path, reference, at):
    """How far paths (T + 1, 2) are apart after a push at `at` s: at most, and in the end, mm."""
    off = 1000 * _norm(path - reference)
    return off[round(at / STEP) :].max(), off[-500:].mean()


def rest_error(path, target):
    """How far a path (T + 1, 2) rests from its target, and how far it swings there, mm."""
    last = 1000 * (path[-500:] - target)
    return _norm(last).mean(), np.ptp(last, axis=0).max()


def compare_models(models, goals, template_set):
    """By name of a forward model, the mean tremor in mm² and overshoot in mm to goals (B, 2)."""
    reference = reference_trajectory(exact_plans(goals, template_set))
    paths = {k: watch(reference, SIGHT, model).hand[..., :2] for k, model in models.items()}
    tremors = {k: tremor(path)[0].mean() for k, path in paths.items()}
    return tremors, {k: 1000 * overshoot(path, goals).mean() for k, path in paths.items()}


def tremor(path, since=1.0, band=TREMOR):
    """Power in mm² in a band (low, high) in Hz, and the strongest frequency in Hz, of hand paths.

    `path` is (B, T + 1, 2) in m; what comes before `since` s is left out. Both answers are (B,).
    """
    late = 1000 * path[:, round(since / STEP) :]
    window = np.hanning(late.shape[1])[:, None]
    waves = np.fft.rfft((late - late.mean(axis=1, keepdims=True)) * window, axis=1)
    power = 2 * (np.abs(waves) ** 2).sum(axis=-1) / ((window**2).sum() * late.shape[1])
    frequency = np.fft.rfftfreq(late.shape[1], STEP)
    low, high = band
    within = (frequency >= low) & (frequency < high)
    return power[:, within].sum(axis=1), frequency[1:][power[:, 1:].argmax(axis=1)]


def overshoot(path, target):
    """How far hands (B, T + 1, 2) go beyond their targets (B, 2), along the way there, (B,), m."""
    way = target - path[:, 0]
    along = ((path - target[:, None]) * (way / _norm(way)[:, None])[:, None]).sum(axis=-1)
    return along.max(axis=1).clip(0)


def path_length_ratio(path):
    """The length of each path in its first second, over the distance between its ends, (B,)."""
    first = path[:, : round(1 / STEP) + 1]
    length = np.linalg.norm(np.diff(first, axis=1), axis=-1).sum(axis=1)
    return length / np.linalg.norm(first[:, -1] - first[:, 0], axis=-1)


def path_deviation(path, meant):
    """Where paths (B, T + 1, 2) are farthest from the meant ones across their way, (B,), m.

    Across the straight line from the first meant place to the last, while the hand should move;
    positive to the left.
    """
    way = meant[:, -1] - meant[:, 0]
    left = np.stack([-way[:, 1], way[:, 0]], axis=-1) / _norm(way)[:, None]
    aside = ((path - meant)[:, :MOVING] * left[:, None]).sum(axis=-1)
    farthest = np.abs(aside).argmax(axis=1)[:, None]
    return np.take_along_axis(aside, farthest, axis=1)[:, 0]


def reach_measures(seed, count=100, seconds=3.0):
    """By arm and measure, the means over so many reaches to a target that stays, or jumps."""
    rng, template_set = np.random.default_rng(seed), load()
    model = fit_forward_model(template_set, rng)
    first, second = draw_target_jumps(template_set, count, rng)
    steady = reference_trajectory(exact_plans(first, template_set), seconds)
    jump = reference_after_jump(template_set, first, second)
    measured = {}
    for arm, (gains, predicts) in ARMS.items():
        known = model if predicts else None
        path = simulate_feedback(steady, gains, known, noise=NOISE, rng=rng).hand[..., :2]
        ends = simulate_feedback(jump, gains, known, noise=NOISE, rng=rng).endpoint
        power, frequency = tremor(path)
        missed = 1000 * _norm(ends - second)
        measures = {
            "swing (mm²)": tremor(path, band=SWING)[0].mean(),
            "tremor (mm²)": power.mean(),
            "strongest at (Hz)": np.median(frequency),
            "overshoot (mm)": 1000 * overshoot(path, first).mean(),
            "path over distance": path_length_ratio(path).mean(),
            "miss after a jump (mm)": missed.mean(),
            "jumps within 10 mm": (missed < 10).mean(),
        }
        measured |= {f"{arm}, {name}": float(value) for name, value in measures.items()}
    return measured


def curl_field_deviations(learner, template_set, model, rng, blocks=(2, 20, 10), targets=5):
    """How far a curl field bends reaches as they are learned: deviations (blocks, targets), in m.

    The same targets come in every block; `blocks` counts those before, in and after the field.
    The second answer, (before or after learning, others), is the same for targets never practised.
    """
    practised, others = (
        reference_trajectory(exact_plans(draw_targets(template_set, n, rng), template_set), 1.0)
        for n in (targets, 20)
    )
    before, during, _ = blocks
    bends, held_out = [], []
    for block in range(sum(blocks)):
        on = before <= block < before + during
        if block in (before, before + during):
            held_out.append(reach_in_field(learner, others, curl(FIELD), model, rng)[0])
        field = curl(FIELD) if on else None
        bend, motion = reach_in_field(learner, practised, field, model, rng)
        learner.update(practised, motion)
        bends.append(bend)
    return np.array(bends), np.array(held_out)


def reach_in_field(learner, reference, disturbance, model, rng):
    """Noisy reaches with what was learned: their deviation (B,) in m, and their `Motion`."""
    motion = simulate_feedback(learner.correct(reference), SIGHT, model, disturbance, NOISE, rng)
    return path_deviation(motion.hand[..., :2], hand(reference.q)[..., :2]), motion


def curl_field_errors(seed, **size):
    """For one seed, the mean deviation in mm of each block, to the left, and its mean size.

    And the mean size for targets never practised, before and after; `size` as for
    `curl_field_deviations`.
    """
    rng, template_set = np.random.default_rng(seed), load()
    model, learner = fit_forward_model(template_set, rng), FeedbackErrorLearning(template_set)
    bends, held_out = curl_field_deviations(learner, template_set, model, rng, **size)
    return {
        "to the left": 1000 * bends.mean(axis=1),
        "size": 1000 * np.abs(bends).mean(axis=1),
        "held-out": 1000 * np.abs(held_out).mean(axis=1),
    }


EXPERIMENTS = {"reaches": reach_measures, "field": curl_field_errors}


def make(experiments=EXPERIMENTS, seeds=SEEDS):
    """What `results/feedback.json` holds: every experiment with every seed, to four digits."""
    return calibration.make(experiments, seeds)


load_results = partial(calibration.load_results, "feedback")
_norm = partial(np.linalg.norm, axis=-1)
