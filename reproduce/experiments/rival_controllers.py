"""Habit, its calibrations and late feedback beside LQG control: equal arm, targets, noise, hold.

All begin at rest in the same posture, reach for the `optimal_control.TARGETS`, on which no
template lies, and hold for 1.5 s. Commands waver by `NOISE`, each millisecond anew, with the same
draws for all; whoever has eyes gets the same reports, `DELAY` late and with the same errors. The
late feedbacks also have the stretch reflex, whose sense is exact; LQG has not. So two rows more
tell the reflex apart: it alone, and LQG with the same reflex, whose commands the filter is told or
not. What can be tuned is tuned on other targets, for the least miss (LQG's price without a reflex).
The processor's time of all with feedback includes the arm's steps, one tick after the other, as far
as they take longer than those of habit's whole reach.
"""

from functools import partial
from itertools import product
from time import process_time
from typing import NamedTuple

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments import calibration
from reproduce.experiments.controller_comparison import templates_with_noise
from reproduce.peers import lqg
from reproduce.peers.lqr_tracking import scatter
from reproduce.peers.minimum_variance import jerk
from reproduce.peers.optimal_control import TARGETS, optimal_excitations
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.muscle import add_noise, noisy
from vmc_lib.cerebellum.forward_model import arm_copy
from vmc_lib.cerebellum.offline import algorithm_1, gauss_newton_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.feedback import (
    SIGHT,
    TICK,
    reference_trajectory,
    simulate_feedback,
)
from vmc_lib.motor.inverse_dynamics import SAMPLES
from vmc_lib.motor.planning import draw_targets, norm, plan
from vmc_lib.motor.templates import keep_last, load, mean_distance, reach

NOISE, DELAY, SECONDS, REPEATS = 0.4, 0.12, 2.5, 20
TICKS = round(1000 * SECONDS) // TICK
HOLD_TICKS = slice(SAMPLES // TICK, 3 * SAMPLES // 2 // TICK + 1)  # ticks: 1 to 1.5 s
GAINS = (0.0, 2.0, 8.0, 32.0, 128.0, 512.0, 2048.0)  # late feedback's
DAMPINGS = (0.04, 0.1, 0.25, 0.6, 1.5, 4.0)
MODEL_GAINS = (60.0, 120.0, 240.0, 480.0, 960.0)  # where it has a forward model
PRICES = (0.1, 0.3, 1.0, 3.0, 10.0)  # of the LQG controller's commands
DELAYS, NOISES = (0.0, 0.06, 0.12, 0.18), (0.2, 0.4, 0.6)  # of the chapter's demo
STATES = [*product(DELAYS, NOISES)]
RULES = {  # how habit's weights are found, by trials on the arm that wavers
    "habit": None,
    "habit, Algorithm 1": algorithm_1,
    "habit, ours": gauss_newton_calibration,
}
LATE, FORESEEN, LQG = "late feedback", "late feedback, forward model", "LQG"
BLIND, FELT, TOLD = "reflex alone", "LQG, reflex", "LQG, reflex, filter told"
AT_PRICE = f"LQG, price {lqg.PRICE:g}"  # not tuned
LQG_KINDS = {  # by name: a price, or None for the tuned one, and what `lqg.steer` is to do
    LQG: (None, {}),
    FELT: (None, {"reflex": True}),
    TOLD: (None, {"reflex": True, "copied": True}),
    AT_PRICE: (lqg.PRICE, {}),
}
MISS, LATER, EFFORT = "miss, 1.0–1.5 s (mm)", "at 2.5 s (mm)", "effort / the least"
PATH, JERK, SCATTER = "way / straight way", "jerk / the least", "scatter (mm)"
TIME = "processor (ms)"
MEASURES = MISS, LATER, SCATTER, EFFORT, PATH, JERK, TIME
MUST_KNOW = {
    "habit": "templates",
    "habit, Algorithm 1": "templates; 21 tries at the target, and where they end",
    "habit, ours": "templates; 8 tries at the target, and their holds",
    BLIND: "templates, the way in joints; muscle lengths",
    LATE: "templates, the way in joints, inverse dynamics; the eye's reports, muscle lengths",
    FORESEEN: "the same, and the arm's equations",
    LQG: "the arm's equations, the sizes of all noises, a price; the eye's reports",
    FELT: "the same; muscle lengths",
    TOLD: "the same; muscle lengths, and what the reflex commands",
    AT_PRICE: "as LQG, and another price",
}


class Luck(NamedTuple):
    """What chance does to B movements: unit noise of commands, and errors of the senses."""

    noise: np.ndarray  # (T TICK, B, 6), by which `muscle.noisy` draws
    errors: np.ndarray  # (T, B, 4), rad and rad/s
    seed: tuple


def draw_luck(count, seed):
    """The `Luck` of so many movements."""
    noise = np.random.default_rng(seed).standard_normal((TICKS * TICK, count, 6))
    errors = lqg.ERRORS * np.random.default_rng((seed, 1)).standard_normal((TICKS, count, 4))
    return Luck(noise, errors, seed)


def habit_paths(plans, luck, share=NOISE):
    """Paths (B, T + 1, 2) and activations (B, T + 1, 6) by plans alone."""
    commands = keep_last(plans.excitations, SECONDS - 1)
    motion = reach(add_noise(commands, share, np.swapaxes(luck.noise, 0, 1)), hold=0.0)
    return motion.hand[:, ::TICK, :2], motion.activation[:, ::TICK]


def feedback_paths(plans, gain, damping, luck, share=NOISE, delay=DELAY, model=None, gains=SIGHT):
    """The same by chapter 12's feedback, whose sight errs; gain and damping one, or (B, 1)."""
    gains = gains._replace(gain=gain, damping=damping, delay=delay)
    rng = np.random.default_rng(luck.seed)
    reference = reference_trajectory(plans, SECONDS)
    motion = simulate_feedback(reference, gains, model, errors=luck.errors, noise=share, rng=rng)
    return motion.hand[:, ::TICK, :2], motion.activation[:, ::TICK]


def lqg_law(target, share=NOISE, price=lqg.PRICE, start=None, **more):
    """The LQG law to a target (2,), found from some commands (T, 6) on, or from habit's plan."""
    if start is None:
        habit = keep_last(plan(target, load()).excitations, SECONDS - 1)
        start = habit.reshape(TICKS, TICK, 6).mean(axis=1)
    return lqg.solve(start, target, price, share=lqg.per_tick(share), **more)


def lqg_paths(law, luck, share=NOISE, delay=DELAY, **reflex):
    """The same by an LQG law, whose senses err and are late; `reflex` as for `lqg.steer`."""
    filters = lqg.filter_gains(law, round(1000 * delay / TICK), lqg.per_tick(share))
    draws = np.swapaxes(luck.noise, 0, 1).reshape(-1, TICKS, TICK, 6)
    states, _ = lqg.steer(law, filters, share, draws, np.swapaxes(luck.errors, 0, 1), **reflex)
    return hand(states[..., :2])[..., :2], states[..., 4:]


def miss(path, targets):
    """How far paths (…, T + 1, 2) are from targets (…, 2) over the hold, (…,), mm."""
    return 1000 * mean_distance(path[..., HOLD_TICKS, :], targets)


def repeat_plans(plans, repeats=REPEATS):
    """Each of n plans so often, one after the other: n × repeats."""
    return plans[np.repeat(np.arange(len(plans.target)), repeats)]


def best_feedback(*state, **size):
    """The gain and damping (2,) with which late feedback misses least, as `feedback_misses`."""
    return least_missed(feedback_misses(*state, **size))


def least_missed(tried):
    """The gain and damping, or the price, (k,), whose misses (count,) are least on average."""
    return np.array(min(tried, key=lambda pair: np.mean(tried[pair])))


def feedback_misses(
    delay=DELAY, share=NOISE, gains=GAINS, dampings=DAMPINGS, model=None, count=6, repeats=3
):
    """The mean misses (count,) in mm at other targets, by gain and damping: all by equal luck."""
    plans = repeat_plans(plan(_other_targets(count), load()), repeats)
    luck, missed = draw_luck(len(plans.target), 101), {}
    for pair in product(gains, dampings):
        path, _ = feedback_paths(plans, *pair, luck, share, delay, model)
        missed[pair] = miss(path, plans.target).reshape(count, repeats).mean(axis=1)
    return missed


def price_misses(prices=PRICES, count=6, repeats=3):
    """The mean misses (count,) in mm of the LQG controller at the same others, by its price."""
    luck, targets = draw_luck(repeats, 101), _other_targets(count)

    def mean_miss(target, price):
        return miss(lqg_paths(lqg_law(target, price=price), luck)[0], target).mean()

    found = Parallel()(delayed(mean_miss)(*pair) for pair in product(targets, prices))
    each = np.reshape(found, (count, -1)).T
    return {(price,): row for price, row in zip(prices, each, strict=True)}


def _other_targets(count):
    return draw_targets(load(), count, np.random.default_rng(100))


def compare(target, number, tuned, repeats=REPEATS):
    """Every measure of every controller at one target (2,): numbers by "controller, measure"."""
    luck, calm = draw_luck(repeats, (1, number)), draw_luck(1, 0)
    calm = calm._replace(errors=0 * calm.errors)
    habit, runs, times = plan(target[None], load()), {}, {}
    wavering = templates_with_noise(partial(noisy, share=NOISE), (2, number))
    for name, rule in RULES.items():
        times[name], learnt = _learn(rule, plan(target[None], wavering))
        runs[name] = partial(_by_habit, habit.with_weights(learnt))
    still = _seconds(lambda: habit_paths(habit, calm))
    gains = {BLIND: (0.0, 0.0), LATE: tuned[LATE], FORESEEN: tuned[FORESEEN]}
    for name, pair in gains.items():
        model = arm_copy() if name == FORESEEN else None
        runs[name] = partial(_by_feedback, habit, pair, model)
        times[name] = _seconds(lambda run=runs[name]: run(calm, 0.0)) - still
    for name, (price, reflex) in LQG_KINDS.items():
        start = process_time()
        law = lqg_law(target, price=tuned[LQG].item() if price is None else price)
        runs[name] = partial(lqg_paths, law, **reflex)
        runs[name](calm, 0.0)
        times[name] = process_time() - start - still
    least = np.square(reach(optimal_excitations()[number], hold=0.0).activation).mean()
    found = {}
    for name, run in runs.items():
        measured = measure(target, *run(luck, NOISE), run(calm, 0.0)[0][0])
        measured |= {EFFORT: measured[EFFORT] / least, TIME: 1000 * times[name]}
        found |= {f"{name}, {what}": float(x) for what, x in measured.items()}
    return found


def measure(target, path, activation, calm):
    """Numbers by name of noisy reaches (B, T + 1, …), and of the way (T + 1, 2) without noise.

    The effort is the mean square of activation, until 1 s.
    """
    way = calm[: SAMPLES // TICK + 1]
    return {
        MISS: miss(path, target).mean(),
        LATER: 1000 * norm(path[:, -1] - target).mean(),
        SCATTER: 1000 * scatter(path)[HOLD_TICKS].mean(),
        EFFORT: np.square(activation[:, : SAMPLES // TICK]).mean(),
        PATH: norm(np.diff(way, axis=0)).sum() / norm(target - way[0]),
        JERK: jerk(way),
    }


def _by_habit(plans, luck, share):
    return habit_paths(repeat_plans(plans, luck.noise.shape[1]), luck, share)


def _by_feedback(plans, gains, model, luck, share):
    return feedback_paths(
        repeat_plans(plans, luck.noise.shape[1]), *gains, luck, share, DELAY, model
    )


def _learn(rule, plans):
    """The processor's seconds that a rule takes, its tries taken off, and its weights (1, N)."""
    tries = 0.0

    def move(plans):
        nonlocal tries
        start = process_time()
        made = execute(plans)
        _ = made.hold  # the arm moves when it is asked for
        tries += process_time() - start
        return made

    start = process_time()
    plan(plans.target, load())
    weights = rule(plans, execute=move).best_weights if rule else plans.weights
    return process_time() - start - tries, weights


def _seconds(call):
    """The processor's seconds for a second call."""
    call()
    start = process_time()
    call()
    return process_time() - start


def make(
    targets=TARGETS, repeats=REPEATS, states=STATES, prices=PRICES, dampings=DAMPINGS, count=6
):
    """What `results/rivals.json` holds: what was tried and tuned, and `compare` at every target.

    `states` are the delays and noises for which late feedback is tuned, at `count` targets.
    """
    size = {"dampings": dampings, "count": count}
    jobs = [partial(best_feedback, *state, **size) for state in states]
    jobs += [
        partial(feedback_misses, **size),
        partial(feedback_misses, gains=MODEL_GAINS, model=arm_copy(), **size),
    ]
    *gains, late, foreseen = Parallel()(delayed(job)() for job in jobs)
    tried = {LATE: late, FORESEEN: foreseen, LQG: price_misses(prices, count)}
    tuned = {name: least_missed(misses) for name, misses in tried.items()}
    each = Parallel()(
        delayed(compare)(target, number, tuned, repeats) for number, target in enumerate(targets)
    )
    return {
        "measures": {k: np.round([one[k] for one in each], 4).tolist() for k in each[0]},
        "tuned": {k: x.tolist() for k, x in tuned.items()},
        **{tried_name(k): _stored(misses) for k, misses in tried.items()},
        "gains": {_state(*state): x.tolist() for state, x in zip(states, gains, strict=True)},
    }


def tried_name(name):
    """Under which name the misses of all that was tried for a controller ship."""
    return f"{name}, tried"


def _stored(misses):
    return {", ".join(f"{x:g}" for x in k): np.round(v, 4).tolist() for k, v in misses.items()}


def _state(delay, share):
    return f"{delay:g} s, {share:g}"


load_results = partial(calibration.load_results, "rivals")


def is_inside(name):
    """Whether all that is tuned of a controller lies inside what was tried, at no edge of it."""
    shipped = load_results()
    tried = np.array([pair.split(", ") for pair in shipped[tried_name(name)]], float)
    best = shipped["tuned"][name]
    return bool(((tried.min(axis=0) < best) & (best < tried.max(axis=0))).all())


def tuned_gains(delay, share):
    """The gain and damping of late feedback that ship for such a delay and noise."""
    return load_results()["gains"][_state(delay, share)]
