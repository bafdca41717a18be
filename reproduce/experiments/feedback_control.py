"""Feedback control of reaches: with and without a forward model, target jumps, curl fields.

The experiments whose results ship.
"""

from functools import partial
from itertools import product

import numpy as np

from reproduce.experiments import calibration
from reproduce.experiments.calibration import NOISE, SEEDS
from reproduce.measures.path_measures import (
    SWING,
    end_error,
    end_speed,
    overshoot,
    path_deviation,
    path_length_ratio,
    tremor,
)
from reproduce.peers.motor_noise import SCATTER_MM
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import noisy
from vmc_lib.cerebellum.feedback_error import FeedbackErrorLearning
from vmc_lib.cerebellum.forward_model import BETWEEN, FAST, ForwardModel, state_inputs
from vmc_lib.motor.feedback import (
    OPEN_LOOP,
    REFLEX,
    SIGHT,
    curl,
    push,
    reference_trajectory,
    simulate_feedback,
    switch,
)
from vmc_lib.motor.planning import draw_targets, exact_weights, is_surrounded, plan
from vmc_lib.motor.templates import HOME, load, reach

JUMP, JUMPS_AT = 0.05, 0.15  # m and s: how far a target jumps, and when
SCATTER_SHARE = 0.5  # noise at which reaches that the eye guides scatter by `SCATTER_MM`
FIELD, BLOCKS = 15.0, (2, 10, 6)  # N for each m/s; blocks of reaches before, in and after the field
FARTHEST = 0.085  # m: of eight equal reaches from `HOME` that end above the table

GAINS = (2, 4, 8, 15, 30, 60, 120, 240, 480)
BY_GAIN = {
    "reflex alone": {k: REFLEX._replace(stretch=k, rate=0.1 * k) for k in (0.25, 0.5, 1.0, 2.0)},
    **{arm: {g: SIGHT._replace(gain=g) for g in GAINS} for arm in ("late sight", "forward model")},
}
BEST = {"reflex alone": 0.5, "late sight": 2, "forward model": 240}  # by `gain_sweep`
# Late sight's gain and damping that missed least in `damping_sweep`: almost a brake alone. Of those
# tried the gain is the lowest, the damping the longest: less pull, braking as much, may miss less.
TUNED = 0.125, 24.0
REACHES = 100  # by each of the seeds
BY_BOTH = {  # gains and dampings of sight
    "late sight": [
        *product((0.5, 1, 2, 4), (0.25, 1.0, 2.0, 3.0, 4.0, 6.0)),
        *product((0.125, 0.25), (6.0, 12.0, 24.0)),
    ],
    "forward model": [*product((120, 240, 480), (0.05, 0.1, 0.15, 0.25, 0.4))],
}
ARMS = {"the plan alone": OPEN_LOOP} | {arm: BY_GAIN[arm][gain] for arm, gain in BEST.items()}
ARMS["late sight"] = SIGHT._replace(gain=TUNED[0], damping=TUNED[1])


def exact_plans(targets, template_set):
    """Plans to targets (B, 2), with weights that satisfy Eq. 4."""
    return plan(targets, template_set, exact_weights)


def fit_forward_model(template_set, rng, count=20, noise=NOISE):
    """A `ForwardModel` that has felt so many reaches with motor noise, without sight."""
    return ForwardModel().update(_lessons(template_set, rng, count, noise))


def _lessons(template_set, rng, count, noise=NOISE):
    some = exact_plans(draw_targets(template_set, count, rng), template_set)
    return reach(noisy(some.excitations, noise, rng))


def active_inputs(q, velocity, activation):
    """`state_inputs` with the activations in place of the torque that they give, (B, 10)."""
    return np.concatenate([q, velocity / FAST, activation], axis=-1)


def fit_null_model(template_set, rng, count, cells, inputs=state_inputs):
    """The null of `fit_forward_model`: the same lessons by other `cells`, or from other `inputs`.

    `cells` have scikit-learn's `fit` and `predict`. The samples are those of `ForwardModel`.
    """
    motion = _lessons(template_set, rng, count)
    q, velocity, activation = (
        x[:, BETWEEN:-1:BETWEEN].reshape(-1, x.shape[-1])
        for x in (motion.q, motion.velocity, motion.activation)
    )
    felt = np.diff(motion.velocity, axis=1)[:, BETWEEN::BETWEEN].reshape(-1, 2) / STEP
    cells.fit(inputs(q, velocity, activation), felt)
    return lambda *state: cells.predict(inputs(*state))


def draw_target_jumps(template_set, count, rng, by=JUMP):
    """Targets (count, 2) and where they jump to, `by` metres in any direction, all within reach.

    ValueError when so few of those drawn jump to a place within reach that targets are missing.
    """
    first = draw_targets(template_set, 4 * count, rng)
    angle = rng.uniform(0, 2 * np.pi, len(first))
    second = first + by * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    inside = is_surrounded(second, template_set.points)
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


def delayed_paths(target, template_set, gains, delay, model=None, sight=SIGHT):
    """Hand paths (n, T + 1, 2) to one target (2,): feedback with gains (n,) and a delay in s."""
    senses = sight._replace(gain=np.array(gains)[:, None], delay=delay)
    return watch(repeat_reach(target, len(gains), template_set), senses, model).hand[..., :2]


def repeat_reach(target, count, template_set):
    """The reference of so many reaches to one target (2,), which stays."""
    return reference_trajectory(exact_plans(np.tile(target, (count, 1)), template_set))


def compare_models(models, goals, template_set):
    """By name of a forward model, the mean tremor in mm² and overshoot in mm to goals (B, 2)."""
    reference = reference_trajectory(exact_plans(goals, template_set))
    paths = {k: watch(reference, SIGHT, model).hand[..., :2] for k, model in models.items()}
    tremors = {k: tremor(path)[0].mean() for k, path in paths.items()}
    return tremors, {k: 1000 * overshoot(path, goals).mean() for k, path in paths.items()}


def reach_measures(seed, arms=ARMS, count=REACHES, seconds=3.0):
    """By arm and measure, the means over so many reaches to a target that stays, or jumps.

    Arms whose name begins with "forward model" have one.
    """
    rng, template_set = np.random.default_rng(seed), load()
    model = fit_forward_model(template_set, rng)
    first, second = draw_target_jumps(template_set, count, rng)
    steady = reference_trajectory(exact_plans(first, template_set), seconds)
    jump = reference_after_jump(template_set, first, second)
    measured = {}
    for arm, gains in arms.items():
        known = model if arm.startswith("forward model") else None
        path, jumped = (
            simulate_feedback(reference, gains, known, noise=NOISE, rng=rng).hand[..., :2]
            for reference in (steady, jump)
        )
        power, frequency = tremor(path)
        missed = end_error(jumped, second)
        measures = {
            "swing (mm²)": tremor(path, band=SWING)[0].mean(),
            "tremor (mm²)": power.mean(),
            "strongest at (Hz)": np.median(frequency),
            "overshoot (mm)": 1000 * overshoot(path, first).mean(),
            "path over distance": path_length_ratio(path).mean(),
            "miss after a jump (mm)": missed.mean(),
            "speed after a jump (mm/s)": end_speed(jumped).mean(),
            "jumps within 10 mm": (missed < 10).mean(),
        }
        measured |= {f"{arm}, {name}": float(value) for name, value in measures.items()}
    return measured


def gain_sweep(seed, by_gain=BY_GAIN, count=40, **size):
    """`reach_measures` of every arm at each of its gains, with other reaches, by "arm, gain"."""
    arms = {f"{arm}, {gain}": v for arm, gains in by_gain.items() for gain, v in gains.items()}
    return reach_measures((seed, 1), arms, count, **size)


def damping_sweep(seed, by_both=BY_BOTH, count=20):
    """By "arm, gain, damping", the mean miss in mm after a jump: other reaches again.

    Every arm, and the reflex alone, meets the same jumps and the same noise.
    """
    rng, template_set = np.random.default_rng((seed, 2)), load()
    model = fit_forward_model(template_set, rng)
    first, second = draw_target_jumps(template_set, count, rng)
    reference = reference_after_jump(template_set, first, second)

    def mean_miss(gains, model=None):
        return end_error(watch(reference, gains, model).hand[..., :2], second).mean()

    found = {"reflex alone": mean_miss(ARMS["reflex alone"])}
    for arm, pairs in by_both.items():
        known = model if arm == "forward model" else None
        for gain, damping in pairs:
            sight = SIGHT._replace(gain=gain, damping=damping)
            found[f"{arm}, {gain:g}, {damping:g}"] = mean_miss(sight, known)
    return found


def sweep_means(measured):
    """By arm, the mean of what `gain_sweep` measured at each of sight's `GAINS`."""
    swept = load_results()["gains"]
    sights = {arm: [f"{arm}, {g}" for g in GAINS] for arm in ("late sight", "forward model")}
    sights["reflex alone"] = [f"reflex alone, {BEST['reflex alone']}"] * len(GAINS)
    return {k: [swept[f"{arm}, {measured}"].mean() for arm in arms] for k, arms in sights.items()}


def centre_out(template_set, turned=0.0):
    """The reference of eight reaches from `HOME`, equally long, 25 degrees apart.

    From straight back on, downwards and to the front; `turned` by so many degrees. Past experience
    knows no way up from there.
    """
    angle = np.radians(180 + turned + 25 * np.arange(8))
    ends = HOME + FARTHEST * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return reference_trajectory(exact_plans(ends, template_set), 1.0)


def curl_field_deviations(learner, template_set, model, rng, blocks=BLOCKS, noise=NOISE):
    """How far a curl field bends `centre_out` reaches as they are learned: (blocks, 8), in m.

    The same reaches come in every block; `blocks` counts those before, in and after the field.
    The second answer, (before or after learning, 8), is the same for ways halfway between them.
    """
    practised, others = (centre_out(template_set, turned) for turned in (0.0, -12.5))
    before, during, _ = blocks
    bends, held_out = [], []
    for block in range(sum(blocks)):
        on = before <= block < before + during
        if block in (before, before + during):
            held_out.append(reach_in_field(learner, others, curl(FIELD), model, rng, noise)[0])
        field = curl(FIELD) if on else None
        bend, motion = reach_in_field(learner, practised, field, model, rng, noise)
        learner.update(practised, motion)
        bends.append(bend)
    return np.array(bends), np.array(held_out)


def reach_in_field(learner, reference, disturbance, model, rng, noise=NOISE, gains=SIGHT):
    """Noisy reaches with what was learned: their deviation (B,) in m, and their `Motion`."""
    motion = simulate_feedback(learner.correct(reference), gains, model, disturbance, noise, rng)
    return path_deviation(motion.hand[..., :2], hand(reference.q)[..., :2]), motion


def curl_field_errors(seed, noise=NOISE, **size):
    """For one seed, the mean deviation in mm of each block, to the left, and its mean size.

    And the mean size for ways never practised, before and after. Commands waver by `noise`;
    `size` as for `curl_field_deviations`.
    """
    rng, template_set = np.random.default_rng(seed), load()
    model = fit_forward_model(template_set, rng, noise=noise)
    learner, size = FeedbackErrorLearning(template_set), {"noise": noise, **size}
    bends, held_out = curl_field_deviations(learner, template_set, model, rng, **size)
    return {
        "to the left": 1000 * bends.mean(axis=1),
        "size": 1000 * np.abs(bends).mean(axis=1),
        "held-out": 1000 * np.abs(held_out).mean(axis=1),
    }


WITH_SCATTER = f"field, {SCATTER_MM} mm of scatter"
EXPERIMENTS = {
    "gains": gain_sweep,
    "dampings": damping_sweep,
    "reaches": reach_measures,
    "field": curl_field_errors,
    WITH_SCATTER: partial(curl_field_errors, noise=SCATTER_SHARE),
}


def make(experiments=EXPERIMENTS, seeds=SEEDS):
    """What `results/feedback.json` holds: every experiment with every seed, to four digits."""
    return calibration.make(experiments, seeds)


load_results = partial(calibration.load_results, "feedback")
