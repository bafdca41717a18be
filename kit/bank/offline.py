"""Questions on off-line calibration: gains and corrections (Eq. 6, 7), and Broyden's rule."""

from types import SimpleNamespace

import numpy as np

from kit.bank.drawing import bars, intervals
from kit.question import choice, count, numeric, picture, steps
from vmc_lib.cerebellum.offline import GAINS, LARGEST_STEP, algorithm_1_change
from vmc_lib.motor.planning import least_change

GAIN = (0, 1, 2, 5, 10, 20)  # n of Eq. 7


def reach(rng):
    """One template, a target and where the hand ended, in whole cm; cos θ; and all in words."""
    target = rng.integers([8, -45], [24, -33]).astype(float)
    hand = target + rng.choice([-3, -2, -1, 1, 2, 3], 2)
    point = target + rng.choice([-6, -5, -4, 4, 5, 6], 2)
    error, towards = target - hand, point - hand
    cosine = error @ towards / np.linalg.norm(error) / np.linalg.norm(towards)
    if abs(cosine) < 0.1:  # at a right angle there is no gain
        return reach(rng)
    text = (
        f"The target is ({target[0]:g}, {target[1]:g}) cm, the hand ended at ({hand[0]:g}, "
        f"{hand[1]:g}), a template reaches ({point[0]:g}, {point[1]:g}); the shoulder is (0, 0)."
    )
    plan = SimpleNamespace(target=target, points=point[None])
    return SimpleNamespace(plan=plan, hand=hand, cosine=cosine, text=text)


def change(reach, n):
    """By how much Algorithm 1 changes the template's weight."""
    return algorithm_1_change(reach.plan, reach.hand, n)[0]


@numeric(hint="Their dot product over their lengths.", tolerance=0.005)
def cosine_of_a_template(reach=reach):
    """{reach.text} What is cos θ, between the error and the way from the hand to the template (Eq.
    6)?"""
    return reach.cosine


@numeric(
    hint="error / d_a · [1 + n (d_t - d_i) / d_i], distances from the shoulder", tolerance=0.001
)
def gain_of_a_template(reach=reach, n=GAIN):
    """{reach.text} What is the gain k of Eq. 7 for n = {n}?"""
    return change(reach, n) / reach.cosine


@numeric(hint="Δw = k cos θ (Eq. 6 and 7)", tolerance=0.001)
def change_of_a_weight(reach=reach, n=GAIN):
    """{reach.text} By how much does Algorithm 1 change the template's weight for n = {n}?"""
    return change(reach, n)


@choice("more", "less", hint="The sign of Δw = k cos θ.")
def is_it_used_more(reach=reach, n=(0, 5)):
    """{reach.text} For n = {n}, will Algorithm 1 use the template more or less than before?"""
    return int(change(reach, n) < 0)


@count("reaches", "One for the plan, one for each n.")
def reaches_that_are_tried(targets=steps(5, 60, 5), high=(10, 20, 40)):
    """Algorithm 1 tries every whole n from 0 to {high}, after the plan itself (the paper:
    {paper[0]} to {paper[1]}). How many reaches are that for {targets} targets?"""
    return targets * (high + 2), {"paper": (GAINS[0], GAINS[-1])}


def five_errors(rng):
    errors = np.round(rng.uniform(0.5, 9, 5), 1)
    return errors if len({*errors}) == 5 else errors + 0.01 * np.arange(5)


@choice(
    "the plan itself",
    *(f"n = {n}" for n in range(4)),
    hint="The trial that came nearest; that may be the plan itself.",
)
def best_of_the_trials(errors=five_errors):
    """A plan misses by {errors[0]:g} mm; with n = 0 to 3 the miss is {errors[1]:g}, {errors[2]:g},
    {errors[3]:g}, {errors[4]:g} mm. Algorithm 1 keeps the
    best of what it has tried, the plan included. Which is that?"""
    return errors.argmin()


@numeric(hint="Each weight is believed to move the hand so much more: the change is smaller.")
def belief_that_is_too_wide(wide=(1.25, 1.5, 2, 2.5, 4)):
    """The templates are believed to lie {wide} times as far apart as they do. The arm is linear.
    What share of the way to the target is made after one correction of Eq. 4?"""
    points = np.array([[1.0, -1, -1, 1], [1, 1, -1, -1]])
    return (points @ least_change(wide * points, np.array([1.0, 0])))[0]


def large_change(rng):
    change = np.round(rng.uniform(-0.8, 0.8, 4), 1)
    change[0] = (0.7, 0.8, 0.9)[rng.integers(3)]
    return change


@numeric(hint="All parts are made smaller by the same factor.")
def capped_step(change=large_change):
    """A correction Δw = {change} is asked for, but no step may be longer than {LARGEST_STEP}. What
    is its first part after that?"""
    return change[0] * LARGEST_STEP / np.linalg.norm(change)


@numeric("mm", "Surprise · Δw / |Δw|², with one weight.", tolerance=0.1)
def surprise_that_is_learned(
    change=(0.1, 0.2, 0.25, 0.5), foreseen=steps(5, 20, 1), moved=steps(2, 25, 1)
):
    """One weight is changed by {change}. The hand was to move {foreseen} mm and moves {moved} mm.
    By how much does Broyden's rule change its belief of how far a weight of 1 moves it (negative:
    less far)?"""
    return (moved - foreseen) / change


@numeric(hint="Evenly spread neurons add up to n/2 times the reach.")
def vote_of_neurons(n=(3, 4, 6, 8, 12), degrees=steps(0, 90, 5)):
    """{n} neurons prefer directions that are evenly spread. Each votes for its own with c · d, for
    a reach d of length 1 at {degrees} degrees. How long is their sum?"""
    angles = 2 * np.pi * np.arange(n) / n
    preferred = np.stack([np.cos(angles), np.sin(angles)], 1)
    reach = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    return np.linalg.norm(preferred.T @ (preferred @ reach))


def noisy_trials(rng):
    """Misses of 21 trials (mm), to a tenth."""
    return np.round(np.abs(rng.normal(8, 3, 21)) + 1, 1)


def trials(axes, misses):
    """The misses of 21 trials of one reach, in mm, one ringed: the smallest. {misses}."""
    axes.plot(range(21), misses, "o")
    best = misses.argmin()
    axes.plot(best, misses[best], "ko", ms=12, mfc="none")
    axes.set(xlabel="n of Eq. 7", ylabel="miss (mm)", ylim=(0, None))
    axes.set_xticks(range(0, 21, 2))
    axes.grid(alpha=0.4)


@picture(trials)
@choice(
    "larger on average",
    "the same",
    "smaller on average",
    hint="The best of many is in part lucky, and luck is not kept. Without noise there is none.",
)
def best_made_again(misses=noisy_trials, noise=("with noise, other in each", "without any noise")):
    """The ringed trial is kept. The trials were made {noise}. It is now made again, in the same
    way. How large is its miss?"""
    return int(noise == "without any noise")


def three_gains(rng):
    """How much three methods improve a reach, in mm: means and half intervals, (3, 2)."""
    half = rng.integers(2, 6, 3) / 2
    mean = np.array([half[0] + 1, half[1] - 0.5, -half[2] - 0.5])
    return np.column_stack([mean, half])[rng.permutation(3)]


def improvements(axes, gains):
    """Mean improvements with their 95 % intervals, and a line at 0: {said}."""
    intervals(axes, {n: (m - h, m, m + h) for n, (m, h) in zip("ABC", gains, strict=True)}, "")
    axes.axvline(0, color="k", lw=1)
    axes.set_xlabel("better by (mm), the same reaches")


@picture(improvements)
@choice("A", "B", "C", hint="The whole interval lies on the side where reaches are better.")
def which_is_shown_to_help(gains=three_gains):
    """Three methods change the same reaches, with 95 % intervals of the mean of the differences.
    Which one is shown to help?"""
    low = gains[:, 0] - gains[:, 1]
    said = (f"{n}: {m:g} ± {h:g} mm" for n, (m, h) in zip("ABC", gains, strict=True))
    return np.argmax(low), {"said": "; ".join(said)}


def three_rules(rng):
    """Mean misses without a change, with random changes, and with Algorithm 1, (3,), mm."""
    return np.array([rng.integers(16, 25), rng.integers(9, 15), rng.integers(3, 8)], float)


def rules(axes, misses):
    """Three bars of the mean miss: the plan as it is, {misses[0]:g} mm; the best of 21 random
    changes, {misses[1]:g} mm; Algorithm 1, the best of its 21, {misses[2]:g} mm."""
    names = "as planned", "best of 21\nrandom changes", "Algorithm 1\n(best of 21)"
    bars(axes, dict(zip(names, misses, strict=True)), "mean miss (mm)")


@picture(rules)
@numeric(hint="What it gains over its control, as a share of its whole gain.", tolerance=0.01)
def gain_by_the_direction(misses=three_rules):
    """The random changes are as large as those of Algorithm 1, and the best is kept as well. Of
    what Algorithm 1 gains over the plan, which share is due to the directions of its changes?"""
    planned, random, algorithm = misses
    return (random - algorithm) / (planned - algorithm)
