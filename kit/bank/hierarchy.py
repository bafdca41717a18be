"""The hierarchy: widths, windows and numbers, layer by layer."""

import numpy as np
import torch

from kit.question import between, choice, count, number, pick
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.learning import Learner


def _network(n_w, maps=2):
    """Two layers of filters so wide, without knowledge, on the book's blocks of two."""
    zeros = torch.zeros
    first = Learner(zeros(maps, 1, n_w, n_w), zeros(maps), zeros(1))
    return CDBN(first, Learner(zeros(maps, maps, n_w, n_w), zeros(maps), zeros(maps)), 0.0, 1.0)


def _chain(rng):
    return between(rng, 60, 160, 10), between(rng, 4, 11, 1)


def width_of_a_layer(rng):
    (width, n_w), layer = _chain(rng), pick(rng, "P1", "H2", "P2")
    return count(
        f"A crop is {width} pixels wide. Both layers have filters {n_w} wide and blocks of 2; a "
        f"row or column that fills no block is trimmed before each. How wide is {layer}?",
        _network(n_w).layers(torch.zeros(1, 1, width, width))[layer].shape[-1],
        "units",
        "Filter: n - n_w + 1. Trim to an even width. Pool: half of it. Then again.",
    )


def window_of_a_unit(rng):
    n_w, c, shift = between(rng, 4, 14, 1), pick(rng, 2, 3, 4), pick(rng, "P1", "one H1")
    pooled = shift == "P1"
    return count(
        f"Filters are {n_w} pixels wide, blocks {c} units. How wide is the patch that the "
        f"filter(s) of {shift} unit lie on{', all units of its block together' if pooled else ''}?",
        n_w + (c - 1) * pooled,
        "pixels",
        "Neighbouring windows are one pixel apart.",
    )


def window_of_the_second_layer(rng):
    n_w, second, c = between(rng, 4, 12, 1), between(rng, 3, 10, 1), pick(rng, 2, 3)
    return count(
        f"First-layer filters are {n_w} pixels wide, blocks {c} units, second-layer filters "
        f"{second} units. How wide is the patch of the picture under one second-layer filter "
        "(without competition in its own block)?",
        (second - 1) * c + n_w + c - 1,
        "pixels",
        "Its pooled units lie c pixels apart, and each sees n_w + c - 1.",
    )


def weights_of_the_second_layer(rng):
    maps, second, n_w = between(rng, 4, 20, 2), between(rng, 4, 40, 4), between(rng, 4, 10, 1)
    machine = Learner.random(second, maps, n_w, torch.Generator().manual_seed(0))
    return count(
        f"The first layer has {maps} maps; the second has {second} filters of {n_w} × {n_w} units "
        "on all of them. How many weights has the second layer, biases not counted?",
        machine.W.numel(),
        "weights",
        "K2 × K1 × n_w²",
    )


def mean_map(rng):
    units = np.round(rng.uniform(0, 1, 5), 1)
    return number(
        f"At one place, five P2 maps have the activities {units.tolist()}. What is MP2 there "
        "(Eq. 2)?",
        units.mean(),
        hint="The mean over the maps.",
        tolerance=0.005,
    )


def what_the_mean_forgets(rng):
    first, second = rng.permutation(np.arange(1, 10))[:2] / 10
    third = round(float(first + pick(rng, 0.05, -0.05)), 2)
    pairs = {
        "swapped": f"({second}, {first})",
        "first changed": f"({third}, {second})",
        "second changed": f"({first}, {round(second + 0.05, 2)})",
    }
    return choice(
        f"Two P2 maps have the activities ({first}, {second}) at one place. Which other pair can "
        "MP2 not tell from it?",
        pairs.values(),
        pairs["swapped"],
        "The mean is the same whichever map is active.",
    )


def numbers_of_a_read_out(rng):
    maps, parts = between(rng, 4, 40, 2), pick(rng, 2, 3, 4)
    width = between(rng, 20, 60, 4)
    what, answer = pick(
        rng,
        (f"mean of each of {parts} × {parts} parts of every map", maps * parts**2),
        ("mean over the maps, place by place", width**2),
    )
    return count(
        f"There are {maps} P2 maps of {width} × {width}. A read-out takes the {what}. How many "
        "features is that?",
        answer,
        "features",
        "Count what is left after taking the mean.",
    )


def standardised(rng):
    mean, spread = between(rng, 0.02, 0.2, 0.02), between(rng, 0.05, 0.3, 0.05)
    unit = between(rng, 0, 0.8, 0.1)
    return number(
        f"Over the training crops, P1 has the mean {mean} and the standard deviation {spread}. "
        f"What does the second layer see of a unit at {unit}?",
        (unit - mean) / spread,
        hint="Less the mean, over the spread.",
        tolerance=0.01,
    )


def steps_between_windows(rng):
    c, layers = pick(rng, 2, 3, 4), pick(rng, 1, 2, 3)
    return count(
        f"Each of {layers} layer(s) pools blocks of {c} × {c}. How many pixels of the picture lie "
        "between the windows of two neighbouring pooled units of the last layer?",
        c**layers,
        "pixels",
        "Each pooling multiplies the step by c.",
    )
