"""Questions on the hierarchy: widths, windows and numbers, layer by layer."""

import numpy as np
import torch

from kit.bank.drawing import bars, boxes
from kit.question import choice, count, numeric, picture, steps, tenths
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.learning import Learner


def zero_network(n_w, maps=2):
    """Two layers of filters so wide, all 0, on the book's blocks of two."""
    zeros = torch.zeros
    first = Learner(zeros(maps, 1, n_w, n_w), zeros(maps), zeros(1))
    return CDBN(first, Learner(zeros(maps, maps, n_w, n_w), zeros(maps), zeros(maps)), 0.0, 1.0)


@count("units", "Filter: n - n_w + 1. Trim to an even width. Pool: half of it. Then again.")
def width_of_a_layer(width=steps(60, 160, 10), n_w=steps(4, 11, 1), layer=("P1", "H2", "P2")):
    """A crop is {width} pixels wide. Both layers have filters {n_w} wide and blocks of 2; a row or
    column that fills no block is trimmed before each. How wide is {layer}?"""
    return zero_network(n_w).layers(torch.zeros(1, 1, width, width))[layer].shape[-1]


@count("pixels", "Neighbouring windows are one pixel apart.")
def window_of_a_unit(n_w=steps(4, 14, 1), c=(2, 3, 4)):
    """Filters are {n_w} pixels wide, blocks {c} units. How wide is the patch that a P1 unit sees,
    under the filters of all units of its block?"""
    return n_w + c - 1


@count("pixels", "Its pooled units lie c pixels apart, and each sees n_w + c - 1.")
def window_of_the_second_layer(n_w=steps(4, 12, 1), second=steps(3, 10, 1), c=(2, 3)):
    """First-layer filters are {n_w} pixels wide, blocks {c} units, second-layer filters {second}
    units. How wide is the patch of the picture under one second-layer filter (without competition
    in its own block)?"""
    return sides(n_w, second, c)[0]


@count("weights", "K2 × K1 × n_w²")
def weights_of_the_second_layer(maps=steps(4, 20, 2), second=steps(4, 40, 4), n_w=steps(4, 10, 1)):
    """The first layer has {maps} maps; the second has {second} filters of {n_w} × {n_w} units on
    all of them. How many weights has the second layer, biases not counted?"""
    return Learner.random(second, maps, n_w, torch.Generator().manual_seed(0)).W.numel()


@numeric(hint="The mean over the maps.", tolerance=0.005)
def mean_map(units=tenths(0, 1, 5)):
    """At one place, five P2 maps have the activities {units}. What is MP2 there (Eq. 2)?"""
    return units.mean()


@choice(
    "({pair[1]}, {pair[0]})",
    "({third}, {pair[1]})",
    "({pair[0]}, {fourth})",
    hint="The mean is the same whichever map is active.",
)
def what_the_mean_forgets(
    pair=lambda rng: rng.permutation(np.arange(1, 10))[:2] / 10, change=(0.05, -0.05)
):
    """Two P2 maps have the activities ({pair[0]}, {pair[1]}) at one place. Which other pair can MP2
    not tell from it?"""
    first, second = pair.tolist()
    return 0, {"third": round(first + change, 2), "fourth": round(second + 0.05, 2)}


@count("features", "Count what is left after taking the mean.")
def numbers_of_a_read_out(maps=steps(4, 40, 2), parts=(2, 3, 4), width=steps(20, 60, 4), k=(0, 1)):
    """There are {maps} P2 maps of {width} × {width}. A read-out takes the {what}. How many features
    is that?"""
    what = (
        f"mean of each of {parts} × {parts} parts of every map",
        "mean over the maps, place by place",
    )
    return (maps * parts**2, width**2)[k], {"what": what[k]}


@numeric(hint="Less the mean, over the spread.", tolerance=0.01)
def standardised(
    mean=steps(0.02, 0.2, 0.02), spread=steps(0.05, 0.3, 0.05), unit=steps(0, 0.8, 0.1)
):
    """Over the training crops, P1 has the mean {mean} and the standard deviation {spread}. What
    does the second layer see of a unit at {unit}?"""
    return (unit - mean) / spread


@count("pixels", "Each pooling multiplies the step by c.")
def steps_between_windows(c=(2, 3, 4, 5), layers=(2, 3, 4)):
    """Each of {layers} layers pools blocks of {c} × {c}. How many pixels of the picture lie
    between the windows of two neighbouring pooled units of the last layer?"""
    return c**layers


def squares(axes, n_w, second, c, order):
    """Three squares around one point. A is {sides[0]} pixels wide, B {sides[1]}, C {sides[2]}."""
    widths = sides(n_w, second, c)[order]
    named = {n: (-w / 2, -w / 2, w / 2, w / 2) for n, w in zip("ABC", widths, strict=True)}
    boxes(axes, named)


def sides(n_w, second, c):
    """The width of a second filter's window in pixels, and two that it is not, (3,)."""
    return np.array([(second - 1) * c + n_w + c - 1, second * n_w, second + n_w - 1])


@picture(squares)
@choice("A", "B", "C", hint="Its pooled units lie c pixels apart, and each sees n_w + c - 1.")
def window_of_three(
    n_w=(7, 8, 9, 10, 11), second=(5, 6, 7, 8), c=(2, 3), order=lambda rng: rng.permutation(3)
):
    """First-layer filters are {n_w} pixels wide, blocks {c} units, second-layer filters {second}
    units. Which square is the patch of the picture under one second-layer filter?"""
    return int(np.flatnonzero(order == 0)[0]), {"sides": sides(n_w, second, c)[order]}


SHOWN = "V", "H1", "P1", "H2", "P2"


def widths(width, n_w):
    """How wide the layers are, in units, (5,)."""
    layers = zero_network(n_w).layers(torch.zeros(1, 1, width, width))
    return np.array([layers[name].shape[-1] for name in SHOWN], float)


def four_widths(axes, width, n_w):
    """Five bars: V is {w[0]:g} wide, H1 {w[1]:g}, P1 {w[2]:g}, H2 {w[3]:g}; P2 is hidden."""
    shown = widths(width, n_w)
    shown[4] = np.nan
    bars(axes, dict(zip(SHOWN, shown, strict=True)), "width (units)")


@picture(four_widths)
@count("units", "Half of H2: a block is two units wide.")
def next_width(width=steps(60, 160, 4), n_w=(6, 7, 8, 9, 10)):
    """The width of each layer of a network with blocks of two. How wide is P2?"""
    w = widths(width, n_w)
    return int(w[4]), {"w": w}
