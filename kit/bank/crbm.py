"""Questions on one CRBM: the sizes of its maps, its blocks, its energy, its learning."""

import numpy as np
import torch

from kit.bank.drawing import bars
from kit.question import choice, count, numeric, picture, steps, tenths
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


UNITS = "unit A", "unit B", "unit C", "unit D"


def chances(drives):
    """Chances of the five states of a block, (5,): of its units, and that all are off."""
    units, pooled = block(drives.tolist())
    return np.array([*units, 1 - pooled]).round(2)


def four_chances(axes, drives):
    """Five bars, one hidden. Unit A: {p[0]:.2f}; unit B: hidden; unit C: {p[2]:.2f}; unit D:
    {p[3]:.2f}; all off: {p[4]:.2f}."""
    shown = chances(drives)
    shown[1] = np.nan
    bars(axes, dict(zip((*UNITS, "all off"), shown, strict=True)), "chance", "{:.2f}")


@picture(four_chances)
@numeric(hint="One of the five states it is: their chances add up to 1.", tolerance=0.01)
def hidden_chance(drives=tenths(-1, 2.5, 4)):
    """The five states of a block of four units, and how likely each is. What is the chance of unit
    B?"""
    p = chances(drives)
    return 1 - np.delete(p, 1).sum(), {"p": p}


def five_chances(axes, drives):
    """Five bars. Units A to D: {p[0]:.2f}, {p[1]:.2f}, {p[2]:.2f}, {p[3]:.2f}; all off:
    {p[4]:.2f}."""
    bars(axes, dict(zip((*UNITS, "all off"), chances(drives), strict=True)), "chance", "{:.2f}")


@picture(five_chances)
@numeric(hint="The logarithm of its chance over that of all off, whose drive is 0.", tolerance=0.12)
def drive_from_chances(drives=tenths(0.3, 2, 4), k=range(4)):
    """The five states of a block of four units, and how likely each is. Which drive does {unit}
    receive?"""
    p = chances(drives)
    return np.log(p[k] / p[4]), {"p": p, "unit": UNITS[k]}


TRICKS = ("whitening", "sparsity")
RUNS = [(1, 1), (1, 0), (0, 1), (0, 0)]  # with each trick (1) or without it


def four_runs(axes, order, scores):
    """Four runs and how many of their filters became edges: {runs}."""
    words = ["\n+ ".join(np.array(TRICKS)[np.array(RUNS[k], bool)]) or "neither" for k in order]
    names = [f"{name}:\n{text}" for name, text in zip("ABCD", words, strict=True)]
    bars(axes, dict(zip(names, scores[order], strict=True)), "filters that are edges (%)")


@picture(four_runs)
@choice(
    "{pairs[0]}",
    "{pairs[1]}",
    "{pairs[2]}",
    hint="They differ in this one thing, and both have the other trick.",
)
def runs_to_compare(
    order=lambda rng: rng.permutation(4),
    scores=lambda rng: np.sort(rng.choice(np.arange(5, 95), 4, replace=False))[::-1],
    trick=(0, 1),
):
    """Filters were learnt four times. Which two runs say what {what} adds to a network that has
    the other trick already?"""
    name = dict(zip(order.tolist(), "ABCD", strict=True))
    without = 2 - trick  # the run that has only the other trick
    pairs = [" and ".join(sorted((name[0], name[k]))) for k in (without, trick + 1, 3)]
    said = (f"{n}: {RUNS[k]}, {scores[k]} %" for n, k in zip("ABCD", order, strict=True))
    runs = f"(whitening, sparsity), 1 for with; {'; '.join(said)}"
    return 0, {"pairs": pairs, "what": TRICKS[trick], "runs": runs}
