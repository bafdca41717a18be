"""Questions beyond the paper: ablations, space, and what grows with what."""

import numpy as np

from kit.bank.drawing import bars
from kit.question import choice, count, numeric, picture, steps
from vmc_lib.statistics import t_interval

SHARE, SECONDS = steps(0.2, 0.9, 0.05), steps(0.2, 2, 0.1)


@numeric(hint="After over before.")
def share_that_is_left(before=steps(4, 12, 0.5), after=steps(0.2, 3.5, 0.1)):
    """One change takes the median miss from {before} to {after} mm. What share of the miss is
    left?"""
    return after / before


@numeric(hint="The standard error is the deviation (n - 1) over √n; times t.", tolerance=0.001)
def interval_of_six_seeds(values=lambda rng: np.round(rng.normal(0.4, 0.05, 6), 2)):
    """Six seeds leave these shares of the miss: {values}. What is the half-width of the mean's 95 %
    interval (Student's t for five degrees of freedom: 2.571)?"""
    return t_interval(values)[1]


@numeric(hint="Multiply. An ablation asks whether that is so.", tolerance=0.003)
def changes_together(first=SHARE, second=SHARE):
    """One change leaves {first} of the miss, another {second}. If they mend different parts of it,
    so that their shares multiply, what do both leave together?"""
    return first * second


@count("templates", "(side / spacing + 1) to the power of the dimensions")
def templates_in_a_plane(
    side=(24, 48, 72), spacing=(2, 3, 4, 6, 8), shape=(("square", 2), ("cube", 3))
):
    """Templates lie {spacing} cm apart and fill a {shape[0]} of {side} cm, edges included. How many
    are they?"""
    return (side // spacing + 1) ** shape[1]


@count("memories", "times to the power of the dimensions")
def twice_as_dense(n=steps(20, 80, 5), times=(2, 3, 4), space=(("the plane", 2), ("space", 3))):
    """{n} memories cover a region of {space[0]}. About how many are needed to have them {times}
    times as dense along every axis?"""
    return n * times ** space[1]


@count("trials", "Multiply until it is small enough.")
def trials_that_are_needed(
    share=(0.1, 0.2, 0.3, 0.4, 0.5), before=steps(4, 12, 1), wanted=(0.1, 0.5, 1)
):
    """Each trial leaves {share:.0%} of the miss. A plan misses by {before} mm. After how many
    trials is the miss under {wanted} mm for the first time?"""
    trials = np.arange(1, 20)
    return trials[before * share**trials < wanted][0]


@numeric("s", "The factor to that power.")
def seconds_that_grow(
    seconds=SECONDS, times=(2, 4, 10, 25), growth=(("n", 1), ("n²", 2), ("n³", 3))
):
    """A step costs {seconds} s for n things, and its cost grows as {growth[0]}. What does it cost
    for {times} times as many?"""
    return seconds * times ** growth[1]


@numeric(
    hint="The logarithm of the ratio of times over that of the ratio of sizes.", tolerance=0.02
)
def power_of_growth(times=(4, 10, 25), power=(0.5, 1, 1.5, 2), seconds=SECONDS):
    """A step takes {seconds} s, and {later} s for {times} times as many things. To which power of
    their number does it grow?"""
    later = round(seconds * times**power, 2)
    return np.log(later / seconds) / np.log(times), {"later": later}


def three_changes(axes, first, second):
    """Three bars of the median miss: no change, 100 %; change A, {a:g} %; change B, {b:g} %."""
    shares = {"no change": 100, "A": 100 * first, "B": 100 * second}
    bars(axes, shares, "median miss (%)")


@picture(three_changes)
@numeric("%", "Of what A leaves, B leaves its own share.", tolerance=1)
def both_if_independent(first=steps(0.2, 0.9, 0.05), second=steps(0.2, 0.9, 0.05)):
    """Two changes, each made alone. If they mend different parts of the miss, so that their shares
    multiply, how much is left with both?"""
    return 100 * first * second, {"a": 100 * first, "b": 100 * second}


def four_cells(rng):
    """Per cent of a miss that is left: with neither change, A, B, both; and which kind, (4,), k."""
    a, b = 10 * rng.choice(np.arange(4, 9), 2, replace=False)
    k = rng.integers(3)
    both = a * b / 100 + (0, 0.5, -0.5)[k] * (min(a, b) - a * b / 100)
    return np.array([100, a, b, round(both)]), k


def two_by_two(axes, cells):
    """Four bars of the median miss: neither change, 100 %; A, {left[1]} %; B, {left[2]} %; both,
    {left[3]} %."""
    left, _ = cells
    names = "neither", "A", "B", "both"
    bars(axes, dict(zip(names, left.astype(float), strict=True)), "median miss (%)")


@picture(two_by_two)
@choice(
    "each does what it does alone",
    "they mend partly the same thing",
    "each helps more beside the other",
    hint="Work out what would be left if the shares multiplied, and compare.",
)
def what_an_ablation_says(cells=four_cells):
    """Two changes, alone and together. What does the fourth bar say of them?"""
    left, k = cells
    return k, {"left": left}
