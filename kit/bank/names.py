"""Names: from features to a probability, and how far to believe a table."""

import numpy as np

from kit.question import between, choice, count, number, pick
from vmc_lib.statistics import wilson
from vmc_lib.what.recogniser import NameClassifier


def chance_of_a_name(rng):
    weights, x = (np.round(rng.uniform(-2, 2, 3), 1) for _ in range(2))
    bias = between(rng, -1, 1, 0.5)
    return number(
        f"A classifier has the weights {weights.tolist()} and the bias {bias}. What probability "
        f"does it give for the features {x.tolist()}?",
        NameClassifier(weights, bias).probability(x),
        hint="1 / (1 + exp(-(w · x + b)))",
        tolerance=0.002,
    )


def score_of_a_chance(rng):
    chance = pick(rng, 0.1, 0.2, 0.25, 0.3, 0.6, 0.7, 0.75, 0.8, 0.9, 0.95)
    return number(
        f"A sigmoid says {chance}. What was the weighted sum before it?",
        np.log(chance / (1 - chance)),
        hint="The logarithm of the odds, p / (1 - p).",
    )


def feature_that_tips_it(rng):
    weight, bias = pick(rng, 0.5, 1.0, 2.0, 4.0), between(rng, -3, -0.5, 0.25)
    return number(
        f"One feature has the weight {weight}, the bias is {bias}, and all else is 0. From which "
        "value of the feature on is the name the likelier one?",
        -bias / weight,
        hint="Where the weighted sum is 0, the probability is one half.",
        tolerance=0.005,
    )


def table_without_errors(rng):
    n = pick(rng, 20, 40, 60, 80, 100, 160, 200)
    return number(
        f"A recogniser makes no error in {n} photos. Where is the lower end of the share's 95 % "
        "interval, after Wilson?",
        wilson(n, n)[0],
        hint="n / (n + z²), z = 1.96",
        tolerance=0.002,
    )


def do_intervals_meet(rng):
    n = pick(rng, 40, 80, 160)
    first, second = (between(rng, n // 2, n - 1, 1) for _ in range(2))
    (low, high), (low2, high2) = wilson(first, n), wilson(second, n)
    return choice(
        f"One method is right in {first} of {n} photos, another in {second} of {n} other photos. "
        "Do their 95 % intervals, after Wilson, have a value in common?",
        ("yes", "no"),
        "yes" if max(low, low2) <= min(high, high2) else "no",
        "Work out both intervals first.",
    )


def share_that_was_printed(rng):
    n, wrong = between(rng, 40, 90, 5), between(rng, 1, 4, 1)
    return number(
        f"All {n} shuttlecocks are named, and {wrong} cup(s) are named shuttlecock too. What "
        "precision is printed, in per cent?",
        100 * n / (n + wrong),
        "%",
        "Right calls over all calls.",
        tolerance=0.05,
    )


def honest_chances(rng):
    chance, n = pick(rng, 0.6, 0.7, 0.8, 0.9), pick(rng, 20, 50, 100, 200)
    return count(
        f"A calibrated recogniser says {chance} for each of {n} crops. How many of them does one "
        "expect to be shuttlecocks?",
        round(chance * n),
        "crops",
        "That is what calibrated means.",
    )
