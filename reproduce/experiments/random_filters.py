"""Does learning name the crops? The CDBN beside networks whose filters no lesson made.

Both layers' filters are drawn at random, as strong as the learnt ones, and each map's bias is set
so that it is on as often as the learnt maps are. Pooling, read-outs and classifier stay, the crops
to learn names from are the same, and the classifier's cost is chosen on the same validation photos.
Every network answers the test photos once.
"""

from dataclasses import replace
from itertools import product

import numpy as np
from joblib import Parallel, delayed
from scipy.optimize import brentq

from reproduce.experiments.cdbn_sensitivity import answer_crops
from reproduce.experiments.other_filters import smooth, with_scaled_filters
from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, crops_of
from vmc_lib.what.crbm import CRBM
from vmc_lib.what.crops import whiten

KINDS, DRAWS = {"noise": np.asarray, "smoothed noise": smooth}, range(6)
LEVELS, ASKED = ("rig", "varied"), ("MP2", "P2")
LESSONS = 20  # photos from whose shuttlecocks a network takes its biases, and the spread of P1


def random_network(network, pictures, rng, kind="noise"):
    """A CDBN as `network`, with Gaussian filters as strong as its own in both layers, of KINDS.

    On whitened pictures (n, 1, 200, 200) its maps are on as often, and its P1 is standardised.
    """

    def machine(crbm, v, share):
        W = KINDS[kind](rng.normal(size=crbm.W.shape))
        return with_activity(with_scaled_filters(crbm, W), v, share)

    learnt = network.pooled(pictures)
    v = network.first.trim(pictures)
    first = machine(network.first, v, learnt[0].mean())
    p1 = first.pooled(v)
    found = replace(network, first=first, mean=float(p1.mean()), spread=float(p1.std()))
    second = machine(network.second, found.standardised_p1(p1), learnt[1].mean())
    return replace(found, second=second)


def with_activity(crbm, v, share):
    """The CRBM with biases for which each map's pooled units are on in a `share` of v, the mean.

    A bias greater by Δ multiplies the odds of each block by exp(Δ): one look at v is enough.
    """
    on = crbm.pooled(v).astype(float)
    with np.errstate(divide="ignore"):
        odds = on / (1 - on)

    def excess(shift, k):
        return (1 - 1 / (1 + np.exp(shift) * odds[:, k])).mean() - share

    shifts = [brentq(excess, -50, 50, args=(k,)) for k in range(len(crbm.b))]
    return CRBM(crbm.W, (crbm.b + shifts).astype(crbm.b.dtype), crbm.a, crbm.c)


def draw_network(draw, kind="noise", folder=photos.FOLDER):
    """The `random_network` of this number."""
    crops, positive = crops_of(photos.load("rig", "train", folder)[:LESSONS])
    rng = np.random.default_rng(draw)
    return random_network(CDBN.load(), whiten(crops[positive]), rng, kind)


def answers(network, folder=photos.FOLDER, levels=LEVELS):
    """Probabilities (crops,) that test crops are shuttlecocks: "level/read-out" -> chances."""
    found = {}
    for level in levels:
        asked = answer_crops(network, level, folder, folder, ASKED)
        found |= {f"{level}/{name}": np.float32(test) for name, (_, (test, _)) in asked.items()}
    return found


def answers_of_draw(draw, kind, folder=photos.FOLDER, levels=LEVELS):
    """The `answers` of one random network."""
    return answers(draw_network(draw, kind, folder), folder, levels)


def make(folder=photos.FOLDER, draws=DRAWS):
    """What `results/random_filters.npz` holds: "kind/level/read-out" -> (draws, crops).

    And "learnt/level/read-out" -> (crops,) of the network that ships.
    """
    cases = list(product(KINDS, draws))
    first, *rows = Parallel()(
        [
            delayed(answers)(CDBN.load(), folder),
            *(delayed(answers_of_draw)(draw, kind, folder) for kind, draw in cases),
        ]
    )
    found = {f"learnt/{key}": chances for key, chances in first.items()}
    for kind in KINDS:
        own = [row for row, (each, _) in zip(rows, cases, strict=True) if each == kind]
        found |= {f"{kind}/{key}": np.array([row[key] for row in own]) for key in first}
    return found


def right_by_network(level, read_out="MP2", kind="noise"):
    """Which test crops of a level the networks name right: learnt (crops,), random (draws, crops).

    And which of them are shuttlecocks, (crops,).
    """
    _, truth = crops_of(photos.load(level, "test"))
    asked, kept = f"{level}/{read_out}", arrays("random_filters")
    learnt, random = ((kept[f"{name}/{asked}"] > 0.5) == truth for name in ("learnt", kind))
    return learnt, random, truth
