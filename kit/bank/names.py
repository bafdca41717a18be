"""Questions on names: from features to a probability, and how far to believe a table."""

import numpy as np

from kit.question import choice, count, numeric, steps, successes, tenths
from vmc_lib.statistics import wilson
from vmc_lib.what.recogniser import NameClassifier


@numeric(hint="1 / (1 + exp(-(w · x + b)))", tolerance=0.002)
def chance_of_a_name(weights=tenths(-2, 2, 3), x=tenths(-2, 2, 3), bias=steps(-1, 1, 0.5)):
    """A classifier has the weights {weights} and the bias {bias}. What probability does it give for
    the features {x}?"""
    return NameClassifier(weights, bias).probability(x)


@numeric(hint="The logarithm of the odds, p / (1 - p).")
def score_of_a_chance(p=(0.1, 0.2, 0.25, 0.3, 0.6, 0.7, 0.75, 0.8, 0.9, 0.95)):
    """A sigmoid says {p}. What was the weighted sum before it?"""
    return np.log(p / (1 - p))


@numeric(hint="Where the weighted sum is 0, the probability is one half.", tolerance=0.005)
def feature_that_tips_it(weight=(0.5, 1.0, 2.0, 4.0), bias=steps(-3, -0.5, 0.25)):
    """One feature has the weight {weight}, the bias is {bias}, and all else is 0. From which value
    of the feature on is the name the likelier one?"""
    return -bias / weight


@numeric(hint="n / (n + z²), z = 1.96", tolerance=0.002)
def table_without_errors(n=(20, 40, 60, 80, 100, 160, 200)):
    """A recogniser makes no error in {n} photos. Where is the lower end of the share's 95 %
    interval, after Wilson?"""
    return wilson(n, n)[0]


@choice("no", "yes", hint="Work out both intervals first.")
def do_intervals_meet(right=successes((40, 80, 160), 2)):
    """One method is right in {right[0]} of {right[2]} photos, another in {right[1]} of {right[2]}
    other photos. Do their 95 % intervals, after Wilson, have a value in common?"""
    *counts, n = right
    lows, highs = zip(*(wilson(count, n) for count in counts), strict=True)
    return max(lows) <= min(highs)


@numeric("%", "Right calls over all calls.", tolerance=0.05)
def precision_with_cups(n=steps(40, 90, 5), wrong=steps(2, 6, 1)):
    """All {n} shuttlecocks are named, and {wrong} cups are named shuttlecock too. What precision
    is printed, in per cent?"""
    return 100 * n / (n + wrong)


@count("crops", "That is what calibrated means.")
def honest_chances(p=(0.6, 0.7, 0.8, 0.9), n=(20, 50, 100, 200)):
    """A calibrated recogniser says {p} for each of {n} crops. How many of them does one expect to
    be shuttlecocks?"""
    return round(p * n)
