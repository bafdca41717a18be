"""Questions on seeing and reaching: a chain of steps, where it breaks, and how sure a count is."""

import numpy as np

from kit.bank.drawing import intervals
from kit.question import choice, count, numeric, picture, steps, successes
from vmc_lib.statistics import wilson

STEPS = ("finding", "naming", "placing", "moving")
PHOTOS = (40, 80, 120)


@numeric(hint="Probabilities multiply.", tolerance=0.003)
def chain_of_links(right=steps(0.8, 0.98, 0.02), links=steps(2, 6, 1)):
    """A chain has {links} links, each right with probability {right}, whatever became of the
    others. With what probability does the whole chain work?"""
    return right**links


@numeric(hint="The root: whole to the power 1 / links.", tolerance=0.002)
def how_good_each_link(whole=(0.5, 0.7, 0.8, 0.9, 0.95), links=steps(2, 6, 1)):
    """{links} independent links, all equally good, should work together in {whole:.0%} of all
    cases. How often must each be right?"""
    return whole ** (1 / links)


@numeric(hint="Probabilities multiply.", tolerance=0.003)
def unequal_links(right=lambda rng: np.round(rng.uniform(0.8, 1, 4), 2)):
    """Each step is right with the probability: finding {right[0]}, naming {right[1]}, placing
    {right[2]}, moving {right[3]}; independently. In what share of the photos does the hand
    arrive?"""
    return right.prod()


@choice(*STEPS, hint="The whole is the product; the smallest factor gains most by becoming 1.")
def link_to_mend(right=lambda rng: 0.8 + 0.01 * rng.permutation(19)[:4]):
    """Each step is right with the probability: finding {right[0]:.2f}, naming {right[1]:.2f},
    placing {right[2]:.2f}, moving {right[3]:.2f}; independently. Which one, made perfect, would
    help the whole chain most?"""
    return right.argmin()


@numeric(hint="Arrived over those that got as far as moving.", tolerance=0.003)
def first_broken_link(photos=PHOTOS, lost=lambda rng: rng.integers(1, 8, 4)):
    """Of {photos} photos, the first step that went wrong was: finding {lost[0]}, naming {lost[1]},
    placing {lost[2]}, moving {lost[3]}; the others arrived. In what share of the photos in which
    seeing (finding, naming, placing) was right did the hand arrive?"""
    return (photos - lost.sum()) / (photos - lost[:3].sum())


@numeric("photos", "Photos × (1 - swapped) × arriving")
def arrivals_with_a_lesion(
    photos=PHOTOS, swapped=steps(0.1, 0.6, 0.05), arrive=steps(0.6, 0.95, 0.05)
):
    """Without names the hand goes for another object in {swapped:.0%} of {photos} photos. In the
    others it arrives in {arrive:.0%}, as before. How many arrivals does one expect?"""
    return photos * (1 - swapped) * arrive


@numeric(hint="The upper end less the lower; z = 1.96.", tolerance=0.005)
def interval_of_arrivals(arrived=successes(PHOTOS)):
    """The hand arrived in {arrived[0]} of {arrived[1]} photos. How wide is the 95 % interval of
    that share (Wilson), from end to end?"""
    return np.ptp(wilson(*arrived))


def misses_with_an_outlier(rng):
    misses = np.round(rng.exponential(6, 7), 1)
    misses[0] = steps(60, 200, 10)[rng.integers(15)]
    return misses


@numeric(
    "mm", "One reach for the wrong thing moves the mean, and hardly the median.", tolerance=0.1
)
def median_miss(misses=misses_with_an_outlier):
    """Seven reaches end {misses} mm from their targets. What is the median?"""
    return np.median(misses)


@numeric(hint="A photo without a reach counts, and has not arrived.", tolerance=0.005)
def within_a_centimetre(
    misses=lambda rng: np.round(rng.exponential(8, 8), 1), without=steps(2, 4, 1)
):
    """Eight reaches end {misses} mm from their targets; in {without} more photos there was no
    reach. What share of all photos ended within 1 cm?"""
    return np.sum(misses <= 10) / (8 + without)


@count("photos", "n = 1.96² p (1 - p) / half²")
def reaches_to_count(half=(0.05, 0.1, 0.15), share=(0.5, 0.6, 0.7, 0.8, 0.9)):
    """A share is near {share}. How many photos are needed for a 95 % interval of about ± {half} (by
    p ± 1.96 √(p (1 - p) / n), rounded up)?"""
    return np.ceil(1.96**2 * share * (1 - share) / half**2 - 1e-9)


def four_counts(rng):
    """Arrivals out of 100: of the whole brain, and of three lesions, one of which does little."""
    whole = rng.integers(70, 90)
    lesions = [whole - rng.integers(2, 6), *whole - rng.integers(25, 50, 2)]
    return np.array([whole, *rng.permutation(lesions)])


def arrivals(axes, counts):
    """Arrivals in 100 photos with 95 % intervals. The whole brain: {counts[0]}; lesion A:
    {counts[1]}; B: {counts[2]}; C: {counts[3]}."""
    names = "whole", "lesion A", "lesion B", "lesion C"
    ends = (wilson(count, 100) for count in counts)
    parts = zip(names, counts, ends, strict=True)
    shares = {name: (low, count / 100, high) for name, count, (low, high) in parts}
    intervals(axes, shares, "share of photos in which the hand arrives")


@picture(arrivals)
@choice("A", "B", "C", hint="So many photos do not tell it from the whole brain.")
def lesion_not_told_apart(counts=four_counts):
    """A whole brain and three lesions, 100 other photos each, with 95 % intervals. Of which lesion
    may one not claim that the part matters, by this result?"""
    return np.argmax(counts[1:])


def links(rng):
    """How often each of four steps works where those before it did, whole and lesioned, (2, 4)."""
    whole = 0.85 + 0.01 * rng.integers(0, 13, 4)
    lesioned = whole + 0.01 * rng.integers(-2, 3, 4)
    lesioned[rng.integers(4)] -= 0.4
    return np.array([whole, lesioned]).round(2)


def two_chains(axes, right):
    """Of the photos in which all steps succeeded up to each step, a share: whole {whole}; with the
    lesion {lesioned}."""
    for row, name in zip(right, ("whole", "lesioned"), strict=True):
        axes.plot(STEPS, row.cumprod(), "o-" if name == "whole" else "s--", label=name)
    axes.set(ylabel="share that works up to here", ylim=(0, 1))
    axes.grid(alpha=0.4)
    axes.legend()


@picture(two_chains)
@choice(*STEPS, hint="From one step to the next, a share is lost: where do the two differ in it?")
def which_link_was_cut(right=links):
    """The share of photos in which this step and all before it work, in a whole brain and in a
    lesioned one. Which step does the lesion hit?"""
    whole, lesioned = right.cumprod(axis=1).round(2)
    return np.argmin(right[1] / right[0]), {"whole": whole, "lesioned": lesioned}


def nine_misses(rng):
    """Nine misses in mm, whole, of which one is far out."""
    return np.array([*rng.choice(np.arange(5, 100, 5), 8, replace=False), rng.integers(120, 200)])


def dots(axes, misses):
    """Nine misses in mm, as dots along a line. In order: {ordered}."""
    axes.plot(misses, np.zeros(9), "o", ms=8, mfc="none")
    axes.set(xlabel="miss (mm)", yticks=[], xticks=np.arange(0, 201, 10))
    axes.tick_params("x", rotation=90)
    axes.grid(alpha=0.4)


@picture(dots)
@numeric(
    "mm", "The fifth of the nine; how far out the last one lies does not matter.", tolerance=1.5
)
def median_of_dots(misses=nine_misses):
    """Nine reaches, a dot each. What is their median miss?"""
    return np.median(misses), {"ordered": np.sort(misses)}
