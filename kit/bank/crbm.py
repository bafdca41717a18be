"""Questions on one CRBM: the sizes of its maps, its blocks, its energy, its learning."""

import numpy as np
import torch

from kit.question import count, numeric, steps, tenths
from vmc_lib.what.learning import Learner

WIDTH, N_W = steps(60, 240, 1), steps(5, 15, 1)


def map_widths(width, n_w, c):
    """The widths of the hidden and the pooled map of a picture, trimmed to whole blocks."""
    crbm = Learner(torch.zeros(1, 1, n_w, n_w), torch.zeros(1), torch.zeros(1), c)
    maps = crbm.posterior(crbm.trim(torch.zeros(1, 1, width, width)))
    return tuple(each.shape[-1] for each in maps)


def block(drives):
    """Probabilities in one block of 2 × 2 units that receive these drives: units', pooled."""
    crbm = Learner(torch.ones(1, 1, 1, 1), torch.zeros(1), torch.zeros(1), 2)
    on, pooled = crbm.posterior(torch.tensor(drives).reshape(1, 1, 2, 2))
    return on.ravel().numpy(), pooled.item()


@count("units", "n_v - n_w + 1")
def hidden_width(width=WIDTH, n_w=N_W):
    """A filter of {n_w} × {n_w} pixels is laid on a picture of {width} × {width}, wherever it fits.
    How wide is the hidden map?"""
    return map_widths(width, n_w, 1)[0]  # blocks of one unit trim nothing


@count("units", "The hidden width over the block's, rounded down.")
def pooled_width(width=WIDTH, n_w=N_W, c=(3, 4, 5)):
    """A picture is {width} pixels wide, filters are {n_w} wide and blocks {c} units. What fills no
    whole block is trimmed. How wide is the pooled map?"""
    return map_widths(width, n_w, c)[1]


@count("numbers", "K × channels × n_w² + K + channels")
def numbers_to_learn(maps=steps(4, 40, 2), channels=(1, 3, 10), n_w=N_W):
    """A CRBM has {maps} filters of {n_w} × {n_w} on pictures whose number of channels is
    {channels}, a bias for every hidden map and one for every channel. How many numbers does it
    learn?"""
    crbm = Learner.random(maps, channels, n_w, torch.Generator().manual_seed(0))
    return crbm.W.numel() + crbm.b.numel() + crbm.a.numel()


@numeric(hint="A softmax over five: the four drives, and 0 for the state in which all are off.")
def unit_in_a_block(drives=tenths(-2, 2, 4), k=range(4)):
    """The four units of a block receive the drives {drives}. With what probability is the unit with
    the drive {drive} on?"""
    return block(drives.tolist())[0][k], {"drive": drives[k]}


@numeric(hint="1 less the probability that all are off.")
def pooled_unit(drives=tenths(-2, 2, 4)):
    """The four units of a block receive the drives {drives}. With what probability is the pooled
    unit on?"""
    return block(drives.tolist())[1]


@count("states", "c² + 1 for each block, multiplied.")
def states_of_a_map(blocks=steps(2, 4, 1), c=(2, 3, 4)):
    """A hidden map has {blocks} blocks of {c} × {c} units, in each of which at most one may be
    on. How many states may the map be in?"""
    return (c**2 + 1) ** blocks


def small_matrix(rng):
    return rng.integers(-2, 3, (2, 2)).astype(np.float32)


@numeric(hint="Multiply number by number, add, and add the bias.", tolerance=0.01)
def drive_of_a_unit(patch=small_matrix, filter_=small_matrix, bias=steps(-2, 2, 0.5)):
    """A filter with the rows {filter_} is laid on a patch with the rows {patch}; the hidden bias is
    {bias}. What drive does the unit get?"""
    patch, filter_ = (torch.tensor(matrix)[None, None] for matrix in (patch, filter_))
    return Learner(filter_, torch.tensor([bias]), torch.zeros(1), 1).preactivation(patch).item()


@numeric(hint="-h (w v + b) + v²/2", tolerance=0.005)
def energy_of_a_pair(
    v=steps(-2, 2, 0.5, zero=1.0),
    w=steps(-2, 2, 0.5, zero=1.0),
    h=(0, 1),
    bias=steps(-1, 1, 0.5),
):
    """A CRBM has one pixel v = {v}, one hidden unit h = {h}, the weight {w} between them, the
    hidden bias {bias} and the visible bias 0. What is its energy (Eq. 1)?"""
    crbm = Learner(torch.full((1, 1, 1, 1), w), torch.tensor([bias]), torch.zeros(1), 1)
    one = torch.ones(1, 1, 1, 1)
    return crbm.energy(v * one, h * one).item()


@numeric(hint="exp(-E1) / exp(-E2)")
def ratio_of_probabilities(low=steps(-4, 2, 0.5), gap=steps(0.5, 3, 0.5)):
    """One state of a CRBM has the energy {low}, another {high}. How many times as likely is the
    first as the second?"""
    return np.exp(gap), {"high": low + gap}


@numeric(hint="rate × (data - dream)", tolerance=1e-4)
def step_of_learning(
    data=steps(0.2, 0.9, 0.05), dream=steps(0.1, 0.8, 0.05), rate=(0.05, 0.1, 0.2)
):
    """A pixel and a hidden unit go together by {data} in the data and by {dream} in the machine's
    dream. By how much does their weight change at a rate of {rate} (contrastive divergence, without
    decay or momentum)?"""
    return rate * (data - dream)
