"""Does learning name the crops? The CDBN beside networks whose filters no lesson made.

Both layers' filters are drawn at random, as strong as the learnt ones; biases, pooling, read-outs
and classifier stay, the crops to learn names from are the same, and the classifier's cost is chosen
on the same validation photos. Every network answers the test photos once.
"""

from dataclasses import replace

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.cdbn_sensitivity import answer_crops
from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, crops_of
from vmc_lib.what.crops import whiten

LEARNT, DRAWS = "learnt", range(6)
LEVELS, ASKED = ("rig", "varied"), ("MP2", "P2")
LESSONS = 20  # photos from whose shuttlecocks a network takes the mean and spread of P1


def random_network(network, pictures, rng):
    """A CDBN as `network`, with Gaussian filters as strong as its own in both layers.

    P1 is standardised by its mean and spread on whitened pictures (n, 1, 200, 200).
    """

    def machine(crbm):
        W = rng.normal(scale=crbm.W.std(), size=crbm.W.shape).astype(np.float32)
        return crbm.with_filters(W)

    first, second = map(machine, (network.first, network.second))
    p1 = first.pooled(first.trim(pictures))
    mean, spread = float(p1.mean()), float(p1.std())
    return replace(network, first=first, second=second, mean=mean, spread=spread)


def draw_network(draw, folder=photos.FOLDER):
    """The `random_network` of this number."""
    crops, positive = crops_of(photos.load("rig", "train", folder)[:LESSONS])
    rng = np.random.default_rng(draw)
    return random_network(CDBN.load(), whiten(crops[positive]), rng)


def answers(draw, folder=photos.FOLDER, levels=LEVELS):
    """Probabilities (crops,) that the test photos' crops are shuttlecocks: "level/read-out" -> p.

    Of the network that ships (LEARNT), or of a random one, by its number.
    """
    network = CDBN.load() if draw == LEARNT else draw_network(draw, folder)
    found = {}
    for level in levels:
        asked = answer_crops(network, level, folder, folder, ASKED)
        found |= {f"{level}/{name}": np.float32(test) for name, (_, (test, _)) in asked.items()}
    return found


def make(folder=photos.FOLDER, draws=DRAWS):
    """What `results/random_filters.npz` holds: "level/read-out" -> (1 + draws, crops).

    The learnt network's answers come first.
    """
    rows = Parallel()(delayed(answers)(draw, folder) for draw in (LEARNT, *draws))
    return {key: np.array([row[key] for row in rows]) for key in rows[0]}


def right_by_network(level, read_out="MP2"):
    """Which test crops of a level the networks name right: learnt (crops,), random (draws, crops).

    And which of them are shuttlecocks, (crops,).
    """
    _, truth = crops_of(photos.load(level, "test"))
    learnt, *random = (arrays("random_filters")[f"{level}/{read_out}"] > 0.5) == truth
    return learnt, np.array(random), truth
