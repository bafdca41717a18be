"""Beyond the paper: ablations, noise, space, and what grows with what."""

import numpy as np

from kit.question import between, count, number, pick
from vmc_lib.arm.muscle import force
from vmc_lib.statistics import student


def share_that_is_left(rng):
    before, after = between(rng, 4, 12, 0.5), between(rng, 0.2, 3.5, 0.1)
    return number(
        f"One change takes the median miss from {before} to {after} mm. What share of the miss is "
        "left?",
        after / before,
        hint="After over before.",
    )


def mean_of_six_seeds(rng):
    values = np.round(rng.normal(0.4, 0.05, 6), 2)
    k = pick(rng, 0, 1)
    what = ("mean", "half-width of its 95 % interval")[k]
    return number(
        f"Six seeds leave these shares of the miss: {values.tolist()}. What is the {what} "
        "(Student's t for five degrees of freedom: 2.571)?",
        student(values)[k],
        hint="The standard error is the deviation (n - 1) over √n; times t.",
        tolerance=0.001,
    )


def changes_together(rng):
    first, second = between(rng, 0.2, 0.9, 0.05), between(rng, 0.2, 0.9, 0.05)
    return number(
        f"One change leaves {first} of the miss, another {second}. If they mend different parts of "
        "it, so that their shares multiply, what do both leave together?",
        first * second,
        hint="Multiply. An ablation asks whether that is so.",
        tolerance=0.003,
    )


def templates_in_a_plane(rng):
    side, spacing = pick(rng, 24, 48, 72), pick(rng, 2, 3, 4, 6, 8)
    space = pick(rng, 2, 3)
    return count(
        f"Templates lie {spacing} cm apart and fill a {('square', 'cube')[space - 2]} of {side} "
        "cm, edges included. How many are they?",
        (side // spacing + 1) ** space,
        "templates",
        "(side / spacing + 1) to the power of the dimensions",
    )


def twice_as_dense(rng):
    n, times, space = between(rng, 20, 80, 5), pick(rng, 2, 3, 4), pick(rng, 2, 3)
    return count(
        f"{n} memories cover a region of {('the plane', 'space')[space - 2]}. About how many are "
        f"needed to have them {times} times as dense along every axis?",
        n * times**space,
        "memories",
        "times to the power of the dimensions",
    )


def trials_that_are_needed(rng):
    share, before = pick(rng, 0.1, 0.2, 0.3, 0.4, 0.5), between(rng, 4, 12, 1)
    wanted = pick(rng, 0.1, 0.5, 1)
    trials = np.arange(1, 20)
    return count(
        f"Each trial leaves {share:.0%} of the miss. A plan misses by {before} mm. After how many "
        f"trials is the miss under {wanted} mm for the first time?",
        trials[before * share**trials < wanted][0],
        "trials",
        "Multiply until it is small enough.",
    )


def noise_of_a_pull(rng):
    sigma, strongest = pick(rng, 0.05, 0.1, 0.2), pick(rng, 400, 600, 900)
    a = between(rng, 0.1, 0.9, 0.1)
    pull = force(a, 1.0, 0.0, strongest) - force(0.0, 1.0, 0.0, strongest)
    return number(
        f"A muscle is held still at its optimal length; its active part pulls with {pull:.1f} N. "
        f"Its activation strays by {sigma:.0%} of itself. By how much does the force (Eq. 10)?",
        sigma * pull,
        "N",
        "Eq. 10 is linear in the activation: the stronger the command, the noisier.",
    )


def luck_of_the_best(rng):
    n, chance = pick(rng, 2, 5, 10, 20), pick(rng, 0.05, 0.1, 0.2)
    return number(
        f"By noise alone, a trial looks better than it is with probability {chance}. With what "
        f"probability does this happen in at least one of {n} independent trials?",
        1 - (1 - chance) ** n,
        hint="1 less the probability that it happens in none.",
    )


def seconds_that_grow(rng):
    seconds, times = between(rng, 0.2, 2, 0.1), pick(rng, 2, 4, 10, 25)
    power, told = pick(rng, (1, "n"), (2, "n²"), (3, "n³"))
    return number(
        f"A step costs {seconds} s for n things, and its cost grows as {told}. What does it cost "
        f"for {times} times as many?",
        seconds * times**power,
        "s",
        "The factor to that power.",
    )


def power_of_growth(rng):
    times, power = pick(rng, 4, 10, 25), pick(rng, 0.5, 1, 1.5, 2)
    seconds = between(rng, 0.2, 2, 0.1)
    later = round(seconds * times**power, 2)
    return number(
        f"A step takes {seconds} s, and {later} s for {times} times as many things. To which power "
        "of their number does it grow?",
        np.log(later / seconds) / np.log(times),
        hint="The logarithm of the ratio of times over that of the ratio of sizes.",
        tolerance=0.02,
    )
