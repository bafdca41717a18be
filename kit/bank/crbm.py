"""One CRBM: the sizes of its maps, its blocks, its energy, its learning."""

import numpy as np
import torch

from kit.question import between, count, number, pick
from vmc_lib.what.learning import Learner


def _blank(width, n_w, c, maps=1):
    """A machine of zeros and a blank picture, trimmed to whole blocks."""
    crbm = Learner(torch.zeros(maps, 1, n_w, n_w), torch.zeros(maps), torch.zeros(1), c)
    return crbm, crbm.trim(torch.zeros(1, 1, width, width))


def _block(drives):
    """Probabilities in one block of 2 × 2 units that receive these drives: units', pooled."""
    crbm = Learner(torch.ones(1, 1, 1, 1), torch.zeros(1), torch.zeros(1), 2)
    on, pooled = crbm.posterior(torch.tensor(drives).reshape(1, 1, 2, 2))
    return on.ravel().numpy(), pooled.item()


def _sizes(rng):
    return between(rng, 60, 240, 1), between(rng, 5, 15, 1), pick(rng, 3, 4, 5)


def _drives(rng):
    return np.round(rng.uniform(-2, 2, 4), 1).tolist()


def hidden_width(rng):
    width, n_w, _ = _sizes(rng)
    crbm, picture = _blank(width, n_w, 1)
    return count(
        f"A filter of {n_w} × {n_w} pixels is laid on a picture of {width} × {width}, wherever it "
        "fits. How wide is the hidden map?",
        crbm.posterior(picture)[0].shape[-1],
        "units",
        "n_v - n_w + 1",
    )


def pooled_width(rng):
    width, n_w, c = _sizes(rng)
    crbm, picture = _blank(width, n_w, c)
    return count(
        f"A picture is {width} pixels wide, filters are {n_w} wide and blocks {c} units. What "
        "fills no whole block is trimmed. How wide is the pooled map?",
        crbm.posterior(picture)[1].shape[-1],
        "units",
        "The hidden width over the block's, rounded down.",
    )


def numbers_to_learn(rng):
    maps, channels, n_w = between(rng, 4, 40, 2), pick(rng, 1, 3, 10), between(rng, 5, 15, 1)
    machine = Learner.random(maps, channels, n_w, torch.Generator().manual_seed(0))
    return count(
        f"A CRBM has {maps} filters of {n_w} × {n_w} on {channels} channel(s), a bias for every "
        "hidden map and one for every channel. How many numbers does it learn?",
        machine.W.numel() + machine.b.numel() + machine.a.numel(),
        "numbers",
        "K × channels × n_w² + K + channels",
    )


def unit_in_a_block(rng):
    drives, k = _drives(rng), between(rng, 0, 3, 1)
    return number(
        f"The four units of a block receive the drives {drives}. With what probability is the unit "
        f"with the drive {drives[k]} on?",
        _block(drives)[0][k],
        hint="A softmax over five: the four drives, and 0 for the state in which all are off.",
    )


def pooled_unit(rng):
    drives = _drives(rng)
    return number(
        f"The four units of a block receive the drives {drives}. With what probability is the "
        "pooled unit on?",
        _block(drives)[1],
        hint="1 less the probability that all are off.",
    )


def states_of_a_map(rng):
    blocks, c = between(rng, 1, 4, 1), pick(rng, 2, 3, 4)
    return count(
        f"A hidden map has {blocks} block(s) of {c} × {c} units, in each of which at most one may "
        "be on. How many states may the map be in?",
        (c**2 + 1) ** blocks,
        "states",
        "c² + 1 for each block, multiplied.",
    )


def drive_of_a_unit(rng):
    patch, filter_ = (torch.tensor(rng.integers(-2, 3, (1, 1, 2, 2))).float() for _ in range(2))
    bias = between(rng, -2, 2, 0.5)
    crbm = Learner(filter_, torch.tensor([bias]), torch.zeros(1), 1)
    return number(
        f"A filter with the rows {filter_[0, 0].tolist()} is laid on a patch with the "
        f"rows {patch[0, 0].tolist()}; the hidden bias is {bias}. What drive does the unit get?",
        crbm.drive(patch).item(),
        hint="Multiply number by number, add, and add the bias.",
        tolerance=0.01,
    )


def energy_of_a_pair(rng):
    v, w = between(rng, -2, 2, 0.5) or 1.0, between(rng, -2, 2, 0.5) or 1.0
    on, bias = pick(rng, 0, 1), between(rng, -1, 1, 0.5)
    crbm = Learner(torch.full((1, 1, 1, 1), w), torch.tensor([bias]), torch.zeros(1), 1)
    energy = crbm.energy(torch.full((1, 1, 1, 1), v), torch.full((1, 1, 1, 1), float(on)))
    return number(
        f"A CRBM has one pixel v = {v}, one hidden unit h = {on}, the weight {w} between them, the "
        f"hidden bias {bias} and the visible bias 0. What is its energy (Eq. 1)?",
        energy.item(),
        hint="-h (w v + b) + v²/2",
        tolerance=0.005,
    )


def ratio_of_probabilities(rng):
    low, gap = between(rng, -4, 2, 0.5), between(rng, 0.5, 3, 0.5)
    return number(
        f"One state of a CRBM has the energy {low}, another {low + gap}. How many times as likely "
        "is the first as the second?",
        np.exp(gap),
        hint="exp(-E1) / exp(-E2)",
    )


def step_of_learning(rng):
    data, dream = between(rng, 0.2, 0.9, 0.05), between(rng, 0.1, 0.8, 0.05)
    rate = pick(rng, 0.05, 0.1, 0.2)
    return number(
        f"A pixel and a hidden unit go together by {data} in the data and by {dream} in the "
        f"machine's dream. By how much does their weight change at a rate of {rate} (contrastive "
        "divergence, without decay or momentum)?",
        rate * (data - dream),
        hint="rate × (data - dream)",
        tolerance=1e-4,
    )
