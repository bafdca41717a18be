"""See and reach: a chain of steps, where it breaks, and how sure a count is."""

import numpy as np

from kit.question import between, choice, count, number, pick
from vmc_lib.statistics import wilson

STEPS = ("finding", "naming", "placing", "moving")


def chain_of_links(rng):
    right, links = between(rng, 0.8, 0.98, 0.02), between(rng, 2, 6, 1)
    return number(
        f"A chain has {links} links, each right with probability {right}, one as likely whatever "
        "became of the others. With what probability does the whole chain work?",
        right**links,
        hint="Probabilities multiply.",
        tolerance=0.003,
    )


def how_good_each_link(rng):
    whole, links = pick(rng, 0.5, 0.7, 0.8, 0.9, 0.95), between(rng, 2, 6, 1)
    return number(
        f"{links} independent links, all equally good, should work together in {whole:.0%} of all "
        "cases. How often must each be right?",
        whole ** (1 / links),
        hint="The root: whole to the power 1 / links.",
        tolerance=0.002,
    )


def unequal_links(rng):
    shares = np.round(rng.uniform(0.8, 1, 4), 2)
    told = ", ".join(f"{step} {share}" for step, share in zip(STEPS, shares, strict=True))
    return number(
        f"Each step is right with the probability: {told}; independently. In what share of the "
        "photos does the hand arrive?",
        shares.prod(),
        hint="Probabilities multiply.",
        tolerance=0.003,
    )


def link_to_mend(rng):
    shares = 0.8 + 0.01 * rng.permutation(19)[:4]
    told = ", ".join(f"{step} {share:.2f}" for step, share in zip(STEPS, shares, strict=True))
    return choice(
        f"Each step is right with the probability: {told}; independently. Which one, made perfect, "
        "would help the whole chain most?",
        STEPS,
        STEPS[shares.argmin()],
        "The whole is the product; the smallest factor gains most by becoming 1.",
    )


def first_broken_link(rng):
    photos, lost = pick(rng, 40, 80, 120), rng.integers(1, 8, 4)
    told = ", ".join(f"{step} {n}" for step, n in zip(STEPS, lost, strict=True))
    return number(
        f"Of {photos} photos, the first step that went wrong was: {told}; the others arrived. In "
        "what share of the photos in which seeing (finding, naming, placing) was right did the "
        "hand arrive?",
        (photos - lost.sum()) / (photos - lost[:3].sum()),
        hint="Arrived over those that got as far as moving.",
        tolerance=0.003,
    )


def arrivals_with_a_lesion(rng):
    photos, swapped = pick(rng, 40, 80, 120), between(rng, 0.1, 0.6, 0.05)
    arrive = between(rng, 0.6, 0.95, 0.05)
    return number(
        f"Without names the hand goes for another object in {swapped:.0%} of {photos} photos. In "
        f"the others it arrives in {arrive:.0%}, as before. How many arrivals does one expect?",
        photos * (1 - swapped) * arrive,
        "photos",
        "Photos × (1 - swapped) × arriving",
    )


def interval_of_arrivals(rng):
    n = pick(rng, 40, 80, 120)
    arrived = between(rng, n // 2, n, 1)
    return number(
        f"The hand arrived in {arrived} of {n} photos. How wide is the 95 % interval of that share "
        "(Wilson), from end to end?",
        np.ptp(wilson(arrived, n)),
        hint="The upper end less the lower; z = 1.96.",
        tolerance=0.005,
    )


def median_miss(rng):
    missed = np.round(rng.exponential(6, 7), 1)
    missed[0] = between(rng, 60, 200, 10)
    measure, answer = pick(rng, ("median", np.median(missed)), ("mean", missed.mean()))
    return number(
        f"Seven reaches end {missed.tolist()} mm from their targets. What is the {measure}?",
        answer,
        "mm",
        "One reach for the wrong thing moves the mean, and hardly the median.",
        tolerance=0.1,
    )


def within_a_centimetre(rng):
    missed = np.round(rng.exponential(8, 8), 1)
    without = between(rng, 1, 4, 1)
    return number(
        f"Eight reaches end {missed.tolist()} mm from their targets; in {without} more photo(s) "
        "there was no reach. What share of all photos ended within 1 cm?",
        np.sum(missed <= 10) / (8 + without),
        hint="A photo without a reach counts, and has not arrived.",
        tolerance=0.005,
    )


def reaches_to_count(rng):
    half = pick(rng, 0.05, 0.1, 0.15)
    share = pick(rng, 0.5, 0.6, 0.7, 0.8, 0.9)
    return count(
        f"A share is near {share}. How many photos are needed for a 95 % interval of about ± "
        f"{half} (by p ± 1.96 √(p (1 - p) / n), rounded up)?",
        np.ceil(1.96**2 * share * (1 - share) / half**2 - 1e-9),
        "photos",
        "n = 1.96² p (1 - p) / half²",
    )
